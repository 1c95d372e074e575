//! Tables for people: columns that line up, Japanese words among them.

/// Rows of cells.
#[derive(Debug, Default)]
pub(super) struct Table(Vec<Vec<String>>);

impl Table {
    /// Adds a row.
    pub(super) fn row<Cell: Into<String>>(&mut self, cells: impl IntoIterator<Item = Cell>) {
        self.0.push(cells.into_iter().map(Into::into).collect());
    }

    /// The text, two blanks between columns: the first `left` of them begin in line, the others end so.
    pub(super) fn text(&self, left: usize) -> String {
        let columns = self.0.iter().map(Vec::len).max().unwrap_or(0);
        let widest = |column: usize| {
            self.0.iter().filter_map(|row| row.get(column)).map(|cell| width(cell)).max()
        };
        let widths: Vec<usize> = (0..columns).map(|column| widest(column).unwrap_or(0)).collect();
        let mut text = String::new();
        for row in &self.0 {
            let mut line = String::new();
            for (column, cell) in row.iter().enumerate() {
                let blanks = " ".repeat(widths[column] - width(cell));
                let gap = if column > 0 { "  " } else { "" };
                line += gap;
                line += &if column < left {
                    format!("{cell}{blanks}")
                } else {
                    format!("{blanks}{cell}")
                };
            }
            text += line.trim_end();
            text.push('\n');
        }
        text
    }
}

/// How many places a word takes on a screen: two a letter from the Japanese kana and signs on.
fn width(word: &str) -> usize {
    word.chars().map(|letter| if letter >= '\u{2e80}' { 2 } else { 1 }).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_line_up_whatever_they_are_written_in() {
        let mut table = Table::default();
        table.row(["genga", "原画のみ", "12"]);
        table.row(["on screen", "画面", "1.25"]);
        table.row(["none"]);
        assert_eq!(table.text(2), "genga      原画のみ    12\non screen  画面      1.25\nnone\n");
        assert_eq!(Table::default().text(1), "");
    }
}
