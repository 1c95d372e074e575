//! The sheet as timesheet programs write tables: a row a koma, a column a layer.

use std::iter::{once, repeat_n};

use crate::deliver::CsvText;
use crate::error::Error;
use crate::sheet::{Layer, Sheet};

/// Where an inbetween begins in the column of the genga.
const INBETWEEN: &str = "○";
/// Nothing is shown.
const BLANK: &str = "×";

/// The sheet as Clip Studio Paint writes it: two rows of names, then a row a koma, from 1, every cell quoted. A column
/// a layer for 原画 (genga numbers and `○`) and one for 動画 (drawing numbers), named in the first row where they
/// begin. An empty cell goes on with what stands above it; `×` is a layer that has ended.
///
/// # Errors
/// [`Error::Sheet`] as [`Sheet::check`].
pub fn columns_csv(sheet: &Sheet) -> Result<String, Error> {
    sheet.check()?;
    let genga = sheet.layers.iter().map(|layer| {
        let numbers = layer.genga_numbers();
        column(layer, sheet.length(), |drawing| {
            numbers[drawing].map_or(INBETWEEN.into(), |number| number.to_string())
        })
    });
    let douga = sheet.layers.iter();
    let douga =
        douga.map(|layer| column(layer, sheet.length(), |drawing| (drawing + 1).to_string()));
    let columns: Vec<Vec<String>> = genga.chain(douga).collect();
    let group = |name| {
        let others = sheet.layers.len().saturating_sub(1);
        once(name).chain(repeat_n("", others))
    };
    let names = || sheet.layers.iter().map(|layer| &layer.name[..]);
    let mut table = CsvText::new(csv::QuoteStyle::Always);
    table.row(once("Frame").chain(group("原画")).chain(group("動画")))?;
    table.row(once("").chain(names()).chain(names()))?;
    for koma in 0..sheet.length() {
        let number = (koma + 1).to_string();
        table.row(once(&number).chain(columns.iter().map(|column| &column[koma])))?;
    }
    table.text()
}

/// What changes on a layer, koma by koma.
fn column(layer: &Layer, length: usize, label: impl Fn(usize) -> String) -> Vec<String> {
    let mut cells = vec![String::new(); length];
    for (koma, drawing) in layer.changes() {
        cells[koma] = label(drawing);
    }
    if layer.length() < length {
        cells[layer.length()] = BLANK.into();
    }
    cells
}
