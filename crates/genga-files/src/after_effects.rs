//! Time remapping for After Effects, as keyframe text for its clipboard.

use std::fmt::Write;

use crate::{Cut, Sink};
use genga::error::Error;
use genga::sheet::{Layer, Sheet};

/// Writes one file per column into the folder `ae`.
pub(super) fn write(sheet: &Sheet, put: &mut Sink<'_>) -> Result<(), Error> {
    sheet.check()?;
    let mut names: Vec<String> = Vec::new();
    for layer in &sheet.layers {
        let name = Cut::file_of(&layer.name, "CUT");
        let same = names.iter().filter(|other| other.eq_ignore_ascii_case(&name)).count();
        let file = if same == 0 { name.clone() } else { format!("{name}~{}", same + 1) };
        names.push(name);
        put(&format!("ae/{file}.txt"), time_remap(layer, sheet.clock.koma_rate).as_bytes())?;
    }
    Ok(())
}

/// Writes a layer's timing as keyframes of *Time Remap*. They are pasted onto a layer that plays the column's
/// pictures at the sheet's `koma_rate` (per second), one picture per drawing, with drawing 1 at 0 s. After Effects
/// gives pasted keys linear interpolation; *Toggle Hold Keyframe* turns them into holds.
pub fn time_remap(layer: &Layer, koma_rate: f64) -> String {
    let mut text = format!(
        "Adobe After Effects 9.0 Keyframe Data\n\n\tUnits Per Second\t{koma_rate}\n\tSource Width\t1920\n\
         \tSource Height\t1080\n\tSource Pixel Aspect Ratio\t1\n\tComp Pixel Aspect Ratio\t1\n\n\
         Layer\nTime Remap\n\tFrame\tseconds\n"
    );
    for (koma, drawing) in layer.changes() {
        let _ = writeln!(text, "\t{koma}\t{}", drawing as f64 / koma_rate);
    }
    text.push_str("\nEnd of Keyframe Data\n");
    text
}
