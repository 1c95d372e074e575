//! The time of what stands beside the body (体以外の時間): which place of the source is when on the sheet.

use genga::knob::choices;
use genga::sheet::{Exposure, Sheet};
use genga_read::{Between, Track};

/// How cameras, props and faces follow the sheet.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum Others {
    /// They keep their own keys, at the koma on which the sheet shows that time of the source.
    #[default]
    Keep,
    /// They take the value that they have at the drawing's place in the source, for as long as the drawing stays.
    Step,
}

choices!(Others { Keep: "keep", Step: "step" });

/// Part of a gap by which a value ends before another one takes its place at once, in koma: too short to be seen.
const GAP: f64 = 0.01;

/// Share of the pace within which two paces are one.
const SAME: f64 = 1e-9;

/// The time of a cut: the place of the source on every koma, with what lies between.
#[derive(Debug, Clone)]
pub(crate) struct Timeline {
    /// Parts in which the source goes at an even pace, one after another.
    parts: Vec<Part>,
    /// Drawings on screen: koma from and to, and their place in the source.
    holds: Vec<Hold>,
    others: Others,
}

/// A part of a cut in which the source goes evenly from a place to another.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Part {
    begin: f64,
    end: f64,
    from: f64,
    to: f64,
}

#[derive(Debug, Clone, Copy)]
struct Hold {
    begin: usize,
    end: usize,
    place: f64,
}

impl Part {
    /// Frames a koma.
    fn pace(&self) -> f64 {
        (self.to - self.from) / (self.end - self.begin)
    }
}

impl Timeline {
    /// Creates the time of a sheet. Blank koma show the place at the first drawing, or that at the last.
    pub(crate) fn new(sheet: &Sheet, others: Others) -> Self {
        let (places, blank) = (sheet.source_places(), sheet.blank);
        let mut line = Self { parts: Vec::new(), holds: holds(sheet), others };
        let (Some(first), Some(last)) = (places.first(), places.last()) else { return line };
        let pace = sheet.clock.frames_in_koma();
        line.push(blank.before, (*first, *first));
        for (koma, place) in places.iter().enumerate() {
            let next = match places.get(koma + 1) {
                Some(next) => next.max(*place),
                // The take goes on to the end of the last koma, if it was going on.
                None if koma == 0 || line.goes_on(pace) => place + pace,
                None => *place,
            };
            // Where the drawings go back in the source, the place stays for a koma.
            line.push(1, (*place, next));
        }
        let end = line.parts.last().map_or(*last, |part| part.to);
        line.push(blank.after, (end, end));
        line
    }

    /// Creates the time of a take from a place to another, with so many frames a koma.
    pub(crate) fn of_take(from: f64, to: f64, pace: f64) -> Self {
        let part = Part { begin: 0.0, end: (to - from) / pace, from, to };
        let parts = if to > from { vec![part] } else { Vec::new() };
        Self { parts, holds: Vec::new(), others: Others::Keep }
    }

    /// Whether the last part has a pace.
    fn goes_on(&self, pace: f64) -> bool {
        self.parts.last().is_some_and(|part| is_same(part.pace(), pace))
    }

    /// Adds some koma, to the last part if they go on with it.
    fn push(&mut self, koma: usize, (from, to): (f64, f64)) {
        if koma == 0 {
            return;
        }
        let begin = self.parts.last().map_or(0.0, |part| part.end);
        let part = Part { begin, end: begin + koma as f64, from, to };
        match self.parts.last_mut() {
            Some(last) if last.to == from && is_same(last.pace(), part.pace()) => {
                (last.end, last.to) = (part.end, to);
            }
            _ => self.parts.push(part),
        }
    }

    /// Koma of the cut.
    pub(crate) fn length(&self) -> f64 {
        self.parts.last().map_or(0.0, |part| part.end)
    }

    /// The part in which the source goes, if it goes in one: the koma and the place at which it begins, and frames a
    /// koma. `None` if the time of the source is not kept throughout, or if values are stepped.
    pub(crate) fn only_pace(&self) -> Option<(f64, f64, f64)> {
        let mut going = self.parts.iter().filter(|part| part.pace() > 0.0);
        let is_whole = self.parts.windows(2).all(|pair| pair[0].to == pair[1].from);
        let part = going.next().filter(|_| is_whole && self.others == Others::Keep)?;
        going.next().is_none().then(|| (part.begin, part.from, part.pace()))
    }

    /// Returns the place of the source at a koma with a fraction; `None` without koma.
    pub(crate) fn place(&self, koma: f64) -> Option<f64> {
        if self.others == Others::Step {
            let at = self.holds.partition_point(|hold| hold.begin as f64 <= koma);
            return self.holds.get(at.saturating_sub(1)).map(|hold| hold.place);
        }
        let at = self.parts.partition_point(|part| part.end <= koma);
        let part = self.parts.get(at.min(self.parts.len().checked_sub(1)?))?;
        Some(part.from + (koma - part.begin).clamp(0.0, part.end - part.begin) * part.pace())
    }

    /// Returns the keys of a track in koma of the cut, with slopes per koma.
    pub(crate) fn retimed(&self, track: &Track) -> Track {
        match self.others {
            Others::Keep => Retimed::new(track).through(&self.parts),
            Others::Step => self.stepped(track),
        }
    }

    /// Returns the values of a track at the drawings, and the last one again when it leaves.
    fn stepped(&self, track: &Track) -> Track {
        let (width, mut value) = (track.width, vec![0.0; track.width]);
        let (mut places, mut values) = (Vec::new(), Vec::new());
        let closing = self.holds.last().map(|hold| (hold.end, hold.place));
        let keys = self.holds.iter().map(|hold| (hold.begin, hold.place)).chain(closing);
        for (koma, place) in keys {
            track.write_at(place, &mut value);
            places.push(koma as f64);
            values.extend(&value);
        }
        Track { places, values, width, between: Between::Step }
    }
}

fn is_same(a: f64, b: f64) -> bool {
    (a - b).abs() <= SAME * a.abs().max(b.abs())
}

/// The drawings on screen of the layer that the time of a sheet is of.
fn holds(sheet: &Sheet) -> Vec<Hold> {
    let Some(layer) = sheet.longest_layer() else { return Vec::new() };
    let hold = |(begin, shown): (usize, Exposure)| Hold {
        begin: sheet.blank.pose_begins(begin),
        end: sheet.blank.pose_ends(begin + shown.koma, layer.length()),
        place: layer.drawings[shown.drawing].source.place(),
    };
    layer.timed().map(hold).collect()
}

/// A track on its way into another time.
struct Retimed<'a> {
    track: &'a Track,
    places: Vec<f64>,
    values: Vec<f64>,
    value: Vec<f64>,
}

impl<'a> Retimed<'a> {
    fn new(track: &'a Track) -> Self {
        Self { track, places: Vec::new(), values: Vec::new(), value: vec![0.0; track.width] }
    }

    /// Takes the keys part by part. Where the pace changes, there is a key more, so that the way from key to key stays.
    fn through(mut self, parts: &[Part]) -> Track {
        let mut before: Option<&Part> = None;
        for part in parts {
            self.enter(part, before);
            let keys = &self.track.places;
            let first = keys.partition_point(|place| *place <= part.from);
            let past = keys.partition_point(|place| *place < part.to);
            for key in first..past {
                let place = self.track.places[key];
                let koma = part.begin + (place - part.from) / part.pace();
                self.add(koma, place, [part.pace(); 2]);
            }
            before = Some(part);
        }
        if let Some(last) = before {
            let end = self.track.places[self.track.places.len() - 1];
            let is_cut = last.to < end && self.track.between != Between::Step;
            let ends = last.pace() > 0.0 && (is_cut || last.to == end);
            if ends || self.places.is_empty() {
                self.add(last.end, last.to, [last.pace(); 2]);
            }
        }
        let Self { track: Track { width, between, .. }, places, values, .. } = self;
        Track { places, values, width: *width, between: *between }
    }

    /// Adds a key where a part begins, if the keys of the track do not say enough.
    fn enter(&mut self, part: &Part, before: Option<&Part>) {
        let keys = &self.track.places;
        let (first, last) = (keys[0], keys[keys.len() - 1]);
        let is_key = keys.binary_search_by(|key| key.total_cmp(&part.from)).is_ok();
        let is_curve = self.track.between != Between::Step;
        // Before its first key a track has that key's value, and after its last one that of the last.
        let is_outside = part.from < first || part.from > last && !self.places.is_empty();
        match before {
            None if is_outside || part.pace() == 0.0 => {}
            None => self.add(part.begin, part.from, [part.pace(); 2]),
            Some(before) if before.to == part.from => {
                if (is_curve || is_key || self.places.is_empty()) && !is_outside {
                    self.add(part.begin, part.from, [before.pace(), part.pace()]);
                }
            }
            Some(before) => {
                if is_curve || self.places.is_empty() {
                    self.add(part.begin - GAP, before.to, [before.pace(), 0.0]);
                }
                self.add(part.begin, part.from, [0.0, part.pace()]);
            }
        }
    }

    /// Adds a key with the value at a place. Its slopes are those at a pace before and after it.
    fn add(&mut self, koma: f64, place: f64, [before, after]: [f64; 2]) {
        if self.places.last().is_some_and(|last| *last >= koma) {
            return;
        }
        let is_cubic = self.track.between == Between::Cubic;
        self.places.push(koma);
        if is_cubic {
            self.add_slope(place, before, true);
        }
        self.track.write_at(place, &mut self.value);
        self.values.extend(&self.value);
        if is_cubic {
            self.add_slope(place, after, false);
        }
    }

    fn add_slope(&mut self, place: f64, pace: f64, is_before: bool) {
        self.track.write_slope(place, is_before, &mut self.value);
        self.values.extend(self.value.iter().map(|slope| slope * pace));
    }
}

#[cfg(test)]
mod tests;
