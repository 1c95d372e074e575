//! The answers of a person, as the page saves them.

use csv::{ReaderBuilder, StringRecord};

use crate::conditions::STUCK;
use crate::plan::{Question, SCHEMA};
use genga::error::Error;
use genga::sanitize::text_of;

/// A person's answer to a pair (回答).
#[derive(Debug, Clone, PartialEq)]
pub struct Answer {
    /// The digest that identifies the trial's page.
    pub trial: String,
    /// The person: a random number.
    pub person: String,
    /// The person's own word for what they do with animation; empty if they gave none.
    pub eye: String,
    /// Measured refresh rate of the screen in Hz.
    pub hz: f64,
    /// The share of measured refreshes that came more than a koma after the one before.
    pub slow: f64,
    /// Number of pairs that the person was to see.
    pub of: usize,
    /// The number of this pair, from 1.
    pub number: usize,
    /// The question.
    pub question: Question,
    /// The motion.
    pub clip: String,
    /// The condition that was shown first.
    pub first: String,
    /// The condition shown second.
    pub second: String,
    /// The chosen film.
    pub chosen: Place,
    /// Number of koma of both films together.
    pub koma: usize,
    /// Number of those koma that were never on screen.
    pub dropped: usize,
}

/// A film of a pair.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Place {
    /// The first.
    First,
    /// The second.
    Second,
}

impl Answer {
    /// Returns the chosen condition, and the other one.
    pub fn taken_and_left(&self) -> (&str, &str) {
        match self.chosen {
            Place::First => (&self.first, &self.second),
            Place::Second => (&self.second, &self.first),
        }
    }

    /// Whether the answer belongs to a catch pair.
    pub fn is_catch(&self) -> bool {
        self.first == STUCK || self.second == STUCK
    }

    /// Whether the motionless film was chosen.
    pub fn is_caught(&self) -> bool {
        self.taken_and_left().0 == STUCK
    }

    /// Reads a file of answers.
    ///
    /// # Errors
    /// [`Error::Table`] with the line when the file or a row is not a table of answers.
    pub fn read(bytes: &[u8]) -> Result<Vec<Self>, Error> {
        let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
        let mut table = ReaderBuilder::new().flexible(true).from_reader(bytes);
        let header = table.headers().map_err(no_table)?.clone();
        let mut answers = Vec::new();
        for row in table.records() {
            let row = row.map_err(no_table)?;
            let line = row.position().map_or(1, |place| place.line() as usize);
            answers.push(Row { header: &header, row: &row, line }.answer()?);
        }
        if answers.is_empty() {
            let message = "there is no answer in it: a row for each, as the page saves them";
            return Err(Error::Table { place: None, message: message.into(), source: None });
        }
        Ok(answers)
    }
}

fn no_table(error: csv::Error) -> Error {
    let place = error.position().map(|place| (place.line() as usize, 1));
    let message = "expected a table of answers in UTF-8, as the page saves it".into();
    Error::Table { place, message, source: Some(error.into()) }
}

/// A row with its header.
struct Row<'a> {
    header: &'a StringRecord,
    row: &'a StringRecord,
    line: usize,
}

impl Row<'_> {
    fn answer(&self) -> Result<Answer, Error> {
        let (at, schema) = self.cell("schema")?;
        if schema != SCHEMA {
            let message = format!("schema: expected {SCHEMA}, found \"{schema}\"");
            return Err(self.wrong(at, message));
        }
        let answer = Answer {
            trial: self.word("trial")?,
            person: self.word("person")?,
            eye: self.text("eye")?,
            hz: self.number("hz", "refreshes a second")?,
            slow: self.number("slow", "a share from 0 to 1")?,
            of: self.count("of")?,
            number: self.count("number")?,
            question: self.parsed("question", "anime or use")?,
            clip: self.text("clip")?,
            first: self.word("first")?,
            second: self.word("second")?,
            chosen: self.chosen()?,
            koma: self.count("koma")?,
            dropped: self.count("dropped")?,
        };
        if answer.first == answer.second {
            let message = format!("second: expected another film than \"{}\"", answer.first);
            return Err(self.wrong(self.cell("second")?.0, message));
        }
        if answer.number == 0 || answer.number > answer.of {
            let message = format!("number: expected 1 to {}, found {}", answer.of, answer.number);
            return Err(self.wrong(self.cell("number")?.0, message));
        }
        if answer.dropped > answer.koma {
            let message = format!("dropped: expected {} at the most", answer.koma);
            return Err(self.wrong(self.cell("dropped")?.0, message));
        }
        Ok(answer)
    }

    /// Returns the number of a field, from 1, and its text.
    fn cell(&self, name: &str) -> Result<(usize, &str), Error> {
        let missing = || {
            let message = format!("there is no column {name}: these are no answers of a trial");
            Error::Table { place: Some((1, 1)), message, source: None }
        };
        let at = self.header.iter().position(|own| own == name).ok_or_else(missing)?;
        let cut = || self.wrong(at + 1, format!("{name}: the row ends before it"));
        Ok((at + 1, self.row.get(at).ok_or_else(cut)?))
    }

    fn text(&self, name: &str) -> Result<String, Error> {
        Ok(text_of(self.cell(name)?.1).to_owned())
    }

    /// Returns a non-empty text.
    fn word(&self, name: &str) -> Result<String, Error> {
        let text = self.text(name)?;
        match text.is_empty() {
            true => Err(self.wrong(self.cell(name)?.0, format!("{name}: nothing stands there"))),
            false => Ok(text),
        }
    }

    fn parsed<T: std::str::FromStr>(&self, name: &str, expected: &str) -> Result<T, Error> {
        let (at, text) = self.cell(name)?;
        let wrong = || self.wrong(at, format!("{name}: expected {expected}, found \"{text}\""));
        text.parse().map_err(|_| wrong())
    }

    fn number(&self, name: &str, expected: &str) -> Result<f64, Error> {
        let number: f64 = self.parsed(name, expected)?;
        match number.is_finite() && number >= 0.0 {
            true => Ok(number),
            false => Err(self.wrong(self.cell(name)?.0, format!("{name}: expected {expected}"))),
        }
    }

    fn count(&self, name: &str) -> Result<usize, Error> {
        self.parsed(name, "a whole number")
    }

    fn chosen(&self) -> Result<Place, Error> {
        match self.cell("chosen")? {
            (_, "first") => Ok(Place::First),
            (_, "second") => Ok(Place::Second),
            (at, text) => {
                let message = format!("chosen: expected first or second, found \"{text}\"");
                Err(self.wrong(at, message))
            }
        }
    }

    fn wrong(&self, field: usize, message: String) -> Error {
        Error::Table { place: Some((self.line, field)), message, source: None }
    }
}
