//! The bones of VRM's humanoid (VRM 1.0), by those of a model of MMD: a dialect of the bone table.

use std::sync::LazyLock;

use crate::motion::body::names::BoneMap;
use crate::motion::body::names::bones::Side;

/// The bone of MMD that is VRM's hips, and the one that is its spine.
pub(super) const HIPS: &str = "下半身";
pub(super) const SPINE: &str = "上半身";

/// The bone that is the hips too, where the whole is carried: VRM has one for both.
const CENTER: &str = "センター";

/// The dialect that has the names.
const DIALECT: &str = "vrm";

static TABLE: LazyLock<BoneMap> = LazyLock::new(BoneMap::default);

/// Those of the sides without which there is no humanoid.
const NEEDED: [&str; 6] = ["腕", "ひじ", "手首", "足", "ひざ", "足首"];

/// VRM's name of a bone.
pub(super) fn vrm_name(bone: &str) -> Option<&'static str> {
    TABLE.first_name(DIALECT, bone).filter(|_| bone != CENTER)
}

/// The bones without which VRM has no humanoid.
pub(super) fn needed() -> impl Iterator<Item = String> {
    let middle = [HIPS, SPINE, "頭"].into_iter().map(str::to_owned);
    middle.chain(Side::BOTH.into_iter().flat_map(|side| NEEDED.map(|bone| side.named(bone))))
}
