//! Camera work (カメラワーク) guessed from a camera that moves: PAN, T.U and T.B, with the koma from and to.

use glam::{DQuat, DVec3};

use super::looks;
use crate::maths;
use crate::motion::{CameraPath, CameraPose, Clip, Lens};
use crate::sheet::{CameraWork, Sheet};

/// How far the camera may stray from an even movement, as a share of the picture's height. On paper, where the picture is
/// some 15 cm high, that is the breadth of a line: trackers and hands shake by as much.
const EVEN: f64 = 0.01;

/// Least change that is a movement, as a share of the picture's height: three times what it may stray.
const MOVES: f64 = 0.03;

/// Change within a koma that is a cut and no movement: at half a picture a koma nobody can follow.
const CUT: f64 = 0.5;

/// Fewest koma of a movement, and of its way in one direction: to and fro in fewer is a shake.
const FEWEST: f64 = 3.0;

/// Koma up to which a movement belongs to the one beside it: a quarter of a second, in which nobody sees two.
const SHORT: usize = 6;

/// Koma that are looked at together, 43 seconds: the work grows with their square where a camera shakes, and what moves less
/// than that in so long a time nobody sees.
const STRETCH: usize = 1024;

/// Half the width of the picture in heights, at 16:9: so far from the middle a roll moves its edge.
const EDGE: f64 = 8.0 / 9.0;

/// What changes of a picture, in heights: turned sideways and up, slid sideways and up, enlarged, rolled.
type Change = [f64; 6];

/// The camera of a clip's file, if it moves (カメラ).
#[derive(Debug, Clone, Copy)]
pub struct Filmed<'a> {
    path: &'a CameraPath,
    /// The middle of the body, at whose distance shares of the picture are measured.
    middle: DVec3,
}

impl<'a> Filmed<'a> {
    /// Looks at the camera that the clip's file has; `None` without one, or for a still one.
    pub fn new(clip: &'a Clip) -> Option<Self> {
        let path = clip.beside()?.camera.as_ref().filter(|path| path.moves())?;
        Some(Self { path, middle: middle(clip) })
    }

    /// Guesses the camera work of a sheet from the way of the camera, with the koma of the sheet without blank ones, sorted.
    /// Empty for a sheet that repeats, since a camera goes on where the drawings begin again.
    ///
    /// A camera that turns, or slides sideways or up, is a `PAN`. One that comes nearer, or whose lens narrows, is a `T.U`;
    /// one that goes back or widens a `T.B`; one that rolls `回転`. Movements at once are joined by ` + `.
    pub fn work(&self, sheet: &Sheet) -> Vec<CameraWork> {
        if sheet.repeat.is_some() {
            return Vec::new();
        }
        let shown = sheet.source_places();
        let poses: Vec<CameraPose> =
            shown.iter().filter_map(|place| self.path.at(*place)).collect();
        let changes: Vec<Change> =
            poses.windows(2).map(|pair| change(&pair[0], &pair[1], self.middle)).collect();
        let mut work = Vec::new();
        let mut from = 0;
        for shot in changes.split(|change| length(change) > CUT) {
            work.extend(of_shot(shot, from));
            from += shot.len() + 1;
        }
        work
    }
}

/// The mean position of all joints over the whole clip.
fn middle(clip: &Clip) -> DVec3 {
    let poses = looks(clip);
    let joints = poses.iter().map(Vec::len).sum::<usize>().max(1);
    poses.iter().flatten().sum::<DVec3>() / joints as f64
}

/// Returns what changes of the picture from one pose to the next.
fn change(from: &CameraPose, to: &CameraPose, middle: DVec3) -> Change {
    let distance = (middle - from.place).length().max(f64::MIN_POSITIVE);
    let back = from.turn.conjugate();
    let (way, turned) = (back * (to.place - from.place) / distance, back * to.turn);
    let (height, nearer) = match from.lens {
        Lens::Perspective(height) => (height, -maths::ln((1.0 + way.z).max(f64::MIN_POSITIVE))),
        Lens::Orthographic(height) => (height / distance, 0.0),
    };
    let height = height.max(f64::MIN_POSITIVE);
    let narrower = match (from.lens, to.lens) {
        (Lens::Perspective(from), Lens::Perspective(to))
        | (Lens::Orthographic(from), Lens::Orthographic(to)) => maths::ln(from / to),
        _ => 0.0,
    };
    let seen = turned * DVec3::NEG_Z;
    let angle = 2.0 * maths::atan(0.5 * height);
    let change = [
        maths::atan2(seen.x, -seen.z) / angle,
        maths::asin(seen.y.clamp(-1.0, 1.0)) / angle,
        way.x / height,
        way.y / height,
        nearer + narrower,
        EDGE * roll(turned),
    ];
    // A camera in the body's middle, or without a lens, shows nothing that could be said.
    if change.iter().all(|share| share.is_finite()) { change } else { [0.0; 6] }
}

/// The angle of a rotation about the axis of view.
fn roll(turned: DQuat) -> f64 {
    let turned = if turned.w < 0.0 { -turned } else { turned };
    2.0 * maths::atan2(turned.z, turned.w)
}

fn length(change: &Change) -> f64 {
    dot(change, change).sqrt()
}

fn dot(a: &Change, b: &Change) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// An even movement between two koma.
#[derive(Debug, Clone, Copy)]
struct Span {
    begin: usize,
    past: usize,
    change: Change,
    kinds: Kinds,
}

/// What a movement is: whether it pans, whether it comes nearer (1) or goes back (−1), and whether it rolls.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
struct Kinds {
    pans: bool,
    nearer: i8,
    rolls: bool,
}

impl Kinds {
    fn new(change: &Change) -> Self {
        let [turn_x, turn_y, slide_x, slide_y, nearer, roll] = *change;
        Self {
            pans: length(&[turn_x, turn_y, slide_x, slide_y, 0.0, 0.0]) > MOVES,
            nearer: i8::from(nearer > MOVES) - i8::from(nearer < -MOVES),
            rolls: roll.abs() > MOVES,
        }
    }

    fn words(self) -> String {
        let nearer = ["T.B", "", "T.U"][(self.nearer + 1) as usize];
        let (pans, rolls) = (self.pans.then_some("PAN"), self.rolls.then_some("回転"));
        let words = [pans.unwrap_or(""), nearer, rolls.unwrap_or("")];
        words.into_iter().filter(|word| !word.is_empty()).collect::<Vec<_>>().join(" + ")
    }
}

/// Finds the camera work of a shot without cuts, whose first koma is `from`.
fn of_shot(changes: &[Change], from: usize) -> Vec<CameraWork> {
    let spans = spans(changes);
    let runs = spans.split(|span| span.kinds == Kinds::default()).filter(|run| is_steady(run));
    let work = |span: Span| {
        // The last koma of a shot belongs to the movement that leads to it.
        let past = span.past + usize::from(span.past == changes.len());
        let (begin, words) = (from + span.begin, span.kinds.words());
        CameraWork { begin, koma: past - span.begin, words, is_guess: true }
    };
    runs.flat_map(joined).map(work).collect()
}

/// Cuts a shot into even movements. What is too little for a movement goes with one beside it in the same direction.
fn spans(changes: &[Change]) -> Vec<Span> {
    let mut ways: Vec<Change> = Vec::with_capacity(changes.len() + 1);
    ways.push([0.0; 6]);
    for change in changes {
        let before = ways[ways.len() - 1];
        ways.push(std::array::from_fn(|at| before[at] + change[at]));
    }
    let corners = corners(&ways);
    let span = |pair: &[usize]| {
        let (begin, past) = (pair[0], pair[1]);
        let change = std::array::from_fn(|at| ways[past][at] - ways[begin][at]);
        Span { begin, past, change, kinds: Kinds::new(&change) }
    };
    let spans: Vec<Span> = corners.windows(2).map(span).collect();
    let mut whole = spans.clone();
    for (at, span) in spans.iter().enumerate().filter(|(_, span)| span.kinds == Kinds::default()) {
        let beside = [at.checked_sub(1).and_then(|at| spans.get(at)), spans.get(at + 1)];
        let goes_along = |other: &&Span| {
            let all = length(&span.change) * length(&other.change);
            length(&span.change) > EVEN && dot(&span.change, &other.change) > 0.5 * all
        };
        let along = beside.into_iter().flatten().find(goes_along);
        whole[at].kinds = along.map_or(Kinds::default(), |other| other.kinds);
    }
    whole
}

/// Finds the koma between which the way is even, by Douglas and Peucker in stretches of [`STRETCH`]; the first and the last
/// are among them.
fn corners(ways: &[Change]) -> Vec<usize> {
    let last = ways.len() - 1;
    let mut corners: Vec<usize> = (0..last).step_by(STRETCH).chain([last]).collect();
    let mut open: Vec<(usize, usize)> = corners.windows(2).map(|pair| (pair[0], pair[1])).collect();
    while let Some((from, to)) = open.pop() {
        let off = |at: usize| {
            let share = (at - from) as f64 / (to - from) as f64;
            let even = |axis: usize| ways[from][axis] + share * (ways[to][axis] - ways[from][axis]);
            length(&std::array::from_fn(|axis| ways[at][axis] - even(axis)))
        };
        let furthest = (from + 1..to).map(|at| (off(at), at)).max_by(|a, b| a.0.total_cmp(&b.0));
        if let Some((_, at)) = furthest.filter(|(off, _)| *off > EVEN) {
            corners.push(at);
            open.extend([(from, at), (at, to)]);
        }
    }
    corners.sort_unstable();
    corners.dedup();
    corners
}

/// Whether movements one after another are more than a shake: they last, and keep their direction while they do.
fn is_steady(run: &[Span]) -> bool {
    let (Some(first), Some(last)) = (run.first(), run.last()) else { return false };
    let back = run.windows(2).filter(|pair| dot(&pair[0].change, &pair[1].change) < 0.0).count();
    (last.past - first.begin) as f64 >= FEWEST * (back + 1) as f64
}

/// Joins movements of the same kind, and short ones with the longer one beside them.
fn joined(run: &[Span]) -> Vec<Span> {
    let mut joined: Vec<Span> = Vec::with_capacity(run.len());
    for span in run {
        match joined.last_mut().filter(|before| before.kinds == span.kinds) {
            Some(before) => before.past = span.past,
            None => joined.push(*span),
        }
    }
    while let Some(short) = shortest(&joined).filter(|_| joined.len() > 1) {
        let span = joined.remove(short);
        let koma = |at: &usize| joined[*at].past - joined[*at].begin;
        let beside = [short.checked_sub(1), (short < joined.len()).then_some(short)];
        let Some(into) = beside.into_iter().flatten().max_by_key(koma) else { break };
        joined[into].begin = joined[into].begin.min(span.begin);
        joined[into].past = joined[into].past.max(span.past);
        joined.dedup_by(|next, before| {
            let is_same = next.kinds == before.kinds;
            before.past = if is_same { next.past } else { before.past };
            is_same
        });
    }
    joined
}

/// Returns the shortest movement that is short.
fn shortest(spans: &[Span]) -> Option<usize> {
    let koma = |at: &usize| spans[*at].past - spans[*at].begin;
    (0..spans.len()).min_by_key(koma).filter(|at| koma(at) < SHORT)
}

#[cfg(test)]
mod tests;
