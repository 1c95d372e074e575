//! The number of a drawing on paper (番号): 3, or 3a for one that came between 3 and 4 later.

use std::cmp::Ordering;
use std::fmt;
use std::str::FromStr;

use serde::{Deserialize, Deserializer, Serialize, Serializer, de};

/// The letter that stands before all others and never at the end. There is room before every number because of it.
const BEFORE: char = 'z';
/// The letter that stands after all others.
const LAST: char = 'y';
/// Most digits of a number that is read.
const DIGITS: usize = 9;

/// The number of a drawing on paper: a whole number, with letters for a drawing that came later.
///
/// Numbers ascend as 3 < 3za < 3a < 3aa < 3b < 4: letter by letter, where z comes before a and does not end a number.
///
/// ```
/// use genga::sheet::Number;
///
/// let number = |text: &str| text.parse::<Number>().unwrap();
/// assert_eq!(Number::between(Some(&number("3")), Some(&number("4"))).to_string(), "3a");
/// assert_eq!(format!("{:04}", number("3a")), "0003a");
/// assert!(number("3a") < number("3b"));
/// ```
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub struct Number {
    whole: usize,
    letters: String,
}

impl Number {
    /// Returns a number between two others, of which the first is the smaller one. Without a second it is the next whole
    /// number. Before 1 come 0a, 0b …, since 0 is no number of a drawing.
    pub fn between(before: Option<&Self>, after: Option<&Self>) -> Self {
        let (whole, letters) = before.map_or((0, ""), |before| (before.whole, &before.letters));
        match after {
            None => Self::from(whole + 1),
            Some(after) if after.whole == whole => {
                Self { whole, letters: letters_between(letters, &after.letters) }
            }
            Some(_) => Self { whole, letters: letters_after(letters) },
        }
    }

    /// The number without its letters.
    pub fn whole(&self) -> usize {
        self.whole
    }

    /// The letters behind the whole number; empty for most.
    pub fn letters(&self) -> &str {
        &self.letters
    }
}

/// Returns the shortest letters after some that are the last of their whole number.
fn letters_after(letters: &str) -> String {
    let mut kept = letters.to_owned();
    match kept.pop() {
        None => "a".into(),
        Some(LAST) => kept + "ya",
        Some(letter) => {
            kept.push(char::from(letter as u8 + 1));
            kept
        }
    }
}

/// Returns letters between two, of which the first are the smaller ones.
fn letters_between(before: &str, after: &str) -> String {
    let next = letters_after(before);
    if rank(&next).lt(rank(after)) {
        return next;
    }
    // Nothing is left between neighbours, so the new letters go on from one of them: from the earlier one unless the
    // later one does so already.
    match after.strip_prefix(before) {
        None => before.to_owned() + "a",
        Some(rest) => before.to_owned() + &letters_before(rest),
    }
}

/// Returns letters before some that are the first behind their beginning.
fn letters_before(letters: &str) -> String {
    let leading: String = letters.chars().take_while(|letter| *letter == BEFORE).collect();
    match letters[leading.len()..].chars().next() {
        None | Some('a') => leading + "za",
        Some(letter) => {
            let mut earlier = leading;
            earlier.push(char::from(letter as u8 - 1));
            earlier
        }
    }
}

/// Returns the places of letters in their order.
fn rank(letters: &str) -> impl Iterator<Item = u8> + '_ {
    letters.bytes().map(|letter| if letter == BEFORE as u8 { 0 } else { letter })
}

impl From<usize> for Number {
    fn from(whole: usize) -> Self {
        Self { whole, letters: String::new() }
    }
}

impl Ord for Number {
    fn cmp(&self, other: &Self) -> Ordering {
        let letters = || rank(&self.letters).cmp(rank(&other.letters));
        self.whole.cmp(&other.whole).then_with(letters)
    }
}

impl PartialOrd for Number {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

/// Formats the number as on paper. A width is that of the whole number: `{:04}` gives 0003a.
impl fmt::Display for Number {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(&self.whole, f)?;
        f.write_str(&self.letters)
    }
}

impl FromStr for Number {
    type Err = String;

    /// Reads a number with or without zeros in front; capital letters are as good as small ones.
    fn from_str(text: &str) -> Result<Self, String> {
        let text = text.trim();
        let digits = text.bytes().take_while(u8::is_ascii_digit).count();
        let (whole, letters) = text.split_at(digits);
        let is_word = letters.bytes().all(|letter| letter.is_ascii_alphabetic());
        let letters = letters.to_ascii_lowercase();
        let whole = whole.parse().ok().filter(|_| digits <= DIGITS);
        let ends_well =
            if letters.is_empty() { whole != Some(0) } else { !letters.ends_with(BEFORE) };
        match whole {
            Some(whole) if is_word && ends_well => Ok(Self { whole, letters }),
            _ => Err(format!(
                "expected the number of a drawing, as 3 or 3a and not ending in z, found \"{text}\""
            )),
        }
    }
}

/// A number without letters is an integer in JSON, and one with letters a string.
impl Serialize for Number {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self.letters.as_str() {
            "" => serializer.serialize_u64(self.whole as u64),
            _ => serializer.collect_str(self),
        }
    }
}

impl<'de> Deserialize<'de> for Number {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        #[derive(Deserialize)]
        #[serde(untagged, expecting = "the number of a drawing, as 3 or \"3a\"")]
        enum Written {
            Whole(usize),
            Text(String),
        }
        let text = match Written::deserialize(deserializer)? {
            Written::Whole(whole) => whole.to_string(),
            Written::Text(text) => text,
        };
        text.parse().map_err(de::Error::custom)
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn number(text: &str) -> Number {
        text.parse().unwrap()
    }

    fn between(before: &str, after: &str) -> String {
        let read = |text: &str| (!text.is_empty()).then(|| number(text));
        Number::between(read(before).as_ref(), read(after).as_ref()).to_string()
    }

    #[test]
    fn a_drawing_that_comes_between_gets_the_next_letter() {
        for (before, after, expected) in [
            ("", "", "1"),
            ("7", "", "8"),
            ("7b", "", "8"),
            ("", "1", "0a"),
            ("0a", "1", "0b"),
            ("", "0a", "0za"),
            ("3", "4", "3a"),
            ("3a", "4", "3b"),
            ("3a", "9", "3b"),
            ("3y", "4", "3ya"),
            ("3", "3a", "3za"),
            ("3", "3za", "3zza"),
            ("3za", "3a", "3zb"),
            ("3", "3b", "3a"),
            ("3a", "3b", "3aa"),
            ("3a", "3aa", "3aza"),
            ("3aa", "3b", "3ab"),
            ("3", "3zb", "3za"),
        ] {
            assert_eq!(between(before, after), expected, "{before} and {after}");
        }
    }

    #[test]
    fn numbers_are_read_as_programs_write_them_and_nothing_else_is_one() {
        for (text, same) in
            [("3", "3"), (" 0012 ", "12"), ("0003A", "3a"), ("0a", "0a"), ("3ZA", "3za")]
        {
            assert_eq!(number(text).to_string(), same);
        }
        for wrong in ["", "0", "-1", "3.5", "a", "3z", "3-1", "3 a", "1234567890", "３", "3é"] {
            assert!(wrong.parse::<Number>().unwrap_err().contains("3a"), "{wrong}");
        }
    }

    #[test]
    fn json_has_whole_numbers_as_numbers_and_others_as_text() {
        let json = serde_json::to_string(&[number("3"), number("3a")]).unwrap();
        assert_eq!(json, "[3,\"3a\"]");
        assert_eq!(
            serde_json::from_str::<Vec<Number>>(&json).unwrap(),
            [number("3"), number("3a")]
        );
        assert!(serde_json::from_str::<Number>("0").is_err());
    }

    proptest! {
        #[test]
        fn there_is_room_between_any_two(places in prop::collection::vec(0..1000usize, 0..60)) {
            let mut numbers: Vec<Number> = Vec::new();
            for place in places {
                let at = place % (numbers.len() + 1);
                let before = at.checked_sub(1).map(|before| &numbers[before]);
                let new = Number::between(before, numbers.get(at));
                prop_assert_eq!(number(&new.to_string()), new.clone());
                numbers.insert(at, new);
            }
            prop_assert!(numbers.is_sorted_by(|a, b| a < b), "{:?}", numbers);
        }
    }
}
