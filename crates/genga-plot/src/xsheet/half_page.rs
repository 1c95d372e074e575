//! Places a half of a page (three seconds) and its columns.

/// Number of koma in a half: three seconds.
pub(super) const ROWS: usize = 72;
/// Height of a koma, in px.
pub(super) const ROW: f64 = 17.0;
/// Y at which the first koma begins, in px.
pub(super) const TOP: f64 = 146.0;

/// A half of a page: its left edge and its first koma.
#[derive(Clone, Copy)]
pub(super) struct Half {
    pub(super) left: f64,
    pub(super) begin: usize,
}

/// A column of cels on a half.
#[derive(Clone, Copy)]
pub(super) struct Place {
    pub(super) left: f64,
    pub(super) width: f64,
}

impl Half {
    pub(super) fn end(self) -> usize {
        self.begin + ROWS
    }

    /// Returns the y at which a koma of this half begins.
    pub(super) fn y(self, koma: usize) -> f64 {
        self.y_at(koma as f64)
    }

    /// Returns the y of a fractional koma.
    pub(super) fn y_at(self, koma: f64) -> f64 {
        TOP + (koma - self.begin as f64) * ROW
    }

    pub(super) fn shows(self, koma: usize) -> bool {
        (self.begin..self.end()).contains(&koma)
    }
}

impl Place {
    pub(super) fn middle(self) -> f64 {
        self.left + 0.5 * self.width
    }
}
