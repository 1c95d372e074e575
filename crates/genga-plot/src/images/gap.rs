//! The gap (隙間) between the cels of two columns that meet at a joint, laid over each other as the sheet says.

use glam::DVec3;

use crate::drawings::composed;
use crate::figure::{Figure, FigureBody};
use crate::points::Showing;
use genga::error::Error;
use genga::motion::{Clip, layer_of};
use genga::sheet::{Layer, Sheet};

/// Gaps that are seen, in % of body height.
const SEEN: f64 = 2.0;

/// The widest gap between the cels of two columns.
///
/// A cel is drawn where the body stands on the first koma that shows it. If the column that it hangs on is drawn anew
/// while it stays, they do not meet.
#[derive(Debug, Clone, PartialEq)]
pub struct CelGap {
    /// Width in % of body height.
    pub percent: f64,
    /// A koma on which it is so wide, from 0 at the first drawing.
    pub koma: usize,
    /// Indices of the two layers, the one that hangs on the other first.
    pub layers: [usize; 2],
    /// Number of koma on which some gap is wider than 2 % of body height.
    pub seen: usize,
}

impl CelGap {
    /// Finds the widest gap on a sheet. `None` if no gap is wider than 2 % of body height, or if the sheet is a loop, on
    /// which the columns begin their rounds together.
    ///
    /// # Errors
    /// [`Error::Sheet`] or [`Error::Picture`] if clip and sheet have nothing to show.
    pub fn widest(clip: &Clip, sheet: &Sheet) -> Result<Option<Self>, Error> {
        let of = layer_of(clip.skeleton(), sheet)?;
        let joints = clip.skeleton().joints.iter().enumerate();
        let hung =
            joints.filter_map(|(joint, data)| Some((joint, [of[joint], of[data.parent?.0]])));
        let hung: Vec<(usize, [usize; 2])> = hung.filter(|(_, [own, on])| own != on).collect();
        if hung.is_empty() || sheet.repeat.is_some() {
            return Ok(None);
        }
        let drawn: Vec<Vec<usize>> = sheet.layers.iter().map(drawn_at).collect();
        let composite = composed(clip, sheet)?;
        let mut showing = Showing::new(&composite, &[]);
        let place = |(koma, drawing)| {
            let points = showing.points(drawing, koma);
            hung.iter().map(|(joint, _)| points[*joint]).collect()
        };
        let places: Vec<Vec<DVec3>> = composite.layer().koma().enumerate().map(place).collect();
        let percent = 100.0 / Figure::new(clip, FigureBody::Sticks).height;
        let mut widest = Self { percent: 0.0, koma: 0, layers: [0, 0], seen: 0 };
        for koma in 0..places.len() {
            let mut is_seen = false;
            for (at, (_, layers)) in hung.iter().enumerate() {
                let ends =
                    layers.map(|layer| drawn[layer].get(koma).map(|drawn| places[*drawn][at]));
                let [Some(own), Some(on)] = ends else { continue };
                let gap = percent * own.distance(on);
                is_seen |= gap > SEEN;
                if gap > widest.percent {
                    widest = Self { percent: gap, koma, layers: *layers, ..widest };
                }
            }
            widest.seen += usize::from(is_seen);
        }
        Ok((widest.seen > 0).then_some(widest))
    }
}

/// Returns for each koma the first one that shows its drawing, on which its cel is drawn.
fn drawn_at(layer: &Layer) -> Vec<usize> {
    let first = layer.first_koma();
    layer.koma().filter_map(|drawing| first[drawing]).collect()
}
