//! **Read** (読む): motion and cameras from files, a file or a folder a format.

pub mod bvh;
pub mod file;
mod gltf_camera;
mod stream;

pub use gltf_camera::GltfCamera;
pub use stream::StreamLimit;
pub(crate) use stream::{GIB, bytes_in_words};
