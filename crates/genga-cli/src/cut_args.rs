//! The slate of a cut (カット), the koma on which its drawings stand, and its camera work.

use clap::Args;

use super::headings::SHEET;
use genga::edits::Edits;
use genga::error::Error;
use genga::sheet::{Blank, CameraWork, Sheet};
use genga::slate::Slate;

/// Options for the slate of a cut and for the koma of its drawings.
#[derive(Debug, Default, Clone, Args)]
pub(super) struct CutArgs {
    /// The work, on every sheet.
    #[arg(long, value_name = "NAME", help_heading = SHEET)]
    title: Option<String>,
    /// The episode [default: ep03 in the clip's name, if that has a cut].
    #[arg(long, value_name = "NUMBER", help_heading = SHEET)]
    episode: Option<String>,
    /// The scene [default: s12 or sc12 in the name].
    #[arg(long, value_name = "NUMBER", help_heading = SHEET)]
    scene: Option<String>,
    /// The cut [default: c045 or c045a in the name].
    #[arg(long, value_name = "NUMBER", help_heading = SHEET)]
    cut: Option<String>,
    /// The take [default: t2 or tk2 in the name].
    #[arg(long, value_name = "NUMBER", help_heading = SHEET)]
    take_number: Option<String>,
    /// The key animator.
    #[arg(long, value_name = "NAME", help_heading = SHEET)]
    animator: Option<String>,
    /// The koma on which the first drawing stands: --at 25
    ///
    /// Those before it are blank (カラ). A motion stands in its first pose there.
    #[arg(long, value_name = "KOMA", value_parser = koma, allow_negative_numbers = true, help_heading = SHEET)]
    at: Option<Koma>,
    /// Koma of the whole cut: --length 72, or 3+0 in seconds and koma
    ///
    /// Those after the drawings are blank (カラ). A motion stands in its last pose there.
    #[arg(long, value_name = "KOMA", value_parser = koma, allow_negative_numbers = true, help_heading = SHEET)]
    length: Option<Koma>,
}

/// A number of koma, also as seconds and koma: 3+0.
#[derive(Debug, Clone, Copy)]
struct Koma {
    seconds: usize,
    koma: usize,
}

impl Koma {
    /// Counts the koma at a rate of koma per second.
    fn count(self, rate: f64) -> usize {
        ((self.seconds as f64 * rate).round() as usize).saturating_add(self.koma)
    }
}

fn koma(text: &str) -> Result<Koma, String> {
    let (seconds, koma) = text.split_once('+').unwrap_or(("0", text));
    let number = |text: &str| text.trim().parse::<usize>().ok();
    let both = number(seconds).zip(number(koma)).filter(|both| *both != (0, 0));
    both.map(|(seconds, koma)| Koma { seconds, koma }).ok_or_else(|| {
        format!(
            "expected a number of koma, 1 or more, as in 25, or seconds and koma, as in 3+0; found \"{text}\""
        )
    })
}

impl CutArgs {
    /// Puts the cut over that of a recipe.
    pub(super) fn put(&self, edits: &mut Edits, rate: f64) {
        edits.at = self.at.map(|koma| koma.count(rate)).or(edits.at);
        edits.length = self.length.map(|koma| koma.count(rate)).or(edits.length);
        edits.slate = self.slate().over(std::mem::take(&mut edits.slate));
    }

    /// Puts the cut over that of a sheet.
    pub(super) fn place(&self, mut sheet: Sheet) -> Result<Sheet, Error> {
        let slate = self.slate();
        slate.validate()?;
        sheet.slate = slate.over(sheet.slate);
        let count = |koma: Option<Koma>| koma.map(|koma| koma.count(sheet.clock.koma_rate));
        let (at, length) = (count(self.at), count(self.length));
        sheet.placed(at, length)
    }

    fn slate(&self) -> Slate {
        let field = |field: &Option<String>| field.as_deref().unwrap_or_default().trim().to_owned();
        Slate {
            title: field(&self.title),
            episode: field(&self.episode),
            scene: field(&self.scene),
            cut: field(&self.cut),
            take: field(&self.take_number),
            animator: field(&self.animator),
        }
    }
}

/// Most guesses of camera work in a line.
const GUESSES: usize = 8;

/// Describes the slate of a sheet, its blank koma and the camera work that is guessed, a line each. `name` is that of the cut's files.
pub(super) fn lines(sheet: &Sheet, name: &str) -> Vec<String> {
    let of_name = Slate::from_name(name);
    let slate = sheet.slate.clone().over(of_name.clone());
    let mut lines = Vec::new();
    if !slate.is_empty() {
        let guess =
            if of_name.is_empty() { "" } else { " (numbers not given: from the file's name)" };
        lines.push(format!("slate       カット情報 {slate}{guess}"));
    }
    if !sheet.blank.is_none() {
        lines.push(format!("blank       カラ       {}", blank(sheet)));
    }
    let guesses: Vec<&CameraWork> = sheet.camera.iter().filter(|work| work.is_guess).collect();
    if !guesses.is_empty() {
        lines.push(format!("camera      カメラ     {}", guessed(&guesses)));
    }
    lines
}

/// Describes camera work that is guessed from the camera's motion.
fn guessed(guesses: &[&CameraWork]) -> String {
    let koma =
        |work: &&CameraWork| format!("{} koma {}", work.words, range(work.begin + 1, work.past()));
    let mut said: Vec<String> = guesses.iter().take(GUESSES).map(koma).collect();
    let more = guesses.len().saturating_sub(GUESSES);
    said.extend((more > 0).then(|| format!("… {more} more")));
    let said = said.join(", ");
    format!("{said}: guessed from the camera's motion; [[edits.camera]] goes over it")
}

/// Describes the blank koma of a sheet.
fn blank(sheet: &Sheet) -> String {
    let Blank { before, after } = sheet.blank;
    let length = sheet.cut_length();
    let first = (before > 0).then(|| (range(1, before), "first"));
    let last = (after > 0).then(|| (range(length - after + 1, length), "last"));
    let (koma, poses): (Vec<String>, Vec<&str>) = first.into_iter().chain(last).unzip();
    format!(
        "koma {} of {length}; a motion stands in its {} pose there",
        koma.join(" and "),
        poses.join(" or ")
    )
}

fn range(from: usize, to: usize) -> String {
    if from == to { from.to_string() } else { format!("{from} to {to}") }
}
