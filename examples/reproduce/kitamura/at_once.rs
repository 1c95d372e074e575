//! Fig. 3: deleting step by step against deleting all at once by the first SSD.

use genga::timing::Omission;

use crate::Outcome;
use crate::kitamura::Window;
use crate::kitamura::strips;
use crate::kitamura::table_1::ACTIONS;
use crate::ones::{Done, Ones, counts};
use crate::part::Part;
use crate::table::{Table, number, spread};

/// Number of drawings to leave out of a real clip. For a sample it is the paper's number.
const LEFT_OUT: usize = 4;

/// Name of the clip that is drawn.
const DRAWN: &str = "cmu-11_01-soccer-kick";

/// Picture names and captions.
const PICTURES: [(&str, &str); 2] =
    [("fig-3-step-by-step", "kick, step by step"), ("fig-3-all-at-once", "kick, all at once")];

/// Both ways applied to one clip.
struct Ways {
    step_by_step: Done,
    all_at_once: Done,
    /// Largest SSD of the source.
    peak: f64,
}

impl Ways {
    fn new(ones: &Ones, naka_nashi: usize) -> Outcome<Self> {
        let step_by_step = counts(naka_nashi, 0);
        let all_at_once = Omission { all_at_once: true, ..step_by_step };
        Ok(Self {
            step_by_step: ones.omit(&step_by_step)?,
            all_at_once: ones.omit(&all_at_once)?,
            peak: ones.peak(),
        })
    }

    /// Growth of the largest SSD in both ways, as a factor.
    fn growth(&self) -> [f64; 2] {
        [&self.step_by_step, &self.all_at_once].map(|done| done.peak / self.peak)
    }

    fn all_at_once_is_larger(&self) -> bool {
        self.all_at_once.peak > self.step_by_step.peak
    }

    /// Draws the same line of koma in both ways, beginning two before the first one left out.
    fn draw(&self, part: &mut Part, ones: &Ones) -> Outcome<()> {
        let ways = [&self.step_by_step, &self.all_at_once];
        let first = ways.iter().filter_map(|done| done.left_out().first().copied()).min();
        let begin = first.unwrap_or(0).saturating_sub(2);
        for (done, (name, words)) in ways.into_iter().zip(PICTURES) {
            part.picture(name, strips::draw(ones, done, begin, words)?);
        }
        Ok(())
    }

    fn row(&self, table: &mut Table, name: &str) {
        let [step, once] = self.growth();
        table.row(&[
            name.into(),
            koma(&self.step_by_step.left_out()),
            number(step, 1),
            koma(&self.all_at_once.left_out()),
            number(once, 1),
        ]);
    }
}

fn table() -> Table {
    Table::new(&[
        "clip",
        ">koma left out step by step",
        ">peak SSD, times",
        ">koma left out all at once",
        ">peak SSD, times",
    ])
}

/// Formats koma for people: from 1, neighbours as a range.
pub(super) fn koma(koma: &[usize]) -> String {
    let runs = koma.chunk_by(|a, b| a + 1 == *b);
    let text = |run: &[usize]| match run {
        [one] => (one + 1).to_string(),
        [first, .., last] => format!("{}–{}", first + 1, last + 1),
        [] => String::new(),
    };
    runs.map(text).collect::<Vec<_>>().join(", ")
}

/// Compares the ways on the paper's four actions.
pub(super) fn add_samples(part: &mut Part) -> Outcome<()> {
    let mut table = table();
    let mut larger = 0;
    for action in ACTIONS {
        let ways = Ways::new(&action.ones()?, action.naka_nashi)?;
        larger += usize::from(ways.all_at_once_is_larger());
        ways.row(&mut table, action.name);
    }
    part.table("fig-3-samples", table);
    part.number("km.fig3.samples", ACTIONS.len());
    part.number("km.fig3.samples.larger", larger);
    Ok(())
}

/// Compares the ways on the real clips, and draws one of them.
pub(super) fn add(part: &mut Part, windows: &[Window<'_>]) -> Outcome<()> {
    let mut table = table();
    let mut ways = Vec::new();
    for window in windows {
        let both = Ways::new(&window.ones, LEFT_OUT)?;
        both.row(&mut table, window.name);
        if window.name == DRAWN {
            both.draw(part, &window.ones)?;
        }
        ways.push(both);
    }
    part.table("fig-3", table);
    let together = |done: &Done| done.adjacent() == LEFT_OUT;
    let [step, once]: [fn(&Ways) -> &Done; 2] =
        [|ways| &ways.step_by_step, |ways| &ways.all_at_once];
    let count = |of: fn(&Ways) -> &Done| ways.iter().filter(|ways| together(of(ways))).count();
    let larger = ways.iter().filter(|ways| ways.all_at_once_is_larger()).count();
    part.number("km.fig3.larger", larger);
    part.number("km.fig3.clips", windows.len());
    part.number("km.fig3.asked", LEFT_OUT);
    part.number("km.fig3.step.together", count(step));
    part.number("km.fig3.once.together", count(once));
    for (at, name) in ["step", "once"].into_iter().enumerate() {
        let [least, middle, most] = spread(ways.iter().map(|ways| ways.growth()[at]));
        part.number(&format!("km.fig3.{name}.least"), number(least, 1));
        part.number(&format!("km.fig3.{name}.middle"), number(middle, 1));
        part.number(&format!("km.fig3.{name}.most"), number(most, 1));
    }
    Ok(())
}
