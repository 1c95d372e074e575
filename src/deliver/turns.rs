//! The keys and walls of every joint, as a table.

use crate::deliver::{csv_table, number};
use crate::error::Error;
use crate::motion::Skeleton;
use crate::signal::{Signals, Turn, TurnKind};

/// `joint,frame,kind,speed_deg_s,confirmed_for`, joint after joint. Frames as in the file, from 0; the
/// speed is the filtered one at that frame, in °/s where the measure is an angle, else in its own
/// unit; `confirmed_for` in frames.
///
/// # Errors
/// Only when memory runs out.
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
