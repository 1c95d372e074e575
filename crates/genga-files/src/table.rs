//! CSV tables.

use genga::error::Error;
use genga::sanitize::cell;

/// Writes a CSV table (RFC 4180, LF, UTF-8) from a header and rows.
pub(super) fn csv_table<Row>(
    header: &[&str],
    rows: impl IntoIterator<Item = Row>,
) -> Result<String, Error>
where
    Row: IntoIterator<Item = String>,
{
    let mut table = CsvText::new(csv::QuoteStyle::Necessary);
    table.row(header)?;
    for row in rows {
        table.row(row)?;
    }
    table.text()
}

/// A CSV table written row by row. Cells are escaped so that no spreadsheet takes them for formulas.
pub(super) struct CsvText(csv::Writer<Vec<u8>>);

impl CsvText {
    pub(super) fn new(quotes: csv::QuoteStyle) -> Self {
        Self(csv::WriterBuilder::new().quote_style(quotes).from_writer(Vec::new()))
    }

    /// Adds a row.
    ///
    /// # Errors
    /// [`Error::Encoding`] if the row is longer or shorter than the first.
    pub(super) fn row(&mut self, cells: impl IntoIterator<Item: AsRef<str>>) -> Result<(), Error> {
        for text in cells {
            self.0.write_field(&*cell(text.as_ref())).map_err(Self::failed)?;
        }
        self.0.write_record(None::<&[u8]>).map_err(Self::failed)
    }

    pub(super) fn text(self) -> Result<String, Error> {
        let bytes = self.0.into_inner().map_err(|error| Self::failed(error.into_error().into()))?;
        Ok(String::from_utf8(bytes).expect("only text was written"))
    }

    fn failed(error: csv::Error) -> Error {
        Error::Encoding { what: "a table", source: error.into() }
    }
}

/// Formats a number for tables: the shortest form that reads back as the same value, −0 as 0.
pub(super) fn number(value: f64) -> String {
    (value + 0.0).to_string()
}
