//! Commands (操作): the actions that pointer and keyboard can ask for.

use std::ops::Range;
use std::path::PathBuf;

use super::corrections::Correction;
use super::export_settings::Order;
use super::goals::presets::Preset;
use super::panels::Side;
use genga::edits::Speech;
use genga::recipe::{Footage, Frames};

/// An action of the user.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Command {
    /// Plays or stops.
    Play,
    /// Steps by this many koma.
    Koma(isize),
    /// Steps by this many drawings.
    Drawing(isize),
    /// Steps by this many genga.
    Genga(isize),
    First,
    Last,
    /// Goes to a koma.
    Go(usize),
    /// Begins the played range here.
    LoopFrom,
    /// Ends the played range here.
    LoopTo,
    /// Plays the whole sheet.
    LoopAll,
    /// Makes a passage with settings of its own of the played range, or dissolves the one that it is.
    Passage,
    /// Removes the passage of some frames.
    Dissolve(Frames),
    /// Switches between source and result.
    Flip,
    /// Shows the source, the result or both.
    See(Seen),
    /// Looks from a standard side.
    Look(Standard),
    /// Fits the whole motion into the view.
    Fit,
    /// Zooms by a factor.
    Zoom(f32),
    Follow,
    Onion,
    Trails,
    /// Switches the source between exaggerated and captured.
    Exaggerated,
    /// Shows or hides the movement of the body into each koma.
    Movement,
    /// Opens or closes the map of the smoothing settings.
    Map,
    /// Freezes all genga, so that no knob changes them, or thaws them.
    Freeze,
    /// Finds the genga of the played range again; those outside it stay.
    FindAgain,
    /// Copies the genga of the column, or of its played range, to the clipboard.
    CopyKeys,
    /// Sets the genga of a text in the column.
    PasteKeys(String),
    /// Shows the sheet before the last change, or after it again.
    Compare,
    /// Shows the action at the play head on the strip, or the whole.
    StripZoom,
    /// Switches to the other sheet of the take, initially a copy of this one.
    Other,
    /// Counts frames instead of koma, or koma again.
    Frames,
    /// Sets a key at the play head, or removes it.
    ToggleKey,
    /// Pins the key at the play head, or unpins it.
    Pin,
    /// Moves the key at the play head by this many koma.
    Nudge(isize),
    /// Moves the key at the play head by this many source frames.
    NudgeFrame(isize),
    /// Lengthens the hold of the drawing at the play head by this many koma.
    Hold(isize),
    /// Adds to the spacing weight of the key at the play head: its inbetweens crowd closer to it.
    Crowd(f64),
    /// Multiplies the height of a koma on the sheet.
    SheetZoom(f32),
    /// Selects a column.
    Column(usize),
    /// Selects the next column, or the first after the last.
    NextColumn,
    /// Focuses the name field of the key at the play head.
    FocusName,
    /// Corrects the selected column.
    Correct(Correction),
    /// Opens the form for a spoken line over some koma. By default over the played range, or from the play head on.
    AskSpeech(Option<Range<usize>>),
    /// Opens a spoken line to be changed.
    EditSpeech(Speech),
    /// Opens the panel of reference footage.
    AskFootage,
    /// Sets pictures, sound and their offsets.
    Footage(Footage),
    /// Sets where the reference pictures are shown.
    Place(Placement),
    /// Mutes or unmutes the sound.
    Silence,
    /// Corrects the named column, or all columns.
    CorrectOf(Option<String>, Correction),
    /// A correction during a drag, applied to the document as it was when the drag began.
    Drag(Correction),
    /// Sets a knob.
    Set(&'static str, String),
    /// Sets several knobs.
    SetAll(&'static [(&'static str, &'static str)]),
    /// Sets the knobs of a preset.
    Preset(&'static Preset),
    /// Finds settings with this many genga.
    Keys(usize),
    /// Ends the search for a number of genga.
    StopSearch,
    /// Resets all knobs to their defaults.
    Defaults,
    Undo,
    Redo,
    Save,
    /// Opens or closes the field for a file name.
    OpenFile,
    /// Opens a clip, or a recipe for the one on the table.
    Open(PathBuf),
    /// Opens the take this many places further in the folder.
    Take(isize),
    /// Marks the take as done (`true`) or flagged (`false`), or removes that mark.
    Mark(bool),
    /// Leaves the take for another clip or closes the window, with its recipe saved or not.
    Leave {
        saves: bool,
    },
    /// Saves the recipe under another name.
    SaveAs(PathBuf),
    /// Opens the system's file dialog.
    Choose,
    /// Opens the built-in clip, and begins the tour.
    Sample,
    /// Begins the tour.
    Tour,
    /// Goes to the next step of the tour, or to the one before.
    TourStep(isize),
    EndTour,
    /// Opens the export panel.
    AskExport,
    /// Runs an export.
    Export(Box<Order>),
    /// Stops the export; nothing of it stays.
    StopExport,
    /// Opens the system's folder dialog for the export.
    ChooseFolder,
    /// Recovers the unsaved work of an earlier session.
    Recover,
    /// Discards the unsaved work of an earlier session.
    Discard,
    /// Switches between the light and the dark theme.
    Theme,
    Language,
    /// Hides or shows a panel.
    Panel(Side),
    /// Moves the focus to the next part of the window, or to the one before.
    Part(isize),
    /// Shows or hides the list of keys.
    Help,
    /// Closes everything that is open: messages, forms and panels.
    Dismiss,
}

/// Which motion is shown.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub(super) enum Seen {
    /// Both, side by side.
    #[default]
    Both,
    /// The motion as it was captured.
    Source,
    /// The result, as the sheet times it.
    Result,
}

/// Placement of reference pictures.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub(super) enum Placement {
    /// In a view of their own.
    #[default]
    Beside,
    /// Behind the figures.
    Behind,
    /// Not shown.
    Off,
}

/// A standard side to look from.
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
