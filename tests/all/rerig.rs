//! The same motion in another rig gives the same keys and the same sheet.

use std::sync::Arc;

use genga::edits::Edits;
use genga::motion::{
    Axis, Body, Channel, Clip, EndSite, Joint, Poser, Skeleton, bvh, local_rotation,
    local_translation,
};
use genga::pipeline::Engine;
use genga::recipe::Recipe;
use genga::sheet::{Role, Sheet};
use genga::time::{Frame, FrameRate};
use glam::{DMat3, DQuat, DVec3};

use crate::clips;

const ORDERS: [[Axis; 3]; 6] = [
    [Axis::X, Axis::Y, Axis::Z],
    [Axis::X, Axis::Z, Axis::Y],
    [Axis::Y, Axis::X, Axis::Z],
    [Axis::Y, Axis::Z, Axis::X],
    [Axis::Z, Axis::X, Axis::Y],
    [Axis::Z, Axis::Y, Axis::X],
];

/// Changes to a rig that leave the motion in the world as it is.
pub(crate) struct Rerig {
    /// Joint j gets the order `orders[(j + first_order) % 6]`.
    pub(crate) first_order: usize,
    /// Whether the rest pose of every bone is turned.
    pub(crate) other_axes: bool,
    /// World units per unit of the file.
    pub(crate) scale: f64,
}

impl Rerig {
    /// Rotations of each joint's rest axes. A joint without rotation channels keeps its parent's.
    fn turns(&self, skeleton: &Skeleton) -> Vec<DQuat> {
        let mut turns: Vec<DQuat> = Vec::with_capacity(skeleton.len());
        for (at, joint) in skeleton.joints.iter().enumerate() {
            let parent = joint.parent.map_or(DQuat::IDENTITY, |parent| turns[parent.0]);
            let can_turn = joint.channels.iter().any(|c| matches!(c, Channel::Rotation(_)));
            let seed = at as f64;
            let axis = DVec3::new((seed + 0.3).sin(), (2.0 * seed).cos(), (3.0 * seed + 1.0).sin());
            let turn = DQuat::from_axis_angle(axis.normalize(), 0.4 + 1.7 * seed);
            turns.push(match (can_turn, self.other_axes) {
                (true, true) => turn,
                (true, false) => DQuat::IDENTITY,
                (false, _) => parent,
            });
        }
        turns
    }

    /// Converts the clip to the other rig, as read from its file.
    pub(crate) fn apply(&self, clip: &Clip) -> Clip {
        let old = clip.skeleton();
        let turns = self.turns(old);
        let parent_turn = |joint: &Joint| {
            joint.parent.map_or(DQuat::IDENTITY, |parent| turns[parent.0]).inverse()
        };
        let mut joints: Vec<Joint> = Vec::with_capacity(old.len());
        let mut first_channel = 0;
        for (at, joint) in old.joints.iter().enumerate() {
            let mut channels = Vec::new();
            let has = |kind: fn(&Channel) -> bool| joint.channels.iter().any(kind);
            let positions = [Axis::Y, Axis::Z, Axis::X].map(Channel::Position);
            if has(|channel| matches!(channel, Channel::Rotation(_))) {
                channels.extend(self.order(at).map(Channel::Rotation));
            }
            if has(|channel| matches!(channel, Channel::Position(_))) {
                // Before the rotations for some joints, after them for others.
                let begin = if at % 2 == 0 { 0 } else { channels.len() };
                channels.splice(begin..begin, positions);
            }
            let end = |end: &EndSite| EndSite {
                name: "Site".into(),
                offset: self.scale * (turns[at].inverse() * end.offset),
            };
            let count = channels.len();
            joints.push(Joint {
                name: joint.name.clone(),
                parent: joint.parent,
                offset: self.scale * (parent_turn(joint) * joint.offset),
                channels,
                first_channel,
                end_sites: joint.end_sites.iter().map(end).collect(),
            });
            first_channel += count;
        }
        let skeleton = Skeleton { joints };
        let mut values = Vec::with_capacity(clip.len() * skeleton.channels());
        for row in clip.rows() {
            for (at, joint) in old.joints.iter().enumerate() {
                let rotation = parent_turn(joint) * local_rotation(joint, row) * turns[at];
                let angles = angles(rotation, self.order(at));
                let place = self.scale * (parent_turn(joint) * local_translation(joint, row));
                let mut rotations = 0..3;
                values.extend(skeleton.joints[at].channels.iter().map(|channel| match channel {
                    Channel::Position(axis) => place[*axis as usize],
                    Channel::Rotation(_) => angles[rotations.next().unwrap()],
                }));
            }
        }
        // Frame numbers in a file begin with 0, so the lead-in is restored as repeats of the first frame.
        let first = skeleton.channels();
        let lead = values[..first].repeat(clip.first().0);
        let frames = clip.len() + clip.first().0;
        let rate = FrameRate::new(clip.rate().fps()).unwrap();
        let rerigged =
            Clip::new(skeleton, rate, Frame(0), frames, [lead, values].concat()).unwrap();
        let read = bvh::read(bvh::write(&rerigged).as_bytes()).unwrap();
        assert!(read.warnings.is_empty(), "{:?}", read.warnings);
        read.clip.trimmed(clip.first(), Frame(clip.last().0 + 1)).unwrap()
    }

    fn order(&self, joint: usize) -> [Axis; 3] {
        ORDERS[(joint + self.first_order) % 6]
    }
}

/// Angles in degrees whose product about `order`, left to right, is the rotation.
fn angles(rotation: DQuat, order: [Axis; 3]) -> [f64; 3] {
    let matrix = DMat3::from_quat(rotation);
    let [i, j, k] = order.map(|axis| axis as usize);
    let sign = if (i + 1) % 3 == j { 1.0 } else { -1.0 };
    let entry = |row: usize, column: usize| matrix.col(column)[row];
    let middle = (sign * entry(i, k)).clamp(-1.0, 1.0).asin();
    let first = (-sign * entry(j, k)).atan2(entry(k, k));
    let last = (-sign * entry(i, j)).atan2(entry(i, i));
    [first, middle, last].map(f64::to_degrees)
}

/// World positions of all joints in all frames.
fn world(clip: &Clip) -> Vec<DVec3> {
    let (mut poser, mut body) = (Poser::new(clip), Body::new(clip.skeleton()));
    let mut all = Vec::new();
    for frame in clip.first().0..=clip.last().0 {
        body.place(poser.frame(Frame(frame)));
        all.extend_from_slice(body.positions());
    }
    all
}

fn stands_where_it_stood(clip: &Clip, other: &Clip, scale: f64, name: &str) {
    let far = world(clip)
        .iter()
        .zip(&world(other))
        .map(|(a, b)| (scale * *a).distance(*b))
        .fold(0.0, f64::max);
    assert!(far < 1e-9, "{name}: a joint stands {far} from where it stood");
}

/// The visible content of a sheet: places, exposures, roles, and turning joints.
#[derive(Debug, PartialEq)]
struct Seen {
    place: f64,
    role: Role,
    koma: usize,
    voters: Vec<usize>,
    reasons: [usize; 3],
}

fn seen(clip: &Clip, sheet: &Sheet) -> Vec<Seen> {
    let layer = &sheet.layers[0];
    let joint = |name: &Arc<str>| clip.skeleton().find(name).unwrap().0;
    let seen = |exposure: &genga::sheet::Exposure| {
        let drawing = &layer.drawings[exposure.drawing];
        let why = &drawing.why;
        let mut voters: Vec<_> = why.voters.iter().map(joint).collect();
        voters.sort_unstable();
        Seen {
            place: drawing.source.place(),
            role: drawing.role,
            koma: exposure.koma,
            voters,
            reasons: [why.lengthened, why.omitted_before, why.held_for],
        }
    };
    layer.exposures.iter().map(seen).collect()
}

fn gives_the_same_sheet(clip: &Clip, name: &str, recipe: &Recipe) {
    let sheet = |clip: &Clip| {
        let mut engine = Engine::new(clip.clone()).unwrap();
        let breakdown = engine.run(recipe, &Edits::default()).unwrap();
        let keys: Vec<_> = breakdown.first_layer().keys.keys.iter().map(|key| key.frame).collect();
        (keys, seen(clip, breakdown.spaced), seen(clip, breakdown.sheet))
    };
    let expected = sheet(clip);
    assert!(expected.0.len() > 1, "{name} has keys to lose");
    for (first_order, other_axes, scale) in [
        (0, false, 1.0),
        (1, true, 1.0),
        (2, true, 2.54),
        (3, false, 0.01),
        (4, true, 1.0),
        (5, true, 39.37),
    ] {
        let rerig = Rerig { first_order, other_axes, scale };
        let other = rerig.apply(clip);
        stands_where_it_stood(clip, &other, scale, name);
        let found = sheet(&other);
        assert_eq!(found.0, expected.0, "{name}, order {first_order}, scale {scale}: keys");
        assert_eq!(found.1, expected.1, "{name}, order {first_order}, scale {scale}: spaced");
        assert_eq!(found.2, expected.2, "{name}, order {first_order}, scale {scale}: sheet");
    }
}

#[test]
fn the_made_pitch_keeps_its_sheet_in_other_rigs() {
    let clip = clips::sample("pitch.bvh");
    gives_the_same_sheet(&clip, "pitch", &Recipe::default());
}

#[test]
fn the_other_merges_measures_and_readings_do_not_depend_on_the_rig_either() {
    let clip = clips::sample("pitch.bvh");
    for (name, value) in [
        ("keys.merge", "vote"),
        ("keys.merge", "union"),
        ("keys.rank", "strength"),
        ("speed.measure", "displacement"),
        ("speed.measure", "combined"),
        ("turns.reading", "literal"),
        ("turns.steady", "5%"),
        ("filter.kind", "butterworth"),
        ("spacing.source", "blend"),
    ] {
        // Displacement and its dead band are in the file's unit, so there the dead band must be a share.
        let mut recipe = Recipe::default();
        recipe.set("turns.steady", if name == "speed.measure" { "5%" } else { "100" }).unwrap();
        recipe.set(name, value).unwrap();
        gives_the_same_sheet(&clip, &format!("pitch with {name} = {value}"), &recipe);
    }
}

#[test]
fn real_clips_keep_their_sheets_in_other_rigs() {
    for path in clips::all() {
        gives_the_same_sheet(&clips::read(&path), &clips::name(&path), &Recipe::default());
    }
}
