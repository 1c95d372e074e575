//! Stills: the positions of all joints in each drawing, computed once, and the distance between two drawings.

use std::array;

use glam::DVec3;
use rayon::prelude::*;

use crate::motion::clip::lane_poser::LanePoser;
use crate::motion::lanes::{LANES, Lanes, wide};
use crate::motion::{Clip, Screen};
use crate::sheet::{Layer, Source};

/// Number of drawings that are posed in sequence by one worker.
const PIECE: usize = 32 * LANES;

/// Coordinates side by side, so that distances are computed several at a time.
type Row = [Lanes; 2];

/// The joints' positions in a layer's drawings (静止画), in the world or on a screen, in the file's unit. The omission
/// stages measure movement over the whole body by them.
#[derive(Debug, Clone, PartialEq)]
pub struct Stills {
    joints: usize,
    drawings: usize,
    /// The source of each drawing; empty for drawings that were [pushed](Self::push).
    sources: Vec<Source>,
    /// x, y, z of each joint, drawing by drawing, each drawing padded with zeros to whole rows.
    coordinates: Vec<Row>,
}

impl Stills {
    /// Creates stills of `joints` joints each, without a drawing.
    pub fn new(joints: usize) -> Self {
        Self { joints, drawings: 0, sources: Vec::new(), coordinates: Vec::new() }
    }

    /// Like [`Stills::on`], in the world instead of on a screen.
    ///
    /// # Panics
    /// When there is a drawing but the clip has no frame.
    pub fn from_layer(clip: &Clip, layer: &Layer) -> Self {
        Self::on(clip, layer, &Screen::WORLD)
    }

    /// Computes the positions of each drawing of a layer, in its order, sampled at its place in the clip. A blend of
    /// two keys is posed as a blend.
    ///
    /// # Panics
    /// When there is a drawing but the clip has no frame.
    pub fn on(clip: &Clip, layer: &Layer, screen: &Screen) -> Self {
        Self::posed(clip, sources(layer), screen)
    }

    /// Like [`Stills::on`], reusing these stills of another layer of the same clip on the same screen: a drawing in
    /// both layers is not posed again.
    pub(crate) fn again(self, clip: &Clip, layer: &Layer, screen: &Screen) -> Self {
        let (sources, mut at) = (sources(layer), 0);
        let known = |source: &Source| {
            at += self.sources[at..].iter().take_while(|own| own.place() < source.place()).count();
            (self.sources.get(at) == Some(source)).then_some(at)
        };
        let known: Vec<Option<usize>> = sources.iter().map(known).collect();
        let others = sources.iter().zip(&known).filter(|(_, known)| known.is_none());
        let posed = Self::posed(clip, others.map(|(source, _)| *source).collect(), screen);
        let mut coordinates = Vec::with_capacity(self.width() * sources.len());
        let mut others = 0..posed.len();
        for known in known {
            let row = match known {
                Some(at) => self.row(at),
                None => posed.row(others.next().expect("what is not known was posed")),
            };
            coordinates.extend_from_slice(row);
        }
        Self { joints: self.joints, drawings: sources.len(), sources, coordinates }
    }

    fn posed(clip: &Clip, sources: Vec<Source>, screen: &Screen) -> Self {
        let mut stills = Self { drawings: sources.len(), ..Self::new(clip.skeleton().len()) };
        let width = stills.width();
        stills.coordinates = vec![Row::default(); width * sources.len()];
        // Each piece has its own poser, so the result does not depend on the thread.
        let pieces = stills.coordinates.par_chunks_mut((width * PIECE).max(1));
        pieces.zip(sources.par_chunks(PIECE)).for_each(|(rows, sources)| {
            let mut poser = LanePoser::new(clip);
            let rows = rows.chunks_mut(width * LANES);
            rows.zip(sources.chunks(LANES)).for_each(|(rows, sources)| {
                let last = sources.len() - 1;
                let sources = array::from_fn(|lane| sources[lane.min(last)]);
                wide(
                    #[inline(always)]
                    || {
                        poser.drawings(sources);
                        poser.stand();
                    },
                );
                for (lane, row) in rows.chunks_mut(width).enumerate() {
                    let places = poser.pose().translations.iter().map(|place| place.lane(lane));
                    write(row, places.map(|place| screen.see(place)));
                }
            });
        });
        Self { sources, ..stills }
    }

    /// Adds a drawing.
    ///
    /// # Panics
    /// Unless there is one position per joint.
    pub fn push(&mut self, positions: &[DVec3]) {
        assert_eq!(positions.len(), self.joints, "a drawing has one position a joint");
        self.add(positions.iter().copied());
    }

    fn add(&mut self, positions: impl Iterator<Item = DVec3>) {
        let begin = self.coordinates.len();
        self.coordinates.resize(begin + self.width(), Row::default());
        write(&mut self.coordinates[begin..], positions);
        self.drawings += 1;
    }

    /// Returns the number of drawings.
    pub fn len(&self) -> usize {
        self.drawings
    }

    /// Whether there is no drawing.
    pub fn is_empty(&self) -> bool {
        self.drawings == 0
    }

    /// Returns the distance between two drawings (KKMFT §3.1): the sum over the joints of the squared distance between
    /// their positions, in the file's unit squared. The order of summation is fixed.
    ///
    /// # Panics
    /// When there is no such drawing.
    pub fn ssd(&self, a: usize, b: usize) -> f64 {
        let mut sums = Row::default();
        for (a, b) in self.row(a).iter().zip(self.row(b)) {
            for ((sum, a), b) in sums.iter_mut().zip(a).zip(b) {
                let apart = *a - *b;
                *sum = *sum + apart * apart;
            }
        }
        sums.iter().flat_map(|sum| sum.0).sum()
    }

    /// Returns the number of joints.
    pub fn joints(&self) -> usize {
        self.joints
    }

    /// Returns the position of a joint in a drawing, in the file's unit.
    ///
    /// # Panics
    /// When there is no such drawing or joint.
    pub fn position(&self, drawing: usize, joint: usize) -> DVec3 {
        assert!(joint < self.joints, "there is such a joint");
        let of = |at: usize| self.row(drawing)[at / (2 * LANES)][at / LANES % 2].0[at % LANES];
        DVec3::from_array([0, 1, 2].map(|axis| of(3 * joint + axis)))
    }

    fn width(&self) -> usize {
        (3 * self.joints).div_ceil(2 * LANES)
    }

    fn row(&self, drawing: usize) -> &[Row] {
        let width = self.width();
        &self.coordinates[drawing * width..(drawing + 1) * width]
    }
}

/// Returns the sources of a layer's drawings, in its order.
fn sources(layer: &Layer) -> Vec<Source> {
    layer.drawings.iter().map(|drawing| drawing.source).collect()
}

/// Writes the joints' positions into the row of a drawing.
fn write(row: &mut [Row], positions: impl Iterator<Item = DVec3>) {
    let values = row.iter_mut().flatten().flat_map(|lanes| &mut lanes.0);
    let coordinates = positions.flat_map(|position| position.to_array());
    values.zip(coordinates).for_each(|(value, coordinate)| *value = coordinate);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::motion::{Axis, Channel, Joint, JointId, Skeleton};
    use crate::sheet::{Drawing, Role, Why};
    use crate::time::{Frame, FrameRate};

    /// Builds a root that walks along x with an arm of length 1 that turns about z.
    fn arm(rows: &[[f64; 2]]) -> Clip {
        let joint = |parent, offset, channel, first_channel| Joint {
            name: "joint".into(),
            parent,
            offset,
            channels: vec![channel],
            first_channel,
            end_sites: vec![],
        };
        let tip = Joint {
            channels: vec![],
            ..joint(Some(JointId(1)), DVec3::Y, Channel::Position(Axis::X), 2)
        };
        let joints = vec![
            joint(None, DVec3::ZERO, Channel::Position(Axis::X), 0),
            joint(Some(JointId(0)), DVec3::ZERO, Channel::Rotation(Axis::Z), 1),
            tip,
        ];
        let rate = FrameRate::new(24.0).unwrap();
        let values = rows.as_flattened().to_vec();
        Clip::new(Skeleton { joints }, rate, Frame(5), rows.len(), values).unwrap()
    }

    fn layer(sources: &[Source]) -> Layer {
        let drawing = |&source| Drawing::new(source, Role::Inbetween, Why::default());
        Layer {
            name: "A".into(),
            joints: vec![],
            drawings: sources.iter().map(drawing).collect(),
            exposures: vec![],
            gone: vec![],
        }
    }

    #[test]
    fn a_still_stands_where_its_source_does() {
        let clip = arm(&[[0.0, 0.0], [1.0, 90.0], [2.0, 90.0]]);
        let key = |from, to, share| Source::Between { from, to, share };
        let sources = [
            Source::At(5.0),
            Source::At(6.0),
            Source::At(5.5),
            key(5.0, 7.0, 0.5),
            key(5.0, 6.0, 0.5),
        ];
        let stills = Stills::from_layer(&clip, &layer(&sources));
        assert_eq!(stills.len(), 5);
        let near = |found: f64, expected: f64| assert!((found - expected).abs() < 1e-12, "{found}");
        // Root and elbow move by 1; the tip goes from (0, 1) to (0, 0).
        near(stills.ssd(0, 1), 3.0);
        // Half way: root and elbow move by 0.5, the tip from (0, 1) to (0.5 − sin 45°, cos 45°).
        let half = 0.5_f64.sqrt();
        near(stills.ssd(0, 2), 0.5 + (0.5 - half).powi(2) + (1.0 - half).powi(2));
        near(stills.ssd(0, 3), 2.0 + (1.0 - half).powi(2) + (1.0 - half).powi(2));
        near(stills.ssd(2, 4), 0.0);
    }

    #[test]
    fn stills_that_are_there_already_are_those_that_would_be_made() {
        let clip = arm(&[[0.0, 0.0], [1.0, 90.0], [2.0, 90.0], [5.0, 20.0]]);
        let key = |from, to, share| Source::Between { from, to, share };
        let layers = [
            layer(&[5.0, 5.5, 6.0, 7.0].map(Source::At)),
            layer(&[Source::At(5.0), key(5.0, 6.0, 0.5), Source::At(6.5), Source::At(7.0)]),
            layer(&[Source::At(7.0), Source::At(5.0), Source::At(8.0)]),
            layer(&[]),
        ];
        for [one, other] in
            layers.each_ref().map(|one| layers.each_ref().map(|other| [one, other])).concat()
        {
            let again = Stills::from_layer(&clip, one).again(&clip, other, &Screen::WORLD);
            assert_eq!(again, Stills::from_layer(&clip, other));
        }
    }

    #[test]
    fn the_distance_is_the_plain_sum_for_every_number_of_joints() {
        for joints in 0..40 {
            let position = |seed: usize| {
                let at = |k: usize| ((seed * 31 + k * 17) % 23) as f64 - 11.0;
                DVec3::new(at(0), at(1), at(2))
            };
            let a: Vec<_> = (0..joints).map(position).collect();
            let b: Vec<_> = (joints..2 * joints).map(position).collect();
            let mut stills = Stills::new(joints);
            stills.push(&a);
            stills.push(&b);
            let plain: f64 = a.iter().zip(&b).map(|(a, b)| a.distance_squared(*b)).sum();
            assert_eq!(stills.ssd(0, 1), plain, "{joints} joints, whole numbers are exact");
            assert_eq!(stills.ssd(1, 0), plain);
            assert_eq!(stills.ssd(1, 1), 0.0);
        }
    }

    #[test]
    fn a_layer_without_drawings_has_no_stills() {
        let stills = Stills::from_layer(&arm(&[]), &layer(&[]));
        assert!(stills.is_empty());
    }
}
