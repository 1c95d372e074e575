//! What a motion file holds beside the body (体のほか): its camera, and what a writer of the same format passes on.

use std::any::Any;
use std::sync::Arc;

use super::camera_path::CameraPath;

/// What a motion file holds beside the body.
///
/// The method looks at the camera alone, and at that only for the CAMERA column. What a reader keeps for the writer of
/// its format is carried unseen, so that no timing can touch it.
#[derive(Debug, Clone, Default)]
pub struct Beside {
    /// The camera of the take; `None` without one.
    pub camera: Option<CameraPath>,
    kept: Vec<Arc<dyn Any + Send + Sync>>,
}

impl Beside {
    /// Creates what holds a camera alone, or nothing.
    pub fn new(camera: Option<CameraPath>) -> Self {
        Self { camera, kept: Vec::new() }
    }

    /// Keeps something for a writer, in place of what was kept of the same type.
    #[must_use]
    pub fn keep<T: Any + Send + Sync>(mut self, what: T) -> Self {
        self.kept.retain(|kept| !kept.is::<T>());
        self.kept.push(Arc::new(what));
        self
    }

    /// Returns what a reader kept of a type.
    pub fn kept<T: Any>(&self) -> Option<&T> {
        self.kept.iter().find_map(|kept| kept.downcast_ref())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_kept_is_found_by_its_type_alone() {
        let beside = Beside::default().keep(vec![1_u8, 2]);
        assert_eq!(beside.kept::<Vec<u8>>(), Some(&vec![1, 2]));
        assert_eq!(beside.kept::<String>(), None);
        let more = beside.keep("a".to_owned()).keep(vec![3_u8]);
        assert_eq!(more.kept::<Vec<u8>>(), Some(&vec![3]));
        assert_eq!(more.kept::<String>().map(String::as_str), Some("a"));
        assert_eq!(Beside::default().kept::<Vec<u8>>(), None);
    }
}
