//! **Read** (読む): the file as written ⇄ [`Clip`], and the poses of a clip.
//!
//! Each module imports only those listed before it: `lanes` computes on several numbers at once, `clip` holds joints,
//! channels and poses, `body` describes the performer, `seen` the camera, `composite` puts layers together again, `laid`
//! repeats a cycle,
//! `bvh` reads and writes the native format, and `clean` removes capture artefacts.

mod axis;

#[doc(hidden)]
pub mod lanes;

pub(crate) mod clip;

pub mod body;

pub mod seen;

mod composite;

mod laid;

pub mod bvh;

pub mod clean;

mod stream;

pub use axis::Axis;
pub use body::Build;
pub use body::MannequinParts;
pub use body::Members;
pub(crate) use body::above;
pub(crate) use body::below;
pub(crate) use body::is_still;
pub(crate) use body::is_t_pose;
pub use body::landmarks;
pub(crate) use body::plain_name;
pub use body::{
    BODY_GUESS, BodySide, BoneMap, Contact, ContactFinder, Description, Foot, Gait, Landmarks,
    Limb, PEOPLE, Point, STILL, Stature, Step, Unit,
};
pub(crate) use clip::rotation_axes;
pub(crate) use clip::turn_columns;
pub use clip::{
    Beside, Body, CameraPath, CameraPose, Channel, Clip, Declared, EndSite, Joint, JointId, Lens,
    Pose, Poser, RowWriter, Skeleton, Word, local_rotation, local_translation, set_local_rotation,
};
pub use composite::Cels;
pub use composite::layer_of;
pub(crate) use composite::travellers;
pub use composite::{Composite, CompositePoser, CompositeRows};
pub use laid::{first_round, laid, middle_round, played_out};
pub use seen::{Camera, Eye, Filmed, Screen, SeenFrom};
pub(crate) use stream::GIB;
pub use stream::StreamLimit;
pub use stream::bytes_in_words;
