//! Only the body counts: other parts of a rig change no key, wherever they are.

use std::collections::BTreeMap;
use std::f64::consts::FRAC_PI_2;
use std::fs;

use genga::edits::Edits;
use genga::keys::Key;
use genga::motion::body::landmarks::paths;
use genga::motion::{
    Axis, BoneMap, Channel, Clip, Description, EndSite, Joint, JointId, Landmarks, Skeleton,
    Stature, local_rotation, local_translation, set_local_rotation,
};
use genga::pipeline::Engine;
use genga::recipe::Recipe;
use genga_read::Options;
use glam::{DQuat, DVec3};

use crate::cases::is_full;
use crate::clips::{self, here};
use crate::program::Place;

/// The keys of the default recipe.
fn keys(clip: &Clip) -> Vec<Key> {
    let mut engine = Engine::new(clip.clone()).unwrap();
    engine.find_keys(&Recipe::default(), &Edits::default()).unwrap().keys.keys.clone()
}

/// Checks that each clip and a changed version of it have the same keys, with the same price and reason.
fn keeps_every_key(changes: impl Fn(&Clip) -> Clip) {
    each_clip(|name, clip| {
        let (own, others) = (keys(clip), keys(&changes(clip)));
        assert!(!own.is_empty(), "{name}");
        assert_eq!(frames(&own), frames(&others), "{name}");
        for (one, two) in own.iter().zip(&others) {
            // Losses have seven digits.
            let near = 1e-6 + 1e-5 * one.price;
            let is_price = one.price == two.price || (one.price - two.price).abs() < near;
            assert!(is_price && one.origin == two.origin, "{name}: {one:?} {two:?}");
        }
    });
}

fn frames(keys: &[Key]) -> Vec<usize> {
    keys.iter().map(|key| key.frame.0).collect()
}

fn each_clip(of: impl Fn(&str, &Clip)) {
    let samples = ["kick", "pitch", "swing", "tennis", "kuroda-pitch"];
    // With real clips at hand, one sample is enough.
    for sample in &samples[..if is_full() { 5 } else { 1 }] {
        of(sample, &clips::sample(&format!("{sample}.bvh")));
    }
    clips::with_all(|paths| {
        paths.iter().for_each(|path| of(&clips::name(path), &clips::read(path)));
    });
    let more = clips::more().into_iter().map(|path| (clips::name(&path), clips::read(&path)));
    more.filter(|(_, clip)| is_known(clip)).for_each(|(name, clip)| of(&name, &clip));
}

/// Whether no part of the body is guessed: a guess may differ in another rig.
fn is_known(clip: &Clip) -> bool {
    Description::notes(clip).iter().all(|note| note.code != "W_BODY_GUESS")
}

/// Puts a chain of joints before all others; the former roots hang on its last joint.
fn on(clip: &Clip, carriers: &[(&str, DVec3)]) -> Clip {
    let count = carriers.len();
    let joint = |(at, (name, offset)): (usize, &(&str, DVec3))| Joint {
        name: (*name).into(),
        parent: at.checked_sub(1).map(JointId),
        offset: *offset,
        channels: vec![Channel::Rotation(Axis::Y)],
        first_channel: at,
        end_sites: vec![],
    };
    let own = clip.skeleton().joints.iter().map(|joint| Joint {
        parent: Some(joint.parent.map_or(JointId(count - 1), |parent| JointId(parent.0 + count))),
        first_channel: joint.first_channel + count,
        ..joint.clone()
    });
    let joints = carriers.iter().enumerate().map(joint).chain(own).collect();
    let zeros = vec![0.0; count];
    let rows = clip.rows().flat_map(|row| zeros.iter().chain(row).copied()).collect();
    Clip::new(Skeleton { joints }, clip.rate(), clip.first(), clip.len(), rows).unwrap()
}

/// Moves the whole take elsewhere.
fn moved(clip: &Clip, way: DVec3) -> Clip {
    let mut rows: Vec<f64> = clip.rows().flatten().copied().collect();
    let width = clip.skeleton().channels();
    for joint in clip.skeleton().joints.iter().filter(|joint| joint.parent.is_none()) {
        for (at, channel) in joint.channels.iter().enumerate() {
            if let Channel::Position(axis) = channel {
                rows.chunks_exact_mut(width)
                    .for_each(|row| row[joint.first_channel + at] += way[*axis as usize]);
            }
        }
    }
    Clip::new(clip.skeleton().clone(), clip.rate(), clip.first(), clip.len(), rows).unwrap()
}

#[test]
fn a_reference_that_stays_changes_no_key() {
    keeps_every_key(|clip| on(clip, &[("Reference", DVec3::ZERO)]));
}

#[test]
fn a_reference_far_from_the_take_changes_no_key() {
    let far = DVec3::new(700.0, 0.0, -900.0);
    keeps_every_key(|clip| moved(&on(clip, &[("world", DVec3::X), ("Reference", DVec3::Z)]), far));
}

#[test]
fn a_take_that_begins_elsewhere_has_the_same_keys() {
    keeps_every_key(|clip| moved(clip, DVec3::new(-250.0, 0.0, 400.0)));
}

/// Hangs a chain of joints on one of the clip's joints; `turned` gives each one's degrees at a frame.
fn hung(
    clip: &Clip,
    on: JointId,
    chain: &[(String, DVec3)],
    turned: impl Fn(usize, usize) -> f64,
) -> Clip {
    let mut joints = clip.skeleton().joints.clone();
    let width = clip.skeleton().channels();
    for (at, (name, offset)) in chain.iter().enumerate() {
        let parent = if at == 0 { on } else { JointId(joints.len() - 1) };
        joints.push(Joint {
            name: name.clone(),
            parent: Some(parent),
            offset: *offset,
            channels: vec![Channel::Rotation(Axis::X)],
            first_channel: width + at,
            end_sites: vec![],
        });
    }
    let mut rows = Vec::with_capacity(clip.len() * (width + chain.len()));
    for (frame, row) in clip.rows().enumerate() {
        rows.extend_from_slice(row);
        rows.extend((0..chain.len()).map(|at| turned(at, frame)));
    }
    Clip::new(Skeleton { joints }, clip.rate(), clip.first(), clip.len(), rows).unwrap()
}

/// The approximate height of a body.
fn height(clip: &Clip) -> f64 {
    genga::motion::Landmarks::new(clip).height
}

/// Joints on which something is hung: a few, or all in the full check.
fn places(clip: &Clip) -> Vec<JointId> {
    let every = if is_full() { 1 } else { 1 + clip.skeleton().len() / 4 };
    (0..clip.skeleton().len()).step_by(every).map(JointId).collect()
}

#[test]
fn static_joints_at_all_ends_change_no_key() {
    keeps_every_key(|clip| {
        let mut is_end = vec![true; clip.skeleton().len()];
        clip.skeleton()
            .joints
            .iter()
            .filter_map(|joint| joint.parent)
            .for_each(|parent| is_end[parent.0] = false);
        let ends: Vec<usize> = (0..is_end.len()).filter(|joint| is_end[*joint]).collect();
        ends.into_iter().fold(clip.clone(), |clip, end| {
            let name = format!("{}_End", clip.skeleton().joints[end].name);
            let tip = 0.05 * height(&clip) * DVec3::new(0.6, 0.8, 0.0);
            hung(&clip, JointId(end), &[(name, tip)], |_, _| 0.0)
        })
    });
}

/// Checks that hanging something on several joints of a clip, cumulatively, changes no key.
fn hanging_changes_no_key(hang: impl Fn(&Clip, JointId) -> Clip) {
    keeps_every_key(|clip| {
        places(clip).into_iter().fold(clip.clone(), |clip, place| hang(&clip, place))
    });
}

#[test]
fn hair_changes_no_key() {
    hanging_changes_no_key(|clip, place| {
        let strand = 0.07 * height(clip) * DVec3::new(0.2, -0.9, -0.3);
        let chain: Vec<_> = (0..7).map(|at| (format!("Hair_{}_{at}", place.0), strand)).collect();
        hung(clip, place, &chain, |at, frame| 8.0 * (0.3 * frame as f64 - 0.6 * at as f64).sin())
    });
}

#[test]
fn a_far_helper_changes_no_key() {
    hanging_changes_no_key(|clip, place| {
        let far = 1.8 * height(clip) * DVec3::new(0.1, 0.0, 1.0);
        hung(clip, place, &[(format!("knee.{}", place.0), far)], |_, frame| {
            5.0 * (0.2 * frame as f64).sin()
        })
    });
}

#[test]
fn a_prop_changes_no_key() {
    hanging_changes_no_key(|clip, place| {
        let blade = 0.3 * height(clip) * DVec3::new(0.0, 0.5, 0.85);
        let name = |end: &str| format!("Blade{end}.{}", place.0);
        hung(clip, place, &[(name("Grip"), 0.1 * blade), (name("Tip"), 0.9 * blade)], |_, _| 0.0)
    });
}

/// Turns the root of a clip in the world, as some programs do to write another up axis.
fn turned(clip: &Clip, turn: DQuat) -> Clip {
    let width = clip.skeleton().channels();
    let mut rows: Vec<f64> = clip.rows().flatten().copied().collect();
    let roots = clip.skeleton().joints.iter().filter(|joint| joint.parent.is_none());
    for (joint, row) in roots.flat_map(|joint| (0..clip.len()).map(move |row| (joint, row))) {
        let row = &mut rows[row * width..(row + 1) * width];
        let (place, own) = (local_translation(joint, row), local_rotation(joint, row));
        set_local_rotation(joint, turn * own, row);
        let place = turn * place;
        for (at, channel) in joint.channels.iter().enumerate() {
            if let Channel::Position(axis) = channel {
                row[joint.first_channel + at] = place[*axis as usize];
            }
        }
    }
    Clip::new(clip.skeleton().clone(), clip.rate(), clip.first(), clip.len(), rows).unwrap()
}

#[test]
fn z_up_in_the_root_alone_changes_no_key() {
    keeps_every_key(|clip| {
        // Some files already have the other axis up.
        let (from, other) = match Stature::new(clip).up {
            Axis::Z => (-FRAC_PI_2, Axis::Y),
            _ => (FRAC_PI_2, Axis::Z),
        };
        let turned = turned(clip, DQuat::from_rotation_x(from));
        assert_eq!(Stature::new(&turned).up, other);
        turned
    });
}

#[test]
fn a_turn_about_the_vertical_changes_no_key() {
    keeps_every_key(|clip| {
        let up = if Stature::new(clip).up == Axis::Z { DVec3::Z } else { DVec3::Y };
        turned(clip, DQuat::from_axis_angle(up, 2.1))
    });
}

#[test]
fn somebody_who_lies_all_the_time_keeps_the_axis_of_the_rest_pose() {
    let lying = turned(&clips::sample("kick.bvh"), DQuat::from_rotation_z(FRAC_PI_2));
    assert_eq!(Stature::new(&lying).up, Axis::Y);
}

#[test]
fn a_layer_of_hair_alone_has_keys_of_its_own() {
    let clip = clips::sample("kick.bvh");
    let head = clip.skeleton().find("Head").unwrap();
    let strand = 0.07 * height(&clip) * DVec3::new(0.0, -0.9, -0.3);
    let chain: Vec<_> = (0..5).map(|at| (format!("Hair_{at}"), strand)).collect();
    let haired =
        hung(&clip, head, &chain, |at, frame| 25.0 * (0.35 * frame as f64 - 0.4 * at as f64).sin());
    let mut recipe = Recipe::default();
    let layers = "[[layers]]\nname = \"A\"\njoints = [\"Hips\"]\n[[layers]]\nname = \"B\"\njoints = \
                  [\"Hair_0\", \"Hair_1\", \"Hair_2\", \"Hair_3\", \"Hair_4\"]\n";
    recipe.take_layers(layers).unwrap();
    let mut engine = Engine::new(haired).unwrap();
    let sheet = engine.run(&recipe, &Edits::default()).unwrap();
    let turns = |layer: usize| sheet.layers().nth(layer).unwrap().body.turns.len();
    assert!(turns(0) > 5 && turns(1) > 5, "{} and {}", turns(0), turns(1));
}

/// Puts two copies of a body into one file, each with its own letter before all names. The second moves; the first
/// keeps the pose of its first frame, or moves too, 4 m away.
fn two_people(clip: &Clip, is_first_still: bool) -> Clip {
    let own = clip.skeleton();
    let (count, width) = (own.len(), own.channels());
    let of = |letter: char, joints: usize, channels: usize| {
        own.joints.iter().map(move |joint| Joint {
            name: format!("{letter}_{}", joint.name),
            parent: joint.parent.map(|parent| JointId(parent.0 + joints)),
            first_channel: joint.first_channel + channels,
            ..joint.clone()
        })
    };
    let joints = of('A', 0, 0).chain(of('B', count, width)).collect();
    let first: Vec<f64> = clip.rows().next().unwrap().to_vec();
    let away = moved(clip, DVec3::new(400.0, 0.0, 0.0));
    let rows = clip.rows().zip(away.rows()).flat_map(|(row, away)| {
        if is_first_still { [&first[..], row].concat() } else { [away, row].concat() }
    });
    let rows = rows.collect();
    Clip::new(Skeleton { joints }, clip.rate(), clip.first(), clip.len(), rows).unwrap()
}

#[test]
fn of_two_people_the_keys_are_those_of_one_and_it_is_said() {
    for is_first_still in [true, false] {
        keeps_every_key(|clip| {
            let both = two_people(clip, is_first_still);
            let notes = Description::new(&both).notes;
            let root = &clip.skeleton().joints[0].name;
            let (whose, other) = if is_first_still { ("B", "A") } else { ("A", "B") };
            let said =
                format!("those of {whose}_{root}; --root {other}_{root} takes another alone");
            assert!(notes.iter().any(|note| note.message.contains(&said)), "{notes:?}");
            both
        });
    }
}

#[test]
fn of_two_people_one_is_seen_where_only_an_arm_moves() {
    let clip = clips::sample("kick.bvh");
    let skeleton = clip.skeleton();
    let joints = skeleton.joints.iter().enumerate();
    let joints = joints.map(|(at, joint)| Joint { name: format!("q{at}"), ..joint.clone() });
    let arm = &skeleton.joints[skeleton.find("LeftForeArm").unwrap().0];
    let moving = arm.first_channel..arm.first_channel + arm.channels.len();
    let first: Vec<f64> = clip.rows().next().unwrap().to_vec();
    let rows = clip.rows().flat_map(|row| {
        let mut held = first.clone();
        held[moving.clone()].copy_from_slice(&row[moving.clone()]);
        held
    });
    let (nameless, rows) = (Skeleton { joints: joints.collect() }, rows.collect());
    let still = Clip::new(nameless, clip.rate(), clip.first(), clip.len(), rows).unwrap();
    let body = Description::new(&two_people(&still, true));
    assert!(body.notes.iter().any(|note| note.code == "W_PEOPLE"), "{body:?}");
    assert!(body.lines.iter().any(|(part, _)| *part == "left arm"), "{body:?}");
}

/// The clip without some joints and all that hangs on them: End Sites stand in their places.
fn cut(clip: &Clip, at: &[&str]) -> Clip {
    let (mut skeleton, mut columns) = (Skeleton::default(), Vec::new());
    let mut kept: Vec<Option<JointId>> = Vec::new();
    for (_, joint) in clip.skeleton().iter() {
        let parent = joint.parent.map(|parent| kept[parent.0]);
        let is_cut = at.contains(&&joint.name[..]);
        if let (true, Some(Some(parent))) = (is_cut, parent) {
            let end = EndSite { name: "Site".into(), offset: joint.offset };
            skeleton.joints[parent.0].end_sites.push(end);
        }
        let is_kept = !is_cut && parent != Some(None);
        kept.push(is_kept.then(|| JointId(skeleton.len())));
        if is_kept {
            let first_channel = columns.len();
            columns.extend(joint.first_channel..joint.first_channel + joint.channels.len());
            let parent = parent.flatten();
            skeleton.joints.push(Joint { parent, first_channel, ..joint.clone() });
        }
    }
    let rows = clip.rows().flat_map(|row| columns.iter().map(|column| row[*column])).collect();
    Clip::new(skeleton, clip.rate(), clip.first(), clip.len(), rows).unwrap()
}

#[test]
fn limbs_without_hands_and_feet_end_in_the_tips_of_their_last_bones() {
    let clip = clips::sample("kick.bvh");
    let told = |clip: &Clip, part: &str| {
        let lines = Description::new(clip).lines;
        lines.into_iter().find(|(own, _)| *own == part).map(|(_, told)| told)
    };
    let feet = ["LeftFoot", "RightFoot"];
    for at in [&feet[..], &["LeftFoot", "RightFoot", "LeftHand", "RightHand"]] {
        let short = cut(&clip, at);
        assert_eq!(told(&short, "height"), told(&clip, "height"));
        let leg = "LeftUpLeg LeftLeg and its End Site, by names";
        assert_eq!(told(&short, "left leg").as_deref(), Some(leg));
        let ankles = |clip: &Clip| {
            let landmarks = Landmarks::new(clip);
            let ankles: Vec<_> = landmarks.feet.iter().map(|foot| foot.ankle).collect();
            paths(clip, clip.clock(24.0), &ankles)
        };
        let apart = ankles(&clip).concat().into_iter().zip(ankles(&short).concat());
        assert!(apart.map(|(a, b)| a.distance(b)).all(|way| way < 1e-9), "{at:?}");
        assert_eq!(Description::new(&short).notes, []);
    }
}

#[test]
fn of_a_body_with_a_limb_missing_that_limb_is_told() {
    let clip = cut(&clips::sample("kick.bvh"), &["LeftUpLeg"]);
    let body = Description::new(&clip);
    let (_, limbs) = body.lines.iter().find(|(part, _)| *part == "limbs").unwrap();
    assert!(limbs.starts_with("not all: no whole left leg;"), "{limbs}");
    assert!(body.notes[0].message.contains("of the body no whole left leg is known"), "{body:?}");
    let clip = cut(&clips::sample("kick.bvh"), &["LeftForeArm"]);
    let lines = Description::new(&clip).lines;
    let (_, arm) = lines.iter().find(|(part, _)| *part == "left arm").unwrap();
    assert_eq!(arm, "LeftShoulder LeftArm and no joint beyond, by shape");
}

#[test]
fn limbs_are_those_that_names_give_whatever_else_hangs_there() {
    let clip = clips::sample("kick.bvh");
    let lines = |clip: &Clip| Description::new(clip).lines;
    let own = lines(&clip);
    let told = |part: &str| own.iter().find(|(own, _)| *own == part).unwrap().1.clone();
    assert_eq!(told("head"), "Head, by name");
    assert_eq!(told("right leg"), "RightUpLeg RightLeg RightFoot, by names");
    let head = clip.skeleton().find("Head").unwrap();
    let strand = 0.12 * height(&clip) * DVec3::new(0.3, -0.9, 0.0);
    let tails =
        |side: &str| (0..7).map(|at| (format!("Hair_{side}_{at}"), strand)).collect::<Vec<_>>();
    let wave = |at: usize, frame: usize| 9.0 * (0.4 * frame as f64 - at as f64).sin();
    let haired = hung(&hung(&clip, head, &tails("L"), wave), head, &tails("R"), wave);
    let found = lines(&haired);
    assert_eq!(found[..own.len()], own[..]);
    assert_eq!(found[own.len()], ("not body", "14 joints: 14 of hair or cloth".into()));
}

#[test]
fn what_only_the_shape_says_is_a_guess_that_is_said() {
    let clip = clips::sample("kick.bvh");
    let nonsense = |at: usize, joint: &Joint| Joint { name: format!("q{at}"), ..joint.clone() };
    let joints = clip.skeleton().joints.iter().enumerate().map(|(at, joint)| nonsense(at, joint));
    let rows = clip.rows().flatten().copied().collect();
    let skeleton = Skeleton { joints: joints.collect() };
    let nameless = Clip::new(skeleton, clip.rate(), clip.first(), clip.len(), rows).unwrap();
    let notes = Description::new(&nameless).notes;
    assert_eq!((notes.len(), notes[0].code), (1, "W_BODY_GUESS"));
    assert!(
        notes[0].message.contains("its shape alone says head, left arm, right arm"),
        "{notes:?}"
    );
    assert_eq!(Description::new(&clip).notes, []);
}

/// Reorders the joints of a clip: the children of each joint are reversed.
fn reordered(clip: &Clip) -> Clip {
    let own = clip.skeleton();
    let mut open: Vec<usize> =
        (0..own.len()).filter(|joint| own.joints[*joint].parent.is_none()).collect();
    let mut order = Vec::new();
    while let Some(joint) = open.pop() {
        order.push(joint);
        open.extend(
            (0..own.len()).filter(|child| own.joints[*child].parent == Some(JointId(joint))),
        );
    }
    let mut places = vec![0; own.len()];
    order.iter().enumerate().for_each(|(place, joint)| places[*joint] = place);
    let mut first_channel = 0;
    let joint = |joint: &usize| {
        let data = own.joints[*joint].clone();
        let parent = data.parent.map(|parent| JointId(places[parent.0]));
        let moved = Joint { parent, first_channel, ..data };
        first_channel += moved.channels.len();
        moved
    };
    let joints = order.iter().map(joint).collect();
    let columns = order.iter().flat_map(|joint| {
        let Joint { first_channel, channels, .. } = &own.joints[*joint];
        *first_channel..first_channel + channels.len()
    });
    let columns: Vec<usize> = columns.collect();
    let rows = clip.rows().flat_map(|row| columns.iter().map(|column| row[*column])).collect();
    Clip::new(Skeleton { joints }, clip.rate(), clip.first(), clip.len(), rows).unwrap()
}

#[test]
fn joints_in_another_order_change_no_key() {
    keeps_every_key(reordered);
}

/// Mirrors a clip, with left and right exchanged.
fn mirrored(clip: &Clip) -> Clip {
    let across = DVec3::new(-1.0, 1.0, 1.0);
    let mut skeleton = clip.skeleton().clone();
    for joint in &mut skeleton.joints {
        joint.name = exchanged(&joint.name);
        joint.offset *= across;
        joint.end_sites.iter_mut().for_each(|end| end.offset *= across);
    }
    let width = skeleton.channels();
    let mut rows: Vec<f64> = clip.rows().flatten().copied().collect();
    for row in rows.chunks_exact_mut(width) {
        for (own, joint) in clip.skeleton().joints.iter().zip(&skeleton.joints) {
            let (place, turn) = (across * local_translation(own, row), local_rotation(own, row));
            set_local_rotation(joint, DQuat::from_xyzw(turn.x, -turn.y, -turn.z, turn.w), row);
            for (at, channel) in joint.channels.iter().enumerate() {
                if let Channel::Position(axis) = channel {
                    row[joint.first_channel + at] = place[*axis as usize];
                }
            }
        }
    }
    Clip::new(skeleton, clip.rate(), clip.first(), clip.len(), rows).unwrap()
}

/// The name of the joint on the other side.
fn exchanged(name: &str) -> String {
    let sides = [
        ("Left", "Right"),
        ("left", "right"),
        ("LHip", "RHip"),
        ("LThumb", "RThumb"),
        ("LFingers", "RFingers"),
    ];
    for (left, right) in sides {
        if name.contains(left) || name.contains(right) {
            let (from, to) = if name.contains(left) { (left, right) } else { (right, left) };
            return name.replace(from, to);
        }
    }
    let mut letters = name.chars();
    let is_sided =
        name.chars().nth(1).is_some_and(char::is_uppercase) || ["lhand", "rhand"].contains(&name);
    match letters.next() {
        Some('l') if is_sided => format!("r{}", letters.as_str()),
        Some('r') if is_sided => format!("l{}", letters.as_str()),
        _ => name.into(),
    }
}

#[test]
fn a_mirrored_take_has_the_same_keys() {
    keeps_every_key(mirrored);
}

/// For each MMD bone, its joints in one dialect of the table.
type Dialect = BTreeMap<String, Vec<String>>;

fn dialects() -> Vec<Dialect> {
    let text = std::fs::read_to_string(clips::here("src/motion/body/names/dialects.toml")).unwrap();
    let table: toml::Table = toml::from_str(&text).unwrap();
    let names = |joints: &toml::Value, side: &str| -> Vec<String> {
        let one = |name: &toml::Value| name.as_str().unwrap().replace('@', side);
        joints.as_array().map_or_else(|| vec![one(joints)], |list| list.iter().map(one).collect())
    };
    let dialect = |dialect: &toml::Value| {
        let sides = dialect.get("sides").and_then(toml::Value::as_array);
        let side = |at: usize| sides.map_or("", |sides| sides[at].as_str().unwrap());
        let rows = dialect["bones"].as_table().unwrap().iter();
        let rows = rows.flat_map(|(bone, joints)| {
            match bone.strip_prefix('左').filter(|_| sides.is_some()) {
                Some(stem) => vec![
                    (bone.clone(), names(joints, side(0))),
                    (format!("右{stem}"), names(joints, side(1))),
                ],
                None => vec![(bone.clone(), names(joints, ""))],
            }
        });
        rows.collect()
    };
    table["dialect"].as_array().unwrap().iter().map(dialect).collect()
}

/// Renames the joints of a clip to another dialect, as far as that has names for them.
fn renamed(clip: &Clip, from: &Dialect, to: &Dialect) -> Clip {
    let mut skeleton = clip.skeleton().clone();
    for (bone, joints) in from {
        let there: Vec<usize> = joints
            .iter()
            .filter_map(|name| clip.skeleton().find(name).map(|joint| joint.0))
            .collect();
        let names = to.get(bone).map_or(&[][..], Vec::as_slice);
        for (joint, name) in there.into_iter().zip(names) {
            skeleton.joints[joint].name.clone_from(name);
        }
    }
    let rows = clip.rows().flatten().copied().collect();
    Clip::new(skeleton, clip.rate(), clip.first(), clip.len(), rows).unwrap()
}

#[test]
fn names_of_another_dialect_move_no_key_by_more_than_a_frame() {
    let dialects = dialects();
    assert!(dialects.len() > 12);
    let named = |clip: &Clip, dialect: &Dialect| {
        dialect.values().flatten().filter(|name| clip.skeleton().find(name).is_some()).count()
    };
    let others: Vec<&Dialect> =
        dialects.iter().filter(|dialect| dialect.contains_key("左手首")).collect();
    // A different one for each clip, in turn.
    let next = std::cell::Cell::new(0);
    each_clip(|name, clip| {
        let own = dialects.iter().max_by_key(|dialect| named(clip, dialect)).unwrap();
        next.set(next.get() + 1);
        // No dialect has limbs that are recognized by words.
        if named(clip, own) < 12 {
            return;
        }
        let other = others[(5 * next.get()) % others.len()];
        let changed = renamed(clip, own, other);
        let limb = |clip: &Clip| Description::new(clip).lines[3].1.clone();
        assert!(limb(&changed).ends_with("by names"), "{}", limb(&changed));
        // Names decide which still joints at the end of a finger count as end points, so frames may differ by one.
        let (own, others) = (frames(&keys(clip)), frames(&keys(&changed)));
        let is_near = own.iter().zip(&others).all(|(one, two)| one.abs_diff(*two) <= 1);
        assert!(own.len() == others.len() && is_near, "{name}: {own:?} {others:?}");
    });
}

#[test]
fn a_head_that_ends_in_its_joint_is_the_head_and_not_the_neck() {
    let clip = clips::sample("kick.bvh");
    let mut skeleton = clip.skeleton().clone();
    let head = skeleton.find("Head").unwrap();
    assert!(!skeleton.joints[head.0].end_sites.is_empty());
    skeleton.joints[head.0].end_sites.clear();
    let rows = clip.rows().flatten().copied().collect();
    let topless = Clip::new(skeleton, clip.rate(), clip.first(), clip.len(), rows).unwrap();
    assert_eq!(Landmarks::new(&topless).head.map(|head| head.joint), Some(head));
}

/// An animal whose legs are each one long bone, without meaningful names.
fn animal() -> Clip {
    let mut joints = Vec::new();
    let mut add = |parent: Option<usize>, offset: DVec3| {
        let at = joints.len();
        joints.push(Joint {
            name: format!("Bone{at}"),
            parent: parent.map(JointId),
            offset,
            channels: [Axis::Z, Axis::X, Axis::Y].map(Channel::Rotation).to_vec(),
            first_channel: 3 * at,
            end_sites: vec![],
        });
        at
    };
    let hips = add(None, DVec3::new(0.0, 100.0, 0.0));
    let chest = add(Some(hips), DVec3::new(0.0, 0.0, 40.0));
    for (on, x) in [(hips, 10.0), (hips, -10.0), (chest, 10.0), (chest, -10.0)] {
        let top = add(Some(on), DVec3::new(x, 0.0, 0.0));
        add(Some(top), DVec3::new(0.0, -90.0, 0.0));
    }
    add(Some(chest), DVec3::new(0.0, 20.0, 20.0));
    let row = |frame: usize| {
        let swing = 30.0 * (0.3 * frame as f64).sin();
        let of_joint = move |at: usize| {
            let sign = if matches!(at, 2 | 8) { 1.0 } else { -1.0 };
            [0.0, if matches!(at, 2 | 4 | 6 | 8) { sign * swing } else { 0.0 }, 0.0]
        };
        (0..11).flat_map(of_joint)
    };
    let values = (0..72).flat_map(row).collect();
    let rate = genga::time::FrameRate::new(24.0).unwrap();
    Clip::new(Skeleton { joints }, rate, genga::time::Frame(0), 72, values).unwrap()
}

#[test]
fn the_long_legs_of_an_animal_are_no_helpers() {
    let animal = animal();
    let lines = Description::new(&animal).lines;
    assert!(lines.iter().all(|(what, _)| *what != "not body"), "{lines:?}");
    assert!(keys(&animal).len() > 4, "{:?}", frames(&keys(&animal)));
}

#[test]
fn names_that_the_shape_contradicts_are_taken_and_it_is_said() {
    let clip = clips::sample("kick.bvh");
    let exchanged = |name: &str| {
        let pairs = [("UpLeg", "Arm"), ("Leg", "ForeArm"), ("Foot", "Hand")];
        let other = pairs.into_iter().find_map(|(leg, arm)| {
            let side =
                |end: &str| name.strip_suffix(end).filter(|side| ["Left", "Right"].contains(side));
            let as_arm = side(leg).map(|side| format!("{side}{arm}"));
            as_arm.or_else(|| side(arm).map(|side| format!("{side}{leg}")))
        });
        other.unwrap_or_else(|| name.to_owned())
    };
    let joints = clip.skeleton().joints.iter();
    let joints =
        joints.map(|joint| Joint { name: exchanged(&joint.name), ..joint.clone() }).collect();
    let rows = clip.rows().flatten().copied().collect();
    let wrong =
        Clip::new(Skeleton { joints }, clip.rate(), clip.first(), clip.len(), rows).unwrap();
    let notes = Description::notes(&wrong);
    assert!(
        notes.iter().any(|note| note.message.contains("arms and legs are others by its shape")),
        "{notes:?}"
    );
    assert_eq!(Description::notes(&clip), []);
}

#[test]
fn what_a_table_of_bones_says_goes_before_names() {
    let clip = clips::sample("kick.bvh");
    let text = clips::here("data/kick.bvh");
    let table =
        BoneMap::parse("[bones]\n\"左ひじ\" = \"LeftHand\"\n\"左手首\" = \"LeftForeArm\"\n");
    let wrong = Options { bones: Some(table.unwrap()), ..Options::default() };
    let left_arm = |clip: &Clip| Description::new(clip).lines[3].clone();
    // A hand does not carry its forearm, so this is no limb, and the names decide.
    assert_eq!(left_arm(&wrong.open(&text).unwrap().clip), left_arm(&clip));
    let table = BoneMap::parse("[bones]\n\"左腕\" = \"LeftShoulder\"\n").unwrap();
    let said = Options { bones: Some(table), ..Options::default() }.open(&text).unwrap().clip;
    assert_eq!(
        left_arm(&said),
        ("left arm", "LeftShoulder LeftForeArm LeftHand, as --bones says".into())
    );
}

/// Bones of a VMD, by name and frame: place and rotation.
fn bones_of_vmd(bytes: &[u8]) -> Vec<(Vec<u8>, [f32; 7])> {
    let count = u32::from_le_bytes(bytes[50..54].try_into().unwrap()) as usize;
    let bone = |record: &[u8]| {
        let value = |at: usize| f32::from_le_bytes(record[19 + 4 * at..][..4].try_into().unwrap());
        (record[..19].to_vec(), std::array::from_fn(value))
    };
    bytes[54..].chunks_exact(111).take(count).map(bone).collect()
}

/// A rest along Y under a root that is turned once and for all: programs that count Z as up write such files.
#[test]
fn a_body_that_stands_along_another_axis_than_its_rest_stands_in_a_vmd() {
    let place = Place::new();
    let kick = fs::read_to_string(here("data/kick.bvh")).unwrap();
    let (tree, motion) = kick.split_once("MOTION").unwrap();
    let tree = tree.replacen(
        "ROOT",
        "ROOT World\n{\nOFFSET 0 0 0\nCHANNELS 3 Zrotation Xrotation Yrotation\nJOINT",
        1,
    );
    let row =
        |(at, line): (usize, &str)| if at < 3 { line.into() } else { format!("0 90 0 {line}") };
    let rows: Vec<String> = motion.lines().enumerate().map(row).collect();
    fs::write(place.path("turned.bvh"), format!("{tree}}}\nMOTION{}\n", rows.join("\n"))).unwrap();
    place.done("run data/kick.bvh --deliver vmd --out a");
    place.done("run turned.bvh --deliver vmd --out b");
    let [own, turned] = ["a/kick.vmd", "b/turned.vmd"]
        .map(|file| bones_of_vmd(&fs::read(place.path(file)).unwrap()));
    assert!(own.len() > 100 && own.len() == turned.len());
    for ((name, a), (other, b)) in own.iter().zip(&turned) {
        assert_eq!(name, other);
        let dot: f32 = a[3..].iter().zip(&b[3..]).map(|(a, b)| a * b).sum();
        let near = a[..3].iter().zip(&b[..3]).all(|(a, b)| (a - b).abs() < 1e-2);
        assert!(near && dot.abs() > 0.9999, "{a:?} {b:?}");
    }
}
