//! Source time of the koma: how far the take has come while a drawing is held.

use std::ops::Range;

use super::{Drawing, Layer, Reason, Sheet};
use crate::time::Clock;

impl Sheet {
    /// Returns the layer whose time is the sheet's: that with the most koma, of several the first. `None` without layers.
    pub fn longest_layer(&self) -> Option<&Layer> {
        // The last of equal elements wins, so the order is reversed.
        self.layers.iter().rev().max_by_key(|layer| layer.length())
    }

    /// Returns the place in the source that each koma of the [longest layer](Self::longest_layer) shows. Blank koma do not
    /// count. [`Layer::source_places`] says how.
    ///
    /// # Panics
    ///
    /// If that layer shows a drawing that it does not have.
    pub fn source_places(&self) -> Vec<f64> {
        self.longest_layer().map_or_else(Vec::new, |layer| layer.source_places(self.clock))
    }
}

impl Layer {
    /// Returns the place in the source that each koma of the layer shows, as a fractional frame number. `clock` is that
    /// of the sheet.
    ///
    /// The take goes on at its own pace as long as its genga are on screen when it passes them, within a koma: spacing
    /// and omission do not disturb it. Up to a genga that comes at another time, the place goes evenly from drawing to
    /// drawing; then the take goes on from there. Before a drawing that lies earlier in the source (a repeat begins
    /// again), and at the end of a sheet that does not keep the take's time, it goes no further than the drawing that
    /// is held. It never runs back.
    ///
    /// # Panics
    ///
    /// If the layer shows a drawing that it does not have.
    ///
    /// ```
    /// use genga::sheet::{Exposure, Sheet};
    /// use genga::time::{Clock, Frame, FrameRate};
    ///
    /// let clock = Clock { first: Frame(0), frame_rate: FrameRate::new(24.0)?, koma_rate: 24.0 };
    /// let mut layer = Sheet::on_ones(clock, 5).layers.remove(0);
    /// layer.exposures = [0, 2, 4, 0].map(|drawing| Exposure { drawing, koma: 2 }).to_vec();
    /// assert_eq!(layer.source_places(clock), [0.0, 1.0, 2.0, 3.0, 4.0, 4.0, 0.0, 0.0]);
    /// # Ok::<(), genga::Error>(())
    /// ```
    pub fn source_places(&self, clock: Clock) -> Vec<f64> {
        let changes: Vec<(usize, usize)> = self.changes().collect();
        let ends = changes.iter().skip(1).map(|(koma, _)| *koma).chain([self.length()]);
        let shown = |(&(begin, drawing), end): (&(usize, usize), usize)| Shown {
            drawing: &self.drawings[drawing],
            koma: begin..end,
        };
        let shown: Vec<Shown<'_>> = changes.iter().zip(ends).map(shown).collect();
        let passages = shown.chunk_by(|one, next| one.place() <= next.place());
        let end = self.length();
        let is_last =
            |passage: &[Shown<'_>]| passage.last().is_some_and(|shown| shown.koma.end == end);
        passages.flat_map(|passage| places(passage, clock, is_last(passage))).collect()
    }
}

/// A drawing on screen until another one comes.
struct Shown<'a> {
    drawing: &'a Drawing,
    koma: Range<usize>,
}

impl Shown<'_> {
    fn place(&self) -> f64 {
        self.drawing.source.place()
    }

    /// Number of koma by which the take may miss the drawing; `None` if the drawing does not tell where the take is. An
    /// inbetween is drawn towards its key, and a fill lies in transit. A step of a gait is drawn where all of them are.
    fn slack(&self) -> Option<f64> {
        match self.drawing.why.reason {
            _ if !self.drawing.role.is_kept() => None,
            Some(Reason::Fill) => None,
            Some(Reason::Step) => Some(3.0),
            _ => Some(1.0),
        }
    }
}

/// The take at its own pace.
#[derive(Clone, Copy)]
struct Pace {
    clock: Clock,
    /// Number of frames by which the take is ahead of the clock.
    ahead: f64,
}

impl Pace {
    /// Returns the pace at which the take is at a place on a koma.
    fn through(place: f64, koma: usize, clock: Clock) -> Self {
        Self { clock, ahead: place - clock.place_from_koma(koma) }
    }

    fn place(&self, koma: usize) -> f64 {
        self.clock.place_from_koma(koma) + self.ahead
    }

    /// Whether the take passes a drawing while that is on screen.
    fn meets(&self, shown: &Shown<'_>) -> bool {
        // The small addend is for rounding.
        let slack = shown.slack().unwrap_or(1.0) * self.clock.frames_in_koma() + 1e-6;
        let [begin, end] = [shown.koma.start, shown.koma.end].map(|koma| self.place(koma));
        (begin - slack..=end + slack).contains(&shown.place())
    }
}

/// Returns the places of a passage: drawings on screen that lie in the order of the source. A take that kept its time
/// goes on under the last drawing of the sheet (`is_last`), as under any other.
fn places(passage: &[Shown<'_>], clock: Clock, is_last: bool) -> Vec<f64> {
    let (first, last) = (&passage[0], &passage[passage.len() - 1]);
    let mut pace = Pace::through(first.place(), first.koma.start, clock);
    let mut places = Vec::new();
    let mut from = 0;
    let tells = |at: &usize| *at == passage.len() - 1 || passage[*at].slack().is_some();
    for to in (1..passage.len()).filter(tells) {
        let stretch = &passage[from..=to];
        if pace.meets(&passage[to]) {
            let koma = stretch[0].koma.start..passage[to].koma.start;
            places.extend(koma.map(|koma| pace.place(koma)));
        } else {
            pace = by_drawings(stretch, pace, &mut places);
        }
        from = to;
    }
    let furthest = match is_last && pace.ahead == 0.0 {
        true => f64::INFINITY,
        false => last.place().max(pace.place(last.koma.start)),
    };
    places.extend(last.koma.clone().map(|koma| pace.place(koma).min(furthest)));
    places
}

/// Goes evenly from drawing to drawing up to the last of `stretch`, and returns the pace from there on.
fn by_drawings(stretch: &[Shown<'_>], pace: Pace, places: &mut Vec<f64>) -> Pace {
    let mut reached = pace.place(stretch[0].koma.start);
    for pair in stretch.windows(2) {
        let (koma, from, to) = (pair[0].koma.clone(), reached, pair[1].place().max(reached));
        let share = |at: usize| at as f64 / koma.len() as f64;
        places.extend((0..koma.len()).map(|at| from + (to - from) * share(at)));
        reached = to;
    }
    Pace::through(reached, stretch[stretch.len() - 1].koma.start, pace.clock)
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use crate::cases::cases;
    use crate::sheet::{Drawing, Exposure, Layer, Reason, Role, Source, Why};
    use crate::time::{Clock, Frame, FrameRate};

    /// Five frames a koma.
    fn clock() -> Clock {
        Clock { first: Frame(0), frame_rate: FrameRate::new(120.0).unwrap(), koma_rate: 24.0 }
    }

    /// Creates a layer that shows some places, each for a number of koma: `g`enga, `s`tep of a gait, `f`ill or
    /// `i`nbetween.
    fn layer(shown: &[(char, f64, usize)]) -> Layer {
        let drawing = |(kind, place, _): &(char, f64, usize)| {
            let reason = match kind {
                's' => Some(Reason::Step),
                'f' => Some(Reason::Fill),
                _ => None,
            };
            let role = if *kind == 'i' { Role::Inbetween } else { Role::Genga };
            Drawing::new(Source::At(*place), role, Why { reason, ..Why::default() })
        };
        let exposure =
            |(drawing, (.., koma)): (usize, &(char, f64, usize))| Exposure { drawing, koma: *koma };
        Layer {
            name: "A".into(),
            joints: vec![],
            drawings: shown.iter().map(drawing).collect(),
            exposures: shown.iter().enumerate().map(exposure).collect(),
            gone: vec![],
        }
    }

    fn places(shown: &[(char, f64, usize)]) -> Vec<f64> {
        layer(shown).source_places(clock())
    }

    #[test]
    fn the_take_keeps_its_pace_under_genga_that_are_in_time() {
        let own: Vec<f64> = (0..9).map(|koma| 5.0 * f64::from(koma)).collect();
        for shown in [
            [('g', 0.0, 3), ('i', 4.0, 5), ('g', 40.0, 1)],
            [('g', 0.0, 3), ('f', 40.0, 5), ('g', 42.0, 1)],
            [('g', 0.0, 3), ('g', 39.0, 5), ('g', 45.0, 1)],
            [('g', 0.0, 3), ('s', 5.0, 5), ('g', 40.0, 1)],
        ] {
            assert_eq!(places(&shown), own, "{shown:?}");
        }
    }

    #[test]
    fn under_the_last_drawing_the_take_goes_on_only_if_it_kept_its_time() {
        assert_eq!(places(&[('g', 0.0, 2), ('g', 10.0, 3)]), [0.0, 5.0, 10.0, 15.0, 20.0]);
        assert_eq!(places(&[('g', 5.0, 2), ('g', 20.0, 3)]), [5.0, 10.0, 15.0, 20.0, 20.0]);
    }

    #[test]
    fn up_to_a_genga_at_another_time_it_goes_evenly_from_drawing_to_drawing() {
        // A hold lasts four koma too long; the take then goes on as late as it is.
        let late = [('g', 0.0, 6), ('i', 12.0, 2), ('g', 20.0, 3), ('g', 35.0, 2)];
        let expected = [0.0, 2.0, 4.0, 6.0, 8.0, 10.0, 12.0, 16.0, 20.0, 25.0, 30.0, 35.0, 35.0];
        assert_eq!(places(&late), expected);
        let early = [('g', 0.0, 1), ('g', 40.0, 2), ('g', 50.0, 1)];
        assert_eq!(places(&early), [0.0, 40.0, 45.0, 50.0]);
    }

    #[test]
    fn a_repeat_goes_like_the_first_round_and_stands_before_it_begins_again() {
        let mut cycle = layer(&[('g', 10.0, 2), ('i', 13.0, 2), ('g', 30.0, 3)]);
        cycle.exposures = cycle.exposures.repeat(2);
        let once = [10.0, 15.0, 20.0, 25.0, 30.0, 30.0, 30.0];
        assert_eq!(cycle.source_places(clock()), [once, once].concat());
    }

    #[test]
    fn a_drawing_that_goes_on_over_two_exposures_is_one_hold() {
        let mut layer = layer(&[('g', 0.0, 1), ('g', 8.0, 1)]);
        layer.exposures.insert(0, Exposure { drawing: 0, koma: 3 });
        assert_eq!(layer.source_places(clock()), [0.0, 2.0, 4.0, 6.0, 8.0]);
    }

    proptest! {
        #![proptest_config(cases(64, 256))]

        #[test]
        fn the_take_runs_back_only_where_a_drawing_lies_earlier(
            shown in prop::collection::vec(
                (prop::sample::select(vec!['g', 's', 'f', 'i']), 1.0..400.0, 1..6usize), 0..12),
        ) {
            let layer = layer(&shown);
            let places = layer.source_places(clock());
            prop_assert_eq!(places.len(), layer.length());
            let least = shown.iter().map(|shown| shown.1).fold(f64::INFINITY, f64::min);
            let most = shown.iter().map(|shown| shown.1).fold(0.0, f64::max);
            // Where the take misses the last drawing by no more than its slack, it keeps its pace.
            let most = most + 3.0 * clock().frames_in_koma() + 1e-6;
            prop_assert!(places.iter().all(|place| (least - 1e-9..=most).contains(place)));
            for (at, (begin, _)) in layer.timed().enumerate().skip(1) {
                let held = layer.exposures[at].koma;
                prop_assert!(places[begin..begin + held].is_sorted());
                if shown[at].1 < shown[at - 1].1 {
                    prop_assert!((places[begin] - shown[at].1).abs() < 1e-9);
                } else {
                    prop_assert!(places[begin] >= places[begin - 1]);
                }
            }
        }
    }
}
