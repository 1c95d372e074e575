//! The omission as rows of the second paper's Table 1 [KKMFT].

use crate::csv_table;
use genga::error::Error;

/// The omission of a clip.
#[derive(Debug, Clone, PartialEq)]
pub struct OmissionRow {
    /// The name of the clip.
    pub clip: String,
    /// Its length in frames at 24 per second.
    pub frames: usize,
    /// Number of koma that naka-nashi cut, N_io. Those that it gave to another drawing can be cut again.
    pub n_io: usize,
    /// Number of frames that koma-dori replaced by the one before, N_hf.
    pub n_hf: usize,
    /// Seconds that both took; milliseconds in the table.
    pub seconds: f64,
}

/// Writes a row for each clip.
///
/// # Errors
/// Fails only if memory runs out.
pub fn omission_csv(clips: &[OmissionRow]) -> Result<String, Error> {
    let row = |own: &OmissionRow| {
        let [frames, n_io, n_hf] = [own.frames, own.n_io, own.n_hf].map(|count| count.to_string());
        [own.clip.clone(), frames, n_io, n_hf, format!("{:.3}", 1e3 * own.seconds)]
    };
    csv_table(&["clip", "frames", "n_io", "n_hf", "time_ms"], clips.iter().map(row))
}
