//! **Body** (体): what is known of whoever moves in a clip, by bones, names and ground.

mod accessories;
mod build;
mod contact;
mod gait;
pub mod landmarks;
pub(crate) mod lay_figure;
pub(crate) mod leg;
mod limbs;
pub(crate) mod mannequin;
mod members;
pub(crate) mod names;
mod role;
mod side;
mod stature;
pub(crate) mod structure;
mod t_pose;
mod upright;
mod words;

pub(crate) use build::Build;
pub use contact::{Contact, ContactFinder, Limb};
pub use gait::{Gait, Step};
pub use landmarks::{Foot, Landmarks, Point};
pub(crate) use landmarks::{above, below};
pub(crate) use lay_figure::LayFigure;
pub(crate) use members::Members;
pub(crate) use members::is_still;
pub use names::BoneMap;
pub(crate) use side::{BodySide, plain_name};
pub use stature::{Stature, Unit};
pub(crate) use t_pose::is_t_pose;
pub use words::{BODY_GUESS, Description, PEOPLE, STILL};
