//! **Read** (読む): motion and cameras from files, a file or a folder a format.

mod acclaim;
pub mod bvh;
mod fbx;
pub mod file;
mod gltf;
mod gltf_camera;
pub(crate) mod mmd;
mod posed;
mod rates;
mod reading;
mod stream;

pub use gltf_camera::GltfCamera;
pub use mmd::MmdModel;
#[cfg(test)]
pub(crate) use mmd::model_tests;
pub(crate) use mmd::{is_motion as is_vmd, key_frames as vmd_key_frames};
pub use stream::StreamLimit;
pub(crate) use stream::{GIB, bytes_in_words};
