//! The screen (画面): the space in which movement is measured.
//!
//! Either the world, as in both papers, or a camera's screen. On a screen, a hand that comes straight towards the
//! camera hardly moves, and near things move more than far ones [KKMFT §5].

use std::fmt;
use std::str::FromStr;

use glam::DVec3;

use crate::error::Error;
use crate::knob::{Kind, Setting, as_word, by_word};
use crate::motion::seen::view::View;
use crate::motion::{Body, Camera, Clip, Poser, Stature};
use crate::time::Frame;

/// Number of frames sampled to choose the side of a [`Camera`]: enough to know where the body goes.
const LOOKS: usize = 200;

/// Smallest depth, as a share of the distance from eye to target. Points that are nearer or behind the eye are
/// projected at this depth: otherwise a hair before the lens would fill the screen.
const NEAREST: f64 = 0.05;

/// Viewpoint from which movement is measured (見る位置).
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub enum SeenFrom {
    /// No viewpoint: distances are measured in the world [KKMFT §3.1]. The default.
    #[default]
    World,
    /// One of the orthographic cameras of the pictures.
    Camera(Camera),
    /// A camera position, with perspective.
    Eye(Eye),
}

/// A fixed perspective camera, in the file's unit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Eye {
    /// Position of the camera.
    pub at: DVec3,
    /// Point it looks at, distinct from `at`. At its distance, movements are as large on the screen as in the world.
    pub target: DVec3,
}

impl Eye {
    /// Whether the camera can see: both points are finite and distinct.
    pub fn is_eye(&self) -> bool {
        let way = self.target - self.at;
        way.is_finite() && way.length_squared() > 0.0 && way.length_squared().is_finite()
    }
}

/// Projection of a camera, or none.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Screen(Sight);

#[derive(Debug, Clone, Copy, PartialEq)]
enum Sight {
    World,
    Far(View),
    Near { eye: Eye, view: View, distance: f64 },
}

impl Screen {
    /// The identity: positions stay in the world.
    pub const WORLD: Self = Self(Sight::World);

    /// Computes the screen of a camera that looks at a clip.
    pub fn new(seen_from: SeenFrom, clip: &Clip) -> Self {
        Self(match seen_from {
            SeenFrom::World => Sight::World,
            SeenFrom::Camera(camera) => Sight::Far(camera.view(clip, &looks(clip))),
            SeenFrom::Eye(eye) => {
                let (way, up) = (eye.target - eye.at, Stature::new(clip).up.unit());
                let near = -way.normalize();
                // Straight from above or below any side will do: distances on the screen are equal.
                let right = up.cross(near).try_normalize().unwrap_or(near.any_orthonormal_vector());
                let view = View { right, up: near.cross(right), near };
                Sight::Near { eye, view, distance: way.length() }
            }
        })
    }

    /// Projects a world position: (right, up, 0) on the screen, in the file's unit. Without a screen it returns the
    /// position itself.
    pub fn see(&self, place: DVec3) -> DVec3 {
        match self.0 {
            Sight::World => place,
            Sight::Far(view) => {
                let (right, up, _) = view.see(place);
                DVec3::new(right, up, 0.0)
            }
            Sight::Near { eye, view, distance } => {
                let (right, up, near) = view.see(place - eye.at);
                let scale = distance / (-near).max(NEAREST * distance);
                DVec3::new(scale * right, scale * up, 0.0)
            }
        }
    }

    /// Whether positions stay in the world.
    pub fn is_world(&self) -> bool {
        self.0 == Sight::World
    }
}

/// Returns the joint positions in some evenly spaced frames of a clip.
pub fn looks(clip: &Clip) -> Vec<Vec<DVec3>> {
    let (mut poser, mut body) = (Poser::new(clip), Body::new(clip.skeleton()));
    let step = clip.len().div_ceil(LOOKS).max(1);
    let stand = |row: usize| {
        body.place(poser.frame(Frame(clip.first().0 + row)));
        body.positions().to_vec()
    };
    (0..clip.len()).step_by(step).map(stand).collect()
}

impl SeenFrom {
    /// Whether movement is measured in the world.
    pub fn is_world(self) -> bool {
        self == Self::World
    }
}

/// Creates the error for an invalid viewpoint, naming the valid ones.
fn nowhere(text: &str) -> Error {
    let message = format!(
        "\"{text}\" is nowhere to look from; it is world, {}, or where the camera stands and what it looks at, \
         in the file's unit: X,Y,Z:X,Y,Z",
        Camera::ALL.map(Camera::word).join(", ")
    );
    Error::setting("seen_from", message)
}

impl fmt::Display for SeenFrom {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::World => f.write_str("world"),
            Self::Camera(camera) => camera.fmt(f),
            Self::Eye(Eye { at, target }) => {
                let [x, y, z] = at.to_array();
                write!(f, "{x},{y},{z}:{},{},{}", target.x, target.y, target.z)
            }
        }
    }
}

impl FromStr for SeenFrom {
    type Err = Error;

    fn from_str(text: &str) -> Result<Self, Error> {
        let text = text.trim();
        if text == "world" {
            return Ok(Self::World);
        }
        if let Ok(camera) = text.parse() {
            return Ok(Self::Camera(camera));
        }
        let eye = text.split_once(':').and_then(|(at, target)| {
            let eye = Eye { at: place(at)?, target: place(target)? };
            eye.is_eye().then_some(Self::Eye(eye))
        });
        eye.ok_or_else(|| nowhere(text))
    }
}

fn place(text: &str) -> Option<DVec3> {
    let mut numbers = text.split(',').map(|number| number.trim().parse::<f64>().ok());
    let place = DVec3::new(numbers.next()??, numbers.next()??, numbers.next()??);
    numbers.next().is_none().then_some(place)
}

impl Setting for SeenFrom {
    const KIND: Kind = Kind::SeenFrom;
    as_word!();
}

by_word!(SeenFrom);

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::motion::{Axis, Channel, Joint, Skeleton};
    use crate::time::FrameRate;

    /// A clip of one point that moves along X.
    fn clip() -> Clip {
        let joint = Joint {
            name: "point".into(),
            parent: None,
            offset: DVec3::ZERO,
            channels: vec![Channel::Position(Axis::X)],
            first_channel: 0,
            end_sites: vec![],
        };
        let rows = (0..500).map(f64::from).collect();
        let rate = FrameRate::new(24.0).unwrap();
        Clip::new(Skeleton { joints: vec![joint] }, rate, Frame(3), 500, rows).unwrap()
    }

    fn screen(text: &str) -> Screen {
        Screen::new(text.parse().unwrap(), &clip())
    }

    #[test]
    fn it_reads_back_as_written_and_refuses_what_cannot_see() {
        for text in ["world", "auto", "front", "side", "three-quarter", "0,1.5,-400:0,90,1e20"] {
            let seen_from: SeenFrom = text.parse().unwrap();
            assert_eq!(seen_from.to_string().parse::<SeenFrom>().unwrap(), seen_from);
            let written = serde_json::to_string(&seen_from).unwrap();
            assert_eq!(serde_json::from_str::<SeenFrom>(&written).unwrap(), seen_from);
        }
        for wrong in
            ["", "top", "1,2,3", "1,2:3,4", "1,2,3:1,2,3", "1,2,3:4,5,nan", "1,2,3,4:5,6,7"]
        {
            let message = wrong.parse::<SeenFrom>().unwrap_err().to_string();
            assert!(message.contains("X,Y,Z:X,Y,Z"), "{message}");
        }
    }

    #[test]
    fn without_a_screen_a_place_is_where_it_is() {
        let place = DVec3::new(1.0, -2.0, 3.0);
        assert_eq!(Screen::WORLD.see(place), place);
        assert!(screen("world").is_world() && !screen("front").is_world());
    }

    #[test]
    fn from_the_front_nothing_is_seen_of_a_way_towards_us() {
        let front = screen("front");
        assert_eq!(front.see(7.0 * DVec3::Z), DVec3::ZERO);
        assert_eq!(front.see(DVec3::new(2.0, 3.0, 4.0)), DVec3::new(2.0, 3.0, 0.0));
        assert_eq!(
            screen("auto").see(5.0 * DVec3::X).length(),
            5.0,
            "the side of the way that is gone"
        );
    }

    #[test]
    fn what_is_half_as_far_is_twice_as_large_and_nothing_grows_without_end() {
        let near = screen("0,0,10:0,0,0");
        assert_eq!(near.see(DVec3::new(1.0, 2.0, 0.0)), DVec3::new(1.0, 2.0, 0.0));
        assert_eq!(near.see(DVec3::new(1.0, 2.0, 5.0)), DVec3::new(2.0, 4.0, 0.0));
        assert_eq!(near.see(DVec3::new(1.0, 0.0, -10.0)), DVec3::new(0.5, 0.0, 0.0));
        for behind in [9.9, 10.0, 50.0] {
            assert_eq!(near.see(DVec3::new(1.0, 0.0, behind)), DVec3::new(20.0, 0.0, 0.0));
        }
    }

    #[test]
    fn it_sees_from_straight_above() {
        let above = screen("3,10,5:3,0,5");
        assert!(
            (above.see(DVec3::new(4.0, 0.0, 5.0)) - above.see(DVec3::new(3.0, 0.0, 5.0))).length()
                > 0.99
        );
        assert!(above.see(DVec3::new(3.0, 6.0, 5.0)).length() < 1e-12, "on the way it looks");
    }

    proptest! {
        #[test]
        fn a_far_eye_sees_what_a_side_does(
            place in prop::array::uniform3(-50.0..50.0f64),
            other in prop::array::uniform3(-50.0..50.0f64),
        ) {
            let (eye, front) = (screen("0,0,1e9:0,0,0"), screen("front"));
            let [place, other] = [place, other].map(DVec3::from_array);
            let ways = [eye, front].map(|screen| screen.see(place).distance(screen.see(other)));
            prop_assert!((ways[0] - ways[1]).abs() < 1e-4 * (1.0 + ways[1]));
        }
    }
}
