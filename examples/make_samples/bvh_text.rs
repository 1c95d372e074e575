//! Writes the text of a BVH file: the hierarchy, then one row per frame with four decimals.

use glam::DVec3;

use super::skeleton::BONES;

/// Writes a file whose rows have six channels for the root and three for every other joint.
pub(crate) fn text(fps: f64, rows: &[Vec<f64>]) -> String {
    let mut text = String::from("HIERARCHY\n");
    joint(&mut text, 0, 0);
    let frame_time = 1.0 / fps;
    text += &format!("MOTION\nFrames: {}\nFrame Time: {frame_time:.8}\n", rows.len());
    for row in rows {
        let row: Vec<String> = row.iter().map(|&value| number(value)).collect();
        text += &row.join(" ");
        text.push('\n');
    }
    text
}

fn joint(text: &mut String, index: usize, depth: usize) {
    let (bone, tabs) = (&BONES[index], "\t".repeat(depth));
    let (word, position) = match bone.parent {
        None => ("ROOT", "6 Xposition Yposition Zposition"),
        Some(_) => ("JOINT", "3"),
    };
    *text += &format!("{tabs}{word} {}\n{tabs}{{\n{tabs}\t", bone.name);
    offset(text, bone.offset);
    *text += &format!("{tabs}\tCHANNELS {position} Zrotation Xrotation Yrotation\n");
    for child in (0..BONES.len()).filter(|&child| BONES[child].parent == Some(index)) {
        joint(text, child, depth + 1);
    }
    if let Some(tip) = bone.tip {
        *text += &format!("{tabs}\tEnd Site\n{tabs}\t{{\n{tabs}\t\t");
        offset(text, tip);
        *text += &format!("{tabs}\t}}\n");
    }
    *text += &format!("{tabs}}}\n");
}

fn offset(text: &mut String, DVec3 { x, y, z }: DVec3) {
    *text += &format!("OFFSET {} {} {}\n", number(x), number(y), number(z));
}

/// Formats a number with four decimals, which rounds away differences between two implementations of sine.
fn number(value: f64) -> String {
    // Adding 0 turns −0 into 0, also if a small negative number was rounded to it.
    let rounded = (value * 1e4).round() / 1e4 + 0.0;
    format!("{rounded:.4}")
}
