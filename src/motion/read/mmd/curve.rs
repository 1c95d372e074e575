//! The curves (補間曲線) by which MMD goes from key to key.

/// A curve from (0, 0) to (1, 1) with two handles: Bézier's, of the third degree.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Curve {
    x: [f64; 2],
    y: [f64; 2],
}

/// The largest value of a handle.
const WHOLE: f64 = 127.0;

/// Halvings until the place on a curve is as exact as a number can be.
const HALVINGS: usize = 52;

impl Curve {
    /// The curve of four bytes: x and y of one handle, x and y of the other.
    pub(super) fn of([x1, y1, x2, y2]: [u8; 4]) -> Self {
        let part = |byte: u8| (f64::from(byte) / WHOLE).min(1.0);
        Self { x: [part(x1), part(x2)], y: [part(y1), part(y2)] }
    }

    /// How much of the way is done when that share of the time is over.
    pub(super) fn done(&self, share: f64) -> f64 {
        if self.x == self.y || share <= 0.0 || share >= 1.0 {
            return share.clamp(0.0, 1.0);
        }
        // Handles are within the time, so that it only grows along the curve.
        let (mut low, mut high) = (0.0, 1.0);
        for _ in 0..HALVINGS {
            let middle = 0.5 * (low + high);
            if at(self.x, middle) < share {
                low = middle;
            } else {
                high = middle;
            }
        }
        at(self.y, 0.5 * (low + high))
    }
}

/// A coordinate of the curve at a place along it.
fn at([a, b]: [f64; 2], t: f64) -> f64 {
    let s = 1.0 - t;
    t * (3.0 * s * s * a + t * (3.0 * s * b + t))
}
