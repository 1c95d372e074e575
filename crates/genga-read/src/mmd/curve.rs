//! Evaluates MMD's interpolation curves (補間曲線) between keys.

/// A cubic Bézier curve from (0, 0) to (1, 1) with two handles.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Curve {
    x: [f64; 2],
    y: [f64; 2],
}

/// The largest value of a handle.
const WHOLE: f64 = 127.0;

/// Number of bisection steps, enough to reach the precision of an `f64`.
const HALVINGS: usize = 52;

impl Curve {
    /// Creates the curve from four bytes: x and y of one handle, x and y of the other.
    pub(super) fn from_bytes([x1, y1, x2, y2]: [u8; 4]) -> Self {
        let part = |byte: u8| (f64::from(byte) / WHOLE).min(1.0);
        Self { x: [part(x1), part(x2)], y: [part(y1), part(y2)] }
    }

    /// The share of the way covered after a share of the time.
    pub(super) fn done(&self, share: f64) -> f64 {
        if self.x == self.y || share <= 0.0 || share >= 1.0 {
            return share.clamp(0.0, 1.0);
        }
        // The handles lie within the time span, so time increases along the curve and can be bisected.
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

/// A coordinate of the curve at the parameter `t`.
fn at([a, b]: [f64; 2], t: f64) -> f64 {
    let s = 1.0 - t;
    t * (3.0 * s * s * a + t * (3.0 * s * b + t))
}
