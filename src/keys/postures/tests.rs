use super::*;
use crate::keys::tests::swing;
use crate::motion::{Channel, bvh};

fn sample(name: &str) -> Clip {
    let path = format!("{}/data/{name}.bvh", env!("CARGO_MANIFEST_DIR"));
    bvh::read(&std::fs::read(path).unwrap()).unwrap().clip
}

fn postures(clip: &Clip) -> Postures {
    Postures::new(
        clip,
        &Build::new(clip),
        clip.clock(48.0),
        (&Screen::WORLD, 2.0),
        &vec![1.0; clip.skeleton().len()],
    )
}

/// Returns the clip scaled by `scale` and then carried by `way` along X.
fn carried(clip: &Clip, way: f64, scale: f64) -> Clip {
    let mut skeleton = clip.skeleton().clone();
    for joint in &mut skeleton.joints {
        joint.offset *= scale;
        joint.end_sites.iter_mut().for_each(|end| end.offset *= scale);
    }
    let mut values = Vec::new();
    for row in clip.rows() {
        let mut row = row.to_vec();
        for joint in &skeleton.joints {
            for (column, channel) in (joint.first_channel..).zip(&joint.channels) {
                if let Channel::Position(axis) = channel {
                    row[column] *= scale;
                    row[column] +=
                        if *axis == Axis::X && joint.parent.is_none() { way } else { 0.0 };
                }
            }
        }
        values.extend(row);
    }
    Clip::new(skeleton, clip.rate(), clip.first(), clip.len(), values).unwrap()
}

fn far(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b).powi(2)).sum::<f64>().sqrt()
}

#[test]
fn a_person_has_the_rows_of_a_mannequin_and_anything_else_its_own_points() {
    let kick = postures(&sample("kick"));
    assert_eq!(kick.columns, COLUMNS);
    assert_eq!(kick.len(), 183, "two a koma");
    let arm = postures(&swing(&[0.0, 30.0, 60.0]));
    assert_eq!(arm.columns, 9, "two joints and a tip");
}

#[test]
fn size_and_place_change_no_distance() {
    let kick = sample("kick");
    let (plain, other) = (postures(&kick), postures(&carried(&kick, 500.0, 2.54)));
    for (a, b) in [(0, 40), (40, 90), (3, 180)] {
        let [one, two] = [&plain, &other].map(|rows| far(rows.row(a), rows.row(b)));
        assert!((one - two).abs() < 1e-9 * one, "{one} {two}");
    }
}

#[test]
fn a_body_that_turns_in_place_keeps_its_points() {
    let kick = sample("kick");
    let root = &kick.skeleton().joints[0];
    let about_y = |channel: &Channel| *channel == Channel::Rotation(Axis::Y);
    let turn = root.channels.iter().position(about_y).unwrap();
    let still: Vec<f64> = (0..48)
        .flat_map(|frame| {
            let mut row = kick.row(kick.first()).to_vec();
            for (column, channel) in root.channels.iter().enumerate() {
                if matches!(channel, Channel::Rotation(_)) {
                    row[root.first_channel + column] = 0.0;
                }
            }
            row[root.first_channel + turn] = 15.0 * f64::from(frame);
            row
        })
        .collect();
    let spin = Clip::new(kick.skeleton().clone(), kick.rate(), kick.first(), 48, still).unwrap();
    let rows = postures(&spin);
    let [first, last] = [rows.row(0), rows.row(rows.len() - 1)];
    let points = 3 * POINTS;
    assert!(far(&first[..points], &last[..points]) < 1e-9);
    let turned = (last[COLUMNS - 1] - first[COLUMNS - 1]).abs() / (100.0 * GIRTH);
    let frames = spin.rate().fps() * (rows.len() - 1) as f64 / 48.0;
    assert!((turned - (15.0 * frames).to_radians()).abs() < 1e-9, "{turned}");
}

#[test]
fn a_joint_without_say_does_not_count() {
    let kick = sample("kick");
    let clock = kick.clock(48.0);
    let mut own = vec![1.0; kick.skeleton().len()];
    let build = Build::new(&kick);
    let wrist = build.mannequin.as_ref().unwrap().joints()[4];
    own[wrist] = 0.0;
    let rows = Postures::new(&kick, &build, clock, (&Screen::WORLD, 2.0), &own);
    assert!((0..rows.len()).all(|at| rows.row(at)[3 * 4..3 * 6].iter().all(|value| *value == 0.0)));
    assert!((0..rows.len()).any(|at| rows.row(at)[..3 * 4].iter().any(|value| *value != 0.0)));
}

/// Returns the postures as seen from a camera.
fn seen(clip: &Clip, from: &str) -> Postures {
    let screen = Screen::new(from.parse().unwrap(), clip);
    let own = vec![1.0; clip.skeleton().len()];
    Postures::new(clip, &Build::new(clip), clip.clock(48.0), (&screen, 2.0), &own)
}

/// Returns the first pose of the clip, carried along each axis by `way` in a second.
fn gone(clip: &Clip, way: [f64; 3]) -> Clip {
    let root = &clip.skeleton().joints[0];
    let rows = (0..25).flat_map(|frame| {
        let mut row = clip.row(clip.first()).to_vec();
        for (column, channel) in (root.first_channel..).zip(&root.channels) {
            if let Channel::Position(axis) = channel {
                row[column] += f64::from(frame) / 24.0 * way[*axis as usize];
            }
        }
        row
    });
    let rows = rows.collect();
    Clip::new(clip.skeleton().clone(), clip.rate(), clip.first(), 25, rows).unwrap()
}

#[test]
fn front_and_side_together_see_a_level_way_and_each_of_them_all_of_one_up() {
    let kick = sample("kick");
    for way in [[90.0, 0.0, 0.0], [0.0, 0.0, 50.0], [-30.0, 0.0, 70.0]] {
        let clip = gone(&kick, way);
        let whole = |rows: Postures| far(rows.row(0), rows.row(rows.len() - 1));
        let [world, front, side] = ["world", "front", "side"].map(|from| whole(seen(&clip, from)));
        assert!((world - front.hypot(side)).abs() < 1e-9 * world, "{world} {front} {side}");
        assert!(front.min(side) < 0.99 * world);
    }
    let up = gone(&kick, [0.0, 40.0, 0.0]);
    let [world, front] = ["world", "front"].map(|from| seen(&up, from));
    let [in_world, on_screen] = [&world, &front].map(|rows| far(rows.row(3), rows.row(40)));
    assert!(in_world > 1.0 && (in_world - on_screen).abs() < 1e-9, "{in_world} {on_screen}");
}

#[test]
fn on_a_screen_a_person_is_still_a_mannequin_and_anything_else_its_own_points() {
    let kick = seen(&sample("kick"), "front");
    assert_eq!(kick.columns, COLUMNS_SEEN + acting::COLUMNS * kick.acting.len());
    let depth =
        |row: &[f64]| row[..COLUMNS_SEEN].chunks_exact(3).map(|point| point[2].abs()).sum::<f64>();
    assert!((0..kick.len()).all(|at| depth(kick.row(at)) == 0.0), "a screen has no depth");
    let arm = swing(&[0.0, 30.0, 60.0]);
    let world = seen(&arm, "world");
    for (from, share) in [("front", 1.0), ("0,0,1e9:0,0,0", 1.0), ("side", 0.9)] {
        let rows = seen(&arm, from);
        let [all, some] = [&world, &rows].map(|rows| far(rows.row(0), rows.row(rows.len() - 1)));
        assert!(if share == 1.0 { (some / all - 1.0).abs() < 1e-6 } else { some < share * all });
    }
}
