//! Table 1 of both papers, repeated on the synthetic samples of `data/`.

use std::fs;
use std::path::Path;

use genga::motion::{Clip, bvh};
use genga::pipeline::Engine;
use genga::study;
use genga::time::{KOMA_RATE, Span};

use crate::Outcome;
use crate::table::Table;
use crate::windows;

/// Keys that KT11 counted, in the order of the sweep.
const KEYS: [usize; 6] = [99, 75, 80, 71, 64, 52];

/// The rows of KKMFT: file, action, koma, N_io, N_hf, milliseconds.
const ACTIONS: [(&str, &str, usize, usize, usize, usize); 4] = [
    ("pitch.bvh", "Pitch", 129, 4, 33, 69),
    ("kick.bvh", "Kick", 92, 4, 30, 28),
    ("tennis.bvh", "Tennis", 88, 4, 29, 27),
    ("swing.bvh", "Baseball swing", 120, 6, 40, 63),
];

fn clip(path: &Path) -> Outcome<Clip> {
    let failed = |error: &dyn std::fmt::Display| format!("{}: {error}", path.display());
    let bytes = fs::read(path).map_err(|error| failed(&error))?;
    Ok(bvh::read(&bytes).map_err(|error| failed(&error))?.clip)
}

/// KT11, Table 1, in the literal reading.
pub(crate) fn keys(data: &Path) -> Outcome<String> {
    let mut engine = Engine::new(clip(&data.join("kuroda-pitch.bvh"))?)?;
    let widths = [10.0, 20.0, 30.0].map(Span::Frames);
    let persistences = [5.0, 10.0].map(Span::Frames);
    let rows = study::sweep(&mut engine, &study::table_1_recipe(), &widths, &persistences)?;
    let header =
        [">filter width", ">persistence", ">paper: keys", ">union", ">total", ">layer keys"];
    let mut table = Table::new(&header);
    for (row, paper) in rows.iter().zip(KEYS) {
        table.row(&[
            row.filter_width.to_string(),
            row.persistence.to_string(),
            paper.to_string(),
            row.union.to_string(),
            row.total.to_string(),
            row.layer_keys.to_string(),
        ]);
    }
    Ok(table.text())
}

/// KKMFT, Table 1, but for the time of this machine.
pub(crate) fn omission(data: &Path) -> Outcome<String> {
    let header = ["action", ">koma", ">N_io done/asked", ">N_hf done/asked", ">paper's time, ms"];
    let mut table = Table::new(&header);
    for (file, action, koma, naka_nashi, koma_dori, milliseconds) in ACTIONS {
        let clip = clip(&data.join(file))?;
        let length = clip.rate().koma_from_frames(clip.len(), KOMA_RATE);
        if length != koma {
            return Err(format!("{file} has {length} koma, the paper's action has {koma}").into());
        }
        let done = windows::omit(&clip, naka_nashi, koma_dori)?;
        table.row(&[
            action.into(),
            koma.to_string(),
            format!("{}/{}", done.naka_nashi[0], done.naka_nashi[1]),
            format!("{}/{}", done.koma_dori[0], done.koma_dori[1]),
            milliseconds.to_string(),
        ]);
    }
    Ok(table.text())
}
