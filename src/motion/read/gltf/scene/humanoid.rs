//! The names that VRM gives to nodes: `hips`, `leftUpperArm`.

use std::collections::BTreeMap;

use serde_json::Value;

use super::super::document::Document;

/// The name of each node that is a bone of the humanoid; none where a file is no VRM.
pub(super) fn names(document: &Document) -> BTreeMap<usize, String> {
    let own =
        |extension: &str| document.extensions.get(extension)?.get("humanoid")?.get("humanBones");
    let bones = ["VRMC_vrm_animation", "VRMC_vrm", "VRM"].into_iter().find_map(own);
    let named: Vec<(Option<usize>, &str)> = match bones {
        Some(Value::Object(bones)) => {
            bones.iter().map(|(name, bone)| (node(bone), name.as_str())).collect()
        }
        // VRM 0 has a list.
        Some(Value::Array(bones)) => {
            let name = |bone: &'_ Value| bone.get("bone").and_then(Value::as_str).map(str::len);
            let named = bones.iter().filter(|bone| name(bone).is_some());
            named.map(|bone| (node(bone), bone["bone"].as_str().unwrap_or_default())).collect()
        }
        _ => Vec::new(),
    };
    let there_is = |node: &usize| *node < document.nodes.len();
    let named = named
        .into_iter()
        .filter_map(|(node, name)| Some((node.filter(there_is)?, name.to_owned())));
    named.collect()
}

fn node(bone: &Value) -> Option<usize> {
    usize::try_from(bone.get("node")?.as_u64()?).ok()
}
