//! The quality of a sheet: its drawings compared with the source, and its keys with reference keys.

use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;

use serde::Serialize;

use crate::quality::pops::Pops;
use crate::quality::{Slip, Timing, shown};
use genga::error::Error;
use genga::keys::{DrawnBody, Reconstruction, Reference};
use genga::motion::{Clip, Composite};
use genga::sheet::{Role, Sheet};
use genga::signal::{ContactFinder, Limb};
use genga::time::{Clock, Frame};

/// Error of the body over some koma, in % of its height (root mean square over its points).
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Off {
    /// The mean over the koma.
    pub mean: f64,
    /// The worst koma.
    pub worst: f64,
}

impl Off {
    /// Summarises one error per koma; 0 if there are none.
    pub fn new(errors: Vec<f64>) -> Self {
        let all = Reconstruction { errors };
        Self { mean: all.mean(), worst: all.worst() }
    }
}

/// Number of drawings of a sheet, and their lengths.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Counts {
    /// Number of koma of the sheet.
    pub koma: usize,
    /// Number of drawings on screen.
    pub drawings: usize,
    /// Number of genga among them, without the clip's two ends.
    pub genga: usize,
    /// Drawings per second of the sheet.
    pub drawings_per_second: f64,
    /// Number of exposures by their length in koma.
    pub holds: BTreeMap<usize, usize>,
}

/// The measures of a sheet (評価).
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Evaluation {
    /// The number of drawings.
    pub pace: Counts,
    /// Error of the motion rebuilt by slerp from only the genga and both ends.
    pub keys: Off,
    /// Error on screen: the drawing of each koma compared with the source at that koma.
    pub shown: Off,
    /// How far feet slide in a motion rebuilt from the genga.
    pub keys_slip: Slip,
    /// How far feet slide on screen.
    pub shown_slip: Slip,
    /// Number of hand contacts in the source.
    pub hand_contacts: usize,
    /// Conspicuous steps out of holds.
    pub pops: Pops,
    /// The genga compared with reference keys, if there are some.
    pub timing: Option<Timing>,
}

impl Evaluation {
    /// Measures a sheet of a clip. The screen is judged with all layers composited and the root as on the sheet; keys
    /// and pace are those of the first layer. `reference` are keys by source frame, and `tolerance` is the largest
    /// distance in koma between a key and its reference. Genga are compared by their nearest frames, not by koma. The
    /// ends of the clip do not count, nor do reference keys within its first or last koma, as both drawings are always
    /// there. A reference key that is given twice counts once. [`Evaluation::notes`] tells what does not count.
    ///
    /// # Errors
    /// [`Error::Sheet`] as in [`Sheet::first_layer`], and if a layer has a joint that the clip lacks; [`Error::Clip`]
    /// for a clip without motion; [`Error::Setting`] for a tolerance below 0 or that is not finite.
    ///
    /// ```
    /// # use genga::{edits::Edits, pipeline::Engine, recipe::Recipe};
    /// use genga_lab::quality::Evaluation;
    ///
    /// # let clip = genga::motion::bvh::open("../../data/kick.bvh".as_ref())?.clip;
    /// # let mut engine = Engine::new(clip)?;
    /// let breakdown = engine.run(&Recipe::default(), &Edits::default())?;
    /// let sheet = Evaluation::new(breakdown.clip, breakdown.sheet, None, 1.0)?;
    /// assert_eq!(sheet.pace.drawings, 26);
    /// assert!(sheet.shown.mean < 10.0, "% of body height off, in the mean over koma");
    /// # Ok::<(), genga::Error>(())
    /// ```
    pub fn new(
        clip: &Clip,
        sheet: &Sheet,
        reference: Option<&[Frame]>,
        tolerance: f64,
    ) -> Result<Self, Error> {
        if !(tolerance.is_finite() && tolerance >= 0.0) {
            let message = format!("expected koma, 0 or more, as in 1 or 0.5, found {tolerance}");
            return Err(Error::setting("tolerance", message));
        }
        if clip.is_empty() || clip.skeleton().is_empty() {
            return Err(Error::clip("the clip has no motion: it needs a joint and a frame"));
        }
        if sheet.repeat.is_some() {
            return Err(Error::sheet(
                "a loop does not keep the time of its take, by which sheets are judged; judge one made without --loop",
            ));
        }
        let composite = Composite::new(clip, sheet)?;
        let layer = sheet.first_layer()?;
        let source = Reference::new(clip, sheet.clock);
        let genga = layer.shown().filter(|drawing| drawing.role == Role::Genga);
        let genga = frames(clip, genga.map(|drawing| drawing.source.place()));
        let on_screen: Vec<usize> = composite.layer().koma().collect();
        let koma = on_screen.len().min(source.koma());
        let mut body = DrawnBody::new(clip, &source);
        let contacts = ContactFinder::default().find(clip, sheet.clock);
        let made = shown::slerped(clip, sheet.clock, &genga);
        Ok(Self {
            pace: pace(sheet),
            keys: Off::new(Reconstruction::new(clip, &source, &genga).errors),
            shown: Off::new(shown::errors(&mut body, &composite, &on_screen[..koma])),
            keys_slip: Slip::new(&mut body, sheet.clock, &contacts, &made),
            shown_slip: shown::slip(&mut body, sheet.clock, &contacts, &composite, &on_screen),
            hand_contacts: contacts.iter().filter(|contact| contact.limb == Limb::Hand).count(),
            pops: shown::pops(&mut body, &composite, sheet.clock.koma_rate),
            timing: reference.map(|keys| timing(clip, sheet, &genga, keys, tolerance)),
        })
    }

    /// Says which layer is judged, if there are several, and how many reference keys do not count: those that repeat
    /// others, that are beyond the clip, or that are ends of it and neither a drawing of the sheet's ends nor an end of
    /// the clip.
    pub fn notes(clip: &Clip, sheet: &Sheet, reference: Option<&[Frame]>) -> Vec<String> {
        let mut notes = Vec::new();
        if let [first, _, ..] = &sheet.layers[..] {
            notes.push(format!(
                "of several layers what is on screen is judged together, keys and pace by the first: {}",
                first.name
            ));
        }
        let given = reference.unwrap_or_default();
        let distinct: BTreeSet<Frame> = given.iter().copied().collect();
        match given.len() - distinct.len() {
            0 => {}
            1 => notes.push("1 reference key repeats another one and does not count".into()),
            count => notes.push(format!("{count} reference keys repeat others and do not count")),
        }
        let count_of = |is_of: &dyn Fn(Frame) -> bool| {
            let count = distinct.iter().filter(|frame| is_of(**frame)).count();
            let (noun, verb) = if count == 1 { ("key", "does") } else { ("keys", "do") };
            (count > 0).then(|| (format!("{count} reference {noun}"), verb))
        };
        let (first, last) = (clip.first(), clip.last());
        if let Some((keys, verb)) = count_of(&|frame| !clip.contains(frame)) {
            notes.push(format!(
                "{keys} beyond frames {first} to {last} of the sheet {verb} not count"
            ));
        }
        let inner = inner(clip, sheet.clock);
        let is_drawn = |frame| [first, inner.end, last].contains(&frame);
        if let Some((keys, verb)) =
            count_of(&|frame| clip.contains(frame) && !inner.contains(&frame) && !is_drawn(frame))
        {
            let Range { start, end } = inner;
            notes.push(format!(
                "{keys} before frame {start} or from frame {end} on, in the first or last koma, {verb} not count: \
                 the ends are always drawn"
            ));
        }
        notes
    }
}

/// Returns the frames between the ends of a clip: those after its first koma and before its last.
fn inner(clip: &Clip, clock: Clock) -> Range<Frame> {
    let koma = clip.rate().koma_from_frames(clip.len(), clock.koma_rate);
    // Below the rate of the sheet several koma share a frame.
    let start = clock.frame_from_koma(1).max(Frame(clip.first().0 + 1));
    start..clock.frame_from_koma(koma.saturating_sub(1)).min(clip.last())
}

fn pace(sheet: &Sheet) -> Counts {
    let layer = &sheet.layers[0];
    let mut holds = BTreeMap::new();
    for exposure in &layer.exposures {
        *holds.entry(exposure.koma).or_default() += 1;
    }
    let (koma, drawings) = (layer.length(), layer.shown().count());
    Counts {
        koma,
        drawings,
        genga: layer.genga(),
        drawings_per_second: layer.drawings_per_second(sheet.clock.koma_rate),
        holds,
    }
}

/// Returns the frames nearest to some places, sorted and without duplicates.
fn frames(clip: &Clip, places: impl Iterator<Item = f64>) -> Vec<Frame> {
    let frame = |place: f64| Frame(place.round() as usize).clamp(clip.first(), clip.last());
    let mut frames: Vec<Frame> = places.map(frame).collect();
    frames.sort_unstable();
    frames.dedup();
    frames
}

fn timing(
    clip: &Clip,
    sheet: &Sheet,
    genga: &[Frame],
    reference: &[Frame],
    tolerance: f64,
) -> Timing {
    let inner = inner(clip, sheet.clock);
    let inside = |frames: &[Frame]| -> Vec<Frame> {
        frames.iter().filter(|frame| inner.contains(frame)).copied().collect()
    };
    Timing::new(&inside(genga), &inside(reference), sheet.clock, tolerance)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::quality::tests::swing;
    use genga::sheet::{Drawing, Exposure, Layer, Source, Why};

    /// Builds a sheet whose drawings show these frames for these numbers of koma; the first and last are ends.
    fn sheet(clip: &Clip, shown: &[(f64, usize)]) -> Sheet {
        let last = shown.len() - 1;
        let drawings = shown.iter().enumerate().map(|(at, (place, _))| {
            let role = if at == 0 || at == last { Role::End } else { Role::Genga };
            Drawing::new(Source::At(*place), role, Why::default())
        });
        let exposures = shown.iter().enumerate();
        let exposures = exposures.map(|(drawing, (_, koma))| Exposure { drawing, koma: *koma });
        let layer = Layer {
            name: "A".into(),
            joints: vec![],
            drawings: drawings.collect(),
            exposures: exposures.collect(),
            gone: vec![],
        };
        Sheet::new(clip.clock(24.0), vec![layer])
    }

    fn clip() -> Clip {
        swing(&(0..13).map(|at| 50.0 * (f64::from(at) * 0.5).sin()).collect::<Vec<_>>())
    }

    #[test]
    fn a_sheet_on_ones_shows_the_source() {
        let clip = clip();
        let ones: Vec<_> = (0..13).map(|frame| (f64::from(frame), 1)).collect();
        let found = Evaluation::new(&clip, &sheet(&clip, &ones), None, 1.0).unwrap();
        assert!(found.shown.worst < 1e-12, "{found:?}");
        assert_eq!(found.keys, Off { mean: 0.0, worst: 0.0 }, "every frame is a key");
        assert_eq!((found.pace.drawings, found.pace.genga), (13, 13));
        assert_eq!(found.pace.drawings_per_second, 24.0);
        assert_eq!(found.pace.holds, BTreeMap::from([(1, 13)]));
        assert_eq!((found.pops, found.timing), (Pops::default(), None));
    }

    #[test]
    fn what_is_held_is_off_and_keys_are_judged_by_slerp() {
        let clip = clip();
        let shown = [(0.0, 3), (3.0, 3), (6.0, 3), (9.0, 3), (12.0, 1)];
        let sheet = sheet(&clip, &shown);
        let keys = [Frame(0), Frame(3), Frame(7), Frame(12)];
        let found = Evaluation::new(&clip, &sheet, Some(&keys), 1.0).unwrap();
        let genga = [Frame(3), Frame(6), Frame(9)];
        let source = Reference::new(&clip, sheet.clock);
        let alone = Reconstruction::new(&clip, &source, &genga);
        assert_eq!(found.keys, Off { mean: alone.mean(), worst: alone.worst() });
        assert!(found.shown.mean > 2.0 * found.keys.mean, "{found:?}");
        let step = |a, b| source.apart(a, b);
        let worst = [(0, 2), (3, 5), (6, 8), (9, 11)].map(|(a, b)| step(a, b));
        let worst = worst.into_iter().fold(0.0, f64::max);
        assert!((found.shown.worst - worst).abs() < 1e-9);
        let timing = found.timing.unwrap();
        assert_eq!((timing.reference, timing.found, timing.pairs), (2, 3, 2), "ends do not count");
        assert_eq!(found.pace.holds, BTreeMap::from([(1, 1), (3, 4)]));
    }

    #[test]
    fn what_lies_in_the_first_or_last_koma_is_an_end_and_a_repeated_key_counts_once() {
        // 5 frames are a koma, the last of which begins at frame 10 of 0 to 12.
        let swung = clip();
        let rate = genga::time::FrameRate::new(120.0).unwrap();
        let angles = (0..13).map(f64::from).collect();
        let clip = Clip::new(swung.skeleton().clone(), rate, Frame(0), 13, angles).unwrap();
        let sheet = sheet(&clip, &[(0.0, 1), (5.0, 1), (10.0, 1)]);
        let counted = |keys: &[usize]| {
            let keys: Vec<Frame> = keys.iter().copied().map(Frame).collect();
            let timing = Evaluation::new(&clip, &sheet, Some(&keys), 1.0).unwrap().timing.unwrap();
            let notes = Evaluation::notes(&clip, &sheet, Some(&keys));
            ((timing.reference, timing.found, timing.pairs), notes)
        };
        assert_eq!(counted(&[0, 5, 10, 12]), ((1, 1, 1), vec![]), "its own drawings, and the ends");
        let (counts, notes) = counted(&[4, 5, 9, 11, 99]);
        assert_eq!(counts, (2, 1, 1));
        assert_eq!(notes.len(), 2, "{notes:?}");
        assert!(notes[0].starts_with("1 reference key beyond frames 0 to 12"), "{notes:?}");
        assert!(
            notes[1].starts_with("2 reference keys before frame 5 or from frame 10 on"),
            "{notes:?}"
        );
        let (counts, notes) = counted(&[5, 5]);
        assert_eq!(counts, (1, 1, 1));
        assert_eq!(notes, ["1 reference key repeats another one and does not count"]);
    }

    #[test]
    fn the_step_into_the_drawing_of_the_end_is_no_pop() {
        // The body hardly moves, and then jumps.
        let clip = swing(
            &(0..25).map(|at| if at < 20 { 0.1 * f64::from(at) } else { 60.0 }).collect::<Vec<_>>(),
        );
        let pops = |shown: &[(f64, usize)]| {
            Evaluation::new(&clip, &sheet(&clip, shown), None, 1.0).unwrap().pops
        };
        let end = pops(&[(0.0, 4), (4.0, 4), (8.0, 4), (12.0, 12), (24.0, 1)]);
        assert_eq!((end.holds, end.pops.len()), (3, 0), "{end:?}");
        let before = pops(&[(0.0, 4), (4.0, 4), (8.0, 4), (12.0, 8), (20.0, 4), (24.0, 1)]);
        assert_eq!((before.holds, before.pops.len()), (4, 1), "{before:?}");
    }

    #[test]
    fn a_sheet_without_a_layer_and_a_clip_without_motion_are_refused() {
        let clip = clip();
        let none = Sheet::new(clip.clock(24.0), vec![]);
        assert!(Evaluation::new(&clip, &none, None, 1.0).is_err());
        let empty = swing(&[]);
        let sheet = sheet(&clip, &[(0.0, 12), (12.0, 1)]);
        assert!(Evaluation::new(&empty, &sheet, None, 1.0).is_err());
    }

    #[test]
    fn a_sheet_longer_or_shorter_than_its_clip_is_judged_as_far_as_both_go() {
        let clip = clip();
        let long =
            Evaluation::new(&clip, &sheet(&clip, &[(0.0, 6), (6.0, 20), (12.0, 1)]), None, 1.0);
        assert_eq!(long.unwrap().pace.koma, 27);
        let short =
            Evaluation::new(&clip, &sheet(&clip, &[(0.0, 2), (12.0, 1)]), None, 1.0).unwrap();
        assert!(short.shown.worst > 0.0);
    }
}
