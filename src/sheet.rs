//! The timesheet (タイムシート): which drawing stands on which koma. The program's one result.
//!
//! Plain data: everything that is handed over is a function of (clip, sheet).

use std::collections::HashMap;
use std::fmt;
use std::ops::Deref;
use std::sync::Arc;

use serde::{Deserialize, Deserializer, Serialize, Serializer};

use crate::error::Error;
use crate::knob::choices;
use crate::time::Clock;

/// Koma of all layers together at most, half a day of film: a longer hold is a slip of the hand, and
/// would fill the memory.
pub(crate) const MOST_KOMA: usize = 1_000_000;

/// A timesheet: for each layer, drawings and how long each stays on screen.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Sheet {
    /// Where its koma stand in the source.
    pub clock: Clock,
    /// Layers (セル), back to front: column A first.
    pub layers: Vec<Layer>,
    /// What carries the body through the room while a drawing is held.
    #[serde(default, skip_serializing_if = "is_default")]
    pub root: RootMotion,
    /// Whether a foot stays where it stands.
    #[serde(default, skip_serializing_if = "is_default")]
    pub feet: Feet,
    /// What is spoken (セリフ), in the order in which it begins.
    #[serde(default, skip_serializing_if = "is_default")]
    pub lines: Vec<SpokenLine>,
}

/// A spoken line (セリフ), of the S column.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, expecting = "a spoken line {\"begin\", \"koma\", \"words\"}")]
pub struct SpokenLine {
    /// The koma on which it begins, from 0.
    pub begin: usize,
    /// For how many koma it is heard, at least 1.
    pub koma: usize,
    /// Who speaks; empty where that is not said.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub speaker: String,
    /// What is said.
    pub words: String,
}

/// Who says what, as it is written in the language of the words: `Ken: no`, アキ「えい！」.
impl fmt::Display for SpokenLine {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { speaker, words, .. } = self;
        let is_latin = words.chars().all(|letter| (letter as u32) < 0x2e80);
        match (speaker.is_empty(), is_latin) {
            (true, true) => write!(f, "{words}"),
            (false, true) => write!(f, "{speaker}: {words}"),
            (_, false) => write!(f, "{speaker}「{words}」"),
        }
    }
}

impl SpokenLine {
    /// The koma after its last.
    pub fn past(&self) -> usize {
        self.begin.saturating_add(self.koma)
    }

    /// For each of some lines the column it stands in, from 0: those that are heard at once stand side by side.
    /// The lines are in the order in which they begin.
    ///
    /// ```
    /// use genga::sheet::SpokenLine;
    ///
    /// let line = |begin, koma| SpokenLine { begin, koma, speaker: "".into(), words: "a".into() };
    /// assert_eq!(SpokenLine::side_by_side(&[line(0, 9), line(4, 9), line(9, 2)]), [0, 1, 0]);
    /// ```
    pub fn side_by_side(lines: &[Self]) -> Vec<usize> {
        let mut free: Vec<usize> = Vec::new();
        let place = |line: &Self| {
            let at = free.iter().position(|koma| *koma <= line.begin).unwrap_or(free.len());
            match free.get_mut(at) {
                Some(koma) => *koma = line.past(),
                None => free.push(line.past()),
            }
            at
        };
        lines.iter().map(place).collect()
    }
}

/// Whether a foot on the ground (接地) stays where it is in the motion that is handed over.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Feet {
    /// It is where its drawing has it.
    #[default]
    Free,
    /// In each drawing of an instant at which it stands in the source, it is where it stood there in the
    /// mean: hip and knee give way as far as the leg reaches, the pelvis stays.
    Held,
}

choices!(Feet { Free: "free", Held: "held" });

/// What carries the body through the room (移動) from koma to koma.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum RootMotion {
    /// Its drawings: the body stays where its drawing has it for as long as that is held.
    #[default]
    Drawings,
    /// The source, on ones (1コマ打ち): a held drawing slides on with the travel of the performer. Only
    /// where the body is follows, not how it is turned.
    Ones,
}

choices!(RootMotion { Drawings: "drawings", Ones: "ones" });

/// A group of joints with a column of its own on the sheet (セル).
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Layer {
    /// The column's name: A, B, C ….
    pub name: String,
    /// The names of its joints. Those that no layer names are of the first one; of a single layer that
    /// names none all are.
    #[serde(default, skip_serializing_if = "is_default")]
    pub joints: Vec<String>,
    /// Drawings in the order of their source places.
    pub drawings: Vec<Drawing>,
    /// What is on screen, koma after koma.
    pub exposures: Vec<Exposure>,
}

/// A drawing and the number of koma it stays on screen.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, expecting = "an exposure {\"drawing\", \"koma\"}")]
pub struct Exposure {
    /// Index into [`Layer::drawings`].
    pub drawing: usize,
    /// Koma on screen, at least 1.
    pub koma: usize,
}

/// What is shown (画): a pose taken from the source, or blended from two keys.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Drawing {
    /// Where its pose comes from.
    pub source: Source,
    /// What it is to the motion.
    pub role: Role,
    /// Why it is here.
    pub why: Why,
}

/// Where a drawing's pose comes from.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Source {
    /// The source at a place: a frame number of the file, fractional between two frames.
    At(f64),
    /// An inbetweener's blend of two key poses: `share` of the way from one to the other.
    Between {
        /// Place of the key before.
        from: f64,
        /// Place of the key after.
        to: f64,
        /// 0 is `from`, 1 is `to`.
        share: f64,
    },
}

impl Source {
    /// The place in the source, as a fractional frame number.
    pub fn place(self) -> f64 {
        match self {
            Self::At(place) => place,
            Self::Between { from, to, share } => from + share * (to - from),
        }
    }
}

/// What a drawing is to the motion.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Role {
    /// A key drawing (原画): a start, an end or a turning point.
    Genga,
    /// A drawing between two keys (中割り).
    Inbetween,
    /// The clip's first or last drawing, a genga whether or not a key was found there.
    End,
}

impl Role {
    /// The word used in files.
    pub fn word(self) -> &'static str {
        match self {
            Self::Genga => "genga",
            Self::Inbetween => "inbetween",
            Self::End => "end",
        }
    }

    /// Whether the omission stages must leave it where it is.
    pub fn is_kept(self) -> bool {
        self != Self::Inbetween
    }
}

/// What makes a drawing a genga.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Reason {
    /// The body turns (変わり目).
    Turn,
    /// It does not turn, but would go astray without a drawing (補い).
    Fill,
    /// A rest (止め) begins or ends.
    Rest,
    /// A contact (接地) begins or ends.
    Contact,
    /// A person wants it (固定).
    Pin,
}

impl Reason {
    /// Every reason.
    pub const ALL: [Self; 5] = [Self::Turn, Self::Fill, Self::Rest, Self::Contact, Self::Pin];

    /// Its word in files.
    pub fn word(self) -> &'static str {
        match self {
            Self::Turn => "turn",
            Self::Fill => "fill",
            Self::Rest => "rest",
            Self::Contact => "contact",
            Self::Pin => "pin",
        }
    }

    /// Its Japanese word.
    pub fn japanese(self) -> &'static str {
        match self {
            Self::Turn => "変わり目",
            Self::Fill => "補い",
            Self::Rest => "止め",
            Self::Contact => "接地",
            Self::Pin => "固定",
        }
    }
}

/// Names that many drawings have in common: a copy of a sheet does not copy them.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Names(Arc<[Arc<str>]>);

impl Deref for Names {
    type Target = [Arc<str>];

    fn deref(&self) -> &[Arc<str>] {
        &self.0
    }
}

impl<T: Into<Arc<str>>> FromIterator<T> for Names {
    fn from_iter<I: IntoIterator<Item = T>>(names: I) -> Self {
        Self(names.into_iter().map(Into::into).collect())
    }
}

impl Serialize for Names {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_seq(self.iter().map(|name| &**name))
    }
}

impl<'de> Deserialize<'de> for Names {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        Vec::<String>::deserialize(deserializer).map(Self::from_iter)
    }
}

/// Why a drawing is on the sheet, and what was done round it.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Why {
    /// Names of the joints that have a turn of their own here.
    #[serde(skip_serializing_if = "is_default")]
    pub voters: Names,
    /// Set by a person, with the name they gave it (empty when they gave none).
    #[serde(skip_serializing_if = "is_default")]
    pub pinned: Option<String>,
    /// The source frame near which the key was found that a person put here.
    #[serde(skip_serializing_if = "is_default")]
    pub moved_from: Option<usize>,
    /// What makes it a genga; none for other drawings.
    #[serde(skip_serializing_if = "is_default")]
    pub reason: Option<Reason>,
    /// How much of a turn the genga is, 0 to 1 (what joints say together where `keys.merge` is not `body`);
    /// none for inbetweens.
    #[serde(skip_serializing_if = "is_default")]
    pub strength: Option<f64>,
    /// What the key saves, in % of body height: how far the body would be off without it; none for
    /// inbetweens.
    #[serde(skip_serializing_if = "is_default")]
    pub price: Option<f64>,
    /// Koma that naka-nashi gave to it.
    #[serde(skip_serializing_if = "is_default")]
    pub lengthened: usize,
    /// Drawings just before it that naka-nashi left out.
    #[serde(skip_serializing_if = "is_default")]
    pub omitted_before: usize,
    /// Drawings after it that koma-dori, or a person's hold, replaced by it.
    #[serde(skip_serializing_if = "is_default")]
    pub held_for: usize,
    /// Whether a person set how long it stays.
    #[serde(skip_serializing_if = "is_default")]
    pub hold_set: bool,
}

/// The usual name of a column: A to Z, then AA, AB ….
pub(crate) fn column_name(column: usize) -> String {
    let letter = char::from(b'A' + (column % 26) as u8);
    let mut name = if column < 26 { String::new() } else { column_name(column / 26 - 1) };
    name.push(letter);
    name
}

/// What says nothing is not written.
pub(crate) fn is_default<T: Default + PartialEq>(value: &T) -> bool {
    *value == T::default()
}

/// In words, for the reason columns.
impl fmt::Display for Why {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut reasons = Vec::new();
        match self.pinned.as_deref() {
            None => {}
            Some("") => reasons.push("pinned".into()),
            Some(name) => reasons.push(format!("pinned: {name}")),
        }
        if let Some(from) = self.moved_from {
            reasons.push(format!("moved from frame {from}"));
        }
        match self.reason {
            Some(Reason::Fill) => reasons.push("keeps the body on its way".into()),
            Some(Reason::Rest) => reasons.push("a rest begins or ends".into()),
            Some(Reason::Contact) => reasons.push("a foot or a hand comes down or leaves".into()),
            Some(Reason::Turn | Reason::Pin) | None => {}
        }
        if let [first, ..] = &*self.voters {
            let others = self.voters.len() - 1;
            let more =
                if others > 0 { format!(" and {others} more turn") } else { " turns".into() };
            reasons.push(format!("{first}{more}"));
        }
        if let Some(price) = self.price {
            reasons.push(format!("saves {price:.1} % of body height"));
        }
        let mut count = |count: usize, what: &str, words: &str| {
            if count > 0 {
                let plural = if count > 1 && what == "drawing" { "s" } else { "" };
                reasons.push(format!("{count} {what}{plural} {words}"));
            }
        };
        count(self.omitted_before, "drawing", "left out before it (naka-nashi)");
        count(self.lengthened, "koma", "given to it (naka-nashi)");
        let by = if self.hold_set { "held over" } else { "held over (koma-dori)" };
        count(self.held_for, "drawing", by);
        if self.hold_set {
            reasons.push("stays as long as was set by hand".into());
        }
        f.write_str(&reasons.join("; "))
    }
}

impl Exposure {
    /// The koma of the layers up to this with it, if it may stand for so long.
    pub(crate) fn after(self, before: usize) -> Result<usize, String> {
        let koma = self.koma;
        if koma == 0 {
            return Err("an exposure of 0 koma is not seen: 1 at the least, or leave it out".into());
        }
        let after = before.checked_add(koma).filter(|after| *after <= MOST_KOMA);
        after.ok_or_else(|| {
            format!("{koma} koma here: the layers of a sheet have {MOST_KOMA} at the most")
        })
    }
}

impl Layer {
    /// Checks it, of which the layers before have so many koma. Gives those with it.
    fn check(&self, before: usize) -> Result<usize, Error> {
        let (name, drawings) = (&self.name, self.drawings.len());
        if let Some(wrong) = self.exposures.iter().find(|shown| shown.drawing >= drawings) {
            let drawing = wrong.drawing;
            let message = format!("layer {name} shows drawing {drawing} but has {drawings}");
            return Err(Error::sheet(message));
        }
        let after = self.exposures.iter().try_fold(before, |before, shown| shown.after(before));
        after.map_err(|message| Error::sheet(format!("layer {name}: {message}")))
    }

    /// Koma of the layer: the sum of its exposures.
    pub fn length(&self) -> usize {
        self.exposures.iter().map(|exposure| exposure.koma).sum()
    }

    /// Each exposure with the koma it begins on, from 0.
    ///
    /// ```
    /// use genga::sheet::{Exposure, Layer};
    ///
    /// let exposures = [3, 1, 2].map(|koma| Exposure { drawing: 0, koma }).to_vec();
    /// let layer = Layer { name: "A".into(), joints: vec![], drawings: vec![], exposures };
    /// assert!(layer.timed().map(|(begin, _)| begin).eq([0, 3, 4]));
    /// ```
    pub fn timed(&self) -> impl Iterator<Item = (usize, Exposure)> + '_ {
        self.exposures.iter().scan(0, |koma, &exposure| {
            let begin = *koma;
            *koma += exposure.koma;
            Some((begin, exposure))
        })
    }

    /// The koma on which another drawing comes, from 0, with its index into [`Layer::drawings`]. One that goes on over two
    /// exposures is no change.
    ///
    /// ```
    /// use genga::sheet::{Exposure, Layer};
    ///
    /// let exposures = [(0, 3), (0, 1), (1, 2), (0, 1)];
    /// let exposures = exposures.map(|(drawing, koma)| Exposure { drawing, koma }).to_vec();
    /// let layer = Layer { name: "A".into(), joints: vec![], drawings: vec![], exposures };
    /// assert!(layer.changes().eq([(0, 0), (4, 1), (6, 0)]));
    /// ```
    pub fn changes(&self) -> impl Iterator<Item = (usize, usize)> + '_ {
        let mut before = None;
        let drawings = self.timed().map(|(koma, shown)| (koma, shown.drawing));
        drawings.filter(move |(_, drawing)| before.replace(*drawing) != Some(*drawing))
    }

    /// The drawing on each koma, as an index into [`Layer::drawings`].
    pub fn koma(&self) -> impl Iterator<Item = usize> + '_ {
        self.exposures
            .iter()
            .flat_map(|exposure| std::iter::repeat_n(exposure.drawing, exposure.koma))
    }

    /// The drawings that are on screen at all, in their order: a person may have left others.
    pub fn shown(&self) -> impl Iterator<Item = &Drawing> {
        let mut is_shown = vec![false; self.drawings.len()];
        for exposure in &self.exposures {
            if let Some(is_shown) = is_shown.get_mut(exposure.drawing) {
                *is_shown = true;
            }
        }
        let drawings = self.drawings.iter().zip(is_shown);
        drawings.filter_map(|(drawing, is_shown)| is_shown.then_some(drawing))
    }

    /// Drawings of a role that are on screen.
    pub fn count(&self, role: Role) -> usize {
        self.shown().filter(|drawing| drawing.role == role).count()
    }

    /// Genga on screen, the clip's first and last drawing among them: how many poses are to be drawn, from
    /// which inbetweens are then made.
    pub fn genga(&self) -> usize {
        self.shown().filter(|drawing| drawing.role.is_kept()).count()
    }

    /// The number of each drawing among the kept ones, genga and ends as one series from 1; none for
    /// inbetweens.
    pub fn genga_numbers(&self) -> Vec<Option<usize>> {
        let number = |kept: &mut usize, drawing: &Drawing| {
            *kept += usize::from(drawing.role.is_kept());
            Some(drawing.role.is_kept().then_some(*kept))
        };
        self.drawings.iter().scan(0, number).collect()
    }

    /// Koma of the longest exposure; 0 for an empty layer.
    pub fn longest_hold(&self) -> usize {
        self.exposures.iter().map(|exposure| exposure.koma).max().unwrap_or(0)
    }

    /// Koma that repeat the drawing before them.
    pub fn held_koma(&self) -> usize {
        self.length() - self.exposures.len()
    }
}

impl Sheet {
    /// A sheet of some layers, whose drawings carry the body.
    pub fn new(clock: Clock, layers: Vec<Layer>) -> Self {
        let (root, feet) = (RootMotion::default(), Feet::default());
        Self { clock, layers, root, feet, lines: vec![] }
    }

    /// Checks that every exposure shows a drawing that its layer has, for a koma at least, that no
    /// layer has more than a million koma, that no joint is of two, and that what is spoken is so on the sheet.
    ///
    /// # Errors
    /// [`Error::Sheet`] naming the first layer or line of which that is not so.
    pub fn check(&self) -> Result<(), Error> {
        self.layers.iter().try_fold(0, |before, layer| layer.check(before))?;
        let mut layer_of = HashMap::new();
        for layer in &self.layers {
            for joint in &layer.joints {
                if let Some(other) = layer_of.insert(joint, &layer.name) {
                    let name = &layer.name;
                    return Err(Error::sheet(format!(
                        "layer {name}: {joint} is in layer {other} already; a joint is of one layer"
                    )));
                }
            }
        }
        self.check_lines()
    }

    fn check_lines(&self) -> Result<(), Error> {
        let length = self.length();
        for line in &self.lines {
            let (words, begin) = (&line.words, line.begin);
            if line.koma == 0 || words.trim().is_empty() {
                return Err(Error::sheet(format!(
                    "the line \"{words}\" on koma {begin} has no koma or no words; leave it out"
                )));
            }
            if line.past() > length {
                return Err(Error::sheet(format!(
                    "the line \"{words}\" ends on koma {}, and the sheet has {length}; shorten it",
                    line.past()
                )));
            }
        }
        match self.lines.windows(2).find(|pair| pair[0].begin > pair[1].begin) {
            Some(pair) => Err(Error::sheet(format!(
                "the line \"{}\" begins before the one in front of it; sort them by begin",
                pair[1].words
            ))),
            None => Ok(()),
        }
    }

    /// The same with lines of a sheet of another length: what lies beyond this one is cut off.
    pub(crate) fn with_lines(mut self, lines: &[SpokenLine]) -> Self {
        let length = self.length();
        let heard = lines.iter().filter(|line| line.begin < length);
        let cut = |line: &SpokenLine| SpokenLine {
            koma: line.koma.min(length - line.begin),
            ..line.clone()
        };
        self.lines = heard.map(cut).collect();
        self
    }

    /// The first layer, to which every joint belongs that no other names.
    ///
    /// # Errors
    /// [`Error::Sheet`] as [`Sheet::check`], and when there is no such layer or it has no koma.
    pub fn first_layer(&self) -> Result<&Layer, Error> {
        self.check()?;
        let layer = self.layers.first().filter(|layer| !layer.exposures.is_empty());
        layer.ok_or_else(|| Error::sheet("the sheet is empty: its first layer has no koma"))
    }

    /// Koma of the sheet: that of its longest layer.
    pub fn length(&self) -> usize {
        self.layers.iter().map(Layer::length).max().unwrap_or(0)
    }

    /// The sheet of a clip on ones (1コマ打ち): a drawing a koma, no keys searched. The first and the
    /// last drawing are ends.
    pub fn on_ones(clock: Clock, koma: usize) -> Self {
        let drawing = |at| Drawing {
            source: Source::At(clock.place_from_koma(at)),
            role: if at == 0 || at + 1 == koma { Role::End } else { Role::Inbetween },
            why: Why::default(),
        };
        let layer = Layer {
            name: "A".into(),
            joints: vec![],
            drawings: (0..koma).map(drawing).collect(),
            exposures: (0..koma).map(|drawing| Exposure { drawing, koma: 1 }).collect(),
        };
        Self::new(clock, vec![layer])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::time::{Frame, FrameRate};

    fn clock() -> Clock {
        Clock { first: Frame(0), frame_rate: FrameRate::new(120.0).unwrap(), koma_rate: 24.0 }
    }

    #[test]
    fn on_ones_has_a_drawing_a_koma_and_ends_at_both_ends() {
        let sheet = Sheet::on_ones(clock(), 3);
        let layer = &sheet.layers[0];
        assert_eq!(sheet.length(), 3);
        assert_eq!(layer.koma().collect::<Vec<_>>(), [0, 1, 2]);
        assert_eq!(layer.drawings[2].source, Source::At(10.0));
        assert_eq!((layer.count(Role::End), layer.count(Role::Inbetween)), (2, 1));
        assert_eq!(Sheet::on_ones(clock(), 0).length(), 0);
        assert_eq!(Sheet::on_ones(clock(), 1).layers[0].count(Role::End), 1);
    }

    #[test]
    fn a_drawing_that_is_on_screen_counts_once_and_another_not_at_all() {
        let mut layer = Sheet::on_ones(clock(), 4).layers.remove(0);
        let shown = [3, 0, 3, 2, 0, 9].map(|drawing| Exposure { drawing, koma: 2 });
        layer.exposures = shown.to_vec();
        let places: Vec<_> = layer.shown().map(|drawing| drawing.source.place()).collect();
        assert_eq!(places, [0.0, 10.0, 15.0]);
        assert_eq!((layer.count(Role::End), layer.count(Role::Inbetween)), (2, 1));
    }

    #[test]
    fn a_joint_is_of_one_layer() {
        let mut sheet = Sheet::on_ones(clock(), 2);
        let mut arm = Layer { name: "B".into(), ..sheet.layers[0].clone() };
        arm.joints = vec!["Hand".into(), "Arm".into()];
        sheet.layers.push(arm.clone());
        assert!(sheet.check().is_ok());
        sheet.layers.push(Layer { name: "C".into(), joints: vec!["Arm".into()], ..arm });
        let error = sheet.check().unwrap_err().to_string();
        assert_eq!(error, "layer C: Arm is in layer B already; a joint is of one layer");
        sheet.layers[2].joints = vec!["Foot".into(), "Foot".into()];
        assert!(sheet.check().is_err(), "nor is it twice of the same");
    }

    #[test]
    fn a_blend_lies_between_its_keys() {
        let source = Source::Between { from: 10.0, to: 20.0, share: 0.25 };
        assert_eq!(source.place(), 12.5);
    }

    #[test]
    fn timed_gives_each_exposure_its_first_koma() {
        let mut layer = Sheet::on_ones(clock(), 3).layers.remove(0);
        layer.exposures[0].koma = 4;
        let begins: Vec<_> = layer.timed().map(|(begin, _)| begin).collect();
        assert_eq!(begins, [0, 4, 5]);
        assert_eq!((layer.length(), layer.longest_hold(), layer.held_koma()), (6, 4, 3));
        assert_eq!(layer.koma().collect::<Vec<_>>(), [0, 0, 0, 0, 1, 2]);
    }
}
