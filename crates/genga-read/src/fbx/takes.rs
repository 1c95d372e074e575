//! Reads the takes of a scene, called animation stacks in FBX.

use ufbx::{AnimCurve, AnimStack, ElementType, Keyframe, Scene};

use crate::rates;
use crate::reading::Take;
use genga::error::{Error, Place, Warning};
use genga::time::FrameRate;

/// Most keys examined per curve; more add no information.
const MOST_KEYS: usize = 2000;

/// Largest distance at which an instant counts as on a key, as a share of a frame: some programs round
/// frame times.
const ON: f64 = 1e-3;

/// The curves of a take that move nodes.
pub(super) struct Curves<'a> {
    /// Whether each node of the scene has curves.
    pub(super) nodes: Vec<bool>,
    /// Whether each node has curves that vary.
    pub(super) moves: Vec<bool>,
    curves: Vec<&'a AnimCurve>,
}

impl<'a> Curves<'a> {
    pub(super) fn new(scene: &Scene, stack: &'a AnimStack) -> Self {
        let none = vec![false; scene.nodes.count];
        let mut found = Self { nodes: none.clone(), moves: none, curves: Vec::new() };
        for prop in stack.layers.into_iter().flat_map(|layer| &layer.anim_props) {
            let element = prop.element.as_ref();
            let moves = ["Lcl Translation", "Lcl Rotation", "Lcl Scaling"];
            if element.type_ != ElementType::Node || !moves.contains(&prop.prop_name.as_ref()) {
                continue;
            }
            let before = found.curves.len();
            found.curves.extend(prop.anim_value.curves.iter().flatten().map(AsRef::as_ref));
            let node = element.typed_id as usize;
            let own = &found.curves[before..];
            found.nodes[node] |= !own.is_empty();
            found.moves[node] |= own.iter().any(|curve| varies(curve));
        }
        found
    }

    /// Whether any curve varies.
    pub(super) fn move_something(&self) -> bool {
        self.curves.iter().any(|curve| varies(curve))
    }

    /// Times of the keys, sorted and unique; only the first keys of each curve are used.
    pub(super) fn times(&self) -> Vec<f64> {
        let keys = self.curves.iter().flat_map(|curve| curve.keyframes.iter().take(MOST_KEYS));
        let mut times: Vec<f64> = keys.map(|key| key.time).collect();
        times.sort_by(f64::total_cmp);
        times.dedup();
        times
    }

    /// The keys of the densest curve. In baked animation they stand for all curves.
    pub(super) fn most_keys(&self) -> &[Keyframe] {
        let most = self.curves.iter().max_by_key(|curve| curve.keyframes.count);
        most.map_or(&[], |curve| curve.keyframes.as_ref())
    }

    /// Times of the first and the last key.
    fn span(&self) -> Option<(f64, f64)> {
        let spans = self.curves.iter().filter(|curve| curve.keyframes.count > 0);
        spans
            .map(|curve| (curve.min_time, curve.max_time))
            .reduce(|all, own| (all.0.min(own.0), all.1.max(own.1)))
    }

    /// Start and end of the take: as the file says, else from its keys.
    pub(super) fn range(&self, stack: &AnimStack) -> (f64, f64) {
        let said = (stack.time_begin, stack.time_end);
        match self.span() {
            Some(span) if said.1 <= said.0 => span,
            _ => said,
        }
    }

    /// The range of a take, cut at the first gap too long for one motion, with a warning about the cut.
    ///
    /// # Errors
    /// Errors of [`rates::cut`].
    pub(super) fn whole(&self, stack: &AnimStack) -> Result<((f64, f64), Option<Warning>), Error> {
        let (begin, end) = self.range(stack);
        if end - begin <= rates::GAP {
            return Ok(((begin, end), None));
        }
        let keys = self.curves.iter().flat_map(|curve| curve.keyframes.iter());
        let inside = keys.map(|key| key.time).filter(|time| (begin..end).contains(time));
        let mut times: Vec<f64> = inside.chain([begin, end]).collect();
        times.sort_by(f64::total_cmp);
        times.dedup();
        let (near, far) = rates::cut(&times, Place::Whole, |at| format!("{} s", times[at]))?;
        Ok(((begin, times[near - 1]), far))
    }
}

/// Whether a curve varies over time.
fn varies(curve: &AnimCurve) -> bool {
    curve.max_value > curve.min_value
}

/// Snaps an instant to a nearby key. Just beside a key an angle may already be on its way to another full
/// turn.
pub(super) fn key_at(keys: &[Keyframe], instant: f64, rate: FrameRate) -> f64 {
    let after = keys.partition_point(|key| key.time < instant);
    let near = keys[after.saturating_sub(1)..].iter().take(2).map(|key| key.time);
    let off = |time: &f64| (time - instant).abs() * rate.fps();
    let nearest = near.min_by(|one, other| off(one).total_cmp(&off(other)));
    nearest.filter(|time| off(time) < ON).unwrap_or(instant)
}

/// Lists the takes for the user.
pub(super) fn listed(scene: &Scene) -> Vec<Take> {
    let take = |stack: &AnimStack| {
        let curves = Curves::new(scene, stack);
        let (begin, end) = curves.range(stack);
        let moves = curves.move_something();
        Take { name: stack.element.name.to_string(), seconds: (end - begin).max(0.0), moves }
    };
    scene.anim_stacks.into_iter().map(take).collect()
}
