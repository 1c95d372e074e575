//! Knobs (つまみ): what is said of a setting, once, beside the struct that has it.
//!
//! From it come the check of its range, `--set` and `--with`, the recipe file, and what the window and the pages show.

mod range;
mod value;

use std::ops::Bound::{Excluded, Included, Unbounded};

use crate::error::Error;

pub use range::Range;
pub(crate) use value::{Setting, Value, as_word, by_word, choices, word_from, word_into};

/// One setting: its name, what it takes, and what it does.
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
    /// The same in Japanese.
    pub japanese: &'static str,
    /// What it takes.
    pub kind: Kind,
    /// Which numbers: of a [`Kind::Number`], and of frames or seconds.
    pub range: Range,
    /// What it counts in; empty for choices and flags.
    pub unit: &'static str,
    /// What it does, in a sentence or two.
    pub help: &'static str,
    /// The same in Japanese.
    pub japanese_help: &'static str,
    /// Who turns it.
    pub who: Who,
}

/// Who turns a knob.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Who {
    /// Who draws (アニメーター): it changes what is drawn, in a way that can be seen and wanted.
    Animator,
    /// Who studies the method (研究者): it is one of the papers' readings, or there for comparison.
    Researcher,
}

/// What a knob takes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Kind {
    /// A number. From `min` to `max` it makes sense on a slider; [`Knob::range`] is what it may be.
    Number {
        /// Where a slider begins.
        min: f64,
        /// Where it ends.
        max: f64,
        /// Whether it must be whole.
        whole: bool,
        /// Whether it may be `none`.
        optional: bool,
    },
    /// A length of time, frames or seconds.
    Span,
    /// A count (`4`) or a share (`4%`, `1/3`).
    Amount,
    /// Koma a drawing (`2`), or the fewest and the most (`1-3`).
    On,
    /// A number, or a share of the joint's own 95th percentile (`5%`).
    Band,
    /// A number, or `auto`.
    OrAuto,
    /// A side to look from (`front`), or where a camera stands and what it looks at (`X,Y,Z:X,Y,Z`).
    SeenFrom,
    /// One of these words.
    Choice(&'static [&'static str]),
    /// `true` or `false`.
    Flag,
    /// Any words.
    Text,
}

/// A knob of an animator, its names and help in two languages; a number it takes is 0 or more.
pub(crate) const fn knob(
    japanese: &'static str,
    help: &'static str,
    japanese_help: &'static str,
) -> Knob {
    let (name, unit, who) = ("", "", Who::Animator);
    let kind = number(f64::NAN, f64::NAN, false);
    Knob { name, japanese, kind, range: Range::LENGTH, unit, help, japanese_help, who }
}

const fn number(min: f64, max: f64, whole: bool) -> Kind {
    Kind::Number { min, max, whole, optional: false }
}

/// The kind of knob that sets a field.
pub(crate) const fn kind_of<S, V: Setting>(_field: fn(&S) -> &V) -> Kind {
    V::KIND
}

/// How a knob is declared.
impl Knob {
    pub(crate) const fn at_least(mut self, least: f64) -> Self {
        self.range.from = Included(least);
        self
    }

    pub(crate) const fn above(mut self, bound: f64) -> Self {
        self.range.from = Excluded(bound);
        self
    }

    pub(crate) const fn at_most(mut self, most: f64) -> Self {
        self.range.to = Included(most);
        self
    }

    pub(crate) const fn below(mut self, bound: f64) -> Self {
        self.range.to = Excluded(bound);
        self
    }

    /// Infinity too, which is no limit.
    pub(crate) const fn or_inf(mut self) -> Self {
        self.range.to = Unbounded;
        self
    }

    pub(crate) const fn unit(mut self, unit: &'static str) -> Self {
        self.unit = unit;
        self
    }

    /// Where a slider begins and ends, if not where the range does.
    pub(crate) const fn slider(mut self, min: f64, max: f64) -> Self {
        self.kind = number(min, max, false);
        self
    }

    /// Nobody draws with it.
    pub(crate) const fn for_studies(mut self) -> Self {
        self.who = Who::Researcher;
        self
    }

    /// The knob with its name and the kind of its field.
    pub(crate) const fn named(mut self, name: &'static str, kind: Kind) -> Self {
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
    /// Section and field; no section for a setting at the top.
    pub fn path(&self) -> (Option<&'static str>, &'static str) {
        self.name
            .split_once('.')
            .map_or((None, self.name), |(section, field)| (Some(section), field))
    }

    /// Whether it may be `none`.
    pub fn is_optional(&self) -> bool {
        matches!(self.kind, Kind::Number { optional: true, .. })
    }

    /// What it takes, in words.
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

    /// That a value is none of those it takes.
    pub(crate) fn refusal(&self, found: &str) -> Error {
        let takes = match self.kind {
            Kind::Choice(words) => format!("one of {}", words.join(", ")),
            _ => self.takes(),
        };
        Error::setting(self.name, format!("expected {takes}, found \"{found}\""))
    }
}

/// Settings that have names.
pub(crate) trait Knobs {
    /// Every knob with its value.
    fn values(&self) -> Vec<(&'static Knob, &dyn Value)>;

    /// Every knob with its value, to be set.
    fn values_mut(&mut self) -> Vec<(&'static Knob, &mut dyn Value)>;

    /// Checks that every value is one that its knob takes.
    fn check(&self) -> Result<(), Error> {
        let wrong = self.values().into_iter().find(|(knob, value)| !value.fits(knob.range));
        wrong.map_or(Ok(()), |(knob, value)| Err(knob.refusal(&value.text())))
    }

    /// Sets the knob of that name from text, without a look at its range; none where there is no such knob.
    fn turn(&mut self, name: &str, text: &str) -> Option<Result<(), Error>> {
        let (knob, value) = self.values_mut().into_iter().find(|(knob, _)| knob.name == name)?;
        Some(if value.take(text.trim()) { Ok(()) } else { Err(knob.refusal(text)) })
    }
}

/// Declares the knobs of a settings struct of a section: `knobs!(filter::LowPass { width: knob(…), … })`.
///
/// Behind `..` stand fields that have none, or in brackets those that have knobs of their own. What is forgotten does
/// not compile.
macro_rules! knobs {
    ($section:ident::$of:ident { $($rows:tt)* }) => {
        $crate::knob::knobs!(@rows (concat!(stringify!($section), ".")) $of $($rows)*);
    };
    ($of:ident { $($rows:tt)* }) => {
        $crate::knob::knobs!(@rows ("") $of $($rows)*);
    };
    (@rows $section:tt $of:ident $($field:ident: $knob:expr,)* ..[$($under:ident),+]) => {
        $crate::knob::knobs!(@impl $section $of [$($field: $knob),*] [] [$($under),+]);
    };
    (@rows $section:tt $of:ident $($field:ident: $knob:expr,)* ..$($bare:ident),+) => {
        $crate::knob::knobs!(@impl $section $of [$($field: $knob),*] [$($bare),+] []);
    };
    (@rows $section:tt $of:ident $($field:ident: $knob:expr),* $(,)?) => {
        $crate::knob::knobs!(@impl $section $of [$($field: $knob),*] [] []);
    };
    (@impl ($section:expr) $of:ident [$($field:ident: $knob:expr),*] [$($bare:ident),*] [$($under:ident),*]) => {
        impl $of {
            /// What is said of each setting.
            pub(crate) const KNOBS: &'static [$crate::knob::Knob] = &[$($knob.named(
                concat!($section, stringify!($field)),
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
pub(crate) use knobs;
