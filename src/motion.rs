//! **Read** (読む): the file as written ⇄ [`Clip`], and the poses of a clip.

pub mod bvh;
mod camera;
mod channels;
mod clip;
mod composite;
mod contact;
mod drawn;
mod gltf_camera;
mod kinematics;
pub mod landmarks;
pub(crate) mod lanes;
mod leg;
pub(crate) mod mannequin;
pub(crate) mod rig;
pub(crate) mod sampler;
mod screen;
mod side;
mod skeleton;
mod stature;
pub(crate) mod view;

pub use camera::Camera;
pub use channels::RowWriter;
pub(crate) use channels::{rotation_axes, turn_columns};
pub use clip::Clip;
pub(crate) use composite::{Composite, CompositeRows, PosedComposite};
pub use contact::{Contact, ContactFinder, Limb};
pub(crate) use drawn::DrawnPose;
pub use gltf_camera::GltfCamera;
pub use kinematics::{Body, Pose, local_rotation, local_translation};
pub(crate) use landmarks::below;
pub use landmarks::{Foot, Landmarks, Point};
pub use screen::{Eye, Screen, SeenFrom};
pub(crate) use side::{BodySide, plain_name};
pub use skeleton::{Axis, Channel, EndSite, Joint, JointId, Skeleton};
pub use stature::{Stature, Unit};
