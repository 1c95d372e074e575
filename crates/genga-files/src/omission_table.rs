//! The omission as a row of the second paper's Table 1 [KKMFT].

use crate::csv_table;
use genga::error::Error;
use genga::timing::OmissionReport;

/// Writes the row of a clip: its length in frames at 24 per second, the number of frames that naka-nashi left out
/// (N_io) and that koma-dori replaced by the one before (N_hf), and the time that both took, given in seconds and
/// written in milliseconds.
///
/// # Errors
/// Fails only if memory runs out.
pub fn omission_csv(
    clip: &str,
    frames: usize,
    report: &OmissionReport,
    seconds: f64,
) -> Result<String, Error> {
    let counts = [frames, report.naka_nashi.done, report.koma_dori.done];
    let mut row = vec![clip.to_owned()];
    row.extend(counts.map(|count| count.to_string()));
    row.push(format!("{:.3}", 1e3 * seconds));
    csv_table(&["clip", "frames", "n_io", "n_hf", "time_ms"], [row])
}
