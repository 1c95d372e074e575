use super::*;
use crate::motion::Joint;

fn skeleton(names: &[&str]) -> Skeleton {
    let joint = |(at, name): (usize, &&str)| Joint {
        name: (*name).into(),
        parent: at.checked_sub(1).map(JointId),
        offset: glam::DVec3::Y,
        channels: vec![],
        first_channel: 0,
        end_sites: vec![],
    };
    Skeleton { joints: names.iter().enumerate().map(joint).collect() }
}

/// Returns the driven bones with their joints.
fn driven(map: &BoneMap, names: &[&str]) -> Vec<(String, Vec<String>)> {
    let skeleton = skeleton(names);
    let found = map.find_among(&skeleton, |_| true);
    let name = |joint: &JointId| skeleton.joints[joint.0].name.clone();
    let bones = map.model.bones.iter().zip(&found.joints);
    let bones = bones.filter(|(_, joints)| !joints.is_empty());
    bones.map(|(bone, joints)| (bone.name.clone(), joints.iter().map(name).collect())).collect()
}

#[test]
fn names_are_compared_without_prefix_case_and_blanks() {
    for (name, same) in [
        ("mixamorig:LeftArm", "LeftArm"),
        ("mixamorig_LeftArm", "leftarm"),
        ("Take1:Bip01 L UpperArm", "L UpperArm"),
        ("Bip001_L_UpperArm", "L UpperArm"),
        ("Character1_Hips", "Hips"),
        ("UpperArm_L", "upperarm_l"),
    ] {
        assert_eq!(plain_name(name), plain_name(same), "{name}");
    }
    assert_ne!(plain_name("Bip01"), "", "a root of nothing but its prefix keeps its name");
}

#[test]
fn left_shoulder_is_a_collar_bone_or_an_arm_by_what_else_there_is() {
    let bone = |names: &[&str]| {
        let bones = driven(&BoneMap::default(), names);
        bones.into_iter().find(|(_, joints)| joints == &["LeftShoulder"]).unwrap().0
    };
    assert_eq!(bone(&["Hips", "LeftShoulder", "LeftArm", "LeftForeArm"]), "左肩");
    assert_eq!(bone(&["Hips", "LeftCollar", "LeftShoulder", "LeftElbow"]), "左腕");
}

#[test]
fn several_joints_make_one_bone() {
    let bones =
        driven(&BoneMap::default(), &["Hips", "Spine", "Spine1", "Spine2", "Neck", "Neck1"]);
    let of = |bone: &str| bones.iter().find(|(name, _)| name == bone).unwrap().1.clone();
    assert_eq!(of("上半身2"), ["Spine1", "Spine2"]);
    assert_eq!(of("首"), ["Neck", "Neck1"]);
    assert_eq!(of("上半身"), ["Spine"]);
}

#[test]
fn a_person_changes_rows_adds_dialects_and_bones() {
    let text = "\
[bones]
\"左腕\" = \"MyArm\"
\"頭\" = [\"Nod\", \"Shake\", \"Absent\"]
[extra.\"左足先EX\"]
parent = \"左足首\"
joints = \"LeftToeBase\"
";
    let map = BoneMap::parse(text).unwrap();
    let names = ["Hips", "LeftArm", "MyArm", "Nod", "Shake", "LeftFoot", "LeftToeBase"];
    let bones = driven(&map, &names);
    let of = |bone: &str| bones.iter().find(|(name, _)| name == bone).unwrap().1.clone();
    assert_eq!(of("左腕"), ["MyArm"]);
    assert_eq!(of("頭"), ["Nod", "Shake"]);
    assert_eq!(of("左足先EX"), ["LeftToeBase"]);
    assert_eq!(map.find_among(&skeleton(&names), |_| true).missing, ["Absent"]);
    let text = "\
[[dialect]]
name = \"mine\"
sides = [\"li\", \"re\"]
[dialect.bones]
\"左腕\" = \"@Arm\"
\"左ひじ\" = \"@Elle\"
";
    let map = BoneMap::parse(text).unwrap();
    let found = map.find_among(&skeleton(&["liArm", "liElle", "reArm", "reElle"]), |_| true);
    assert_eq!(found.dialect, "mine");
    assert_eq!(found.joints.iter().flatten().count(), 4);
    assert_eq!(map.dialects().next(), Some("mine"));
}

#[test]
fn a_wrong_file_is_refused_with_its_place() {
    for (text, begin) in [
        ("[bones]\n\"左うで\" = \"A\"\n", "bones: 2:1: there is no bone 左うで to map"),
        ("[bones]\n\"左腕\" = 3\n", "bones: 2:"),
        ("[bone]\n", "bones: 1:2: unknown field `bone`"),
        ("[[dialect]]\nname = \"a\"\nside = 1\n", "bones: 3:1: unknown field `side`"),
        (
            "[extra.\"とてもとても長い骨\"]\nparent = \"頭\"\njoints = \"A\"\n",
            "bones: 1:8: \"とてもとても長い骨\" is 18 bytes",
        ),
        (
            "[extra.\"耳\"]\nparent = \"首輪\"\njoints = \"A\"\n",
            "bones: 1:8: 耳 cannot hang on 首輪",
        ),
        ("[extra.\"頭\"]\nparent = \"首\"\njoints = \"A\"\n", "bones: 1:8: 頭 is there already"),
        ("[bones\n", "bones: 1:"),
    ] {
        let error = BoneMap::parse(text).unwrap_err().to_string();
        assert!(error.starts_with(begin), "{error}");
    }
}

#[test]
fn a_clip_of_unknown_names_is_told_the_way_out() {
    let rate = crate::time::FrameRate::new(24.0).unwrap();
    let unknown = skeleton(&["ボーン1", "ボーン2"]);
    let clip = Clip::new(unknown, rate, crate::time::Frame(0), 1, vec![]).unwrap();
    let error = BoneMap::default().locate(&clip).unwrap_err().to_string();
    assert!(error.contains("ボーン1, ボーン2") && error.contains("[bones]"), "{error}");
    let own = BoneMap::parse("[bones]\n\"頭\" = \"ボーン2\"\n").unwrap();
    assert_eq!(driven(&own, &["ボーン1", "ボーン2"]), [("頭".into(), vec!["ボーン2".into()])]);
}

#[test]
fn every_dialect_names_the_limbs_on_both_sides() {
    let map = BoneMap::default();
    for dialect in &map.dialects {
        for bone in [
            "センター",
            "下半身",
            "上半身",
            "首",
            "頭",
            "左腕",
            "右ひじ",
            "左手首",
            "右足",
            "左ひざ",
            "右足首",
        ] {
            assert!(dialect.rows.contains_key(bone), "{}: {bone}", dialect.name);
        }
        let sided = dialect.rows.keys().filter(|bone| bone.starts_with('左')).count();
        assert_eq!(sided, dialect.rows.keys().filter(|bone| bone.starts_with('右')).count());
    }
}
