//! The keys and walls of every joint, as a table.

use crate::{csv_table, number};
use genga::error::Error;
use genga::motion::Skeleton;
use genga::signal::{Signals, Turn, TurnKind};

/// Writes `joint,frame,kind,speed_deg_s,confirmed_for`, joint after joint. Frames count from 0 as in the file.
/// The speed is the filtered one at that frame, in °/s if the measure is an angle, else in the measure's own
/// unit. `confirmed_for` is in frames.
///
/// # Errors
/// Fails only if memory runs out.
pub fn turns_csv(
    skeleton: &Skeleton,
    filtered: &Signals,
    turns: &[Vec<Turn>],
) -> Result<String, Error> {
    let rows = skeleton.iter().zip(turns).flat_map(|((joint, data), turns)| {
        turns.iter().map(move |turn| {
            let speed = filtered.joint(joint)[turn.frame.0 - filtered.first.0];
            let kind = match turn.kind {
                TurnKind::Key => "key",
                TurnKind::Wall => "wall",
            };
            [
                data.name.clone(),
                turn.frame.to_string(),
                kind.into(),
                number(speed * filtered.unit.for_people()),
                turn.confirmed_for.to_string(),
            ]
        })
    });
    csv_table(&["joint", "frame", "kind", "speed_deg_s", "confirmed_for"], rows)
}
