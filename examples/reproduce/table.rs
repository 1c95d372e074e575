//! A Markdown table.

use std::fmt::Write;

/// A table that grows row by row.
pub(crate) struct Table(String);

impl Table {
    /// Begins a table with a header; a name that begins with `>` makes a column of numbers.
    pub(crate) fn new(header: &[&str]) -> Self {
        let names: Vec<String> =
            header.iter().map(|name| name.trim_start_matches('>').to_owned()).collect();
        let mut table = Self(String::new());
        table.row(&names);
        let rule = |name: &&str| if name.starts_with('>') { "---:" } else { "---" }.to_owned();
        table.row(&header.iter().map(rule).collect::<Vec<_>>());
        table
    }

    /// Adds a row.
    pub(crate) fn row(&mut self, cells: &[String]) {
        writeln!(self.0, "| {} |", cells.join(" | ")).expect("a String takes everything");
    }

    /// The text; each line ends with a newline.
    pub(crate) fn text(self) -> String {
        self.0
    }
}

/// Formats a number with the given decimals; −0 as 0.
pub(crate) fn number(value: f64, places: usize) -> String {
    let text = format!("{value:.places$}");
    let is_zero = text.trim_matches(['-', '0', '.']).is_empty();
    if is_zero { text.trim_start_matches('-').to_owned() } else { text }
}

/// Formats a share in whole %.
pub(crate) fn percent(share: f64) -> String {
    format!("{} %", number(100.0 * share, 0))
}

/// Formats a distance with its sign, so that early and late can be told apart.
pub(crate) fn signed(value: i64) -> String {
    match value {
        0 => "0".into(),
        early if early < 0 => format!("−{}", early.unsigned_abs()),
        late => format!("+{late}"),
    }
}

/// Smallest, median (mean of both middle values of an even number) and largest.
pub(crate) fn spread(values: impl IntoIterator<Item = f64>) -> [f64; 3] {
    let mut values: Vec<f64> = values.into_iter().collect();
    values.sort_by(f64::total_cmp);
    let (low, high) = ((values.len() - 1) / 2, values.len() / 2);
    [values[0], 0.5 * (values[low] + values[high]), values[values.len() - 1]]
}
