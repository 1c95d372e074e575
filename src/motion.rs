//! **Read** (読む): the file as written ⇄ [`Clip`], and the poses of a clip.

pub mod bvh;
mod channels;
mod clip;
mod composite;
mod drawn;
mod kinematics;
pub mod landmarks;
pub(crate) mod lanes;
pub(crate) mod mannequin;
pub(crate) mod rig;
pub(crate) mod sampler;
mod side;
mod skeleton;
mod stature;

pub use channels::RowWriter;
pub(crate) use channels::{rotation_axes, turn_columns};
pub use clip::Clip;
pub(crate) use composite::{Composite, CompositeRows, PosedComposite};
pub(crate) use drawn::DrawnPose;
pub use kinematics::{Body, Pose, local_rotation, local_translation};
pub(crate) use landmarks::below;
pub use landmarks::{Foot, Landmarks, Point};
pub(crate) use side::{BodySide, plain_name};
pub use skeleton::{Axis, Channel, EndSite, Joint, JointId, Skeleton};
pub use stature::{Stature, Unit};
