//! A camera through a take, frame by frame.

use glam::{DQuat, DVec3};
use serde::{Deserialize, Serialize};

/// The way of a camera through a take (カメラの動き): its pose on each frame of the file, in the clip's unit and axes.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct CameraPath {
    /// Its name in the file.
    pub name: String,
    /// The pose on each frame, counted from frame 0 of the file.
    pub poses: Vec<CameraPose>,
}

/// Where a camera stands, where it looks, and how much it sees.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct CameraPose {
    /// Its place.
    pub place: DVec3,
    /// Its rotation, of length 1: at rest it looks along −Z, and +Y is up.
    pub turn: DQuat,
    /// Its lens.
    pub lens: Lens,
}

/// The lens of a camera.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub enum Lens {
    /// With perspective: the height of the picture at distance 1, which is 2·tan(angle of view / 2).
    Perspective(f64),
    /// Without perspective: the height of the picture, in the clip's unit.
    Orthographic(f64),
}

impl CameraPath {
    /// Whether the camera moves at all.
    pub fn moves(&self) -> bool {
        self.poses.windows(2).any(|pair| pair[0] != pair[1])
    }

    /// Returns the pose at a place of the source, a frame number with a fraction; the nearest one outside the file, `None`
    /// without any.
    pub fn at(&self, place: f64) -> Option<CameraPose> {
        let last = self.poses.len().checked_sub(1)?;
        let place = place.clamp(0.0, last as f64);
        let before = place.floor() as usize;
        let (from, to) = (self.poses[before], self.poses[(before + 1).min(last)]);
        Some(from.towards(&to, place - before as f64))
    }
}

impl CameraPose {
    /// Returns the pose after a share of the way to the next frame.
    fn towards(&self, next: &Self, share: f64) -> Self {
        let mix = |from: f64, to: f64| from + share * (to - from);
        let lens = match (self.lens, next.lens) {
            (Lens::Perspective(from), Lens::Perspective(to)) => Lens::Perspective(mix(from, to)),
            (Lens::Orthographic(from), Lens::Orthographic(to)) => Lens::Orthographic(mix(from, to)),
            (own, _) => own,
        };
        // From frame to frame a camera turns so little that the chord is as good as the arc.
        let near = if self.turn.dot(next.turn) < 0.0 { -next.turn } else { next.turn };
        let turn = (self.turn * (1.0 - share) + near * share).normalize();
        Self { place: self.place.lerp(next.place, share), turn, lens }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn pose(x: f64, degrees: f64, lens: Lens) -> CameraPose {
        let turn = DQuat::from_rotation_y(degrees.to_radians());
        CameraPose { place: DVec3::new(x, 0.0, 0.0), turn, lens }
    }

    #[test]
    fn a_camera_is_between_its_poses_between_frames_and_stays_outside() {
        let poses =
            vec![pose(0.0, 0.0, Lens::Perspective(1.0)), pose(2.0, 10.0, Lens::Perspective(3.0))];
        let path = CameraPath { name: "cut".into(), poses };
        let half = path.at(0.5).unwrap();
        assert_eq!((half.place.x, half.lens), (1.0, Lens::Perspective(2.0)));
        assert!(half.turn.angle_between(DQuat::from_rotation_y(5_f64.to_radians())) < 1e-6);
        assert_eq!(path.at(-3.0), Some(path.poses[0]));
        assert_eq!(path.at(9.0).unwrap().place, path.poses[1].place);
        assert_eq!(CameraPath::default().at(0.0), None);
        assert!(path.moves() && !CameraPath::default().moves());
    }

    #[test]
    fn a_rotation_goes_the_short_way_and_another_lens_comes_with_its_frame() {
        let [from, to] = [Lens::Perspective(1.0), Lens::Orthographic(4.0)];
        let (from, mut to) = (pose(0.0, 0.0, from), pose(0.0, 8.0, to));
        to.turn = -to.turn;
        let path = CameraPath { poses: vec![from, to], ..CameraPath::default() };
        let half = path.at(0.5).unwrap();
        assert!(half.turn.angle_between(DQuat::from_rotation_y(4_f64.to_radians())) < 1e-6);
        assert_eq!((half.lens, path.at(1.0).unwrap().lens), (from.lens, to.lens));
    }
}
