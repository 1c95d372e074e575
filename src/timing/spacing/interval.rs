//! The time between two neighbouring keys, and the source places of its inbetweens.

use super::{InbetweenSource, Spacing, Station};
use crate::keys::Wall;
use crate::sheet::{Drawing, Role, Source, Why};
use crate::time::Clock;
use crate::timing::ByPassage;
use crate::timing::koma_per_drawing::STAY;

/// The largest weight that dragging can set: at 1 all inbetweens would be the key itself.
const MOST_WEIGHT: f64 = 0.95;

/// The time between two neighbouring stations, with the rule of its spacing.
pub(super) struct Interval<'a> {
    spacing: &'a ByPassage<Spacing>,
    koma: [usize; 2],
    places: [f64; 2],
    weights: [f64; 2],
    /// The strongest wall strictly between the two, if any.
    wall: Option<f64>,
    /// How far either key may pull an inbetween, in frames.
    max_shifts: [f64; 2],
}

impl<'a> Interval<'a> {
    pub(super) fn new(
        spacing: &'a ByPassage<Spacing>,
        from: &Station<'_>,
        to: &Station<'_>,
        walls: &[Wall],
        clock: Clock,
    ) -> Self {
        let begin = walls.partition_point(|wall| wall.frame.0 as f64 <= from.place);
        let before_next = |wall: &&Wall| (wall.frame.0 as f64) < to.place;
        // `reduce` with a strict comparison keeps the earlier of two equals.
        let wall = walls[begin..]
            .iter()
            .take_while(before_next)
            .reduce(|a, b| if b.strength > a.strength { b } else { a });
        let weight = |station: &Station<'_>| {
            let own = station.key.and_then(|key| key.weight);
            own.unwrap_or(spacing.at(station.koma).weight)
        };
        let max_shift =
            |station: &Station<'_>| spacing.at(station.koma).max_shift * clock.frames_in_koma();
        Self {
            spacing,
            koma: [from.koma, to.koma],
            places: [from.place, to.place],
            weights: [weight(from), weight(to)],
            wall: wall.map(|wall| wall.frame.0 as f64),
            max_shifts: [max_shift(from), max_shift(to)],
        }
    }

    /// Returns the inbetween on a koma that stays for `stay` koma.
    pub(super) fn inbetween(&self, koma: usize, stay: usize) -> Drawing {
        let [from, to] = self.places;
        let place = self.place(koma, stay);
        let source = match self.spacing.at(koma).source {
            InbetweenSource::Sample => Source::At(place),
            InbetweenSource::Blend => {
                Source::Between { from, to, share: (place - from) / (to - from) }
            }
        };
        Drawing::new(source, Role::Inbetween, Why::default())
    }

    /// Returns the source place of an inbetween on a koma, drawn towards the key on its side.
    fn place(&self, koma: usize, stay: usize) -> f64 {
        let [from, to] = self.places;
        let share = self.share(koma, stay);
        let (side, shifted) = match self.side(share) {
            Some(0) => (0, share * (1.0 - self.weights[0])),
            Some(_) => (1, 1.0 - (1.0 - share) * (1.0 - self.weights[1])),
            None => return self.even(share),
        };
        self.bounded(from + shifted * (to - from), share, side)
    }

    /// Returns the weight that takes an inbetween on a koma to a place, and its key: 0 for the key before, 1 for the
    /// key after. `None` on a key, in the middle, and if both show one place.
    pub(super) fn weight_at(&self, koma: usize, stay: usize, place: f64) -> Option<(usize, f64)> {
        let [from, to] = self.places;
        let share = self.share(koma, stay);
        let side = self.side(share)?;
        let (key, even) = ([from, to][side], self.even(share));
        let left = (self.bounded(place, share, side) - key) / (even - key);
        (even != key).then_some((side, (1.0 - left).clamp(0.0, MOST_WEIGHT)))
    }

    /// Returns the elapsed share of the time, 0 to 1, for a drawing that stays `stay` koma. A drawing shows the middle
    /// of its exposure, as a key that stays for two koma does. A hold in a rest shows its begin.
    fn share(&self, koma: usize, stay: usize) -> f64 {
        let [from, to] = self.koma;
        // Most koma that a drawing stays while the body moves.
        let longest = self.spacing.at(koma).on.most + STAY - 1;
        let middle = stay.min(longest).saturating_sub(STAY) as f64 / 2.0;
        ((koma - from) as f64 + middle) / (to - from) as f64
    }

    /// Returns the place without any weight.
    fn even(&self, share: f64) -> f64 {
        let [from, to] = self.places;
        from + share * (to - from)
    }

    /// Returns the side of the nearer key, or, if there is a wall, the side of the wall; `None` in the middle.
    fn side(&self, share: f64) -> Option<usize> {
        let even = self.even(share);
        let side = match self.wall {
            Some(wall) if (even - wall).abs() < 1e-9 => 0.0,
            Some(wall) => even - wall,
            None => share - 0.5,
        };
        (side != 0.0).then_some(usize::from(side > 0.0))
    }

    /// Clamps a place around the even place. Clamping around the koma's own instant would be wrong: a key may stand
    /// half a koma off its instant, and the clamp must not push an inbetween past it.
    fn bounded(&self, place: f64, share: f64, side: usize) -> f64 {
        let (even, max_shift) = (self.even(share), self.max_shifts[side]);
        place.clamp(even - max_shift, even + max_shift)
    }
}
