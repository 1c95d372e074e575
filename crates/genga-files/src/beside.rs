//! What a clip's file holds beside the body, and a format cannot take over.

use genga::error::Warning;
use genga::motion::Clip;
use genga_read::{GltfScene, VmdBeside};

/// Whose things a format takes over.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Passes {
    Gltf,
    Vmd,
    Nothing,
}

/// Names what the file holds beside the body that a format does not have.
pub(crate) fn unpassed(format: &str, clip: &Clip, passes: Passes) -> Option<Warning> {
    let beside = clip.beside()?;
    let scene = beside.kept::<GltfScene>();
    let nodes = scene.filter(|_| passes != Passes::Gltf).and_then(GltfScene::words);
    let lost = scene.map(|scene| scene.lost.join(", ")).filter(|lost| !lost.is_empty());
    let of_mmd = beside.kept::<VmdBeside>().filter(|_| passes != Passes::Vmd);
    let keys = of_mmd.and_then(VmdBeside::words);
    let all: Vec<String> = [nodes, lost, keys].into_iter().flatten().collect();
    let message =
        format!("{format}: not in it is what the file holds beside the body: {}", all.join(", "));
    (!all.is_empty()).then(|| Warning::new("W_NOT_PASSED", message))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::stage::stage;
    use genga_read::Options;

    fn said(clip: &Clip, passes: Passes) -> Option<String> {
        unpassed("it", clip, passes).map(|note| note.to_string())
    }

    #[test]
    fn what_a_format_cannot_hold_is_named() {
        let mut face = stage();
        let weights = face.add("SCALAR", 1, &[0.0; 6]);
        face.play(6, "weights", "LINEAR", weights);
        let clip = Options::default().read(&face.glb()).unwrap().clip;
        let lost = "the morphs of skin, whose shape is the body's";
        let begin = "it: not in it is what the file holds beside the body: ";
        assert_eq!(said(&clip, Passes::Gltf), Some(format!("{begin}{lost} [W_NOT_PASSED]")));
        let nodes = "cameras (1), shapes (2), nodes that move: sword, eye, balloon (3)";
        let all = format!("{begin}{nodes}, {lost} [W_NOT_PASSED]");
        assert_eq!(
            [Passes::Vmd, Passes::Nothing].map(|passes| said(&clip, passes)),
            [Some(all.clone()), Some(all),]
        );
        let whole = Options::default().read(&stage().glb()).unwrap().clip;
        assert_eq!(said(&whole, Passes::Gltf), None);
        let bare = whole.with_beside(genga::motion::Beside::default());
        assert_eq!(said(&bare, Passes::Nothing), None);
    }
}
