//! Names of VRM's humanoid bones (VRM 1.0), by MMD bone: a dialect of the bone table.

use std::sync::LazyLock;

use genga::motion::body::names::BoneMap;
use genga::motion::body::names::bones::Side;

/// The MMD bones that become VRM's hips and spine.
pub(super) const HIPS: &str = "下半身";
pub(super) const SPINE: &str = "上半身";

/// The MMD bone for the position of the whole body. It is left out, because VRM's hips serve for both.
const CENTER: &str = "センター";

/// The dialect of the bone table that has VRM's names.
const DIALECT: &str = "vrm";

static TABLE: LazyLock<BoneMap> = LazyLock::new(BoneMap::default);

/// The bones that VRM requires on both sides.
const NEEDED: [&str; 6] = ["腕", "ひじ", "手首", "足", "ひざ", "足首"];

/// VRM's name of an MMD bone; `None` if it has none.
pub(super) fn vrm_name(bone: &str) -> Option<&'static str> {
    TABLE.first_name(DIALECT, bone).filter(|_| bone != CENTER)
}

/// The MMD names of all bones that VRM requires.
pub(super) fn needed() -> impl Iterator<Item = String> {
    let middle = [HIPS, SPINE, "頭"].into_iter().map(str::to_owned);
    middle.chain(Side::BOTH.into_iter().flat_map(|side| NEEDED.map(|bone| side.named(bone))))
}
