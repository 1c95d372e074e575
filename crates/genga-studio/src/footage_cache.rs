//! The reel (参考映像): reference pictures recorded beside the motion. A few are kept in memory. They are read in the
//! background, so that the window never waits.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use egui::{ColorImage, Context, TextureHandle, TextureOptions};

use super::host::{Host, Pictures};
use super::task::{Look, Task};

/// Number of pictures kept in memory: two seconds of them.
const KEPT: usize = 48;
/// Number of pictures read ahead.
const AHEAD: usize = 8;
/// Greatest size of a kept picture. Views are no larger, and memory is limited.
const WITHIN: [usize; 2] = [640, 480];

/// Reference pictures, those in memory and those being read.
#[derive(Default)]
pub(super) struct FrameCache {
    /// Path from which the pictures are listed.
    of: Option<PathBuf>,
    listing: Option<Task<Result<Pictures, String>>>,
    pictures: Option<Pictures>,
    /// Pictures in memory, each with the value of `wishes` when it was last wanted.
    there: BTreeMap<usize, (TextureHandle, u64)>,
    reading: Option<(usize, Task<Result<ColorImage, String>>)>,
    /// Index of the wanted picture; `wishes` counts the requests so far.
    wanted: Option<usize>,
    wishes: u64,
    /// Pictures that cannot be read, so that they are not tried again and again.
    broken: Vec<usize>,
}

impl FrameCache {
    /// Switches to the pictures of another path. Does nothing if the path is unchanged.
    pub(super) fn take_up(&mut self, desk: &Arc<dyn Host>, of: Option<&Path>) {
        if self.of.as_deref() == of {
            return;
        }
        *self = Self { of: of.map(Path::to_owned), ..Self::default() };
        self.listing = of.map(|of| {
            let (desk, of) = (Arc::clone(desk), of.to_owned());
            Task::begin(move || desk.pictures(&of))
        });
    }

    /// Collects what has been read, and starts reading the next picture. Returns messages for the person.
    pub(super) fn receive(&mut self, desk: &Arc<dyn Host>, context: &Context) -> Vec<Told> {
        let mut told = Vec::new();
        match self.listing.as_ref().map(Task::look) {
            Some(Look::Done(Ok(pictures))) => {
                told.extend(pictures.note.clone().map(Told::Note));
                (self.pictures, self.listing) = (Some(pictures), None);
            }
            Some(Look::Done(Err(error))) => {
                told.push(Told::Failure(error));
                self.listing = None;
            }
            Some(Look::BrokeOff) => self.listing = None,
            Some(Look::Waiting) | None => {}
        }
        let Some((at, errand)) = &self.reading else { return told };
        let at = *at;
        match errand.look() {
            Look::Waiting => return told,
            Look::Done(Ok(image)) => {
                let name = format!("picture {at}");
                let texture = context.load_texture(name, image, TextureOptions::LINEAR);
                self.there.insert(at, (texture, self.wishes));
                self.forget();
            }
            Look::Done(Err(error)) => {
                told.push(Told::Failure(error));
                self.broken.push(at);
            }
            Look::BrokeOff => self.broken.push(at),
        }
        self.reading = None;
        self.read_next(desk);
        told
    }

    /// Requests a picture and those after it.
    pub(super) fn want(&mut self, desk: &Arc<dyn Host>, at: Option<usize>) {
        self.wanted = at.filter(|at| *at < self.count());
        if let Some(at) = self.wanted {
            self.wishes += 1;
            let wishes = self.wishes;
            for (_, used) in
                self.there.range_mut(at..=at + AHEAD).map(|(at, kept)| (at, &mut kept.1))
            {
                *used = wishes;
            }
        }
        self.read_next(desk);
    }

    /// The wanted picture. While it is being read, the nearest one before it, else after it.
    pub(super) fn shown(&self) -> Option<&TextureHandle> {
        let wanted = self.wanted?;
        let before = self.there.range(..=wanted).next_back();
        before.or_else(|| self.there.range(wanted..).next()).map(|(_, (texture, _))| texture)
    }

    /// Number of pictures.
    pub(super) fn count(&self) -> usize {
        self.pictures.as_ref().map_or(0, |pictures| pictures.files.len())
    }

    /// Whether anything is being read.
    pub(super) fn is_waiting(&self) -> bool {
        self.listing.is_some() || self.reading.is_some()
    }

    /// Whether the pictures are being listed, or extracted from a video.
    pub(super) fn is_listing(&self) -> bool {
        self.listing.is_some()
    }

    /// Starts reading the first missing picture among those wanted soon. One at a time, to leave cores for other work.
    fn read_next(&mut self, desk: &Arc<dyn Host>) {
        let (Some(wanted), Some(pictures), None) = (self.wanted, &self.pictures, &self.reading)
        else {
            return;
        };
        let is_missing = |at: &usize| !self.there.contains_key(at) && !self.broken.contains(at);
        let soon = wanted..(wanted + AHEAD + 1).min(pictures.files.len());
        let Some(at) = soon.into_iter().find(is_missing) else { return };
        let (desk, file) = (Arc::clone(desk), pictures.files[at].clone());
        self.reading = Some((at, Task::begin(move || desk.picture(&file, WITHIN))));
    }

    /// Drops the pictures that were wanted the longest ago.
    fn forget(&mut self) {
        while self.there.len() > KEPT {
            let oldest = self.there.iter().min_by_key(|(_, (_, used))| *used).map(|(at, _)| *at);
            oldest.and_then(|at| self.there.remove(&at));
        }
    }
}

/// A message about the pictures.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Told {
    Note(String),
    Failure(String),
}

#[cfg(test)]
mod tests {
    use std::sync::Mutex;
    use std::thread;

    use super::*;
    use crate::host::{Export, Exported, Opened};

    /// A desk with pictures of one size, which records every read.
    #[derive(Default)]
    struct Album {
        read: Mutex<Vec<usize>>,
        /// Lock that holds up the reading of a picture.
        gate: Mutex<()>,
    }

    impl Host for Album {
        fn open(&self, _: &Path) -> Result<Opened, String> {
            Err(String::new())
        }

        fn read(&self, _: &Path) -> Result<Option<String>, String> {
            Ok(None)
        }

        fn write(&self, _: &Path, _: &str) -> Result<(), String> {
            Ok(())
        }

        fn remove(&self, _: &Path) -> Result<(), String> {
            Ok(())
        }

        fn export(&self, _: &Path, _: &Export<'_>, _: &dyn Fn(&str)) -> Result<Exported, String> {
            Ok(vec![].into())
        }

        fn pictures(&self, of: &Path) -> Result<Pictures, String> {
            let files = (0..1000).map(|at| of.join(format!("{at}.png"))).collect();
            Ok(Pictures { files, note: None, kept: None })
        }

        fn picture(&self, file: &Path, within: [usize; 2]) -> Result<ColorImage, String> {
            drop(self.gate.lock().unwrap());
            let number = file.file_stem().unwrap().to_str().unwrap().parse().unwrap();
            self.read.lock().unwrap().push(number);
            if number == 7 {
                Err("7 is torn".into())
            } else {
                Ok(ColorImage::filled(within, egui::Color32::RED))
            }
        }
    }

    /// A reel whose pictures are listed, its desk and a context.
    fn reel() -> (FrameCache, Arc<Album>, Arc<dyn Host>, Context) {
        let (album, mut reel, context) =
            (Arc::<Album>::default(), FrameCache::default(), Context::default());
        let desk: Arc<dyn Host> = Arc::clone(&album) as _;
        reel.take_up(&desk, Some(Path::new("take")));
        while reel.is_listing() {
            let told = reel.receive(&desk, &context);
            assert!(told.is_empty());
            thread::yield_now();
        }
        (reel, album, desk, context)
    }

    /// Waits until nothing is being read.
    fn rest(reel: &mut FrameCache, desk: &Arc<dyn Host>, context: &Context) -> Vec<Told> {
        let mut told = vec![];
        while reel.is_waiting() {
            told.extend(reel.receive(desk, context));
            thread::yield_now();
        }
        told
    }

    #[test]
    fn what_is_wanted_is_read_with_those_after_it_and_each_once() {
        let (mut reel, album, desk, context) = reel();
        assert!(reel.shown().is_none(), "nothing is wanted yet");
        reel.want(&desk, Some(20));
        assert!(rest(&mut reel, &desk, &context).is_empty());
        assert_eq!(*album.read.lock().unwrap(), (20..=28).collect::<Vec<_>>());
        assert_eq!(reel.shown().unwrap().name(), "picture 20");
        reel.want(&desk, Some(21));
        rest(&mut reel, &desk, &context);
        assert_eq!(album.read.lock().unwrap().last(), Some(&29));
        assert_eq!(
            (reel.shown().unwrap().name(), album.read.lock().unwrap().len()),
            ("picture 21".into(), 10)
        );
        reel.want(&desk, Some(5000));
        assert!(reel.shown().is_none(), "there are no more");
    }

    #[test]
    fn while_one_is_read_the_one_before_stays_and_nobody_waits() {
        let (mut reel, album, desk, context) = reel();
        reel.want(&desk, Some(100));
        rest(&mut reel, &desk, &context);
        let gate = album.gate.lock().unwrap();
        reel.want(&desk, Some(300));
        reel.receive(&desk, &context);
        assert_eq!(reel.shown().unwrap().name(), "picture 108");
        // Of many pictures wanted meanwhile, only the last is read next.
        (301..340).for_each(|at| reel.want(&desk, Some(at)));
        drop(gate);
        rest(&mut reel, &desk, &context);
        assert_eq!(reel.shown().unwrap().name(), "picture 339");
        let read = album.read.lock().unwrap();
        assert!(!read.contains(&320), "{read:?}");
    }

    #[test]
    fn memory_has_a_bound_and_a_torn_picture_is_said_once() {
        let (mut reel, album, desk, context) = reel();
        let mut told = vec![];
        for at in 0..300 {
            reel.want(&desk, Some(at));
            told.extend(rest(&mut reel, &desk, &context));
            assert!(reel.there.len() <= KEPT);
            assert!(at == 7 || reel.shown().unwrap().name() == format!("picture {at}"));
        }
        assert_eq!(told, [Told::Failure("7 is torn".into())]);
        assert_eq!(album.read.lock().unwrap().len(), 308);
        reel.take_up(&desk, None);
        assert!(reel.shown().is_none() && reel.there.is_empty() && !reel.is_waiting());
    }
}
