//! Keys that a person marked in a file. Only those are pinned that the run would not have anyway.

use std::path::PathBuf;

use super::console::counted;
use super::format_args::shortened;
use genga::edits::{Edits, Pin};
use genga::sheet::{Layer, Role, Sheet};
use genga::time::{Clock, Frame};
use genga_files::xdts::MarkedKey;

/// Most genga that a note names.
const NAMED: usize = 4;

/// The marked keys of a column, and what became of them.
pub(super) struct MarkedKeys {
    file: PathBuf,
    /// The column they were read from.
    pub(super) column: String,
    /// Notes for the user about the file.
    notes: Vec<String>,
    /// Whether they are numbers on a timesheet. Their names are those numbers, and the ends of the clip have one too.
    is_timesheet: bool,
    /// All of them.
    all: Vec<MarkedKey>,
    /// Keys that are no pins.
    open: Vec<MarkedKey>,
    pinned: usize,
    gave_way: usize,
}

impl MarkedKeys {
    /// Takes the keys of a timesheet.
    pub(super) fn of_timesheet(file: PathBuf, column: String, marked: Vec<MarkedKey>) -> Self {
        let mut open: Vec<MarkedKey> = Vec::with_capacity(marked.len());
        for key in marked {
            // A drawing that comes again has its number again.
            let is_same =
                |other: &MarkedKey| other.pin.frame == key.pin.frame && other.koma == key.koma;
            if !open.iter().any(is_same) {
                open.push(key);
            }
        }
        Self::new((file, column), open, true)
    }

    /// Takes the keys of a table or a sheet.
    pub(super) fn of_table(file: PathBuf, (pins, column): (Vec<Pin>, String)) -> Self {
        let open = pins.into_iter().map(|pin| MarkedKey { pin, koma: None }).collect();
        Self::new((file, column), open, false)
    }

    fn new((file, column): (PathBuf, String), open: Vec<MarkedKey>, is_timesheet: bool) -> Self {
        let all = open.clone();
        Self { file, column, notes: vec![], is_timesheet, all, open, pinned: 0, gave_way: 0 }
    }

    /// Sets the notes about the file.
    pub(super) fn with_notes(self, notes: Vec<String>) -> Self {
        Self { notes, ..self }
    }

    /// Adds pins, in a layer or in all, for the keys that the sheet of `edits` does not have. Where pins are to be the
    /// only keys, all become pins. Returns whether the sheet is to be made again.
    ///
    /// A key gives way to a pin or a move on its koma.
    pub(super) fn pin(
        &mut self,
        sheet: &Sheet,
        (layer, clock): (Option<&str>, Clock),
        edits: &mut Edits,
    ) -> bool {
        let of_layer =
            |edits: &Edits| layer.map_or_else(|| edits.clone(), |name| edits.of_layer(name));
        let own = of_layer(edits);
        let is_there = |key: &MarkedKey| {
            !edits.only_pins && self.is_as_set(&key.pin, &own) && self.is_on(sheet, layer, key)
        };
        let (there, lost): (Vec<_>, Vec<_>) = self.open.iter().cloned().partition(is_there);
        let (before, count) = (self.pinned, lost.len());
        for MarkedKey { pin, .. } in lost {
            match is_taken(&pin, &of_layer(edits), clock) {
                true => self.gave_way += 1,
                false => {
                    edits.pins_of(layer).push(pin);
                    self.pinned += 1;
                }
            }
        }
        self.open = there;
        self.pinned > before || (edits.only_pins && count > 0)
    }

    /// Whether a pin with a person's name or weight is among the corrections already, or has neither.
    fn is_as_set(&self, pin: &Pin, own: &Edits) -> bool {
        let is_met = |set: &Pin| {
            set.frame == pin.frame
                && (pin.name.is_none() || set.name == pin.name)
                && (pin.weight.is_none() || set.weight == pin.weight)
        };
        let is_plain = pin.name.is_none() && pin.weight.is_none();
        self.is_timesheet
            || is_plain
            || own.pins.iter().any(is_met)
            || own.moves.iter().any(|moved| is_met(&moved.pin()))
    }

    /// Whether a layer, or each, draws a key, and on the koma that is marked if no drawing was there.
    fn is_on(&self, sheet: &Sheet, layer: Option<&str>, key: &MarkedKey) -> bool {
        let is_key = |role: Role| role == Role::Genga || (self.is_timesheet && role.is_kept());
        let draws = |layer: &Layer| {
            layer.changes().any(|(koma, drawing)| {
                let drawing = &layer.drawings[drawing];
                is_key(drawing.role)
                    && drawing.source.place().round() == key.pin.frame.0 as f64
                    && key.koma.is_none_or(|marked| marked == koma)
            })
        };
        let mut meant = sheet.layers.iter().filter(|own| layer.is_none_or(|name| own.name == name));
        meant.all(draws)
    }

    /// Names the genga that were found and are not marked: a person may have taken them out of the file.
    fn unmarked(&self, sheet: &Sheet, layer: Option<&str>) -> Option<String> {
        let own = match (layer, sheet.layers.as_slice()) {
            (None, [only]) => only,
            (None, _) => return None,
            (Some(name), layers) => layers.iter().find(|own| own.name == name)?,
        };
        let found = own.changes().filter_map(|(koma, drawing)| {
            let drawing = &own.drawings[drawing];
            let frame = Frame(drawing.source.place().round() as usize);
            let is_found = drawing.role == Role::Genga && drawing.why.pinned.is_none();
            let is_marked = self.all.iter().any(|key| key.pin.frame == frame);
            (is_found && !is_marked).then_some((sheet.blank.before + koma + 1, frame))
        });
        let found: Vec<(usize, Frame)> = found.collect();
        let (_, frame) = *found.first()?;
        let mut named: Vec<String> = found
            .iter()
            .take(NAMED)
            .map(|(koma, frame)| format!("koma {koma} (frame {frame})"))
            .collect();
        named.extend((found.len() > NAMED).then(|| format!("{} more", found.len() - NAMED)));
        Some(format!(
            "not marked there, and genga all the same: {}; --forbid {frame} takes one away, --only-pins all",
            named.join(", ")
        ))
    }

    /// Names the keys that stand on another koma than the one that was marked, if a genga could stand there.
    fn elsewhere(&self, sheet: &Sheet, layer: Option<&str>) -> Option<String> {
        let is_off = |key: &&MarkedKey| !self.is_on(sheet, layer, key);
        let off = self.all.iter().filter(|key| key.koma.is_some()).filter(is_off);
        let off =
            off.filter_map(|key| Some(format!("koma {}", sheet.blank.before + key.koma? + 1)));
        let off: Vec<String> = off.collect();
        (!off.is_empty()).then(|| {
            format!(
                "marked too near to another genga, a step or an end to stand on its own koma: {}",
                shortened(off).join(", ")
            )
        })
    }

    /// Says what became of the keys.
    pub(super) fn notes(
        self,
        sheet: &Sheet,
        (layer, edits): (Option<&str>, &Edits),
    ) -> Vec<String> {
        let unmarked = self.unmarked(sheet, layer).filter(|_| !edits.only_pins);
        let elsewhere = self.elsewhere(sheet, layer);
        let Self { file, column, open, pinned, gave_way, .. } = self;
        let (file, there) = (file.display(), open.len());
        let mut said = vec![match (pinned + gave_way, there) {
            (_, 0) => format!("pinned from {file}: {} of column {column}", counted(pinned, "key")),
            (0, _) => format!(
                "nothing to pin from {file}: {} of column {column} {} genga already",
                counted(there, "key"),
                be(there)
            ),
            _ => format!(
                "pinned from {file}: {} of column {column}; {} {} genga already",
                counted(pinned, "key"),
                counted(there, "other"),
                be(there)
            ),
        }];
        if gave_way > 0 {
            said.push(format!(
                "{} marked there gave way to pins or moves on the same koma",
                counted(gave_way, "other")
            ));
        }
        said.extend(elsewhere);
        said.extend(unmarked);
        said.extend(self.notes);
        said
    }
}

/// Whether a pin's koma has a pin or a move.
fn is_taken(pin: &Pin, own: &Edits, clock: Clock) -> bool {
    let koma = |frame: Frame| clock.koma_from_frame(frame);
    let moves = own.moves.iter().flat_map(|moved| [moved.from, moved.to]);
    let mut set = own.pins.iter().map(|pin| pin.frame).chain(moves);
    set.any(|frame| koma(frame) == koma(pin.frame))
}

fn be(count: usize) -> &'static str {
    if count == 1 { "is" } else { "are" }
}
