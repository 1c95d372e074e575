//! The sheet as a table of the kind timesheet programs write: a row per koma, a column per layer.

use std::iter::{once, repeat_n};

use crate::CsvText;
use genga::error::Error;
use genga::sheet::{Layer, Number, Sheet};

/// Marks the first koma of an inbetween in the genga column.
const INBETWEEN: &str = "○";
/// Marks the koma from which nothing is shown.
const BLANK: &str = "×";

/// Writes the sheet as Clip Studio Paint does: two header rows, then one row per koma, from 1, every cell quoted.
/// Each layer has a column in the group 原画 (genga numbers and `○`) and one in the group 動画 (drawing numbers);
/// the first header row names a group where it begins. An empty cell continues the drawing above; `×` begins
/// blank koma, before a layer enters or once it has ended.
///
/// # Errors
/// [`Error::Sheet`] as [`Sheet::check`].
pub fn columns_csv(sheet: &Sheet) -> Result<String, Error> {
    sheet.check()?;
    let genga = sheet.layers.iter().map(|layer| {
        let numbers = layer.genga_numbers();
        column(sheet, layer, |drawing| {
            numbers[drawing].as_ref().map_or(INBETWEEN.into(), Number::to_string)
        })
    });
    let douga = sheet.layers.iter().map(|layer| {
        let numbers = layer.numbers();
        column(sheet, layer, |drawing| numbers[drawing].to_string())
    });
    let columns: Vec<Vec<String>> = genga.chain(douga).collect();
    let group = |name| {
        let others = sheet.layers.len().saturating_sub(1);
        once(name).chain(repeat_n("", others))
    };
    let names = || sheet.layers.iter().map(|layer| &layer.name[..]);
    let mut table = CsvText::new(csv::QuoteStyle::Always);
    table.row(once("Frame").chain(group("原画")).chain(group("動画")))?;
    table.row(once("").chain(names()).chain(names()))?;
    for koma in 0..sheet.cut_length() {
        let number = (koma + 1).to_string();
        table.row(once(&number).chain(columns.iter().map(|column| &column[koma])))?;
    }
    table.text()
}

/// The cells of a layer's column: a label on each koma where the drawing changes.
fn column(sheet: &Sheet, layer: &Layer, label: impl Fn(usize) -> String) -> Vec<String> {
    let before = sheet.blank.before;
    let mut cells = vec![String::new(); sheet.cut_length()];
    if before > 0 {
        cells[0] = BLANK.into();
    }
    for (koma, drawing) in layer.changes() {
        cells[before + koma] = label(drawing);
    }
    if let Some(end) = cells.get_mut(before + layer.length()) {
        *end = BLANK.into();
    }
    cells
}
