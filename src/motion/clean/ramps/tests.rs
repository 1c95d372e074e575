use super::*;
use crate::motion::bvh::{read, sample};
use crate::motion::clean::{Cleaning, lead_in};
use crate::time::FrameRate;

/// The true path of the body: it walks past the origin at 1.4 units a second, while a joint swings.
fn walk(seconds: f64) -> [f64; 3] {
    [1.4 * seconds - 1.0, 0.9 + 0.03 * (6.0 * seconds).sin(), 0.3 * seconds]
}

/// A walk of two seconds whose positions are scaled by a share that depends on the frame.
fn clip(fps: f64, share: impl Fn(usize, usize) -> f64) -> Clip {
    let frames = (2.0 * fps) as usize;
    let row = |frame: usize| {
        let seconds = frame as f64 / fps;
        let [x, y, z] = walk(seconds).map(|at| at * share(frame, frames));
        format!("{x} {y} {z} 0 {} 0 0 {} 0", 20.0 * (6.0 * seconds).sin(), 30.0 * seconds.cos())
    };
    let rows: Vec<String> = (0..frames).map(row).collect();
    let rows: Vec<&str> = rows.iter().map(String::as_str).collect();
    let clip = read(sample::text(&(1.0 / fps).to_string(), &rows).as_bytes()).unwrap().clip;
    clip.with_rate(FrameRate::new(fps).unwrap())
}

/// Number of frames in each ramp of a clip.
fn found(clip: &Clip) -> (usize, usize) {
    let count = |ramp: Option<(Frame, Frame)>| ramp.map_or(0, |(from, to)| to.0 - from.0 + 1);
    let ramps = Ramps::find(clip);
    assert!(ramps.front.is_none_or(|(from, _)| from == clip.first()));
    assert!(ramps.back.is_none_or(|(_, to)| to == clip.last()));
    (count(ramps.front), count(ramps.back))
}

fn strip(clip: Clip) -> (Clip, Option<Warning>) {
    Ramps::find(&clip).leave_out(clip)
}

#[test]
fn three_frames_of_ramp_at_either_end_are_found_at_every_rate() {
    for fps in [24.0, 30.0, 60.0, 100.0, 120.0, 240.0] {
        for held in [1, 2, 6] {
            // Held at the origin, then a third and two thirds of the way.
            let share = |frame: usize| ((frame + 1) as f64 - held as f64).clamp(0.0, 3.0) / 3.0;
            let front = clip(fps, |frame, _| share(frame));
            assert_eq!(found(&front), (held + 2, 0), "{held} at {fps}");
            let back = clip(fps, |frame, frames| share(frames - 1 - frame));
            assert_eq!(found(&back), (0, held + 2), "{held} at {fps}");
            let both = clip(fps, |frame, frames| share(frame).min(share(frames - 1 - frame)));
            let (motion, warning) = strip(both.clone());
            assert_eq!(motion.first(), Frame(held + 2));
            assert_eq!(motion.len(), both.len() - 2 * (held + 2));
            let said = warning.unwrap().message;
            let (to, last) = (held + 1, both.len() - 1);
            let expected = format!("frames 0 to {to} and frames {} to {last}: ", last - to);
            assert!(said.starts_with(&expected), "{said}");
        }
    }
}

#[test]
fn a_body_that_starts_or_ends_elsewhere_or_walks_away_from_the_origin_has_no_ramp() {
    for fps in [24.0, 30.0, 60.0, 120.0] {
        assert_eq!(Ramps::find(&clip(fps, |_, _| 1.0)), Ramps::default(), "{fps}");
        // Three times as fast as before within a frame, but not from the origin.
        let elsewhere = clip(fps, |frame, _| if frame == 0 { 0.5 } else { 1.0 });
        assert_eq!(Ramps::find(&elsewhere), Ramps::default(), "{fps}");
        // From the origin, as fast as it goes on.
        let from = clip(fps, |frame, _| frame as f64 / (2.0 * fps));
        assert_eq!(Ramps::find(&from), Ramps::default(), "{fps}");
    }
}

#[test]
fn drawings_that_are_held_and_short_clips_have_no_ramp() {
    let held = |holds: usize| {
        let rows: Vec<String> =
            (0..48).map(|frame| format!("{} 1 0 0 0 0 0 0 0", frame / holds)).collect();
        let rows: Vec<&str> = rows.iter().map(String::as_str).collect();
        read(sample::text("0.0416667", &rows).as_bytes()).unwrap().clip
    };
    for holds in [2, 3, 12] {
        assert_eq!(Ramps::find(&held(holds)), Ramps::default(), "{holds}");
    }
    let short = clip(24.0, |frame, _| if frame == 0 { 0.0 } else { 1.0 });
    for len in 1..6 {
        let short = short.clone().trimmed(Frame(0), Frame(len)).unwrap();
        assert_eq!(strip(short.clone()), (short, None), "{len}");
    }
}

/// Tests whole clips and every second, fourth and fifth frame of them.
#[test]
fn real_clips_have_no_ramps_and_no_lead_outs_and_those_put_on_them_are_found() {
    for (name, bytes) in sample::real_clips() {
        let clip = lead_in::strip(read(&bytes).unwrap().clip).0;
        for stride in [1, 2, 4, 5] {
            let rows: Vec<&[f64]> = clip.rows().step_by(stride).collect();
            let rate = FrameRate::new(clip.rate().fps() / stride as f64).unwrap();
            let of = |rows: &[f64], len: usize| {
                Clip::new(clip.skeleton().clone(), rate, Frame(0), len, rows.to_vec()).unwrap()
            };
            let sound = of(&rows.concat(), rows.len());
            assert_eq!(Ramps::find(&sound), Ramps::default(), "{name}, every {stride}");
            assert_eq!(lead_in::strip_out(sound.clone()).1, None, "{name}, every {stride}");
            let mut values = rows.concat();
            let width = clip.skeleton().channels();
            for (back, share) in [(1, 0.0), (2, 1.0 / 3.0), (3, 2.0 / 3.0)] {
                let row = (rows.len() - back) * width;
                values[row..row + 3].iter_mut().for_each(|value| *value *= share);
            }
            let spoiled = of(&values, rows.len());
            assert_eq!(found(&spoiled), (0, 3), "{name}, every {stride}");
            let (motion, notes) = Cleaning::default().apply(spoiled).unwrap();
            assert_eq!(motion.len(), rows.len() - 3, "{name}, every {stride}: {notes:?}");
        }
    }
}
