//! The timesheet (タイムシート): which drawing is on screen on which koma. It is the program's one result.
//!
//! Plain data: every delivered file is a function of (clip, sheet).

mod blank;
mod camera;
mod number;
mod numbers;
mod renumber;
mod source_time;
mod spoken;
mod why;

use std::borrow::Cow;
use std::collections::HashMap;

use serde::{Deserialize, Serialize};

use crate::error::Error;
use crate::knob::choices;
use crate::slate::Slate;
use crate::time::{Clock, FrameRate};

pub use blank::Blank;
pub use camera::CameraWork;
pub use number::Number;
pub use numbers::{Gone, Numbers};
pub use renumber::Renumbered;
pub use spoken::SpokenLine;
pub use why::{Names, Reason, Why};

/// Most koma that all layers together may have: half a day of film. A longer hold is a slip of the hand and would
/// exhaust the memory.
pub(crate) const MOST_KOMA: usize = 1_000_000;

/// A timesheet: the drawings of each layer and how long each stays on screen.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Sheet {
    /// Maps the koma of the sheet to places in the source.
    pub clock: Clock,
    /// Layers (セル), back to front: column A first.
    pub layers: Vec<Layer>,
    /// How the body travels through the room while a drawing is held.
    #[serde(default, skip_serializing_if = "is_default")]
    pub root: RootMotion,
    /// Whether a foot on the ground stays in place.
    #[serde(default, skip_serializing_if = "is_default")]
    pub feet: Feet,
    /// Spoken lines (セリフ), sorted by their first koma. Their koma are those of the cut, blank ones included.
    #[serde(default, skip_serializing_if = "is_default")]
    pub lines: Vec<SpokenLine>,
    /// Camera work (カメラワーク), sorted by its first koma in the cut.
    #[serde(default, skip_serializing_if = "is_default")]
    pub camera: Vec<CameraWork>,
    /// Blank koma (カラ) before and after the drawings. Layers, exposures and clock do not count them.
    #[serde(default, skip_serializing_if = "is_default")]
    pub blank: Blank,
    /// Names and numbers of the cut; empty fields are those of the file name.
    #[serde(default, skip_serializing_if = "is_default")]
    pub slate: Slate,
    /// The round that repeats; `None` for a sheet that is played once.
    #[serde(default, skip_serializing_if = "is_default")]
    pub repeat: Option<Repeat>,
}

/// The round of a sheet that repeats (リピート): its last drawing goes on with the first.
///
/// The drawings of a round lie between the clip's first and last frame, which show one pose. Where a layer goes back in
/// the source, it goes on in the next round.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, expecting = "a round {\"frames\", \"koma\"}")]
pub struct Repeat {
    /// Source frames from a pose to the same pose in the next round.
    pub frames: usize,
    /// Koma of a round.
    pub koma: usize,
}

impl Repeat {
    /// Returns the frames per second at which a round lasts its whole number of koma. The source may be a little slower
    /// or faster.
    ///
    /// # Errors
    /// [`Error::Setting`] if it is no valid [`FrameRate`], as for a round without frames or koma.
    pub fn frame_rate(self, koma_rate: f64) -> Result<FrameRate, Error> {
        FrameRate::new(self.frames as f64 * koma_rate / self.koma as f64)
    }
}

/// How a foot on the ground (接地) behaves in the delivered motion.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Feet {
    /// The foot moves freely, as drawn.
    #[default]
    Free,
    /// While the foot stands in the source, every drawing puts it at its mean position of that contact. Hip and knee
    /// bend as far as the leg reaches; the pelvis stays.
    Held,
}

choices!(Feet { Free: "free", Held: "held" });

/// How the body travels through the room (移動) from koma to koma.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum RootMotion {
    /// With the drawings: the body stays where its drawing has it for as long as the drawing is held.
    #[default]
    Drawings,
    /// With the source, on ones (1コマ打ち): a held drawing slides on with the performer's travel, by the source time that
    /// the sheet shows ([`Layer::source_places`]). Only the position follows the source, not the orientation.
    Ones,
}

choices!(RootMotion { Drawings: "drawings", Ones: "ones" });

/// A layer (セル): a group of joints with its own column on the sheet.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Layer {
    /// The column's name: A, B, C ….
    pub name: String,
    /// Names of its joints. A joint that no layer names belongs to the first layer; a single layer without names has
    /// all joints.
    #[serde(default, skip_serializing_if = "is_default")]
    pub joints: Vec<String>,
    /// Drawings in the order of their source places.
    pub drawings: Vec<Drawing>,
    /// Exposures in order of time.
    pub exposures: Vec<Exposure>,
    /// Drawings that earlier sheets of the cut had, whose numbers no other drawing gets.
    #[serde(default, skip_serializing_if = "is_default")]
    pub gone: Vec<Gone>,
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

/// A drawing (画): a pose taken from the source, or blended from two keys.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Drawing {
    /// Origin of its pose.
    pub source: Source,
    /// Its role in the motion.
    pub role: Role,
    /// Why it is on the sheet.
    pub why: Why,
    /// Its numbers, if they come from an earlier sheet.
    #[serde(default, skip_serializing_if = "is_default")]
    pub numbers: Numbers,
}

/// Origin of a drawing's pose.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Source {
    /// The source at a place: a frame number of the file, fractional between two frames.
    At(f64),
    /// An inbetweener's blend of two key poses: `share` of the way from the first to the second.
    Between {
        /// Place of the earlier key.
        from: f64,
        /// Place of the later key.
        to: f64,
        /// 0 is `from`, 1 is `to`.
        share: f64,
    },
}

impl Drawing {
    /// Creates a drawing whose number is its place in the list.
    pub fn new(source: Source, role: Role, why: Why) -> Self {
        Self { source, role, why, numbers: Numbers::default() }
    }
}

impl Source {
    /// Returns the place in the source, as a fractional frame number.
    pub fn place(self) -> f64 {
        match self {
            Self::At(place) => place,
            Self::Between { from, to, share } => from + share * (to - from),
        }
    }

    /// Returns the source so many frames later.
    pub fn later(self, frames: f64) -> Self {
        match self {
            Self::At(place) => Self::At(place + frames),
            Self::Between { from, to, share } => {
                Self::Between { from: from + frames, to: to + frames, share }
            }
        }
    }
}

/// Role of a drawing in the motion.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Role {
    /// A key drawing (原画): a start, an end or a turning point.
    Genga,
    /// A drawing between two keys (中割り).
    Inbetween,
    /// The first or last drawing of the clip, or where a passage meets the take as it is: a genga even if no key was found
    /// there.
    End,
}

impl Role {
    /// Returns the word used in files.
    pub fn word(self) -> &'static str {
        match self {
            Self::Genga => "genga",
            Self::Inbetween => "inbetween",
            Self::End => "end",
        }
    }

    /// Whether the omission stages must leave the drawing in place.
    pub fn is_kept(self) -> bool {
        self != Self::Inbetween
    }
}

/// Returns the usual name of a column: A to Z, then AA, AB ….
pub fn column_name(column: usize) -> String {
    let letter = char::from(b'A' + (column % 26) as u8);
    let mut name = if column < 26 { String::new() } else { column_name(column / 26 - 1) };
    name.push(letter);
    name
}

/// Whether a value equals its default, and serialization can skip it.
pub fn is_default<T: Default + PartialEq>(value: &T) -> bool {
    *value == T::default()
}

impl Exposure {
    /// Adds this exposure to the koma counted `before` it. Fails if it lasts 0 koma or the sum exceeds a million.
    pub fn after(self, before: usize) -> Result<usize, String> {
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
    /// Checks the layer. `before` is the number of koma in the layers before it; returns that number plus its own.
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

    /// Number of koma in the layer: the sum of its exposures.
    pub fn length(&self) -> usize {
        self.exposures.iter().map(|exposure| exposure.koma).sum()
    }

    /// Returns each exposure with its first koma, counted from 0.
    ///
    /// ```
    /// use genga::sheet::{Exposure, Layer};
    ///
    /// let exposures = [3, 1, 2].map(|koma| Exposure { drawing: 0, koma }).to_vec();
    /// let layer = Layer { name: "A".into(), joints: vec![], drawings: vec![], exposures, gone: vec![] };
    /// assert!(layer.timed().map(|(begin, _)| begin).eq([0, 3, 4]));
    /// ```
    pub fn timed(&self) -> impl Iterator<Item = (usize, Exposure)> + '_ {
        self.exposures.iter().scan(0, |koma, &exposure| {
            let begin = *koma;
            *koma += exposure.koma;
            Some((begin, exposure))
        })
    }

    /// Returns each koma, counted from 0, on which a new drawing appears, with its index into [`Layer::drawings`]. A
    /// drawing that continues over two exposures is no change.
    ///
    /// ```
    /// use genga::sheet::{Exposure, Layer};
    ///
    /// let exposures = [(0, 3), (0, 1), (1, 2), (0, 1)];
    /// let exposures = exposures.map(|(drawing, koma)| Exposure { drawing, koma }).to_vec();
    /// let layer = Layer { name: "A".into(), joints: vec![], drawings: vec![], exposures, gone: vec![] };
    /// assert!(layer.changes().eq([(0, 0), (4, 1), (6, 0)]));
    /// ```
    pub fn changes(&self) -> impl Iterator<Item = (usize, usize)> + '_ {
        let mut before = None;
        let drawings = self.timed().map(|(koma, shown)| (koma, shown.drawing));
        drawings.filter(move |(_, drawing)| before.replace(*drawing) != Some(*drawing))
    }

    /// Returns how many drawings come on screen a second. Those of a loop come in every round.
    pub fn drawings_per_second(&self, koma_rate: f64) -> f64 {
        self.per_second(self.changes().count(), koma_rate)
    }

    /// Returns how many genga come on screen a second, ends included.
    pub fn genga_per_second(&self, koma_rate: f64) -> f64 {
        let is_kept = |(_, drawing): &(usize, usize)| self.drawings[*drawing].role.is_kept();
        self.per_second(self.changes().filter(is_kept).count(), koma_rate)
    }

    fn per_second(&self, count: usize, koma_rate: f64) -> f64 {
        count as f64 * koma_rate / self.length().max(1) as f64
    }

    /// Returns the koma on which each drawing is first shown; `None` if it never is.
    pub fn first_koma(&self) -> Vec<Option<usize>> {
        let mut first = vec![None; self.drawings.len()];
        for (koma, exposure) in self.timed() {
            first[exposure.drawing].get_or_insert(koma);
        }
        first
    }

    /// Returns the drawing on each koma, as an index into [`Layer::drawings`].
    pub fn koma(&self) -> impl Iterator<Item = usize> + '_ {
        self.exposures
            .iter()
            .flat_map(|exposure| std::iter::repeat_n(exposure.drawing, exposure.koma))
    }

    /// Returns the drawing that is on screen on a koma.
    pub fn shown_at(&self, koma: usize) -> Option<&Drawing> {
        let shown = self.timed().take_while(|(begin, _)| *begin <= koma).last();
        let shown = shown.filter(|(begin, shown)| koma < begin + shown.koma);
        shown.and_then(|(_, shown)| self.drawings.get(shown.drawing))
    }

    /// Returns the drawings that appear on screen, in order. A person's edits may leave others unused.
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

    /// Number of drawings of a role on screen.
    pub fn count(&self, role: Role) -> usize {
        self.shown().filter(|drawing| drawing.role == role).count()
    }

    /// Number of genga on screen, the clip's first and last drawing included: the poses to draw by hand before
    /// inbetweening.
    pub fn genga(&self) -> usize {
        self.shown().filter(|drawing| drawing.role.is_kept()).count()
    }

    /// Number of koma of the longest exposure; 0 for an empty layer.
    pub fn longest_hold(&self) -> usize {
        self.exposures.iter().map(|exposure| exposure.koma).max().unwrap_or(0)
    }

    /// Number of koma that repeat the drawing before them.
    pub fn held_koma(&self) -> usize {
        self.length() - self.exposures.len()
    }
}

impl Sheet {
    /// Creates a sheet of these layers, with the default motion of root and feet, without blank koma or slate.
    pub fn new(clock: Clock, layers: Vec<Layer>) -> Self {
        let (root, feet) = (RootMotion::default(), Feet::default());
        let (blank, slate) = (Blank::default(), Slate::default());
        let (lines, camera, repeat) = (vec![], vec![], None);
        Self { clock, layers, root, feet, lines, repeat, camera, blank, slate }
    }

    /// Checks that each exposure lasts at least one koma and shows a drawing of its layer, that all layers together
    /// have at most a million koma, that no joint belongs to two layers, and that the spoken lines fit the sheet.
    ///
    /// # Errors
    ///
    /// [`Error::Sheet`] naming the first layer or line that fails.
    pub fn check(&self) -> Result<(), Error> {
        self.layers.iter().try_fold(0, |before, layer| layer.check(before))?;
        let Blank { before, after } = self.blank;
        if before.saturating_add(after) > MOST_KOMA {
            return Err(Error::sheet(format!("the sheet has over {MOST_KOMA} blank koma")));
        }
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
        self.check_lines()?;
        self.check_camera()
    }

    /// Returns the first layer, which owns every joint that no other layer names.
    ///
    /// # Errors
    ///
    /// [`Error::Sheet`] as in [`Sheet::check`], and if there is no layer or the first has no koma.
    pub fn first_layer(&self) -> Result<&Layer, Error> {
        self.check()?;
        let layer = self.layers.first().filter(|layer| !layer.exposures.is_empty());
        layer.ok_or_else(|| Error::sheet("the sheet is empty: its first layer has no koma"))
    }

    /// Number of koma with drawings: those of the longest layer. [`Sheet::cut_length`] has the blank ones too.
    pub fn length(&self) -> usize {
        self.layers.iter().map(Layer::length).max().unwrap_or(0)
    }

    /// Number of rounds of a loop that the sheet has: how often its exposures come again. 1 for a sheet that does not
    /// repeat, and for one whose rounds a person made different.
    pub fn rounds(&self) -> usize {
        let of_layer = |layer: &Layer| {
            let shown = &layer.exposures[..];
            let is_round = |count: &usize| {
                shown.len().is_multiple_of(*count)
                    && shown.chunks(*count).all(|round| round == &shown[..*count])
            };
            (1..=shown.len()).find(is_round).map_or(1, |count| shown.len() / count)
        };
        match self.repeat {
            None => 1,
            Some(_) => self.layers.iter().map(of_layer).min().unwrap_or(1),
        }
    }

    /// Returns the first round of a loop; any other sheet as it is.
    pub fn first_round(&self) -> Cow<'_, Self> {
        let rounds = self.rounds();
        if rounds == 1 {
            return Cow::Borrowed(self);
        }
        let mut round = self.clone();
        for layer in &mut round.layers {
            layer.exposures.truncate(layer.exposures.len() / rounds);
        }
        let length = round.length();
        round.lines.retain(|line| line.past() <= length);
        Cow::Owned(round)
    }

    /// Creates a sheet of a clip on ones (1コマ打ち): one drawing per koma, without a search for keys. The first and the
    /// last drawing are ends.
    pub fn on_ones(clock: Clock, koma: usize) -> Self {
        let drawing = |at| {
            let role = if at == 0 || at + 1 == koma { Role::End } else { Role::Inbetween };
            Drawing::new(Source::At(clock.place_from_koma(at)), role, Why::default())
        };
        let layer = Layer {
            name: "A".into(),
            joints: vec![],
            drawings: (0..koma).map(drawing).collect(),
            exposures: (0..koma).map(|drawing| Exposure { drawing, koma: 1 }).collect(),
            gone: vec![],
        };
        Self::new(clock, vec![layer])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::time::Frame;

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
    fn a_loop_has_as_many_rounds_as_all_its_layers() {
        let mut sheet = Sheet::on_ones(clock(), 4);
        sheet.layers[0].exposures = sheet.layers[0].exposures.repeat(6);
        assert_eq!(sheet.rounds(), 1, "a plain sheet may show drawings again");
        sheet.repeat = Some(Repeat { frames: 15, koma: 4 });
        assert_eq!(sheet.rounds(), 6);
        let held = Layer {
            exposures: vec![Exposure { drawing: 2, koma: 12 }; 2],
            ..sheet.layers[0].clone()
        };
        sheet.layers.push(held);
        assert_eq!(sheet.rounds(), 2);
        let round = sheet.first_round();
        assert_eq!((round.length(), round.layers[1].exposures.len(), round.rounds()), (12, 1, 1));
        sheet.layers[0].exposures[23].koma = 2;
        assert_eq!(sheet.rounds(), 1);
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
