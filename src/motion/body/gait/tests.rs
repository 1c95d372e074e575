use std::array;
use std::f64::consts::{PI, TAU};

use glam::{DQuat, DVec3};

use super::chains::gaits;
use super::legs::{Legs, Paths, RATE};
use super::*;

/// Half a second per step.
const STEP: f64 = 0.5 * RATE;

/// Share of its cycle in which a foot stands.
const STANDS: f64 = 0.6;

/// Half a koma, in instants.
const NEAR: f64 = 2.0;

/// A simulated walk.
#[derive(Debug, Clone, Copy)]
struct Walker {
    /// Half of a stride, and the lift of a foot, in %H.
    reach: f64,
    lift: f64,
    /// How far a raised knee takes the foot ahead, in %H.
    ahead: f64,
    /// Distance travelled and climbed in a cycle, in %H.
    travels: f64,
    climbs: f64,
    /// Number of cycles completed by an instant.
    cycle: fn(f64) -> f64,
}

const WALKER: Walker = Walker {
    reach: 20.0,
    lift: 12.0,
    ahead: 0.0,
    travels: 0.0,
    climbs: 0.0,
    cycle: |at| at / (2.0 * STEP) + 0.9,
};

impl Walker {
    /// Position of an ankle along the way and upwards at a phase of its cycle, which begins at the contact.
    fn ankle(&self, cycle: f64) -> (f64, f64) {
        let part = cycle.rem_euclid(1.0);
        if part < STANDS {
            return (self.reach * (1.0 - 2.0 * part / STANDS), 5.0);
        }
        let swing = (part - STANDS) / (1.0 - STANDS);
        let raised = (PI * swing).sin();
        (-self.reach * (PI * swing).cos() + self.ahead * raised, 5.0 + self.lift * raised)
    }

    /// Height climbed by a foot: it stands until it swings up to the next step.
    fn climbed(&self, cycle: f64) -> f64 {
        let swing = ((cycle.rem_euclid(1.0) - STANDS) / (1.0 - STANDS)).max(0.0);
        self.climbs * (cycle.floor() + swing * swing * (3.0 - 2.0 * swing))
    }

    fn paths(&self, instants: usize) -> Paths {
        let mut paths = Paths::default();
        for at in 0..instants {
            let cycle = (self.cycle)(at as f64);
            // The pelvis is lowest a twelfth of a cycle after a contact, and highest a quarter later.
            let pelvis = DVec3::new(
                self.travels * cycle,
                53.0 - 1.5 * (TAU * (2.0 * cycle - 1.0 / 6.0)).cos() + self.climbs * cycle,
                0.0,
            );
            for (foot, (side, later)) in [(-5.0, 0.0), (5.0, 0.5)].into_iter().enumerate() {
                let (along, up) = self.ankle(cycle + later);
                let up = up + self.climbed(cycle + later) - self.climbs * later;
                let ankle = DVec3::new(self.travels * cycle + along, up, side);
                paths.hips[foot].push(pelvis + side * DVec3::Z);
                paths.ankles[foot].push(ankle);
                paths.soles[foot].push(ankle + DVec3::new(8.0, -4.0, 0.0));
            }
        }
        paths
    }

    fn gaits(&self, instants: usize) -> Vec<Gait> {
        found(&self.paths(instants))
    }
}

fn found(paths: &Paths) -> Vec<Gait> {
    gaits(&Legs::new(paths, DVec3::Y))
}

fn changed(paths: &Paths, change: impl Fn(&Vec<DVec3>) -> Vec<DVec3>) -> Paths {
    let [hips, ankles, soles] =
        [&paths.hips, &paths.ankles, &paths.soles].map(|pair| pair.each_ref().map(&change));
    Paths { hips, ankles, soles }
}

fn instants(step: &Step) -> [f64; 5] {
    [step.contact, step.down, step.passing, step.up, step.next]
}

fn are_near(a: &[Gait], b: &[Gait], most: f64) -> bool {
    let steps = |gaits: &[Gait]| gaits.iter().flat_map(|gait| gait.steps.clone()).collect();
    let (a, b): (Vec<Step>, Vec<Step>) = (steps(a), steps(b));
    let is_near = |(a, b): (&Step, &Step)| {
        let off = array::from_fn::<f64, 5, _>(|at| (instants(a)[at] - instants(b)[at]).abs());
        a.foot == b.foot && off.iter().all(|off| *off <= most)
    };
    a.len() == b.len() && a.iter().zip(&b).all(is_near)
}

/// Expected steps of the walker: its left foot comes down a tenth of a cycle after the first instant.
fn expected(steps: usize) -> Vec<Gait> {
    let step = |at: usize| {
        let phase = |share: f64| (0.2 + at as f64 + share) * STEP;
        let [contact, down, passing, up, next] =
            [0.0, 1.0 / 6.0, STANDS, 2.0 / 3.0, 1.0].map(phase);
        Step { foot: at % 2, contact, down, passing, up, next }
    };
    vec![Gait { steps: (0..steps).map(step).collect() }]
}

#[test]
fn every_step_has_its_phases_even_the_one_that_the_clip_cuts() {
    // The clip ends just after the fifth passing.
    let clip = (4.9 * STEP) as usize;
    for travels in [0.0, 80.0] {
        let gaits = Walker { travels, ..WALKER }.gaits(clip);
        assert!(are_near(&gaits, &expected(5), NEAR), "{gaits:?}");
    }
}

#[test]
fn on_the_spot_a_foot_passes_where_it_is_highest() {
    let gaits = Walker { reach: 0.0, lift: 20.0, ..WALKER }.gaits((4.9 * STEP) as usize);
    assert!(are_near(&gaits, &expected(5), NEAR), "{gaits:?}");
}

#[test]
fn on_the_spot_a_raised_knee_takes_the_foot_ahead() {
    let walker = Walker { reach: 0.0, lift: 22.0, ahead: 20.0, ..WALKER };
    let gaits = walker.gaits((4.9 * STEP) as usize);
    assert!(are_near(&gaits, &expected(5), NEAR), "{gaits:?}");
    let low = Walker { lift: 7.0, ahead: 3.0, ..walker }.gaits((4.9 * STEP) as usize);
    assert!(are_near(&low, &expected(5), NEAR), "{low:?}");
}

/// Goes over from one movement to another within a step.
fn mixed(from: &Paths, to: &Paths, begin: f64) -> Paths {
    let mix = |from: &Vec<DVec3>, to: &Vec<DVec3>| {
        let share = |at: usize| ((at as f64 - begin) / STEP + 0.5).clamp(0.0, 1.0);
        (0..from.len()).map(|at| from[at].lerp(to[at], share(at))).collect()
    };
    let pair = |from: &[Vec<DVec3>; 2], to: &[Vec<DVec3>; 2]| {
        array::from_fn(|foot| mix(&from[foot], &to[foot]))
    };
    Paths {
        hips: pair(&from.hips, &to.hips),
        ankles: pair(&from.ankles, &to.ankles),
        soles: pair(&from.soles, &to.soles),
    }
}

#[test]
fn a_march_on_the_spot_goes_on_from_a_walk() {
    let (walk, spot) = (WALKER, Walker { reach: 0.0, lift: 22.0, ahead: 10.0, ..WALKER });
    let [walk, spot] = [walk, spot].map(|walker| walker.paths((14.4 * STEP) as usize));
    for at in 0..20 {
        let begin = (6.5 + 0.05 * f64::from(at)) * STEP;
        for [from, to] in [[&walk, &spot], [&spot, &walk]] {
            let gaits = found(&mixed(from, to, begin));
            assert_eq!(gaits.len(), 2, "{at}: {gaits:?}");
            let [first, second] = [&gaits[0].steps, &gaits[1].steps];
            assert!(first.len() + second.len() >= 13, "{at}: {gaits:?}");
            let (last, next) = (first[first.len() - 1], second[0]);
            assert!(last.next <= next.contact, "{at}: {gaits:?}");
            if next.contact - last.next < 0.5 * STEP {
                assert_eq!((last.next, 1 - last.foot), (next.contact, next.foot), "{at}");
            }
        }
    }
}

#[test]
fn on_stairs_down_and_up_are_about_the_climb() {
    for climbs in [30.0, -30.0] {
        let gaits = Walker { travels: 40.0, climbs, ..WALKER }.gaits((4.9 * STEP) as usize);
        let off = |(own, expected): (&Step, &Step)| {
            f64::max((own.down - expected.down).abs(), (own.up - expected.up).abs())
        };
        assert_eq!(gaits.len(), 1, "{climbs}");
        let flat = expected(5);
        let steps = gaits[0].steps.iter().zip(&flat[0].steps);
        assert!(steps.clone().count() == 5 && steps.map(off).all(|off| off <= NEAR), "{gaits:?}");
    }
}

#[test]
fn the_first_step_out_of_a_stand_counts() {
    // Stands with the feet side by side; then the left foot goes ahead.
    let (stand, half) = (96, 24);
    let mut paths = Walker { cycle: |at| at / (2.0 * STEP), ..WALKER }.paths(300);
    let begin = |path: &Vec<DVec3>, foot: usize| {
        let place = |at: usize| {
            let share = (at as f64 - f64::from(stand)).max(0.0) / f64::from(half);
            let lift = if foot == 0 { 12.0 * (PI * share).sin() } else { 0.0 };
            let rest = DVec3::new(path[0].x * share, path[0].y + lift, path[0].z);
            // A tremble, at which the feet are nearest.
            if at == 40 {
                rest + DVec3::Z * 0.01 * if foot == 0 { 1.0 } else { -1.0 }
            } else {
                rest
            }
        };
        let all = (0..(stand + half) as usize).map(place);
        all.chain(path.iter().copied()).collect::<Vec<_>>()
    };
    for foot in 0..2 {
        let sole = paths.soles[foot][0] - paths.ankles[foot][0];
        paths.ankles[foot] = begin(&paths.ankles[foot], foot);
        paths.soles[foot] = paths.ankles[foot].iter().map(|ankle| *ankle + sole).collect();
        let hip = paths.hips[foot][0];
        let stood = vec![hip; (stand + half) as usize];
        paths.hips[foot] = stood.into_iter().chain(paths.hips[foot].iter().copied()).collect();
    }
    let gaits = found(&paths);
    let first = gaits[0].steps[0];
    assert_eq!(first.foot, 0);
    assert!((first.contact - f64::from(stand + half)).abs() <= NEAR, "{first:?}");
}

#[test]
fn a_step_whose_passing_comes_late_is_not_like_the_others() {
    // As long as the others, but most of its way is done at its end.
    let late = |at: f64| {
        let (step, part) = ((at / STEP).floor(), at / STEP % 1.0);
        0.5 * (step + if step == 5.0 { part.powi(5) } else { part })
    };
    let gaits = Walker { cycle: late, ..WALKER }.gaits((6.3 * STEP) as usize);
    assert_eq!(gaits.len(), 1);
    let last = gaits[0].steps.last().unwrap();
    assert!((last.next - 5.0 * STEP).abs() <= NEAR, "{gaits:?}");
}

#[test]
fn a_walk_is_the_same_wherever_it_goes_and_however_it_is_recorded() {
    let paths = Walker { travels: 80.0, ..WALKER }.paths(400);
    let gaits = found(&paths);
    assert_eq!(gaits[0].steps.len(), 8);
    let turn = DQuat::from_rotation_y(2.0);
    let turned = changed(&paths, |path| path.iter().map(|place| turn * *place + 7.0).collect());
    assert!(are_near(&found(&turned), &gaits, 1e-6));
    let rough = changed(&paths, |path| {
        let tremble = |at: usize| 0.1 * DVec3::Y * f64::from((at * 7 % 5) as u32 as i32 - 2);
        path.iter().enumerate().map(|(at, place)| *place + tremble(at)).collect()
    });
    assert!(are_near(&found(&rough), &gaits, NEAR), "noise");
    let coarse = changed(&paths, |path| {
        let place = |at: usize| {
            let (from, share) = (at / 4 * 4, (at % 4) as f64 / 4.0);
            path[from].lerp(path[(from + 4).min(path.len() - 1)], share)
        };
        (0..path.len()).map(place).collect()
    });
    assert!(are_near(&found(&coarse), &gaits, NEAR), "24 frames a second");
}

#[test]
fn left_and_right_exchanged_give_the_steps_of_the_other_foot() {
    let mut paths = WALKER.paths(400);
    let mut gaits = found(&paths);
    for pair in [&mut paths.hips, &mut paths.ankles, &mut paths.soles] {
        pair.reverse();
    }
    gaits[0].steps.iter_mut().for_each(|step| step.foot = 1 - step.foot);
    assert!(are_near(&found(&paths), &gaits, 1e-9));
}

#[test]
fn a_clip_that_begins_later_has_the_same_steps_so_much_earlier() {
    let paths = WALKER.paths(400);
    let mut gaits = found(&paths);
    let later = changed(&paths, |path| path[130..].to_vec());
    gaits[0].steps.drain(..2);
    for step in &mut gaits[0].steps {
        let Step { foot: _, contact, down, passing, up, next } = step;
        [contact, down, passing, up, next].into_iter().for_each(|at| *at -= 130.0);
    }
    assert!(are_near(&found(&later), &gaits, NEAR), "{:?} {gaits:?}", found(&later));
}

#[test]
fn a_limp_is_a_gait_and_a_change_of_pace_begins_another() {
    // The steps of one foot take 1.4 times as long as those of the other.
    let limp = |at: f64| {
        let (cycle, part) = ((at / (2.4 * STEP)).floor(), at / STEP % 2.4);
        cycle + if part < 1.0 { 0.5 * part } else { 0.5 + 0.5 * (part - 1.0) / 1.4 }
    };
    let gaits = Walker { cycle: limp, ..WALKER }.gaits(700);
    assert_eq!(gaits.len(), 1);
    let lengths = gaits[0].steps[1..].iter().map(|step| (step.next - step.contact) / STEP);
    let lengths: Vec<f64> = lengths.map(|length| (length * 10.0).round() / 10.0).collect();
    assert!(lengths[..4] == [1.4, 1.0, 1.4, 1.0] || lengths[..4] == [1.0, 1.4, 1.0, 1.4]);
    let quicker = |at: f64| at.min(400.0) / (2.0 * STEP) + (at - 400.0).max(0.0) / STEP;
    assert_eq!(Walker { cycle: quicker, ..WALKER }.gaits(700).len(), 2);
}

#[test]
fn standing_ends_a_gait_and_three_steps_are_none() {
    let pauses = |at: f64| (at.min(384.0) + (at - 500.0).max(0.0)) / (2.0 * STEP) + 0.05;
    let gaits = Walker { cycle: pauses, ..WALKER }.gaits(900);
    assert_eq!(gaits.len(), 2, "{gaits:?}");
    let stops = |at: f64| at.clamp(100.0, 260.0) / (2.0 * STEP) + 0.05;
    assert!(Walker { cycle: stops, ..WALKER }.gaits(500).is_empty());
}

#[test]
fn who_stands_jumps_kicks_or_pedals_does_not_walk() {
    assert!(Walker { cycle: |_| 0.1, ..WALKER }.gaits(500).is_empty(), "stands");
    assert!(found(&Paths::default()).is_empty(), "nobody");
    let mut paths = Walker { reach: 0.0, ..WALKER }.paths(500);
    for pair in [&mut paths.ankles, &mut paths.soles] {
        pair[1] = pair[0].clone();
    }
    assert!(found(&paths).is_empty(), "jumps");
    let mut paths = WALKER.paths(500);
    let stands = |path: &Vec<DVec3>| vec![path[0]; path.len()];
    for pair in [&mut paths.ankles, &mut paths.soles] {
        pair[1] = stands(&pair[1]);
    }
    assert!(found(&paths).is_empty(), "kicks with one leg");
    let mut paths = WALKER.paths(500);
    for at in 0..500 {
        for (foot, later) in [(0, 0.0), (1, PI)] {
            let (sin, cos) = (TAU * at as f64 / 70.0 + later).sin_cos();
            paths.ankles[foot][at] =
                DVec3::new(10.0 * sin, 15.0 - 10.0 * cos, paths.ankles[foot][at].z);
            paths.soles[foot][at] = paths.ankles[foot][at] - 4.0 * DVec3::Y;
        }
    }
    assert!(found(&paths).is_empty(), "pedals");
}
