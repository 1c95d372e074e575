//! Places the phases of the steps of a gait in time.

use crate::keys::walk::{Phase, ROOM, Walk, WalkStep};
use crate::maths::median;
use crate::motion::{Gait, Step};

/// Least distance of two phases in koma; nearer ones are one.
const ONE: f64 = 1.0;

/// Instants of the phases of each step, in koma from the sheet's first.
pub(super) type Instants = Vec<Vec<f64>>;

/// Builds a gait with the phases that fit into its steps. Its steps do not have their frames yet.
pub(super) fn walk(gait: &Gait) -> (Walk, Instants) {
    let phasing = Phasing::new(gait);
    let instants: Instants = gait.steps.iter().map(|step| phasing.instants(step)).collect();
    let usual_share = |phase: usize| {
        let of_step = |(step, instants): (&Step, &Vec<f64>)| share(step, instants[phase]);
        middle(gait.steps.iter().zip(&instants).map(of_step))
    };
    let step = |step: &Step| {
        let Step { contact, next, .. } = *step;
        WalkStep { contact, next, frames: vec![], taken: vec![], has_no_phase: false }
    };
    let walk = Walk {
        shares: (0..phasing.phases.len()).map(usual_share).collect(),
        phases: phasing.phases,
        koma: phasing.koma,
        steps: gait.steps.iter().map(step).collect(),
    };
    (walk, instants)
}

/// The phases of a gait, and how they are placed in each of its steps.
struct Phasing {
    phases: Vec<Phase>,
    /// Length of the median step in koma.
    koma: f64,
    /// Whether *down* and *up* are far enough from the phases beside them to be drawn where the body is lowest and
    /// highest.
    has_own: (bool, bool),
}

impl Phasing {
    fn new(gait: &Gait) -> Self {
        let koma = middle(gait.steps.iter().map(length));
        let usual_share =
            |at: fn(&Step) -> f64| middle(gait.steps.iter().map(|step| share(step, at(step))));
        let usual = |at: fn(&Step) -> f64| koma * usual_share(at);
        let passing = usual(|step| step.passing);
        let is_between = |at: f64, from: f64, to: f64| from + ONE <= at && at <= to - ONE;
        let has_own = (
            is_between(usual(|step| step.down), 0.0, passing),
            is_between(usual(|step| step.up), passing, koma),
        );
        let phases = Phase::with_room(koma, usual_share(|step| step.passing));
        Self { phases, koma, has_own }
    }

    /// Returns the instant of each phase of a step.
    fn instants(&self, step: &Step) -> Vec<f64> {
        self.phases.iter().map(|phase| self.instant(step, *phase)).collect()
    }

    fn instant(&self, step: &Step, phase: Phase) -> f64 {
        match phase {
            Phase::Contact => step.contact,
            Phase::Down if self.has_own.0 => behind(step.down, step.contact, step.passing),
            Phase::Down => f64::midpoint(step.contact, step.passing),
            Phase::Passing => step.passing,
            Phase::Up if self.has_own.1 => behind(step.up, step.passing, step.next),
            Phase::Up => f64::midpoint(step.passing, step.next),
        }
    }
}

/// Moves a phase between two others so far behind the first that its drawing has room. Any sooner, the drawing before
/// is still on screen, and its pose is nearly the same.
fn behind(at: f64, from: f64, to: f64) -> f64 {
    at.max((from + ROOM).min(f64::midpoint(from, to)))
}

/// Returns how much of a step has passed at an instant, 0 to 1.
fn share(step: &Step, instant: f64) -> f64 {
    (instant - step.contact) / length(step)
}

/// Returns the koma from contact to contact.
fn length(step: &Step) -> f64 {
    step.next - step.contact
}

/// Returns the median, 0 of no values.
fn middle(values: impl Iterator<Item = f64>) -> f64 {
    median(values).unwrap_or(0.0)
}
