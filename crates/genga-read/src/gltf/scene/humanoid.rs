//! Reads the humanoid bone names that VRM gives to nodes: `hips`, `leftUpperArm`.

use std::collections::BTreeMap;

use serde_json::Value;

use super::super::document::Document;

/// The name of each node that is a humanoid bone; empty if the file is no VRM.
pub(super) fn names(document: &Document) -> BTreeMap<usize, String> {
    let own =
        |extension: &str| document.extensions.get(extension)?.get("humanoid")?.get("humanBones");
    let bones = ["VRMC_vrm_animation", "VRMC_vrm", "VRM"].into_iter().find_map(own);
    let named: Vec<(Option<usize>, &str)> = match bones {
        Some(Value::Object(bones)) => {
            bones.iter().map(|(name, bone)| (node(bone), name.as_str())).collect()
        }
        // VRM 0 stores a list.
        Some(Value::Array(bones)) => bones.iter().filter_map(of_list).collect(),
        _ => Vec::new(),
    };
    let there_is = |node: &usize| *node < document.nodes.len();
    let named = named
        .into_iter()
        .filter_map(|(node, name)| Some((node.filter(there_is)?, name.to_owned())));
    named.collect()
}

/// The node and the name of a bone in the list of VRM 0.
fn of_list(bone: &Value) -> Option<(Option<usize>, &str)> {
    Some((node(bone), of_now(bone.get("bone")?.as_str()?)))
}

/// Thumb bones in VRM 0, which names them one joint further out than VRM 1.0, and in VRM 1.0.
const THUMBS: [(&str, &str); 4] = [
    ("leftThumbProximal", "leftThumbMetacarpal"),
    ("leftThumbIntermediate", "leftThumbProximal"),
    ("rightThumbProximal", "rightThumbMetacarpal"),
    ("rightThumbIntermediate", "rightThumbProximal"),
];

/// Converts a bone name of VRM 0 to VRM 1.0.
fn of_now(name: &str) -> &str {
    THUMBS.iter().find(|(old, _)| *old == name).map_or(name, |(_, new)| new)
}

fn node(bone: &Value) -> Option<usize> {
    usize::try_from(bone.get("node")?.as_u64()?).ok()
}
