//! Knobs (つまみ): the description of each setting, declared once beside the struct that holds it.
//!
//! The range check, `--set` and `--with`, the recipe file, the window and the pages are all derived from it.

mod range;
mod value;

use std::ops::Bound::{Excluded, Included, Unbounded};

use crate::error::Error;

#[doc(hidden)]
pub use crate::{as_word, by_word, choices, knobs};
pub use range::Range;
#[doc(hidden)]
pub use value::{Setting, Value, word_from, word_into};

/// A setting: its name, the values it accepts, and its effect.
///
/// ```
/// use genga::knob::{Knob, Who};
///
/// let knob = Knob::find("spacing.weight")?;
/// assert_eq!((knob.japanese, knob.who), ("詰めの重み", Who::Animator));
/// assert_eq!(knob.takes(), "weight (0 is even), 0 to below 1");
/// assert!(!knob.range.contains(1.0));
/// # Ok::<(), genga::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Knob {
    /// Its name, `section.field`.
    pub name: &'static str,
    /// The Japanese name.
    pub japanese: &'static str,
    /// The type of its values.
    pub kind: Kind,
    /// The valid numbers of a [`Kind::Number`], and of a number of frames or seconds.
    pub range: Range,
    /// The unit; empty for choices and flags.
    pub unit: &'static str,
    /// Its effect, in a sentence or two.
    pub help: &'static str,
    /// The help in Japanese.
    pub japanese_help: &'static str,
    /// The audience.
    pub who: Who,
}

/// The audience of a knob.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Who {
    /// Animators (アニメーター): the knob changes the drawings visibly, in a way one may want.
    Animator,
    /// Researchers (研究者): the knob is a reading of the papers, or there for comparison.
    Researcher,
}

/// The type of value that a knob accepts.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Kind {
    /// A number. `min` to `max` is the useful span of a slider; [`Knob::range`] is the valid range.
    Number {
        /// Start of the slider.
        min: f64,
        /// End of the slider.
        max: f64,
        /// Whether it must be a whole number.
        whole: bool,
        /// Whether the value may also be `none`.
        optional: bool,
    },
    /// A length of time, in frames or seconds.
    Span,
    /// A count (`4`) or a share (`4%`, `1/3`).
    Amount,
    /// Number of koma per drawing (`2`), or the fewest and the most (`1-3`).
    On,
    /// A number, or a share of the 95th percentile of the joint's own values (`5%`).
    Band,
    /// A number, or `auto`.
    OrAuto,
    /// A side to look from (`front`), or a camera's position and target (`X,Y,Z:X,Y,Z`).
    SeenFrom,
    /// One of the listed words.
    Choice(&'static [&'static str]),
    /// `true` or `false`.
    Flag,
    /// Free text.
    Text,
}

/// Creates a knob for animators from its Japanese name and its help in two languages; numbers must be 0 or more.
pub const fn knob(japanese: &'static str, help: &'static str, japanese_help: &'static str) -> Knob {
    let (name, unit, who) = ("", "", Who::Animator);
    let kind = number(f64::NAN, f64::NAN, false);
    Knob { name, japanese, kind, range: Range::LENGTH, unit, help, japanese_help, who }
}

const fn number(min: f64, max: f64, whole: bool) -> Kind {
    Kind::Number { min, max, whole, optional: false }
}

/// Returns the kind of knob for the type of a field.
pub const fn kind_of<S, V: Setting>(_field: fn(&S) -> &V) -> Kind {
    V::KIND
}

/// Returns the name of a field without the mark of a Rust keyword.
pub const fn plain(field: &'static str) -> &'static str {
    match field.as_bytes() {
        [b'r', b'#', name @ ..] => match str::from_utf8(name) {
            Ok(name) => name,
            Err(_) => field,
        },
        _ => field,
    }
}

/// Builder methods that declare a knob.
impl Knob {
    /// Sets the lower bound of a number, inclusive.
    pub const fn at_least(mut self, least: f64) -> Self {
        self.range.from = Included(least);
        self
    }

    /// Sets the lower bound of a number, exclusive.
    pub const fn above(mut self, bound: f64) -> Self {
        self.range.from = Excluded(bound);
        self
    }

    /// Sets the upper bound of a number, inclusive.
    pub const fn at_most(mut self, most: f64) -> Self {
        self.range.to = Included(most);
        self
    }

    pub(crate) const fn below(mut self, bound: f64) -> Self {
        self.range.to = Excluded(bound);
        self
    }

    /// Also accepts infinity, which means no limit.
    pub(crate) const fn or_inf(mut self) -> Self {
        self.range.to = Unbounded;
        self
    }

    /// Sets the unit.
    pub const fn unit(mut self, unit: &'static str) -> Self {
        self.unit = unit;
        self
    }

    /// Sets the start and end of the slider, if they differ from the range.
    pub const fn slider(mut self, min: f64, max: f64) -> Self {
        self.kind = number(min, max, false);
        self
    }

    /// Marks the knob as one for researchers.
    pub const fn for_studies(mut self) -> Self {
        self.who = Who::Researcher;
        self
    }

    /// Returns the knob with its name and the kind of its field.
    pub const fn named(mut self, name: &'static str, kind: Kind) -> Self {
        self.name = name;
        self.kind = match (self.kind, kind) {
            (Kind::Number { min, max, .. }, Kind::Number { whole, optional, .. }) => {
                let min = if min.is_nan() { self.range.least() } else { min };
                let max = if max.is_nan() { self.range.most() } else { max };
                Kind::Number { min, max, whole, optional }
            }
            _ => kind,
        };
        if matches!(kind, Kind::Span) {
            self.unit = "source frames or seconds";
        }
        self
    }
}

impl Knob {
    /// Returns section and field; a setting at the top level has no section.
    pub fn path(&self) -> (Option<&'static str>, &'static str) {
        self.name
            .split_once('.')
            .map_or((None, self.name), |(section, field)| (Some(section), field))
    }

    /// Whether the knob accepts `none`.
    pub fn is_optional(&self) -> bool {
        matches!(self.kind, Kind::Number { optional: true, .. })
    }

    /// Describes in words the values that the knob accepts.
    pub fn takes(&self) -> String {
        let Self { unit, range, .. } = self;
        match self.kind {
            Kind::Choice(words) => words.join(" | "),
            Kind::Flag => "true | false".into(),
            Kind::Number { whole, optional, .. } => {
                let whole = if whole { "whole " } else { "" };
                let unit = if unit.is_empty() { "number" } else { unit };
                let none = if optional { ", or none" } else { "" };
                format!("{whole}{unit}, {range}{none}")
            }
            Kind::Span => format!("{unit}, {range}"),
            Kind::OrAuto => format!("auto, or {range}"),
            Kind::Amount | Kind::On | Kind::Band | Kind::SeenFrom | Kind::Text => (*unit).into(),
        }
    }

    /// Returns the error for a value that the knob does not accept.
    pub fn refusal(&self, found: &str) -> Error {
        let takes = match self.kind {
            Kind::Choice(words) => format!("one of {}", words.join(", ")),
            _ => self.takes(),
        };
        Error::setting(self.name, format!("expected {takes}, found \"{found}\""))
    }
}

/// Named settings.
pub trait Knobs {
    /// Returns every knob with its value.
    fn values(&self) -> Vec<(&'static Knob, &dyn Value)>;

    /// Returns every knob with its mutable value.
    fn values_mut(&mut self) -> Vec<(&'static Knob, &mut dyn Value)>;

    /// Checks that every knob accepts its value.
    fn check(&self) -> Result<(), Error> {
        let wrong = self.values().into_iter().find(|(knob, value)| !value.fits(knob.range));
        wrong.map_or(Ok(()), |(knob, value)| Err(knob.refusal(&value.text())))
    }

    /// Sets the knob called `name` from text without checking its range. `None` for an unknown name.
    fn turn(&mut self, name: &str, text: &str) -> Option<Result<(), Error>> {
        let (knob, value) = self.values_mut().into_iter().find(|(knob, _)| knob.name == name)?;
        Some(if value.take(text.trim()) { Ok(()) } else { Err(knob.refusal(text)) })
    }
}

/// Declares the knobs of a settings struct of a section: `knobs!(filter::LowPass { width: knob(…), … })`.
///
/// Fields after `..` have no knob; fields after `..` in brackets are structs with knobs of their own, behind which others
/// without a knob may follow. A forgotten field does not compile.
#[doc(hidden)]
#[macro_export]
macro_rules! knobs {
    ($section:ident::$of:ident { $($rows:tt)* }) => {
        $crate::knob::knobs!(@rows (concat!(stringify!($section), ".")) $of $($rows)*);
    };
    ($of:ident { $($rows:tt)* }) => {
        $crate::knob::knobs!(@rows ("") $of $($rows)*);
    };
    (@rows $section:tt $of:ident $($field:ident: $knob:expr,)* ..[$($under:ident),+] $(, ..$bare:ident)*) => {
        $crate::knob::knobs!(@impl $section $of [$($field: $knob),*] [$($bare),*] [$($under),+]);
    };
    (@rows $section:tt $of:ident $($field:ident: $knob:expr,)* ..$($bare:ident),+) => {
        $crate::knob::knobs!(@impl $section $of [$($field: $knob),*] [$($bare),+] []);
    };
    (@rows $section:tt $of:ident $($field:ident: $knob:expr),* $(,)?) => {
        $crate::knob::knobs!(@impl $section $of [$($field: $knob),*] [] []);
    };
    (@impl ($section:expr) $of:ident [$($field:ident: $knob:expr),*] [$($bare:ident),*] [$($under:ident),*]) => {
        impl $of {
            /// The knob of each setting.
            pub(crate) const KNOBS: &'static [$crate::knob::Knob] = &[$($knob.named(
                $crate::knob::plain(concat!($section, stringify!($field))),
                $crate::knob::kind_of(|of: &Self| &of.$field),
            )),*];
        }

        impl $crate::knob::Knobs for $of {
            fn values(&self) -> Vec<(&'static $crate::knob::Knob, &dyn $crate::knob::Value)> {
                let Self { $($field,)* $($bare: _,)* $($under,)* } = self;
                let own: Vec<&dyn $crate::knob::Value> = vec![$($field),*];
                Self::KNOBS.iter().zip(own)$(.chain($under.values()))*.collect()
            }

            fn values_mut(&mut self) -> Vec<(&'static $crate::knob::Knob, &mut dyn $crate::knob::Value)> {
                let Self { $($field,)* $($bare: _,)* $($under,)* } = self;
                let own: Vec<&mut dyn $crate::knob::Value> = vec![$($field),*];
                Self::KNOBS.iter().zip(own)$(.chain($under.values_mut()))*.collect()
            }
        }
    };
}
