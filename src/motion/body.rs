//! **Body** (体): describes the performer of a clip from bones, names and ground contact.

mod accessories;
mod build;
mod contact;
mod description;
mod gait;
pub mod landmarks;
pub mod leg;
mod limbs;
pub(crate) mod mannequin;
pub(crate) mod mannequin_parts;
mod members;
pub mod names;
mod role;
mod side;
mod stature;
pub mod structure;
mod t_pose;
mod upright;

pub use build::Build;
pub use contact::{Contact, ContactFinder, Limb};
pub use description::{BODY_GUESS, Description, PEOPLE, STILL};
pub use gait::{Gait, Step};
pub use landmarks::{Foot, Landmarks, Point};
pub(crate) use landmarks::{above, below};
pub use mannequin_parts::MannequinParts;
pub use members::Members;
pub use members::is_still;
pub use names::BoneMap;
pub use side::{BodySide, plain_name};
pub use stature::{Stature, Unit};
pub(crate) use t_pose::is_t_pose;
