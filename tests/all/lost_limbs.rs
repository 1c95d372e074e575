//! An arm or a leg that a file will not move is reported on the first line.

use std::fs;

use crate::clips::here;
use crate::program::{Place, text};

/// Replaces the joint names of a motion by nonsense.
fn nonsense(bvh: &str) -> String {
    let mut at = 0;
    let line = |line: &str| {
        let word = ["ROOT ", "JOINT "].into_iter().find(|word| line.trim_start().starts_with(word));
        word.map_or(line.to_owned(), |word| {
            at += 1;
            format!("{word}q{at}")
        })
    };
    bvh.lines().map(line).collect::<Vec<_>>().join("\n")
}

/// A motion of a trunk on two legs.
fn without_arms() -> String {
    let joint = |name: &str, offset: &str, inside: &str| {
        format!(
            "JOINT {name}\n{{\nOFFSET {offset}\nCHANNELS 3 Zrotation Xrotation Yrotation\n{inside}}}\n"
        )
    };
    let end = "End Site\n{\nOFFSET 0 0 12\n}\n";
    let leg = |side: &str, x: i32| {
        let foot = joint(&format!("{side}Foot"), "0 -40 0", end);
        let shin = joint(&format!("{side}Leg"), "0 -42 0", &foot);
        joint(&format!("{side}UpLeg"), &format!("{x} -5 0"), &shin)
    };
    let head = joint("Head", "0 45 0", end);
    let spine = joint("Spine", "0 10 0", &head);
    let body = format!("{spine}{}{}", leg("Left", 9), leg("Right", -9));
    let root =
        "OFFSET 0 90 0\nCHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation\n";
    let mut text = format!(
        "HIERARCHY\nROOT Hips\n{{\n{root}{body}}}\nMOTION\nFrames: 24\nFrame Time: 0.0416667\n"
    );
    for frame in 0..24 {
        let row: Vec<String> = (0..30)
            .map(|column| match column {
                1 => "90".to_owned(),
                13 | 22 => format!("{}", (frame % 12) * 4),
                _ => "0".to_owned(),
            })
            .collect();
        text.push_str(&format!("{}\n", row.join(" ")));
    }
    text
}

#[test]
fn what_neither_names_nor_shape_know_stands_on_the_first_line() {
    let place = Place::new();
    fs::write(place.path("legs.bvh"), without_arms()).unwrap();
    let output = place.genga("run legs.bvh --out a --deliver vmd");
    let said = text(&output.stderr);
    let first = said.lines().next().unwrap();
    let warning = "; warning: vmd: left arm, right arm will not move: no joint is known to be there; a file of bones says \
                   which (--bones) [W_STILL_LIMB]";
    assert!(
        output.status.success() && first.starts_with("legs: 24 frames") && first.ends_with(warning),
        "{said}"
    );
    let quiet = text(&place.genga("run legs.bvh --out a --deliver vmd --quiet").stderr);
    assert_eq!(quiet.trim_end(), first, "a loss is said when quiet too");
    let report: serde_json::Value =
        serde_json::from_slice(&fs::read(place.path("a/report.json")).unwrap()).unwrap();
    assert_eq!(report["losses"].as_array().unwrap().len(), 1);
    let error = place.refused(1, "run legs.bvh --out b --deliver vrma");
    assert!(error.contains("VRM has no body without leftUpperArm"), "{error}");
}

#[test]
fn nonsense_has_arms_and_legs() {
    let place = Place::new();
    let kick = fs::read_to_string(here("data/kick.bvh")).unwrap();
    fs::write(place.path("q.bvh"), nonsense(&kick)).unwrap();
    let output = place.genga("run q.bvh --out a --deliver vmd,vrma");
    let said = text(&output.stderr);
    assert!(
        output.status.success() && !said.contains("warning") && said.contains("W_BY_SHAPE"),
        "{said}"
    );
    let bones = fs::read_to_string(place.path("a/q-bones.csv")).unwrap();
    for bone in ["左腕", "右ひじ", "左手首", "左足", "右ひざ", "右足首", "頭"] {
        assert!(bones.contains(&format!(",{bone},drives")), "{bones}");
    }
}
