//! **Read** (読む): the file as written ⇄ [`Clip`], and the poses of a clip.
//!
//! Its rooms, each of which imports only those above it: `lanes` works on several numbers at once, `clip` is joints,
//! channels and poses, `body` whoever moves, `seen` from where, `composite` layers put together again, `read` the files.

mod axis;

pub(crate) mod lanes;

pub(crate) mod clip;

pub(crate) mod body;

pub(crate) mod seen;

mod composite;

mod read;

pub use axis::Axis;
pub use body::landmarks;
pub use body::{
    BODY_GUESS, BoneMap, Contact, ContactFinder, Description, Foot, Gait, Landmarks, Limb, PEOPLE,
    Point, STILL, Stature, Step, Unit,
};
pub(crate) use body::{
    BodySide, Build, LayFigure, Members, above, below, is_still, is_t_pose, plain_name,
};
pub use clip::{
    Body, Channel, Clip, Declared, EndSite, Joint, JointId, Pose, Poser, RowWriter, Skeleton, Word,
    local_rotation, local_translation, set_local_rotation,
};
pub(crate) use clip::{rotation_axes, turn_columns};
#[cfg(feature = "panels")]
pub(crate) use composite::Cels;
#[cfg(feature = "pictures")]
pub(crate) use composite::layer_of;
pub(crate) use composite::{Composite, CompositePoser, CompositeRows};
#[cfg(test)]
pub(crate) use read::model_tests;
pub(crate) use read::{GIB, bytes_in_words};
pub use read::{GltfCamera, MmdModel, StreamLimit, bvh, file};
pub(crate) use read::{is_vmd, vmd_key_frames};
pub use seen::{Camera, Eye, Screen, SeenFrom};
