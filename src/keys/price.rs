//! What a key saves: the error that appears when it is left out and its neighbours are slerped.
//!
//! Strength alone is a poor order: strong keys come in pairs round rests, and long fast passages get
//! none. So the cheapest key is taken away, its two neighbours are priced again, and so on: one nested
//! ranked list.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use glam::{DQuat, DVec3};

use crate::motion::{Body, Clip, Pose};
use crate::time::{Clock, Frame};

/// The source at each koma, computed once: what a reconstruction is measured against.
pub(super) struct Reference<'a> {
    clip: &'a Clip,
    clock: Clock,
    koma: usize,
    /// Koma × joints.
    positions: Vec<DVec3>,
    /// Height of the body in the file's unit: see [`Reference::of`].
    height: f64,
}

impl<'a> Reference<'a> {
    /// Samples the clip at every koma of the clock.
    ///
    /// The body's height is the median over the koma of the longest side of the box round all joints.
    /// It is taken from the motion and not from the rest pose because rest poses are a matter of the
    /// rig: arms out, arms down, or all bones along one axis.
    pub(super) fn of(clip: &'a Clip, clock: Clock) -> Self {
        let joints = clip.skeleton().len();
        let koma = clip.rate().koma_from_frames(clip.len(), clock.koma_rate);
        let mut positions = vec![DVec3::ZERO; koma * joints];
        let (mut pose, mut body) = (Pose::rest(clip.skeleton()), Body::new(clip.skeleton()));
        let mut sides = Vec::with_capacity(koma);
        for (at, row) in positions.chunks_exact_mut(joints.max(1)).enumerate() {
            pose.take_place(clip, clock.place_from_koma(at));
            body.place(&pose, row);
            let low = row.iter().copied().reduce(DVec3::min).unwrap_or_default();
            let high = row.iter().copied().reduce(DVec3::max).unwrap_or_default();
            sides.push((high - low).max_element());
        }
        sides.sort_by(f64::total_cmp);
        let height = sides.get(sides.len() / 2).copied().unwrap_or(0.0);
        Self { clip, clock, koma, positions, height }
    }

    /// The koma whose place lies strictly between two frames.
    fn koma_between(&self, from: Frame, to: Frame) -> std::ops::Range<usize> {
        let per_frame = self.clock.koma_rate / self.clock.frame_rate.fps();
        let koma = |frame: Frame| (frame.0 - self.clock.first.0) as f64 * per_frame;
        let begin = (koma(from) + 1e-9).floor() as usize + 1;
        let end = ((koma(to) - 1e-9).ceil().max(0.0) as usize).min(self.koma);
        begin.min(end)..end
    }
}

/// The error of slerping between two keys, with its buffers.
struct Bridge<'a> {
    reference: &'a Reference<'a>,
    from: Pose,
    to: Pose,
    /// The rotation of a joint from one koma to the next.
    step: Vec<DQuat>,
    pose: Pose,
    body: Body,
    positions: Vec<DVec3>,
}

impl<'a> Bridge<'a> {
    fn new(reference: &'a Reference<'a>) -> Self {
        let skeleton = reference.clip.skeleton();
        let rest = Pose::rest(skeleton);
        Self {
            reference,
            from: rest.clone(),
            to: rest.clone(),
            step: vec![DQuat::IDENTITY; skeleton.len()],
            pose: rest,
            body: Body::new(skeleton),
            positions: vec![DVec3::ZERO; skeleton.len()],
        }
    }

    /// Joint-position error, mean over joints, in % of body height, summed over the koma between.
    fn error(&mut self, from: Frame, to: Frame) -> f64 {
        let Reference { clip, clock, .. } = self.reference;
        let range = self.reference.koma_between(from, to);
        let joints = self.positions.len();
        if range.is_empty() || joints == 0 || self.reference.height <= 0.0 {
            return 0.0;
        }
        self.from.take_frame(clip, from);
        self.to.take_frame(clip, to);
        let share =
            |koma: usize| (clock.place_from_koma(koma) - from.0 as f64) / (to.0 - from.0) as f64;
        let first = share(range.start);
        self.pose.take_blend(&self.from, &self.to, first);
        // Koma stand evenly, so from one to the next each joint turns by the same rotation: a product
        // instead of a slerp.
        let koma_share = clock.frames_in_koma() / (to.0 - from.0) as f64;
        for (step, (from, to)) in
            self.step.iter_mut().zip(self.from.rotations.iter().zip(&self.to.rotations))
        {
            *step = DQuat::IDENTITY.slerp(from.conjugate() * *to, koma_share);
        }
        let mut sum = 0.0;
        for koma in range.clone() {
            if koma > range.start {
                self.advance(share(koma));
            }
            self.body.place(&self.pose, &mut self.positions);
            let source = &self.reference.positions[koma * joints..(koma + 1) * joints];
            sum += source.iter().zip(&self.positions).map(|(a, b)| a.distance(*b)).sum::<f64>();
        }
        100.0 * sum / (joints as f64 * self.reference.height)
    }

    fn advance(&mut self, share: f64) {
        for (rotation, step) in self.pose.rotations.iter_mut().zip(&self.step) {
            *rotation *= *step;
        }
        let ends = self.from.translations.iter().zip(&self.to.translations);
        for (translation, (from, to)) in self.pose.translations.iter_mut().zip(ends) {
            *translation = from.lerp(*to, share);
        }
    }
}

/// A key that stands in the list to be priced.
#[derive(Debug, Clone, Copy)]
pub(super) struct Entry {
    pub(super) frame: Frame,
    pub(super) strength: f64,
    /// Pinned keys and the clip's ends are never taken away.
    pub(super) stays: bool,
}

/// The price of each entry: the error that leaving it out adds, × √strength; infinite where it stays.
///
/// `entries` by frame, the first and the last of them the clip's ends. The cheapest goes first, then
/// its neighbours are priced again; a price never falls below that of what went before, so that one
/// threshold cuts the list. Once the cheapest costs more than `enough`, the rest keep the price they
/// have then: it is only known that they cost at least that much.
pub(super) fn prices(reference: &Reference<'_>, entries: &[Entry], enough: f64) -> Vec<f64> {
    let mut list = RankedList::new(reference, entries);
    let mut prices = vec![f64::INFINITY; entries.len()];
    let mut least = 0.0;
    while let Some((price, entry)) = list.cheapest() {
        least = price.max(least);
        if least > enough {
            list.standing().for_each(|(entry, price)| prices[entry] = price.max(least));
            break;
        }
        prices[entry] = least;
        list.remove(entry);
    }
    prices
}

/// Keys in a doubly linked list with the price of each, cheapest first.
struct RankedList<'a> {
    entries: &'a [Entry],
    bridge: Bridge<'a>,
    before: Vec<usize>,
    after: Vec<usize>,
    /// The error between an entry and the next one that stands.
    gap: Vec<f64>,
    /// The error with the entry left out, and its price; NaN once it is gone.
    joined: Vec<f64>,
    price: Vec<f64>,
    queue: BinaryHeap<Reverse<(OrderedPrice, usize)>>,
}

impl<'a> RankedList<'a> {
    fn new(reference: &'a Reference<'a>, entries: &'a [Entry]) -> Self {
        let count = entries.len();
        let mut bridge = Bridge::new(reference);
        let gap =
            entries.windows(2).map(|pair| bridge.error(pair[0].frame, pair[1].frame)).collect();
        let mut list = Self {
            entries,
            bridge,
            before: (0..count).map(|entry| entry.saturating_sub(1)).collect(),
            after: (1..=count).collect(),
            gap,
            joined: vec![0.0; count],
            price: vec![f64::NAN; count],
            queue: BinaryHeap::with_capacity(count),
        };
        (0..count).for_each(|entry| list.set_price(entry));
        list
    }

    fn set_price(&mut self, entry: usize) {
        let Entry { strength, stays, .. } = self.entries[entry];
        if stays {
            return;
        }
        let (before, after) = (self.before[entry], self.after[entry]);
        self.joined[entry] =
            self.bridge.error(self.entries[before].frame, self.entries[after].frame);
        let saved = (self.joined[entry] - self.gap[before] - self.gap[entry]).max(0.0);
        self.price[entry] = saved * strength.max(0.0).sqrt();
        self.queue.push(Reverse((OrderedPrice(self.price[entry]), entry)));
    }

    fn cheapest(&mut self) -> Option<(f64, usize)> {
        while let Some(Reverse((OrderedPrice(price), entry))) = self.queue.pop() {
            // What is in the queue may be an old price, or an entry that is gone.
            if self.price[entry] == price {
                return Some((price, entry));
            }
        }
        None
    }

    fn remove(&mut self, entry: usize) {
        let (before, after) = (self.before[entry], self.after[entry]);
        self.after[before] = after;
        self.before[after] = before;
        self.gap[before] = self.joined[entry];
        self.price[entry] = f64::NAN;
        self.set_price(before);
        self.set_price(after);
    }

    fn standing(&self) -> impl Iterator<Item = (usize, f64)> {
        self.price.iter().copied().enumerate().filter(|(_, price)| !price.is_nan())
    }
}

/// A price in the order of numbers; prices are never NaN.
#[derive(PartialEq)]
struct OrderedPrice(f64);

impl Eq for OrderedPrice {}

impl Ord for OrderedPrice {
    fn cmp(&self, other: &Self) -> std::cmp::Ordering {
        self.0.total_cmp(&other.0)
    }
}

impl PartialOrd for OrderedPrice {
    fn partial_cmp(&self, other: &Self) -> Option<std::cmp::Ordering> {
        Some(self.cmp(other))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::motion::{Axis, Channel, EndSite, Joint, JointId, Skeleton};
    use crate::time::FrameRate;

    /// An arm of one bone that swings about Z, given by its angle in degrees at each frame of 24 fps.
    fn swing(angles: &[f64]) -> Clip {
        let joint = |name: &str, parent, channels: &[Channel], end_sites| Joint {
            name: name.into(),
            parent,
            offset: DVec3::X,
            channels: channels.to_vec(),
            first_channel: 0,
            end_sites,
        };
        let tip = EndSite { name: "Site".into(), offset: DVec3::X };
        let skeleton = Skeleton {
            joints: vec![
                joint("shoulder", None, &[Channel::Rotation(Axis::Z)], vec![]),
                Joint { first_channel: 1, ..joint("hand", Some(JointId(0)), &[], vec![tip]) },
            ],
        };
        let rate = FrameRate::new(24.0).unwrap();
        Clip::new(skeleton, rate, Frame(0), angles.len(), angles.to_vec()).unwrap()
    }

    fn entries(frames: &[usize], last: usize) -> Vec<Entry> {
        let entry = |frame: &usize| Entry {
            frame: Frame(*frame),
            strength: 1.0,
            stays: *frame == 0 || *frame == last,
        };
        frames.iter().map(entry).collect()
    }

    fn triangle(frames: usize, turn: usize) -> Vec<f64> {
        (0..frames).map(|at| 3.0 * (turn as f64 - at.abs_diff(turn) as f64)).collect()
    }

    #[test]
    fn a_key_on_an_even_turn_saves_nothing_and_the_turning_point_saves_much() {
        let clip = swing(&triangle(21, 10));
        let reference = Reference::of(&clip, clip.clock(24.0));
        let prices = prices(&reference, &entries(&[0, 5, 10, 20], 20), f64::INFINITY);
        assert!(prices[1] < 1e-9, "{prices:?}");
        assert!(prices[2] > 20.0, "{prices:?}");
        assert_eq!((prices[0], prices[3]), (f64::INFINITY, f64::INFINITY));
    }

    #[test]
    fn the_bridge_equals_a_slerp_a_koma() {
        let clip = swing(&(0..40).map(|at| 40.0 * (at as f64 * 0.4).sin()).collect::<Vec<_>>());
        let clip = clip.with_rate(FrameRate::new(50.0).unwrap());
        let reference = Reference::of(&clip, clip.clock(24.0));
        let fast = Bridge::new(&reference).error(Frame(3), Frame(36));
        let (mut from, mut to) = (Pose::rest(clip.skeleton()), Pose::rest(clip.skeleton()));
        from.take_frame(&clip, Frame(3));
        to.take_frame(&clip, Frame(36));
        let mut pose = from.clone();
        let (mut source, mut slow) = (from.clone(), 0.0);
        let mut body = Body::new(clip.skeleton());
        let (mut a, mut b) = ([DVec3::ZERO; 2], [DVec3::ZERO; 2]);
        for koma in 0..20 {
            let place = koma as f64 * 50.0 / 24.0;
            if place > 3.0 && place < 36.0 {
                pose.take_blend(&from, &to, (place - 3.0) / 33.0);
                source.take_place(&clip, place);
                body.place(&pose, &mut a);
                body.place(&source, &mut b);
                slow += (a[0].distance(b[0]) + a[1].distance(b[1])) / 2.0;
            }
        }
        slow *= 100.0 / reference.height;
        assert!((fast - slow).abs() < 1e-9 * slow, "{fast} {slow}");
    }

    #[test]
    fn what_stays_is_never_priced_and_the_list_is_nested() {
        let angles: Vec<f64> =
            (0..60).map(|at| 30.0 * (at as f64 * 0.3).sin() + at as f64).collect();
        let clip = swing(&angles);
        let reference = Reference::of(&clip, clip.clock(24.0));
        let mut list = entries(&[0, 5, 11, 16, 22, 27, 33, 40, 48, 59], 59);
        list[4].stays = true;
        let all = prices(&reference, &list, f64::INFINITY);
        assert_eq!(all[4], f64::INFINITY);
        // Cutting at any threshold gives the same keys as stopping there.
        for enough in [0.0, 1.0, 5.0, 20.0] {
            let cut = prices(&reference, &list, enough);
            for (full, early) in all.iter().zip(&cut) {
                assert_eq!(*full > enough, *early > enough, "{all:?} {cut:?}");
            }
        }
    }

    #[test]
    fn nothing_between_two_frames_costs_nothing() {
        let clip = swing(&[0.0, 10.0, 0.0]);
        let reference = Reference::of(&clip, clip.clock(24.0));
        assert_eq!(Bridge::new(&reference).error(Frame(0), Frame(1)), 0.0);
        let still = swing(&[0.0; 9]);
        let reference = Reference::of(&still, still.clock(24.0));
        assert_eq!(prices(&reference, &entries(&[0, 4, 8], 8), 1.0)[1], 0.0);
    }
}
