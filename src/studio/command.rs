//! Commands (操作): what a hand or a key asks for, and the words it has for it.

use std::ops::Range;
use std::path::PathBuf;

use super::corrections::Correction;
use super::order::Order;
use super::panels::Side;
use crate::edits::Speech;
use crate::recipe::Footage;

/// What a hand asks for.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Command {
    /// Plays or stops.
    Play,
    /// So many koma on.
    Koma(isize),
    /// So many drawings on.
    Drawing(isize),
    /// So many genga on.
    Genga(isize),
    First,
    Last,
    /// To a koma.
    Go(usize),
    /// What is played begins here.
    LoopFrom,
    /// What is played ends here.
    LoopTo,
    /// All is played.
    LoopAll,
    /// From source to result and back.
    Flip,
    /// Source, result or both.
    See(Seen),
    /// From a standard side.
    Look(Standard),
    /// All of the motion fits into the view.
    Fit,
    /// Nearer or further.
    Zoom(f32),
    Follow,
    Onion,
    Trails,
    /// The source as it is drawn, or as it was captured.
    Exaggerated,
    /// How far the body moves into each koma.
    Movement,
    /// The map of what is found with other settings of the smoothing.
    Map,
    /// All genga stay as they are whatever the knobs say, or may be found again.
    Freeze,
    /// In the part that is played genga are found again; those outside stay.
    FindAgain,
    /// The genga of the column, or of the part that is played, go to the clipboard.
    CopyKeys,
    /// Genga of a text are set in the column.
    PasteKeys(String),
    /// The other sheet of the take; at first the one there is.
    Other,
    /// Frames are counted, or koma.
    Frames,
    /// A key at the play head, or none.
    ToggleKey,
    /// The key at the play head stays, or may go again.
    Lock,
    /// The key at the play head is drawn so many koma later.
    Nudge(isize),
    /// The same in source frames.
    NudgeFrame(isize),
    /// The drawing at the play head stays so many koma longer.
    Hold(isize),
    /// The inbetweens of the key at the play head crowd so much closer to it.
    Crowd(f64),
    /// Koma of the sheet become so many times as high.
    SheetZoom(f32),
    /// Another column is worked on.
    Column(usize),
    /// The next column is worked on, and the first after the last.
    NextColumn,
    /// Gives a name to the key at the play head.
    FocusName,
    /// A correction of the column that is worked on.
    Correct(Correction),
    /// A spoken line over some koma; without any over what is played, or from the play head on.
    AskSpeech(Option<Range<usize>>),
    /// A spoken line is looked at, to be changed.
    EditSpeech(Speech),
    /// What is shown and heard beside the motion is asked for.
    AskFootage,
    /// Other pictures, another sound, or the same with other offsets.
    Footage(Footage),
    /// Where the pictures are seen.
    Place(Placement),
    /// Nothing is heard while the sheet is played, or the sound.
    Silence,
    /// A correction of the column that is named, or of all.
    CorrectOf(Option<String>, Correction),
    /// A correction in the making: what was there when the hand took hold is corrected so.
    Drag(Correction),
    /// A knob and its value.
    Set(&'static str, String),
    /// Several knobs.
    Preset(&'static [(&'static str, &'static str)]),
    /// All knobs as they come.
    Defaults,
    Undo,
    Redo,
    Save,
    /// Opens or closes the field for a file's name.
    OpenFile,
    /// Opens a clip, or a recipe for the one on the table.
    Open(PathBuf),
    /// The take of the folder that is so many further.
    Take(isize),
    /// The take is done, or flagged; asked again it is not.
    Mark(bool),
    /// Saves the recipe under another name.
    SaveAs(PathBuf),
    /// Lets the person choose a file in a dialog of the system.
    Choose,
    /// Asks what is exported, and where.
    AskExport,
    /// Exports it.
    Export(Box<Order>),
    /// Stops writing; nothing of it stays.
    StopExport,
    /// Lets the person choose a folder for the export.
    ChooseFolder,
    /// Takes what an earlier session left.
    Recover,
    /// Throws it away.
    Discard,
    /// Light or dark.
    Theme,
    Language,
    /// A panel is put away, or back.
    Panel(Side),
    /// The keyboard goes so many parts of the window on.
    Part(isize),
    /// The list of keys.
    Help,
    /// Closes what is open.
    Dismiss,
}

/// Which of the two is seen.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub(super) enum Seen {
    /// Both, side by side.
    #[default]
    Both,
    /// The motion as it was captured.
    Source,
    /// What the sheet shows.
    Result,
}

/// Where pictures are seen that were taken beside the motion.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub(super) enum Placement {
    /// In a view of their own.
    #[default]
    Beside,
    /// Behind the figures.
    Behind,
    /// Nowhere.
    Off,
}

/// A side that everybody knows.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Standard {
    /// 正面.
    Front,
    /// 側面.
    Side,
    /// 真上.
    Top,
    /// 斜め.
    ThreeQuarter,
}
