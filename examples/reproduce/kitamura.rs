//! The second paper: Kitamura et al., naka-nashi and koma-dori.

mod at_once;
mod curve;
mod growth;
mod letter;
mod order;
mod strips;
mod table_1;

use crate::Outcome;
use crate::ones::Ones;
use crate::part::Part;
use crate::takes::{Take, named};
use crate::windows::window;

/// Length in koma of a window of a real clip, similar to the paper's actions, which have 88 to 129.
const KOMA: usize = 96;

/// The real clips with an action: without walks, runs, climbs and standing, and with only the first of two rigs of one
/// take.
const ACTIONS: [&str; 10] = [
    "cmu-02_04-jump-balance",
    "cmu-02_05-punch-strike",
    "cmu-02_07-swordplay",
    "cmu-05_11-dance-pirouette",
    "cmu-06_15-dribble-shoot",
    "cmu-10_03-soccer-kick",
    "cmu-11_01-soccer-kick",
    "cmu-131_03-start-hop-stop",
    "cmu-135_04-front-kick",
    "rokoko-jesse-dance",
];

/// A window of a clip, with the clip's name.
struct Window<'a> {
    name: &'a str,
    ones: Ones,
}

impl<'a> Window<'a> {
    fn new(take: &'a Take) -> Outcome<Self> {
        Ok(Self { name: &take.name, ones: Ones::new(window(&take.clip, KOMA)?) })
    }
}

/// Results from the samples.
pub(crate) fn from_samples() -> Outcome<Part> {
    let mut part = Part::default();
    table_1::add(&mut part)?;
    curve::add(&mut part)?;
    strips::add(&mut part)?;
    at_once::add_samples(&mut part)?;
    order::add_samples(&mut part)?;
    Ok(part)
}

/// Results from the real clips.
pub(crate) fn from_takes(takes: &[Take]) -> Outcome<Part> {
    let all = takes.iter().map(Window::new).collect::<Outcome<Vec<_>>>()?;
    let actions = ACTIONS.iter().map(|name| Window::new(named(takes, name)?));
    let actions = actions.collect::<Outcome<Vec<_>>>()?;
    let mut part = Part::default();
    part.number("km.window", KOMA);
    at_once::add(&mut part, &actions)?;
    order::add(&mut part, &all)?;
    growth::add(&mut part, &actions)?;
    Ok(part)
}
