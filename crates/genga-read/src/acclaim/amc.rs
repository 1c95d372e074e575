//! Reads the motion (.amc): for each frame one line per bone, with the values of its degrees of freedom.

use std::collections::HashMap;

use super::asf::{Asf, degrees};
use super::lines::{Line, Word, lines};
use genga::error::{Error, Warning};
use genga::motion::bvh::warnings::FRAMES_MISMATCH;

/// Warning that the frame numbers are not consecutive.
pub(super) const NUMBERS: &str = "W_FRAME_NUMBERS";

/// Smallest frame number that is rejected, because no take reaches it.
const MOST_FRAMES: f64 = 1e12;

/// The contents of an `.amc`.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Amc {
    /// The number of the first frame.
    pub(super) first: usize,
    pub(super) frames: usize,
    /// Values of every bone with degrees of freedom, frame after frame, in the order of the skeleton.
    pub(super) values: Vec<f64>,
    /// Whether angles are in degrees, if the file says so.
    pub(super) in_degrees: Option<bool>,
    /// Frames per second, if the file says so.
    pub(super) rate: Option<f64>,
    pub(super) warnings: Vec<Warning>,
}

/// The reader of the lines of an `.amc`.
struct Reader<'a> {
    /// The first column of each bone in a frame, and its number of values.
    columns: HashMap<&'a str, (usize, usize)>,
    width: usize,
    /// Number of bones with degrees of freedom, which is the number of lines in a frame.
    free: usize,
    /// The latest frame, counted from 1, in which each bone had a line; indexed by the bone's first column.
    given: Vec<usize>,
    seen: usize,
    /// The current frame.
    begin: Option<Word<'a>>,
    before: Option<usize>,
    amc: Amc,
}

impl Amc {
    /// Rejects a text that does not begin like a motion, before its skeleton is searched for.
    ///
    /// # Errors
    /// [`Error::Motion`] with line and column if it does not begin like one.
    pub(super) fn check(text: &str) -> Result<(), Error> {
        let first = lines(text).next().ok_or_else(no_frame)?.first();
        if first.text.starts_with(':') || is_frame(&first) {
            return Ok(());
        }
        Err(first.instead_of(":FULLY-SPECIFIED or the number of the first frame"))
    }

    /// Reads the text of a motion for a skeleton.
    ///
    /// # Errors
    /// [`Error::Motion`] with line and column if the text is no motion, or does not fit the skeleton.
    pub(super) fn read(text: &str, asf: &Asf) -> Result<Self, Error> {
        let (mut columns, mut width) = (HashMap::new(), 0);
        for bone in asf.bones.iter().filter(|bone| !bone.freedoms.is_empty()) {
            columns.insert(&bone.name[..], (width, bone.freedoms.len()));
            width += bone.freedoms.len();
        }
        let mut reader = Reader {
            free: columns.len(),
            columns,
            width,
            given: vec![0; width],
            seen: 0,
            begin: None,
            before: None,
            amc: Self {
                first: 0,
                frames: 0,
                values: Vec::new(),
                in_degrees: None,
                rate: None,
                warnings: Vec::new(),
            },
        };
        for line in lines(text) {
            reader.line(&line)?;
        }
        reader.finish()
    }
}

/// Whether a word is a frame number.
fn is_frame(word: &Word<'_>) -> bool {
    word.text.bytes().all(|byte| byte.is_ascii_digit())
}

fn no_frame() -> Error {
    Word { text: "", line: 1, column: 1 }.wrong("there is no frame in this motion")
}

impl<'a> Reader<'a> {
    fn line(&mut self, line: &Line<'a>) -> Result<(), Error> {
        let first = line.first();
        if first.text.starts_with(':') {
            return self.says(line);
        }
        if is_frame(&first) && line.words().nth(1).is_none() {
            return self.begin(first);
        }
        self.bone(line)
    }

    /// Parses a line of the head.
    fn says(&mut self, line: &Line<'_>) -> Result<(), Error> {
        let first = line.first();
        match &first.text.to_ascii_lowercase()[..] {
            ":degrees" | ":radians" => {
                let word = Word { text: &first.text[1..], ..first };
                self.amc.in_degrees = Some(degrees(&word)?);
            }
            ":samples-per-second" => {
                let rate = line.words().nth(1).unwrap_or(line.end());
                self.amc.rate = Some(rate.number()?);
            }
            _ => {}
        }
        Ok(())
    }

    fn begin(&mut self, number: Word<'a>) -> Result<(), Error> {
        if let Some(begin) = self.begin.filter(|_| self.seen < self.free) {
            return Err(begin.wrong(self.lacking()));
        }
        let value = number.number()?;
        if value >= MOST_FRAMES {
            return Err(number.instead_of("the number of a frame"));
        }
        let value = value as usize;
        match self.before {
            None => self.amc.first = value,
            Some(before) if before + 1 != value && self.amc.warnings.is_empty() => {
                let message =
                    format!("frame {value} follows frame {before}: frames are taken as they stand");
                let place = (number.line, number.column);
                self.amc.warnings.push(Warning::at(place, NUMBERS, message));
            }
            Some(_) => {}
        }
        self.before = Some(value);
        self.begin = Some(number);
        self.seen = 0;
        self.amc.frames += 1;
        self.amc.values.resize(self.amc.frames * self.width, 0.0);
        Ok(())
    }

    fn bone(&mut self, line: &Line<'_>) -> Result<(), Error> {
        let name = line.first();
        if self.begin.is_none() {
            return Err(name.instead_of("the number of the first frame"));
        }
        let Some(&(column, width)) = self.columns.get(name.text) else {
            return Err(name.instead_of("a bone of the skeleton that is free to move"));
        };
        if self.given[column] == self.amc.frames {
            return Err(name.wrong(format!("{} is there twice in this frame", name.text)));
        }
        self.given[column] = self.amc.frames;
        self.seen += 1;
        let row = (self.amc.frames - 1) * self.width;
        let mut words = line.words().skip(1);
        for at in 0..width {
            let word = words.next().unwrap_or(line.end());
            self.amc.values[row + column + at] = word.number()?;
        }
        match words.next() {
            Some(word) => Err(word.instead_of("the end of the line")),
            None => Ok(()),
        }
    }

    /// Describes the first bone that the frame lacks.
    fn lacking(&self) -> String {
        let lacks =
            |(_, (column, _)): &(&&str, &(usize, usize))| self.given[*column] != self.amc.frames;
        let mut lacking: Vec<&str> =
            self.columns.iter().filter(lacks).map(|(name, _)| *name).collect();
        lacking.sort_unstable();
        let name = lacking.first().copied().unwrap_or_default();
        format!("this frame has {} of {} bones: it lacks {name}", self.seen, self.free)
    }

    fn finish(mut self) -> Result<Amc, Error> {
        let Some(begin) = self.begin else {
            return Err(no_frame());
        };
        if self.seen < self.free {
            // The file ends early; the complete frames are kept.
            let message = format!("{}; it is left out", self.lacking());
            if self.amc.frames == 1 {
                return Err(begin.wrong(self.lacking()));
            }
            let place = (begin.line, begin.column);
            self.amc.warnings.push(Warning::at(place, FRAMES_MISMATCH, message));
            self.amc.frames -= 1;
            self.amc.values.truncate(self.amc.frames * self.width);
        }
        Ok(self.amc)
    }
}
