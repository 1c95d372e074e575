//! What stands side by side in a film (見比べ): a sheet beside its source, or two sheets of one take, in step.

use std::borrow::Cow;

use glam::DVec3;

use crate::drawings::{Signs, composed, counts};
use crate::figure::{Figure, FigureBody};
use crate::points::Showing;
use genga::error::Error;
use genga::motion::{Clip, Composite, played_out};
use genga::sheet::{Blank, Layer, Sheet};

/// Least distance between two poses that count as different drawings, as a share of the body's height. It is about one
/// pixel of a figure that fills a screen.
const APART: f64 = 0.002;

/// A version of a take (版): a sheet under its own name, with the motion that its drawings show.
#[derive(Debug, Clone, Copy)]
pub struct Version<'a> {
    /// Its name, as people call it.
    pub name: &'a str,
    /// The motion that its drawings show.
    pub clip: &'a Clip,
    /// The sheet.
    pub sheet: &'a Sheet,
}

/// What a film shows side by side, koma by koma.
#[derive(Debug, Clone, Copy)]
pub enum SideBySide<'a> {
    /// The motion, and a sheet of it (素材と結果).
    Source(&'a Clip, &'a Sheet),
    /// Two sheets of one take. The shorter one holds its end.
    Versions([Version<'a>; 2]),
}

impl<'a> SideBySide<'a> {
    /// Number of blank koma before a sheet that is shown alone, which a page that plays again and again leaves out.
    pub(crate) fn koma_before(&self) -> usize {
        match self {
            Self::Source(_, sheet) => sheet.blank.before,
            Self::Versions(_) => 0,
        }
    }

    /// Puts two sheets side by side.
    ///
    /// # Errors
    /// [`Error::Sheet`] if they are no versions of one take that can run in step: of other joints, of another rate, or
    /// with another first frame.
    pub fn versions(versions: [Version<'a>; 2]) -> Result<Self, Error> {
        let [one, other] = versions;
        let wrong = |what: String, way_out: &str| Err(Error::sheet(format!("{what}; {way_out}")));
        let clocks = versions.map(|version| version.sheet.clock);
        let [rate, other_rate] = clocks.map(|clock| clock.koma_rate);
        if rate != other_rate {
            let what = format!(
                "{} has {rate} koma a second and {} has {other_rate}",
                one.name, other.name
            );
            return wrong(what, "two versions run in step at one rate alone");
        }
        let joints =
            |version: Version<'a>| version.clip.skeleton().joints.iter().map(|own| &own.name);
        if !joints(one).eq(joints(other)) || clocks[0].frame_rate != clocks[1].frame_rate {
            let what =
                format!("{} and {} are of other joints or another rate", one.name, other.name);
            return wrong(what, "two versions are of one take");
        }
        let [first, other_first] = clocks.map(|clock| clock.first);
        if first != other_first {
            let what = format!(
                "{} begins with source frame {first} and {} with {other_first}",
                one.name, other.name
            );
            return wrong(what, "two versions begin with the same frame");
        }
        Ok(Self::Versions(versions))
    }

    /// Number of koma of the film: those of the longer cut.
    pub fn koma(&self) -> usize {
        self.sheets().map(|(_, sheet)| sheet.cut_length()).max().unwrap_or(0)
    }

    /// Koma a second.
    pub fn koma_rate(&self) -> f64 {
        match self {
            Self::Source(_, sheet) | Self::Versions([Version { sheet, .. }, _]) => {
                sheet.clock.koma_rate
            }
        }
    }

    /// Returns, for each koma, whether two versions show different drawings: a point of the body is visibly elsewhere,
    /// or only one of them shows any. It is empty for a sheet beside its source.
    ///
    /// # Errors
    /// [`Error::Sheet`] or [`Error::Picture`] if a sheet has nothing to show.
    pub fn differences(&self) -> Result<Vec<bool>, Error> {
        let played = self.played_out()?;
        let reels = played.iter().map(PlayedOut::reel).collect::<Result<Vec<_>, _>>()?;
        Ok(differences(&reels))
    }

    fn sheets(&self) -> impl Iterator<Item = (&'a Clip, &'a Sheet)> + use<'a> {
        let (first, second) = match *self {
            Self::Source(clip, sheet) => ((clip, sheet), None),
            Self::Versions([one, other]) => {
                ((one.clip, one.sheet), Some((other.clip, other.sheet)))
            }
        };
        [first].into_iter().chain(second)
    }

    /// Plays out all rounds of the sheets.
    ///
    /// # Errors
    /// As [`composed`].
    pub(crate) fn played_out(&self) -> Result<Vec<PlayedOut<'a>>, Error> {
        self.sheets().map(|(clip, sheet)| PlayedOut::new(clip, sheet)).collect()
    }
}

/// Returns, for each koma, whether two reels show different drawings; empty for one. See [`SideBySide::differences`].
pub(crate) fn differences(reels: &[Reel<'_>]) -> Vec<bool> {
    let [one, other] = reels else { return Vec::new() };
    let apart = APART * Figure::new(one.composite.clip(), FigureBody::Sticks).height;
    let mut showing = [one, other].map(|reel| Showing::new(&reel.composite, &[]));
    let differ = |koma: usize| {
        let [one, other] = [0, 1].map(|at| {
            reels[at].at(koma).map(|shown| showing[at].points(shown.drawing, shown.koma))
        });
        match (one, other) {
            (Some(one), Some(other)) => are_apart(&one, &other, apart),
            (one, other) => one.is_some() != other.is_some(),
        }
    };
    (0..longest(reels)).map(differ).collect()
}

/// Number of koma of the longest of some reels.
pub(crate) fn longest(reels: &[Reel<'_>]) -> usize {
    reels.iter().map(Reel::length).max().unwrap_or(0)
}

/// Returns first koma and number of koma of each run of true.
pub(crate) fn runs(of: &[bool]) -> impl Iterator<Item = (usize, usize)> {
    let chunks = of.chunk_by(|one, next| one == next);
    let begins = chunks.scan(0, |begin, run| {
        let from = *begin;
        *begin += run.len();
        Some((from, run))
    });
    begins.filter(|(_, run)| run[0]).map(|(from, run)| (from, run.len()))
}

fn are_apart(one: &[DVec3], other: &[DVec3], least: f64) -> bool {
    one.iter().zip(other).any(|(one, other)| one.distance(*other) > least)
}

/// A sheet with the rounds of a loop one after the other, as they are on screen.
pub(crate) struct PlayedOut<'a> {
    clip: Cow<'a, Clip>,
    sheet: Cow<'a, Sheet>,
    /// Layer of the sheet as it was given. Its drawings have the numbers that people know.
    named: Layer,
    /// The signs of its drawings, if it is composited from several columns.
    signs: Signs,
    /// Genga and drawings of all its columns.
    counts: [usize; 2],
    /// Number of rounds.
    rounds: usize,
}

impl<'a> PlayedOut<'a> {
    /// Plays out all rounds.
    ///
    /// # Errors
    /// As [`composed`].
    pub(crate) fn new(clip: &'a Clip, sheet: &'a Sheet) -> Result<Self, Error> {
        let (named, rounds) = (composed(clip, sheet)?.layer().clone(), sheet.rounds());
        let (signs, counts) = (Signs::new(clip, sheet), counts(sheet));
        let (clip, sheet) = played_out(clip, sheet);
        Ok(Self { clip, sheet, named, signs, counts, rounds })
    }

    /// Leaves out the blank koma.
    pub(crate) fn without_blank(self) -> Self {
        let sheet = match self.sheet.blank.is_none() {
            true => self.sheet,
            false => Cow::Owned(self.sheet.into_owned().with_blank(Blank::default())),
        };
        Self { sheet, ..self }
    }

    /// Composites the layers.
    ///
    /// # Errors
    /// As [`composed`].
    pub(crate) fn reel(&self) -> Result<Reel<'_>, Error> {
        let composite = composed(&self.clip, &self.sheet)?;
        let shown = composite.layer().koma().collect();
        let Self { named, signs, counts, rounds, .. } = self;
        let (counts, rounds) = (*counts, *rounds);
        Ok(Reel { composite, sheet: &self.sheet, named, signs, counts, rounds, shown })
    }
}

/// A sheet as it runs on screen (フィルム).
pub(crate) struct Reel<'a> {
    pub(crate) composite: Composite<'a>,
    pub(crate) sheet: &'a Sheet,
    /// Layer whose drawings have the numbers that people know.
    pub(crate) named: &'a Layer,
    /// The signs of its drawings, if it is composited from several columns.
    pub(crate) signs: &'a Signs,
    /// Genga and drawings of all its columns.
    pub(crate) counts: [usize; 2],
    /// Number of rounds of a loop.
    pub(crate) rounds: usize,
    /// Drawing of each koma that has one.
    shown: Vec<usize>,
}

/// A drawing on a koma.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct OnScreen {
    /// Koma of the sheet, counted without the blank ones before.
    pub(crate) koma: usize,
    /// Index of the drawing in the composite.
    pub(crate) drawing: usize,
}

impl Reel<'_> {
    /// Number of koma of the cut.
    pub(crate) fn length(&self) -> usize {
        self.sheet.blank.before + self.shown.len() + self.sheet.blank.after
    }

    /// Returns what is on screen on a koma of the cut, and after its end what stands there last; `None` on a blank
    /// koma.
    pub(crate) fn at(&self, koma: usize) -> Option<OnScreen> {
        let koma = koma.min(self.length().checked_sub(1)?);
        let koma = koma.checked_sub(self.sheet.blank.before)?;
        let drawing = *self.shown.get(koma)?;
        Some(OnScreen { koma, drawing })
    }
}
