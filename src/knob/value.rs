//! Values of knobs: each is written as one word, on the command line and in files.

use std::fmt::Display;
use std::str::FromStr;

use serde::de::Error as _;
use serde::{Deserialize, Deserializer, Serializer};

use super::{Kind, Range, number};

/// A type whose values are each written as one word.
pub trait Setting: Sized {
    /// The kind of knob for this type.
    const KIND: Kind;

    /// Returns the value as a word.
    fn word(&self) -> String;

    /// Parses a word; `None` if it is invalid.
    fn of_word(word: &str) -> Option<Self>;

    /// Whether the value is valid. By default, that is whether its word parses back.
    fn is_in(&self, _: Range) -> bool {
        Self::of_word(&self.word()).is_some()
    }
}

/// A knob's value of any type.
pub trait Value {
    /// Returns the value as text that [`Value::take`] reads back.
    fn text(&self) -> String;

    /// Sets the value from text. Returns false, and changes nothing, if the text is invalid.
    fn take(&mut self, text: &str) -> bool;

    /// Whether the value is valid; a number must lie in `range`.
    fn fits(&self, range: Range) -> bool;
}

impl<T: Setting> Value for T {
    fn text(&self) -> String {
        self.word()
    }

    fn take(&mut self, text: &str) -> bool {
        Self::of_word(text).map(|value| *self = value).is_some()
    }

    fn fits(&self, range: Range) -> bool {
        self.is_in(range)
    }
}

/// Implements the conversions of a [`Setting`] by `Display` and `FromStr`.
#[doc(hidden)]
#[macro_export]
macro_rules! as_word {
    () => {
        fn word(&self) -> String {
            self.to_string()
        }

        fn of_word(word: &str) -> Option<Self> {
            word.parse().ok()
        }
    };
}

macro_rules! numbers {
    ($($of:ty, $whole:literal;)+) => {$(
        impl Setting for $of {
            const KIND: Kind = number(0.0, 0.0, $whole);
            $crate::knob::as_word!();

            fn is_in(&self, range: Range) -> bool {
                range.contains(*self as f64)
            }
        }
    )+};
}
numbers! { f64, false; usize, true; u32, true; }

macro_rules! optional_numbers {
    ($($of:ty, $whole:literal;)+) => {$(
        impl Setting for Option<$of> {
            const KIND: Kind = Kind::Number { min: 0.0, max: 0.0, whole: $whole, optional: true };

            fn word(&self) -> String {
                self.map_or_else(|| "none".into(), |number| number.to_string())
            }

            fn of_word(word: &str) -> Option<Self> {
                if word == "none" { Some(None) } else { word.parse().ok().map(Some) }
            }

            fn is_in(&self, range: Range) -> bool {
                self.is_none_or(|number| number.is_in(range))
            }
        }
    )+};
}
optional_numbers! { f64, false; usize, true; }

impl Setting for bool {
    const KIND: Kind = Kind::Flag;
    as_word!();
}

impl Setting for String {
    const KIND: Kind = Kind::Text;
    as_word!();
}

/// Declares the words of an enum, with which it is read and written everywhere: `choices!(Feet { Free: "free", … })`.
#[doc(hidden)]
#[macro_export]
macro_rules! choices {
    ($of:ident { $($choice:ident: $word:literal),+ $(,)? }) => {
        impl std::fmt::Display for $of {
            fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                f.pad(match self { $(Self::$choice => $word),+ })
            }
        }

        impl std::str::FromStr for $of {
            type Err = String;

            fn from_str(text: &str) -> Result<Self, String> {
                match text {
                    $($word => Ok(Self::$choice),)+
                    _ => Err(format!("expected one of {}, found \"{text}\"", [$($word),+].join(", "))),
                }
            }
        }

        impl $crate::knob::Setting for $of {
            const KIND: $crate::knob::Kind = $crate::knob::Kind::Choice(&[$($word),+]);
            $crate::knob::as_word!();
        }

        $crate::knob::by_word!($of);
    };
}

/// Implements serde for a type with `Display` and `FromStr`: a file holds its word, or a number if the word is one.
#[doc(hidden)]
#[macro_export]
macro_rules! by_word {
    ($of:ident) => {
        $crate::knob::by_word!($of, |word, to| to.collect_str(word));
    };
    ($of:ident, or_number) => {
        $crate::knob::by_word!($of, |word, to| $crate::knob::word_into(word, to));
    };
    ($of:ident, |$word:ident, $to:ident| $write:expr) => {
        impl serde::Serialize for $of {
            fn serialize<S: serde::Serializer>(&self, $to: S) -> Result<S::Ok, S::Error> {
                let $word = self;
                $write
            }
        }

        impl<'de> serde::Deserialize<'de> for $of {
            fn deserialize<D: serde::Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
                $crate::knob::word_from(deserializer)
            }
        }
    };
}

/// Writes a value as its word, without quotes if the word is a number.
pub fn word_into<S: Serializer>(value: &impl Display, serializer: S) -> Result<S::Ok, S::Error> {
    let word = value.to_string();
    match (word.parse(), word.parse()) {
        (Ok(whole), _) => serializer.serialize_u64(whole),
        (_, Ok(number)) => serializer.serialize_f64(number),
        _ => serializer.serialize_str(&word),
    }
}

/// Reads a value from a file that holds its word as a text or a number.
pub fn word_from<'de, T, D>(deserializer: D) -> Result<T, D::Error>
where
    T: FromStr<Err: Display>,
    D: Deserializer<'de>,
{
    #[derive(Deserialize)]
    #[serde(untagged, expecting = "expected a number or a text")]
    enum Word {
        Whole(i64),
        Number(f64),
        Text(String),
    }
    let word = match Word::deserialize(deserializer)? {
        Word::Whole(number) => number.to_string(),
        // Keeps the decimal point: 1.0 is a share, 1 is a count.
        Word::Number(number) => format!("{number:?}"),
        Word::Text(text) => text,
    };
    word.parse().map_err(D::Error::custom)
}
