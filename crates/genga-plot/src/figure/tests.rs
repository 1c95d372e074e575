use super::*;
use crate::points::Posing;
use crate::sample;
use genga::motion::bvh::read;
use genga::sheet::Source;

fn kick() -> Clip {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../data/kick.bvh");
    read(&std::fs::read(path).unwrap()).unwrap().clip
}

fn pose(clip: &Clip, figure: &Figure, place: f64) -> Vec<DVec3> {
    Posing::new(clip, figure.marks()).points(Source::At(place))
}

/// Draws a pose as a viewer in the direction of `near` sees it.
fn seen(figure: &Figure, pose: &[DVec3], near: DVec3) -> Vec<Shape> {
    let view = View::from(DVec3::Y, near);
    let at = |point: DVec3| (view.see(point).0, -view.see(point).1);
    figure.draw(pose, &view, 1.0, at).shapes
}

/// Counts the lines on parts of the trunk.
fn face_lines(shapes: &[Shape]) -> usize {
    let is_line = |shape: &&Shape| matches!(shape, Shape::Line(line) if line.ink == Ink::Side(BodySide::Trunk));
    shapes.iter().filter(is_line).count()
}

/// Returns the places of the first and the last part of a side in the order of drawing.
fn order(shapes: &[Shape], of: BodySide) -> (usize, usize) {
    let is_of = |shape: &Shape| matches!(shape, Shape::Part { side, .. } if *side == of);
    let first = shapes.iter().position(is_of).unwrap();
    (first, shapes.iter().rposition(is_of).unwrap())
}

#[test]
fn a_face_is_seen_from_in_front_and_not_from_behind() {
    let clip = kick();
    let figure = Figure::new(&clip, FigureBody::Mannequin);
    let pose = pose(&clip, &figure, 0.0);
    let front = figure.solid(&pose).unwrap().fronts[1];
    let front = (front - DVec3::Y * front.y).normalize();
    assert_eq!(face_lines(&seen(&figure, &pose, front)), 3 + 1 + 3 + 2, "nose, eyes, ribs, V");
    assert_eq!(face_lines(&seen(&figure, &pose, -front)), 0);
}

#[test]
fn near_limbs_lie_over_the_trunk_and_far_ones_under_it() {
    let clip = kick();
    let figure = Figure::new(&clip, FigureBody::Mannequin);
    let pose = pose(&clip, &figure, 0.0);
    let front = figure.solid(&pose).unwrap().fronts[1];
    let left = DVec3::Y.cross(front).normalize();
    for (near, over, under) in
        [(left, BodySide::Left, BodySide::Right), (-left, BodySide::Right, BodySide::Left)]
    {
        let shapes = seen(&figure, &pose, near);
        let trunk = order(&shapes, BodySide::Trunk);
        let (over, under) = (order(&shapes, over), order(&shapes, under));
        assert!(over.0 > trunk.1, "{over:?} {trunk:?}");
        assert!(under.1 < over.0 && under.0 < trunk.1, "{under:?} {trunk:?}");
    }
}

#[test]
fn a_mirrored_pose_has_the_mirrored_picture() {
    let clip = kick();
    let figure = Figure::new(&clip, FigureBody::Mannequin);
    let Form::Mannequin(mannequin) = &figure.form else { panic!("sticks") };
    let mirror = |point: DVec3| DVec3::new(-point.x, point.y, point.z);
    for place in [0.0, 33.0, 47.0] {
        let pose = pose(&clip, &figure, place);
        let mirrored: Vec<DVec3> = pose.iter().copied().map(mirror).collect();
        let other = mannequin.mirrored();
        let (plain, turned) = (mannequin.solid(&pose), other.solid(&mirrored));
        for (a, b) in plain.balls.iter().zip(&turned.balls) {
            assert!(mirror(a.middle).abs_diff_eq(b.middle, 1e-9) && a.radius == b.radius);
        }
        for (a, b) in plain.fronts.iter().zip(&turned.fronts) {
            assert!(mirror(*a).abs_diff_eq(*b, 1e-9));
        }
    }
}

#[test]
fn each_part_is_filled_by_its_balls_and_all_poses_have_the_same_parts() {
    let clip = kick();
    let figure = Figure::new(&clip, FigureBody::Mannequin);
    let first = figure.solid(&pose(&clip, &figure, 0.0)).unwrap();
    let sides = |solid: &Solid| solid.parts.iter().map(|part| part.side).collect::<Vec<_>>();
    for place in 0..clip.len() {
        let solid = figure.solid(&pose(&clip, &figure, place as f64)).unwrap();
        assert_eq!((sides(&solid), solid.lines.len()), (sides(&first), first.lines.len()));
        let balls: usize = (0..solid.parts.len()).map(|part| solid.balls(part).len()).sum();
        assert_eq!(balls, solid.balls.len());
        assert!(solid.balls.iter().all(|ball| ball.middle.is_finite() && ball.radius > 0.0));
        for (ball, same) in solid.balls.iter().zip(&first.balls) {
            assert!((ball.radius - same.radius).abs() < 1e-9, "a body keeps its size");
        }
    }
}

#[test]
fn sticks_are_drawn_where_they_are_asked_for_and_have_no_marks() {
    let clip = kick();
    let figure = Figure::new(&clip, FigureBody::Sticks);
    assert!(figure.marks().is_empty() && figure.solid(&[]).is_none());
    let shapes = seen(&figure, &pose(&clip, &figure, 0.0), DVec3::Z);
    assert!(shapes.iter().all(|shape| !matches!(shape, Shape::Part { .. })));
    assert_eq!(shapes.iter().filter(|shape| matches!(shape, Shape::Ring(..))).count(), 1);
}

#[test]
fn a_body_of_other_shape_is_drawn_as_sticks() {
    let rows = ["0 0 0 0 0 0 0 0 0", "0 0 0 9 0 0 0 9 0"];
    let armless = read(sample::text("0.0416667", &rows).as_bytes()).unwrap().clip;
    let figure = Figure::new(&armless, FigureBody::Mannequin);
    assert!(matches!(figure.form, Form::Sticks(_)));
}

/// Hangs the body of a clip on an additional joint on the floor, which `turned` turns at each frame.
fn on_a_root(clip: &Clip, turned: impl Fn(usize) -> f64) -> Clip {
    use genga::motion::{Axis, Channel, Joint, JointId};
    let mut skeleton = clip.skeleton().clone();
    for joint in &mut skeleton.joints {
        joint.parent = Some(joint.parent.map_or(JointId(0), |parent| JointId(parent.0 + 1)));
        joint.first_channel += 1;
    }
    let root = Joint {
        name: "joint_Root".into(),
        parent: None,
        offset: DVec3::ZERO,
        channels: vec![Channel::Rotation(Axis::Y)],
        first_channel: 0,
        end_sites: vec![],
    };
    skeleton.joints.insert(0, root);
    let rows = clip.rows().enumerate();
    let rows = rows.flat_map(|(at, row)| std::iter::once(turned(at)).chain(row.iter().copied()));
    Clip::new(skeleton, clip.rate(), clip.first(), clip.len(), rows.collect()).unwrap()
}

#[test]
fn a_root_on_the_floor_is_a_thin_guide_in_sticks_too_and_none_where_it_never_moves() {
    let rooted = on_a_root(&kick(), |frame| 0.1 * frame as f64);
    let still = on_a_root(&kick(), |_| 0.0);
    for body in [FigureBody::Mannequin, FigureBody::Sticks] {
        let figure = Figure::new(&rooted, body);
        assert_eq!(figure.guides(), [(0, 1)], "{body}");
        let shapes = seen(&figure, &pose(&rooted, &figure, 0.0), DVec3::Z);
        let Shape::Line(guide) = &shapes[0] else { panic!("the guide lies behind all") };
        assert!(guide.ink == Ink::Guide && guide.width <= 1.0, "{guide:?}");
        assert_eq!(Figure::new(&still, body).guides(), [], "{body}");
    }
}

#[test]
fn a_far_helper_is_in_no_picture() {
    use crate::stage::Bounds;
    use genga::motion::{Joint, JointId};
    let clip = kick();
    let mut skeleton = clip.skeleton().clone();
    skeleton.joints.push(Joint {
        name: "KneePole".into(),
        parent: Some(JointId(0)),
        offset: DVec3::new(0.0, 0.0, 300.0),
        channels: vec![],
        first_channel: skeleton.channels(),
        end_sites: vec![],
    });
    let rows = clip.rows().flatten().copied().collect();
    let poled = Clip::new(skeleton, clip.rate(), clip.first(), clip.len(), rows).unwrap();
    for body in [FigureBody::Mannequin, FigureBody::Sticks] {
        let seen = |clip: &Clip| {
            let figure = Figure::new(clip, body);
            let poses = [pose(clip, &figure, 0.0), pose(clip, &figure, 40.0)];
            let view = genga::motion::Camera::Auto.view(clip, &poses);
            (figure.guides().len(), figure.height, view, Bounds::new(&figure, &view, &poses))
        };
        assert_eq!(seen(&poled), seen(&clip), "{body}");
    }
}
