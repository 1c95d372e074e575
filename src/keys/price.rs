//! What a key saves: how far the body would be off if it were left out and its neighbours slerped.
//!
//! Strength alone is a poor order: strong keys come in pairs round rests, and long fast passages get
//! none. So the cheapest key is taken away, its two neighbours are priced again, and so on: one nested
//! ranked list.
//!
//! "How far off" is the worst koma, not the sum over koma: a pose that is missed once shows more than
//! a small drift that lasts. And it is the root mean square over the joints, not the mean: a foot that
//! misses its contact shows, though the rest of the body be right.

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

    /// The motion.
    pub(super) fn clip(&self) -> &'a Clip {
        self.clip
    }

    /// Where its koma stand.
    pub(super) fn clock(&self) -> Clock {
        self.clock
    }

    /// How fast the body goes into each koma from the second on, in % of its height a second: root mean
    /// square over the joints.
    pub(super) fn speeds(&self) -> Vec<f64> {
        let joints = self.clip.skeleton().len();
        if joints == 0 || self.height <= 0.0 {
            return Vec::new();
        }
        let percent = 100.0 * self.clock.koma_rate / self.height;
        let rows: Vec<&[DVec3]> = self.positions.chunks_exact(joints).collect();
        let speed = |pair: &[&[DVec3]]| {
            let squares = pair[0].iter().zip(pair[1]).map(|(a, b)| a.distance_squared(*b));
            percent * (squares.sum::<f64>() / joints as f64).sqrt()
        };
        rows.windows(2).map(speed).collect()
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

    /// The joint-position error of the worst koma between, root mean square over the joints, in % of
    /// body height.
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
        let mut worst = 0.0;
        for koma in range.clone() {
            if koma > range.start {
                self.advance(share(koma));
            }
            self.body.place(&self.pose, &mut self.positions);
            let source = &self.reference.positions[koma * joints..(koma + 1) * joints];
            let squares = source.iter().zip(&self.positions).map(|(a, b)| a.distance_squared(*b));
            worst = f64::max(worst, squares.sum());
        }
        100.0 * (worst / joints as f64).sqrt() / self.reference.height
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
    /// Pinned keys and the clip's ends are never taken away.
    pub(super) stays: bool,
}

/// The price in % of body height of each entry that is worth keeping: the error between its neighbours
/// with it left out, infinite where it stays whatever it costs. None for those that are not.
///
/// `entries` by frame, the first and the last of them the clip's ends. The cheapest goes first, then
/// its neighbours are priced again, until the cheapest costs at least `enough` and no more than `most`
/// are left besides those that stay. What is kept for a smaller `most` or a larger `enough` is
/// therefore part of what is kept for a larger or smaller one.
pub(super) fn worthwhile(
    reference: &Reference<'_>,
    entries: &[Entry],
    enough: f64,
    most: usize,
) -> Vec<Option<f64>> {
    let mut list = RankedList::new(reference, entries);
    let mut left = entries.iter().filter(|entry| !entry.stays).count();
    while let Some((price, entry)) = list.cheapest() {
        if price >= enough && left <= most {
            break;
        }
        list.remove(entry);
        left -= 1;
    }
    let kept = |entry: usize| {
        let price = list.price[entry];
        if entries[entry].stays { Some(f64::INFINITY) } else { (!price.is_nan()).then_some(price) }
    };
    (0..entries.len()).map(kept).collect()
}

/// Keys in a doubly linked list with the price of each, cheapest first.
struct RankedList<'a> {
    entries: &'a [Entry],
    bridge: Bridge<'a>,
    before: Vec<usize>,
    after: Vec<usize>,
    /// What an entry costs now; NaN where it stays or once it is gone.
    price: Vec<f64>,
    queue: BinaryHeap<Reverse<(OrderedPrice, usize)>>,
}

impl<'a> RankedList<'a> {
    fn new(reference: &'a Reference<'a>, entries: &'a [Entry]) -> Self {
        let count = entries.len();
        let mut list = Self {
            entries,
            bridge: Bridge::new(reference),
            before: (0..count).map(|entry| entry.saturating_sub(1)).collect(),
            after: (1..=count).collect(),
            price: vec![f64::NAN; count],
            queue: BinaryHeap::with_capacity(count),
        };
        (0..count).for_each(|entry| list.set_price(entry));
        list
    }

    fn set_price(&mut self, entry: usize) {
        if self.entries[entry].stays {
            return;
        }
        let (before, after) = (self.before[entry], self.after[entry]);
        let price = self.bridge.error(self.entries[before].frame, self.entries[after].frame);
        self.price[entry] = price;
        self.queue.push(Reverse((OrderedPrice(price), entry)));
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
        self.price[entry] = f64::NAN;
        self.set_price(before);
        self.set_price(after);
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
pub(super) mod tests {
    use super::*;
    use crate::motion::{Axis, Channel, EndSite, Joint, JointId, Skeleton};
    use crate::time::FrameRate;

    /// An arm of one bone that swings about Z, given by its angle in degrees at each frame of 24 fps.
    pub(in crate::keys) fn swing(angles: &[f64]) -> Clip {
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
        let entry =
            |frame: &usize| Entry { frame: Frame(*frame), stays: *frame == 0 || *frame == last };
        frames.iter().map(entry).collect()
    }

    fn triangle(frames: usize, turn: usize) -> Vec<f64> {
        (0..frames).map(|at| 3.0 * (turn as f64 - at.abs_diff(turn) as f64)).collect()
    }

    #[test]
    fn a_key_on_an_even_turn_goes_and_the_turning_point_stays() {
        let clip = swing(&triangle(21, 10));
        let reference = Reference::of(&clip, clip.clock(24.0));
        let kept = worthwhile(&reference, &entries(&[0, 5, 10, 20], 20), 1e-6, usize::MAX);
        assert_eq!(kept[1], None);
        assert!(kept[2].is_some_and(|price| price > 20.0), "{kept:?}");
        assert_eq!((kept[0], kept[3]), (Some(f64::INFINITY), Some(f64::INFINITY)));
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
                let squares = a[0].distance_squared(b[0]) + a[1].distance_squared(b[1]);
                slow = f64::max(slow, (squares / 2.0).sqrt());
            }
        }
        slow *= 100.0 / reference.height;
        assert!((fast - slow).abs() < 1e-9 * slow, "{fast} {slow}");
    }

    /// The same from the words: each round prices every entry anew and takes the cheapest away.
    fn slowly(
        reference: &Reference<'_>,
        entries: &[Entry],
        enough: f64,
        most: usize,
    ) -> Vec<Frame> {
        let mut kept = entries.to_vec();
        loop {
            let price =
                |at: usize| Bridge::new(reference).error(kept[at - 1].frame, kept[at + 1].frame);
            let cheapest = (1..kept.len() - 1)
                .filter(|at| !kept[*at].stays)
                .map(|at| (price(at), at))
                .reduce(|a, b| if b.0 < a.0 { b } else { a });
            let left = kept.iter().filter(|entry| !entry.stays).count();
            match cheapest {
                Some((price, at)) if price < enough || left > most => kept.remove(at),
                _ => return kept.iter().map(|entry| entry.frame).collect(),
            };
        }
    }

    #[test]
    fn the_ranked_list_equals_pricing_everything_anew_each_round() {
        let angles: Vec<f64> =
            (0..60).map(|at| 30.0 * (at as f64 * 0.3).sin() + at as f64).collect();
        let clip = swing(&angles);
        let reference = Reference::of(&clip, clip.clock(24.0));
        let mut list = entries(&[0, 5, 11, 16, 22, 27, 33, 40, 48, 59], 59);
        list[4].stays = true;
        for (enough, most) in
            [(0.0, 9), (1.0, 9), (5.0, 9), (20.0, 9), (0.0, 4), (1.0, 2), (0.0, 0)]
        {
            let kept = worthwhile(&reference, &list, enough, most);
            let frames: Vec<Frame> = list
                .iter()
                .zip(&kept)
                .filter(|(_, kept)| kept.is_some())
                .map(|(e, _)| e.frame)
                .collect();
            assert_eq!(frames, slowly(&reference, &list, enough, most), "{enough} {most}");
            assert_eq!(kept[4], Some(f64::INFINITY), "what stays is never taken away");
        }
    }

    #[test]
    fn nothing_between_two_frames_costs_nothing() {
        let clip = swing(&[0.0, 10.0, 0.0]);
        let reference = Reference::of(&clip, clip.clock(24.0));
        assert_eq!(Bridge::new(&reference).error(Frame(0), Frame(1)), 0.0);
        let still = swing(&[0.0; 9]);
        let reference = Reference::of(&still, still.clock(24.0));
        assert_eq!(worthwhile(&reference, &entries(&[0, 4, 8], 8), 0.0, usize::MAX)[1], Some(0.0));
    }
}
