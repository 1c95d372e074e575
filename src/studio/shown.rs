//! What is shown (表示): everything that the panels of one frame read, and none of them changes.

use egui::{TextureId, Vec2};

use super::column::Column;
use super::command::Command;
use super::document::Document;
use super::look::Look;
use super::on_screen::OnScreen;
use super::reel::Reel;
use super::scene::Scene;
use super::track::Track;
use super::waveform::Waveform;
use super::words::Words;
use crate::motion::JointId;
use crate::pipeline::Breakdown;
use crate::recipe::Footage;
use crate::time::Frame;

/// What was recorded beside the motion, at a koma.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Beside<'a> {
    /// How many pictures there are, or none while they are looked for; nothing where none are asked for.
    pub(super) pictures: Option<usize>,
    /// The picture of the koma by its number, from 0, and what of it is there.
    pub(super) number: Option<usize>,
    pub(super) picture: Option<(TextureId, Vec2)>,
    pub(super) waveform: Option<&'a Waveform>,
}

impl<'a> Beside<'a> {
    /// What there is of it at a koma.
    pub(super) fn at(
        reel: &Reel,
        track: &'a Track,
        footage: &Footage,
        at: usize,
        koma_rate: f64,
    ) -> Self {
        let number = footage.picture(at, koma_rate).filter(|number| *number < reel.count());
        let picture = reel.shown().map(|texture| (texture.id(), texture.size_vec2()));
        Self {
            pictures: (!footage.pictures.is_empty()).then(|| reel.count()),
            number,
            picture: picture.filter(|_| number.is_some()),
            waveform: track.waveform.as_ref(),
        }
    }
}

/// A look at the results from one koma.
pub(super) struct Shown<'a> {
    pub(super) breakdown: Breakdown<'a>,
    /// All columns on one another.
    pub(super) on_screen: OnScreen<'a>,
    /// Every column, and which of them is worked on.
    pub(super) columns: Vec<Column<'a>>,
    pub(super) chosen: usize,
    pub(super) scene: &'a Scene,
    /// What is asked for: of a clip that takes long not yet what the results are made of.
    pub(super) wanted: &'a Document,
    /// The joints whose curves and trails are drawn.
    pub(super) joints: &'a [JointId],
    /// The koma of the play head.
    pub(super) at: usize,
    /// Whether frames of the source are counted, and not koma.
    pub(super) counts_frames: bool,
    /// What was recorded beside the motion.
    pub(super) beside: Beside<'a>,
    pub(super) look: Look,
    pub(super) words: Words,
}

impl<'a> Shown<'a> {
    /// The column that is worked on.
    pub(super) fn column(&self) -> &Column<'a> {
        &self.columns[self.chosen]
    }

    /// Whether another motion is drawn than was captured.
    pub(super) fn is_exaggerated(&self) -> bool {
        !self.wanted.recipe.exaggerate.is_off()
    }

    /// How loud it is from a koma to another, 0 to 1, where there is a sound.
    pub(super) fn level(&self, from: f64, to: f64) -> Option<f32> {
        let second = |koma| self.wanted.footage.second(koma, self.column().clock.koma_rate);
        self.beside.waveform.map(|waveform| waveform.level(second(from), second(to)))
    }

    /// To a koma, if the play head is elsewhere.
    pub(super) fn go(&self, koma: usize) -> Option<Command> {
        let koma = koma.min(self.column().length.saturating_sub(1));
        (koma != self.at).then_some(Command::Go(koma))
    }

    /// To a column, if another is worked on.
    pub(super) fn choose(&self, column: usize) -> Option<Command> {
        (column != self.chosen).then_some(Command::Column(column))
    }

    /// The source frame nearest to a place, within the clip.
    pub(super) fn frame(&self, place: f64) -> Frame {
        let clip = self.breakdown.clip;
        let frame = place.round().max(0.0) as usize;
        Frame(frame.clamp(clip.first().0, clip.last().0))
    }

    /// The source frame nearest to a koma, within the clip.
    pub(super) fn frame_of_koma(&self, koma: usize) -> Frame {
        self.frame(self.column().clock.place_from_koma(koma))
    }
}
