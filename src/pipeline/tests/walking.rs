//! A body that walks on the spot, and its sheet.

use std::fmt::Write;

use super::*;
use crate::keys::Layers;
use crate::sheet::Reason;

/// Frames per step: 13 koma at 48 frames per second.
const STEP: f64 = 26.0;

/// Swing of a thigh and bend of the shin under it, in degrees.
const SWING: (f64, f64) = (24.0, 55.0);

const BODY: &str = "\
HIERARCHY
ROOT Hips
{
OFFSET 0 0 0
CHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation
";

/// Writes a limb of three rotating joints: names, offset of the first, and bone.
fn limb(text: &mut String, names: [&str; 3], at: [f64; 3], bone: [f64; 3]) {
    let mut offset = at;
    for name in names {
        let [x, y, z] = offset;
        writeln!(text, "JOINT {name}\n{{\nOFFSET {x} {y} {z}").unwrap();
        writeln!(text, "CHANNELS 3 Zrotation Xrotation Yrotation").unwrap();
        offset = bone;
    }
    writeln!(text, "End Site\n{{\nOFFSET 0 -5 12\n}}\n}}\n}}\n}}").unwrap();
}

/// Returns the angles of thigh and shin at a phase of the cycle, which begins when the foot lands.
fn leg(cycle: f64) -> [f64; 2] {
    let part = cycle.rem_euclid(1.0);
    let bent = (2.0 * std::f64::consts::PI * (part - 0.5)).sin().max(0.0);
    [-SWING.0 * (std::f64::consts::TAU * part).cos(), if part > 0.5 { SWING.1 * bent } else { 0.0 }]
}

/// Frames of a cycle, two steps: 26 koma.
pub(crate) const ROUND: usize = 2 * STEP as usize;

/// Builds a clip of six steps.
pub(crate) fn clip() -> Clip {
    walk(0.3, (6.0 * STEP) as usize, 0.0)
}

/// Builds a walk that begins at a phase of the cycle, and travels so far in a frame.
pub(crate) fn walk(phase: f64, frames: usize, travel: f64) -> Clip {
    let mut text = String::from(BODY);
    limb(&mut text, ["LeftUpLeg", "LeftLeg", "LeftFoot"], [9.0, 0.0, 0.0], [0.0, -42.0, 0.0]);
    limb(&mut text, ["RightUpLeg", "RightLeg", "RightFoot"], [-9.0, 0.0, 0.0], [0.0, -42.0, 0.0]);
    writeln!(text, "JOINT Spine\n{{\nOFFSET 0 10 0\nCHANNELS 3 Zrotation Xrotation Yrotation")
        .unwrap();
    limb(&mut text, ["LeftArm", "LeftForeArm", "LeftHand"], [16.0, 40.0, 0.0], [0.0, -26.0, 0.0]);
    limb(
        &mut text,
        ["RightArm", "RightForeArm", "RightHand"],
        [-16.0, 40.0, 0.0],
        [0.0, -26.0, 0.0],
    );
    writeln!(text, "JOINT Head\n{{\nOFFSET 0 48 0\nCHANNELS 3 Zrotation Xrotation Yrotation")
        .unwrap();
    writeln!(text, "End Site\n{{\nOFFSET 0 20 0\n}}\n}}\n}}\n}}").unwrap();
    writeln!(text, "MOTION\nFrames: {frames}\nFrame Time: {}", 1.0 / 48.0).unwrap();
    for frame in 0..frames {
        let cycle = frame as f64 / (2.0 * STEP) + phase;
        let [left, right] = [leg(cycle), leg(cycle + 0.5)];
        let stands = if cycle.rem_euclid(1.0) < 0.5 { left[0] } else { right[0] };
        let height = 84.0 * stands.to_radians().cos() + 5.0;
        let of_leg = |[thigh, shin]: [f64; 2]| format!("0 {thigh} 0 0 {shin} 0 0 0 0");
        let of_arm = |thigh: f64| format!("0 {thigh} 0 0 0 0 0 0 0");
        let (legs, spine) = (format!("{} {}", of_leg(left), of_leg(right)), "0 0 0");
        let arms = format!("{} {}", of_arm(right[0]), of_arm(left[0]));
        let z = frame as f64 * travel;
        writeln!(text, "0 {height} {z} 0 0 0 {legs} {spine} {arms} 0 0 0").unwrap();
    }
    crate::motion::bvh::read(text.as_bytes()).unwrap().clip
}

/// Returns how many koma each genga of a step stays, up to the next.
fn steps(engine: &mut Engine, settings: &[(&str, &str)]) -> Vec<usize> {
    let mut recipe = Recipe::default();
    settings.iter().for_each(|(name, value)| recipe.set(name, value).unwrap());
    let breakdown = engine.run(&recipe, &Edits::default()).unwrap();
    let layer = breakdown.first_layer().layer;
    let is_step = |drawing: usize| layer.drawings[drawing].why.reason == Some(Reason::Step);
    let begins = layer.timed().filter(|(_, exposure)| is_step(exposure.drawing));
    let begins: Vec<usize> = begins.map(|(begin, _)| begin).collect();
    begins.windows(2).map(|pair| pair[1] - pair[0]).collect()
}

#[test]
fn who_walks_evenly_is_drawn_evenly() {
    let mut engine = Engine::new(clip()).unwrap();
    for on in ["1-3", "1", "2", "3"] {
        let koma = steps(&mut engine, &[("spacing.on", on)]);
        assert!(koma.len() >= 19, "{on}: {koma:?}");
        assert_eq!(koma[..koma.len() - 4], koma[4..], "{on}");
        assert_eq!(koma[..4].iter().sum::<usize>(), 13, "{on}: {koma:?}");
    }
}

#[test]
fn nothing_is_left_out_or_held_in_a_gait() {
    let mut engine = Engine::new(clip()).unwrap();
    let greedy = [("omission.naka_nashi", "5"), ("omission.koma_dori", "100%")];
    let greedy = [&greedy[..], &[("omission.fast", "0"), ("omission.small", "100")]].concat();
    let none = [("omission.naka_nashi", "0"), ("omission.koma_dori", "0")];
    assert_eq!(steps(&mut engine, &greedy), steps(&mut engine, &none));
}

#[test]
fn an_inbetween_of_a_step_is_pulled_by_the_weight_that_it_has() {
    let mut engine = Engine::new(clip()).unwrap();
    let recipe = super::recipe(&[("spacing.on", "1")]);
    let breakdown = engine.run(&recipe, &Edits::default()).unwrap();
    let (first, clock) = (breakdown.first_layer(), breakdown.clock);
    let inside = |koma: usize| first.gaits.iter().any(|gait| gait.contains(&koma));
    let mut pulled = 0;
    for (begin, exposure) in first.spaced.timed().filter(|(begin, _)| inside(*begin)) {
        let drawing = &first.spaced.drawings[exposure.drawing];
        let place = drawing.source.place();
        let pull = recipe.spacing.pulled(first.keys, first.spaced, clock, begin, place);
        if let Some(pull) = pull.filter(|_| drawing.role == Role::Inbetween) {
            assert!((pull.weight - recipe.spacing.weight).abs() < 1e-6, "{begin}: {pull:?}");
            pulled += 1;
        }
    }
    assert!(pulled > 0);
}

#[test]
fn a_layer_with_one_leg_has_no_gait() {
    let mut engine = Engine::new(clip()).unwrap();
    let recipe = Recipe { layers: Layers::Limbs, ..Recipe::default() };
    let breakdown = engine.run(&recipe, &Edits::default()).unwrap();
    assert!(breakdown.layers().all(|layer| layer.keys.gaits.is_empty()));
}
