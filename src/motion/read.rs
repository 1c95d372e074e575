//! **Read** (読む): motion and cameras from files, a file or a folder a format.

pub mod bvh;
mod gltf_camera;

pub use gltf_camera::GltfCamera;
