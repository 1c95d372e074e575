//! What a knob sets: a value that is written as one word, on the command line and in files.

use std::fmt::Display;
use std::str::FromStr;

use serde::de::Error as _;
use serde::{Deserialize, Deserializer, Serializer};

use super::{Kind, Range, number};

/// A type of values of which each is written as a word.
pub(crate) trait Setting: Sized {
    /// The kind of knob that sets one.
    const KIND: Kind;

    /// The word.
    fn word(&self) -> String;

    /// The value of a word; none where it is of no value.
    fn of_word(word: &str) -> Option<Self>;

    /// Whether it can be. Most types know that from the word.
    fn is_in(&self, _: Range) -> bool {
        Self::of_word(&self.word()).is_some()
    }
}

/// One value, whatever its type.
pub(crate) trait Value {
    /// As text, which [`Value::take`] takes back.
    fn text(&self) -> String;

    /// Takes the value of a text; false, and nothing is changed, where it is of none.
    fn take(&mut self, text: &str) -> bool;

    /// Whether it can be, as a number in a range.
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

/// The word of a [`Setting`] that has `Display` and `FromStr`.
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
pub(crate) use as_word;

macro_rules! numbers {
    ($($of:ty, $whole:literal;)+) => {$(
        impl Setting for $of {
            const KIND: Kind = number(0.0, 0.0, $whole);
            as_word!();

            fn is_in(&self, range: Range) -> bool {
                range.contains(*self as f64)
            }
        }
    )+};
}
numbers! { f64, false; usize, true; u32, true; }

impl Setting for Option<usize> {
    const KIND: Kind = Kind::Number { min: 0.0, max: 0.0, whole: true, optional: true };

    fn word(&self) -> String {
        self.map_or_else(|| "none".into(), |count| count.to_string())
    }

    fn of_word(word: &str) -> Option<Self> {
        if word == "none" { Some(None) } else { word.parse().ok().map(Some) }
    }

    fn is_in(&self, range: Range) -> bool {
        self.is_none_or(|count| count.is_in(range))
    }
}

impl Setting for bool {
    const KIND: Kind = Kind::Flag;
    as_word!();
}

impl Setting for String {
    const KIND: Kind = Kind::Text;
    as_word!();
}

/// Lists the words of an enum, from which it is read and written everywhere: `choices!(Feet { Free: "free", … })`.
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
pub(crate) use choices;

/// Lets a type with `Display` and `FromStr` stand in files: as its word, or where that is one as a number.
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
pub(crate) use by_word;

/// Writes a value as its word, without quotes where it is a number.
pub(crate) fn word_into<S: Serializer>(
    value: &impl Display,
    serializer: S,
) -> Result<S::Ok, S::Error> {
    let word = value.to_string();
    match (word.parse(), word.parse()) {
        (Ok(whole), _) => serializer.serialize_u64(whole),
        (_, Ok(number)) => serializer.serialize_f64(number),
        _ => serializer.serialize_str(&word),
    }
}

/// Reads a value from a file, which may write its word as a text or, where that is one, as a number.
pub(crate) fn word_from<'de, T, D>(deserializer: D) -> Result<T, D::Error>
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
        // 1.0 is not 1: a share, and no count.
        Word::Number(number) => format!("{number:?}"),
        Word::Text(text) => text,
    };
    word.parse().map_err(D::Error::custom)
}
