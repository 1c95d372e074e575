//! Numbers that stay (番号): the drawings on screen have those of the sheet that was exported last.

use std::path::Path;

use super::host::Host;
use genga::pipeline::Breakdown;
use genga::sheet::Sheet;

/// The sheet that was exported last, and the one on screen with its numbers.
#[derive(Debug, Default)]
pub(super) struct KeptNumbers {
    before: Option<Sheet>,
    /// `None` if drawings are numbered 1, 2, 3 ….
    numbered: Option<Sheet>,
}

impl KeptNumbers {
    /// Looks for the sheet of a clip in an export folder.
    pub(super) fn find(desk: &dyn Host, folder: &Path, clip: &Path) -> Self {
        Self { before: desk.sheet_in(folder, clip), numbered: None }
    }

    /// Numbers a new sheet.
    pub(super) fn renew(&mut self, sheet: &Sheet) {
        self.numbered = self.before.as_ref().map(|before| {
            let mut sheet = sheet.clone();
            sheet.keep_numbers(before);
            sheet
        });
    }

    /// The results with their numbers.
    pub(super) fn on<'a>(&'a self, breakdown: Breakdown<'a>) -> Breakdown<'a> {
        self.numbered.as_ref().map_or(breakdown, |sheet| breakdown.with_sheet(sheet))
    }
}
