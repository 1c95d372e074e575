//! Everything that is shown in a frame (表示). All panels read it, and none changes it.

use egui::{TextureId, Vec2};

use super::column::Column;
use super::command::Command;
use super::composite_poses::OnScreen;
use super::document::Document;
use super::footage_cache::FrameCache;
use super::scene::Scene;
use super::sound_track::Track;
use super::theme::Look;
use super::waveform::Waveform;
use super::words::Words;
use genga::edits::Forbidden;
use genga::motion::JointId;
use genga::pipeline::Breakdown;
use genga::recipe::Footage;
use genga::time::Frame;

/// Reference footage at a koma.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Beside<'a> {
    /// Number of pictures, 0 while they are being listed. `None` if the document names none.
    pub(super) pictures: Option<usize>,
    /// Number of the koma's picture, from 0; `picture` is its texture, or a nearby one while it is read.
    pub(super) number: Option<usize>,
    pub(super) picture: Option<(TextureId, Vec2)>,
    pub(super) waveform: Option<&'a Waveform>,
}

impl<'a> Beside<'a> {
    /// Looks up the footage at a koma.
    pub(super) fn at(
        reel: &FrameCache,
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

/// The results as shown at one koma.
pub(super) struct Shown<'a> {
    pub(super) breakdown: Breakdown<'a>,
    /// All columns laid on one another.
    pub(super) on_screen: OnScreen<'a>,
    /// Every column; `chosen` is the index of the selected one.
    pub(super) columns: Vec<Column<'a>>,
    pub(super) chosen: usize,
    pub(super) scene: &'a Scene,
    /// The document asked for. The results of a slow clip may lag behind it.
    pub(super) wanted: &'a Document,
    /// The genga that a person took away since the clip was opened.
    pub(super) taken: &'a [Taken],
    /// The joints whose curves and trails are drawn.
    pub(super) joints: &'a [JointId],
    /// The koma of the play head.
    pub(super) at: usize,
    /// Whether source frames are counted instead of koma.
    pub(super) counts_frames: bool,
    /// Reference footage at the koma.
    pub(super) beside: Beside<'a>,
    pub(super) look: Look,
    pub(super) words: Words,
}

/// A genga that a person took away (禁止した原画): its ban, its frame, and the koma on which it was seen.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Taken {
    pub(super) ban: Forbidden,
    pub(super) frame: Frame,
    pub(super) koma: usize,
}

impl<'a> Shown<'a> {
    /// The selected column.
    pub(super) fn column(&self) -> &Column<'a> {
        &self.columns[self.chosen]
    }

    /// Whether the motion is exaggerated before it is drawn.
    pub(super) fn is_exaggerated(&self) -> bool {
        !self.wanted.recipe.exaggerate.is_off()
    }

    /// Loudness between two koma, 0 to 1. `None` without a sound.
    pub(super) fn level(&self, from: f64, to: f64) -> Option<f32> {
        let second = |koma| self.wanted.footage.second(koma, self.column().clock.koma_rate);
        self.beside.waveform.map(|waveform| waveform.level(second(from), second(to)))
    }

    /// The place of the source at a koma. Every round of a loop goes through the clip again.
    pub(super) fn place(&self, koma: usize) -> f64 {
        let (column, clock) = (self.column(), self.column().clock);
        let Some(repeat) = self.breakdown.sheet.repeat else { return clock.place_from_koma(koma) };
        let (first, frames) = (clock.place_from_koma(0), repeat.frames as f64);
        let begin = column.cells[0].drawing.source.place() - first;
        let gone = (koma % repeat.koma.max(1)) as f64 * frames / repeat.koma.max(1) as f64;
        first + (begin + gone) % frames
    }

    /// The command that moves the play head to a koma. `None` if it stands there already.
    pub(super) fn go(&self, koma: usize) -> Option<Command> {
        let koma = koma.min(self.column().length.saturating_sub(1));
        (koma != self.at).then_some(Command::Go(koma))
    }

    /// The command that selects a column. `None` if it is selected already.
    pub(super) fn choose(&self, column: usize) -> Option<Command> {
        (column != self.chosen).then_some(Command::Column(column))
    }

    /// The source frame nearest to a place, within the clip.
    pub(super) fn frame(&self, place: f64) -> Frame {
        let clip = self.breakdown.clip;
        let frame = place.round().max(0.0) as usize;
        Frame(frame.clamp(clip.first().0, clip.last().0))
    }

    /// The first and the last frame of a ban; the last lies within the clip.
    pub(super) fn ends(&self, ban: Forbidden) -> [Frame; 2] {
        [ban.from, self.frame(ban.past.0 as f64 - 1.0)]
    }

    /// The first and the last koma of a ban in a column, between the genga that stay: those may stand on other koma than
    /// their frames.
    pub(super) fn koma_of_ban(&self, column: &Column<'_>, ban: Forbidden) -> [usize; 2] {
        let [from, to] = self.ends(ban).map(|frame| column.clock.koma_from_frame(frame));
        let keyed = || column.cells.iter().filter_map(|cell| Some((cell.key?.frame, cell.koma)));
        let before = keyed().rfind(|(frame, _)| *frame < ban.from);
        let after = keyed().find(|(frame, _)| *frame >= ban.past);
        let from = before.map_or(from, |(_, koma)| from.max(koma + 1));
        let to = after.map_or(to, |(_, koma)| to.min(koma.saturating_sub(1)));
        [from, to.max(from)]
    }

    /// The found genga that a ban takes away from a column, by their frames, with the koma on which they were seen, else
    /// those of their frames. A genga belongs to the shortest ban.
    pub(super) fn taken_away(&self, column: &Column<'_>, ban: Forbidden) -> Vec<(usize, Frame)> {
        let edits = self.wanted.edits.of_layer(column.name);
        let length = |ban: &Forbidden| ban.past.0 - ban.from.0;
        let in_koma = column.clock.frames_in_koma();
        let is_its = |frame: &Frame| {
            let bans = edits.forbidden.iter().filter(|own| own.reaches(*frame, in_koma));
            bans.min_by_key(|own| length(own)) == Some(&ban)
        };
        let seen =
            |frame: Frame| self.taken.iter().rfind(|own| (own.ban, own.frame) == (ban, frame));
        let koma =
            |frame| seen(frame).map_or_else(|| column.clock.koma_from_frame(frame), |own| own.koma);
        let taken = column.found.keys.taken_by(ban, in_koma).filter(is_its);
        taken.map(|frame| (koma(frame), frame)).collect()
    }

    /// The koma, in the middle of a ban or of the one genga that it takes away.
    pub(super) fn middle_of_ban(&self, column: &Column<'_>, ban: Forbidden) -> f32 {
        match self.taken_away(column, ban).as_slice() {
            [(koma, _)] => *koma as f32,
            _ => {
                let [from, to] = self.koma_of_ban(column, ban);
                0.5 * (from + to.min(column.length.saturating_sub(1))) as f32
            }
        }
    }

    /// Names the koma on which a source frame is shown, or the frame if frames are counted.
    pub(super) fn named(&self, frame: Frame) -> String {
        let koma = || self.column().koma_of(frame) + 1;
        let number = if self.counts_frames { frame.0 } else { koma() };
        self.counted(&number.to_string())
    }

    /// Names the koma of a ban in the selected column, or its frames if frames are counted, and before them that of the
    /// one genga that it takes away.
    pub(super) fn named_ban(&self, ban: Forbidden) -> String {
        let column = self.column();
        let [from, to] = match self.counts_frames {
            true => self.ends(ban).map(|frame| frame.0),
            false => self.koma_of_ban(column, ban).map(|koma| koma + 1),
        };
        let range = if from == to { from.to_string() } else { format!("{from}–{to}") };
        match self.taken_away(column, ban).as_slice() {
            [(koma, frame)] if from != to => {
                let number = if self.counts_frames { frame.0 } else { koma + 1 };
                self.counted(&format!("{number} ({range})"))
            }
            _ => self.counted(&range),
        }
    }

    /// Says what a number counts.
    fn counted(&self, number: &str) -> String {
        match (self.counts_frames, self.words.is_japanese()) {
            (false, false) => format!("koma {number}"),
            (false, true) => format!("コマ{number}"),
            (true, false) => format!("frame {number}"),
            (true, true) => format!("フレーム{number}"),
        }
    }

    /// The source frame nearest to a koma, within the clip.
    pub(super) fn frame_of_koma(&self, koma: usize) -> Frame {
        self.frame(self.place(koma))
    }
}
