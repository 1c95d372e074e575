//! Measures how fast each joint moves [KT11 §3.1].

mod steps;

use glam::{DQuat, DVec3};
use nalgebra::DMatrix;
use serde::{Deserialize, Serialize};

use crate::error::Error;
use crate::knob::{Knobs, choices, knob, knobs};
use crate::maths;
use crate::motion::clip::rig::Rig;
use crate::motion::lanes::{LANES, Lanes, wide};
use crate::motion::{Body, Clip, Poser, Screen, local_rotation};
use crate::signal::{Quantity, Signals};
use crate::time::Frame;

use steps::{BLOCK, JointSteps, PARTS, block};

/// The property of the motion that is measured.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Measure {
    /// Angular speed (角速度) of the local rotation, rad/s: the paper's measure. Blind to a joint that
    /// is only carried along.
    #[default]
    Rotation,
    /// Speed of the joint in the world or on a screen, the file's unit a second. Blind to a hand that turns
    /// in place.
    Displacement,
    /// Rotation and displacement, each divided by its root mean square over all frames and joints, then added.
    Combined,
    /// Signed change per second of the joint's own rotation angle, rad/s: for studies. It reads 0 while the axis turns
    /// at a constant angle, and its sign jumps where the angle passes half a turn.
    Angle,
}

choices!(Measure {
    Rotation: "rotation",
    Displacement: "displacement",
    Combined: "combined",
    Angle: "angle"
});

/// Speed (速さ) of every joint at every frame [KT11 §3.1].
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Speed {
    /// The measure; `rotation` by default.
    pub measure: Measure,
}

impl Measure {
    /// Whether it measures displacements, which depend on the camera.
    pub fn is_seen(self) -> bool {
        matches!(self, Self::Displacement | Self::Combined)
    }
}

knobs!(speed::Speed {
    measure: knob(
        "速さの測り方",
        "How the speed of a joint is measured: its rotation against its parent (rotation), its \
         displacement in the world or on the screen (displacement), both (combined), or the signed \
         change of its own rotation angle (angle).",
        "部位の速さの測り方。親に対する回転（rotation）、空間または画面での移動（displacement）、\
         その両方（combined）、自身の回転角の符号つき変化（angle）。",
    )
    .for_studies(),
});

impl Speed {
    /// Checks the settings; no setting here can be wrong.
    ///
    /// # Errors
    /// None today.
    pub fn validate(&self) -> Result<(), Error> {
        self.check()
    }

    /// Measures the speeds of a clip in the world: see [`Speed::measure_on`].
    ///
    /// # Errors
    /// The errors of [`Speed::measure_on`].
    ///
    /// ```
    /// use genga::signal::Speed;
    ///
    /// # let clip = genga::motion::bvh::open("data/kick.bvh".as_ref())?.clip;
    /// let speeds = Speed::default().measure(&clip)?;
    /// let knee = clip.skeleton().find("RightLeg").expect("a kick has a knee");
    /// let fastest = speeds.joint(knee).iter().copied().fold(0.0, f64::max);
    /// assert_eq!((fastest * speeds.unit.for_people()).round(), 1157.0, "°/s");
    /// # Ok::<(), genga::Error>(())
    /// ```
    pub fn measure(&self, clip: &Clip) -> Result<Signals, Error> {
        self.measure_on(clip, &Screen::WORLD)
    }

    /// Measures the speeds of a clip, frames × joints; displacements are those on the screen.
    ///
    /// Row k is the step *into* frame k, so the first row repeats the second. A clip of one frame has
    /// speed 0.
    ///
    /// # Errors
    /// [`Error::Clip`] if values of the clip are so large that a speed is not finite.
    pub fn measure_on(&self, clip: &Clip, screen: &Screen) -> Result<Signals, Error> {
        self.validate()?;
        let (mut values, unit) = match self.measure {
            Measure::Rotation => (rotation(clip), Quantity::Angle),
            Measure::Displacement => (displacement(clip, screen), Quantity::Length),
            Measure::Combined => (combined(clip, screen), Quantity::Ratio),
            Measure::Angle => (angle(clip), Quantity::Angle),
        };
        if values.nrows() > 1 {
            let second = values.row(1).into_owned();
            values.set_row(0, &second);
        }
        if !values.as_slice().iter().all(|value| value.is_finite()) {
            return Err(Error::clip("the motion is too fast to be measured: a speed is infinite"));
        }
        Ok(Signals { values, unit, rate: clip.rate(), first: clip.first() })
    }
}

/// Returns a matrix of zeros in the clip's shape.
fn still(clip: &Clip) -> DMatrix<f64> {
    let (frames, joints) = (clip.len(), clip.skeleton().len());
    DMatrix::from_vec(frames, joints, vec![0.0; frames * joints])
}

/// Measures several frames at once, joint by joint, so that quaternions live no longer than their step.
fn rotation(clip: &Clip) -> DMatrix<f64> {
    let mut values = still(clip);
    let (rig, frames) = (Rig::new(clip.skeleton()), clip.len());
    let rows: Vec<&[f64]> = clip.rows().collect();
    let Some(first) = rows.first() else { return values };
    let mut joints = JointSteps::prepare(&rig, first);
    let per_second = Lanes::splat(clip.rate().fps());
    let mut steps = [Lanes::ZERO; PARTS];
    for begin in (0..frames).step_by(BLOCK) {
        let block = block(&rows[begin..]);
        let columns = values.as_mut_slice().chunks_exact_mut(frames);
        wide(
            #[inline(always)]
            || {
                for (joint, column) in joints.iter_mut().zip(columns) {
                    joint.steps(&block, &mut steps);
                    let speeds = &mut column[begin..frames.min(begin + BLOCK)];
                    for (speeds, step) in speeds.chunks_mut(LANES).zip(steps) {
                        speeds.copy_from_slice(&(step * per_second).0[..speeds.len()]);
                    }
                }
            },
        );
    }
    values
}

/// Returns the angle of a rotation in radians, 0 to π, the same for q and −q.
fn angle_of(q: DQuat) -> f64 {
    2.0 * maths::atan2(q.xyz().length(), q.w.abs())
}

fn displacement(clip: &Clip, screen: &Screen) -> DMatrix<f64> {
    let (fps, skeleton) = (clip.rate().fps(), clip.skeleton());
    let mut values = still(clip);
    let (mut poser, mut body) = (Poser::new(clip), Body::new(skeleton));
    let mut before = vec![DVec3::ZERO; skeleton.len()];
    let mut now = before.clone();
    for row in 0..clip.len() {
        body.place(poser.frame(Frame(clip.first().0 + row)));
        let seen = body.positions().iter().map(|place| screen.see(*place));
        now.iter_mut().zip(seen).for_each(|(now, seen)| *now = seen);
        if row > 0 {
            for (joint, (before, now)) in before.iter().zip(&now).enumerate() {
                values[(row, joint)] = before.distance(*now) * fps;
            }
        }
        std::mem::swap(&mut before, &mut now);
    }
    values
}

/// Adds both measures. Each has one root mean square for all joints, so that a joint that hardly moves stays small
/// beside one that does.
fn combined(clip: &Clip, screen: &Screen) -> DMatrix<f64> {
    let mut values = in_own_rms(rotation(clip));
    values += in_own_rms(displacement(clip, screen));
    values
}

/// Divides values by their root mean square over the steps between frames; values that are all 0 stay 0.
fn in_own_rms(values: DMatrix<f64>) -> DMatrix<f64> {
    let steps = values.nrows().saturating_sub(1) * values.ncols();
    let rms = values.norm() / (steps as f64).sqrt();
    if rms > 0.0 { values / rms } else { values }
}

fn angle(clip: &Clip) -> DMatrix<f64> {
    let fps = clip.rate().fps();
    let mut values = still(clip);
    let mut before = vec![0.0; clip.skeleton().len()];
    for (row, channels) in clip.rows().enumerate() {
        for (joint, (data, before)) in clip.skeleton().joints.iter().zip(&mut before).enumerate() {
            let now = angle_of(local_rotation(data, channels));
            if row > 0 {
                values[(row, joint)] = (now - *before) * fps;
            }
            *before = now;
        }
    }
    values
}

#[cfg(test)]
mod tests;
