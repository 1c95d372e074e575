//! Recognizes a T-pose (Tポーズ): a body with its arms spread level.

use glam::DVec3;

use crate::maths;
use crate::motion::Clip;
use crate::motion::body::Build;
use crate::motion::clip::{Body, Pose};
use crate::time::Frame;

/// Largest angle between an arm and the line through both shoulders, in degrees: people asked for a T-pose let their
/// arms hang a little.
const LEVEL: f64 = 25.0;

/// Indices of left and right shoulder and wrist among a mannequin's points.
const ARMS: [[usize; 2]; 2] = [[2, 4], [10, 12]];

/// Whether both arms point straight away from each other and across the spine at a frame. The body may lie, lean or
/// face anywhere. False for a body without head, two arms and two legs.
pub(crate) fn is_t_pose(clip: &Clip, frame: Frame) -> bool {
    let Some(mannequin) = Build::new(clip).mannequin else { return false };
    let mut pose = Pose::rest(clip.skeleton());
    pose.take_frame(clip, frame);
    let mut body = Body::new(clip.skeleton());
    body.place(&pose);
    let points = mannequin.stand(|point| point.position(&body)).points;
    let spine = points[0].normalize_or_zero();
    let arms = ARMS.map(|[shoulder, wrist]| (points[wrist] - points[shoulder]).normalize_or_zero());
    let (level, spread) = maths::sin_cos(LEVEL.to_radians());
    let is_level = |arm: &DVec3| *arm != DVec3::ZERO && arm.dot(spine).abs() <= level;
    arms.iter().all(is_level) && -arms[0].dot(arms[1]) >= spread
}
