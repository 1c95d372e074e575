//! The pictures of what was measured, of a run and of a study, and of a skeleton.

use std::path::Path;

use super::failure::Failure;
use super::io;
use crate::motion::{Clip, SeenFrom};
use crate::pipeline::Breakdown;
use crate::plot::{self, SkeletonPlot, SpeedPlot, SsdPlot};
use crate::sheet::Sheet;
use crate::time::Frame;

/// Speeds before and after the filter with keys and walls, of the joints that move most.
pub(super) fn speed(breakdown: &Breakdown<'_>) -> Result<String, Failure> {
    let names: Vec<&str> =
        breakdown.clip.skeleton().joints.iter().map(|joint| joint.name.as_str()).collect();
    // The kept drawings of the sheet, so that their numbers are those of the key table.
    let kept = breakdown.sheet.layers[0].drawings.iter().filter(|drawing| drawing.role.is_kept());
    let keys: Vec<Frame> =
        kept.map(|drawing| Frame(drawing.source.place().round() as usize)).collect();
    let Breakdown { speed, filtered, turns, .. } = breakdown;
    let order = filtered.movers_first(breakdown.clip.skeleton());
    let splits = breakdown.actions.splits().iter().map(|split| split.frame).collect();
    let plot = SpeedPlot { splits, ..SpeedPlot::default() };
    Ok(plot.draw(&names, speed, filtered, turns, &keys, &order)?)
}

/// The movement into each koma before and after omission, an SVG or a PNG by the name as well.
pub(super) fn write_omission(
    path: &Path,
    clip: &Clip,
    (before, after): (&Sheet, &Sheet),
    seen_from: SeenFrom,
) -> Result<(), Failure> {
    let plot = SsdPlot { seen_from, ..SsdPlot::default() };
    write(path, &plot.draw(clip, before, after)?)
}

/// The skeleton: its rest pose and its hierarchy.
pub(super) fn write_skeleton(path: &Path, name: &str, clip: &Clip) -> Result<(), Failure> {
    write(path, &SkeletonPlot::default().draw(name, clip)?)
}

/// Refuses a picture that could not be written, before any work.
pub(super) fn check_name(option: &str, path: &Path) -> Result<(), Failure> {
    match ending(path).as_deref() {
        Some("png" | "svg") | None => Ok(()),
        Some(other) => Err(Failure::AskedWrongly(format!(
            "--{option}: a picture is .svg or .png, not .{other}"
        ))),
    }
}

/// A picture as an SVG or, for a name that ends in `.png`, a PNG.
pub(super) fn write(path: &Path, svg: &str) -> Result<(), Failure> {
    match ending(path).as_deref() {
        Some("png") => io::write(path, &plot::png_from_svg(svg, 2.0)?),
        _ => io::write(path, svg.as_bytes()),
    }
}

fn ending(path: &Path) -> Option<String> {
    path.extension().map(|ending| ending.to_string_lossy().to_lowercase())
}
