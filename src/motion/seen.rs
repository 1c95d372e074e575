//! **Seen** (画面): the camera that looks at a body, and its screen.

mod camera;
mod camera_work;
mod screen;
pub mod view;

pub use camera::Camera;
pub use camera_work::Filmed;
pub use screen::looks;
pub use screen::{Eye, Screen, SeenFrom};
