//! **Seen** (画面): from where a body is looked at, and what of it is seen there.

mod camera;
mod screen;
pub(crate) mod view;

pub use camera::Camera;
pub(in crate::motion) use screen::looks;
pub use screen::{Eye, Screen, SeenFrom};
