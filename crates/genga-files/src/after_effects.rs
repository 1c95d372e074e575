//! Time remapping for After Effects, as keyframe text for its clipboard.

use std::fmt::Write;

use crate::{Cut, Sink};
use genga::error::{Error, Warning};
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
        put(&format!("ae/{file}.txt"), in_cut(sheet, layer).as_bytes())?;
    }
    Ok(())
}

/// Writes a layer's timing as keyframes of *Time Remap*. They are pasted onto a layer that plays the column's
/// pictures at the sheet's `koma_rate` (per second), one picture per drawing by file name, the first at 0 s. After Effects
/// gives pasted keys linear interpolation; *Toggle Hold Keyframe* turns them into holds.
pub fn time_remap(layer: &Layer, koma_rate: f64) -> String {
    keyframes(koma_rate, &[Property::time_remap(changes(layer, 0, koma_rate))])
}

/// Says how to import pictures whose numbers are not 1, 2, 3 ….
pub(super) fn notes(sheet: &Sheet) -> Vec<Warning> {
    if sheet.layers.iter().all(Layer::is_plainly_numbered) {
        return vec![];
    }
    let message = "some numbers are missing or have letters: import the pictures into After Effects with \"Force \
                   alphabetical order\"";
    vec![Warning::new("W_AE_NUMBERS", message)]
}

/// A keyed property: its name, its unit and its values by frame.
struct Property {
    name: &'static str,
    unit: &'static str,
    keys: Vec<(usize, f64)>,
}

impl Property {
    fn time_remap(keys: Vec<(usize, f64)>) -> Self {
        Self { name: "Layer\nTime Remap", unit: "seconds", keys }
    }

    fn opacity(keys: Vec<(usize, f64)>) -> Self {
        Self { name: "Transform\tOpacity", unit: "percent", keys }
    }
}

/// Writes the time remapping of a layer of a sheet and, if the sheet has blank koma, the opacity that hides the layer
/// on them. Two opacities on neighbouring frames make it change at once, even between linear keys.
fn in_cut(sheet: &Sheet, layer: &Layer) -> String {
    let (koma_rate, begin) = (sheet.clock.koma_rate, sheet.blank.before);
    let remapped = Property::time_remap(changes(layer, begin, koma_rate));
    if sheet.blank.is_none() {
        return keyframes(koma_rate, &[remapped]);
    }
    let end = begin + layer.length();
    let enters = if begin > 0 { vec![(begin - 1, 0.0), (begin, 100.0)] } else { vec![(0, 100.0)] };
    let leaves = if end < sheet.cut_length() { vec![(end - 1, 100.0), (end, 0.0)] } else { vec![] };
    let mut shown = [enters, leaves].concat();
    shown.dedup();
    keyframes(koma_rate, &[remapped, Property::opacity(shown)])
}

/// The times of the drawings in the column's pictures, in seconds, by the frame on which they come. The layer enters on
/// frame `begin`.
fn changes(layer: &Layer, begin: usize, koma_rate: f64) -> Vec<(usize, f64)> {
    let pictures = pictures(layer);
    let changes = layer.changes();
    changes.map(|(koma, drawing)| (begin + koma, pictures[drawing] as f64 / koma_rate)).collect()
}

/// The place of each drawing's picture among those of its column, from 0, in alphabetical order.
fn pictures(layer: &Layer) -> Vec<usize> {
    let numbers = layer.numbers();
    let mut ordered: Vec<usize> = (0..numbers.len()).collect();
    ordered.sort_by_key(|drawing| (numbers[*drawing].whole(), numbers[*drawing].letters()));
    let mut places = vec![0; numbers.len()];
    ordered.into_iter().enumerate().for_each(|(place, drawing)| places[drawing] = place);
    places
}

/// Writes properties as After Effects copies them.
fn keyframes(koma_rate: f64, properties: &[Property]) -> String {
    let mut text = format!(
        "Adobe After Effects 9.0 Keyframe Data\n\n\tUnits Per Second\t{koma_rate}\n\tSource Width\t1920\n\
         \tSource Height\t1080\n\tSource Pixel Aspect Ratio\t1\n\tComp Pixel Aspect Ratio\t1\n"
    );
    for Property { name, unit, keys } in properties {
        let _ = writeln!(text, "\n{name}\n\tFrame\t{unit}");
        for (frame, value) in keys {
            let _ = writeln!(text, "\t{frame}\t{value}");
        }
    }
    text.push_str("\nEnd of Keyframe Data\n");
    text
}
