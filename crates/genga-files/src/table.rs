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

/// Tells by the first line what separates the fields of a table: a comma, a semicolon or a tab.
pub fn delimiter(text: &str) -> u8 {
    let header = text.lines().next().unwrap_or_default();
    let count = |byte: &u8| header.bytes().filter(|other| other == byte).count();
    // On a tie the last one wins: a comma if there is only one column.
    [b'\t', b';', b','].into_iter().max_by_key(count).unwrap_or(b',')
}

/// Reads a table whose fields are separated by commas, semicolons or tabs, depending on the program that saved it. Rows
/// may be of different lengths.
pub(super) fn table_reader(text: &str) -> csv::Reader<&[u8]> {
    let mut reader = csv::ReaderBuilder::new();
    reader
        .delimiter(delimiter(text))
        .trim(csv::Trim::All)
        .flexible(true)
        .from_reader(text.as_bytes())
}

/// Formats a number for tables: the shortest form that reads back as the same value, −0 as 0.
pub(super) fn number(value: f64) -> String {
    (value + 0.0).to_string()
}
