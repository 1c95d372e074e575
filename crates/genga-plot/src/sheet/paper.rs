//! Draws the lines of koma of a timesheet.

use crate::canvas::{Align, Canvas, Type};
use crate::chart::number;
use crate::sheet::fate::{Fate, held_by_hand};
use crate::style;
use genga::sheet::{Drawing, Exposure, Layer, Number, Role};

pub(super) const LEFT: f64 = 52.0;
const SECONDS: f64 = 18.0;
const SSD: f64 = 30.0;
const SPACED: f64 = 24.0;
const TALL: f64 = 46.0;
const SHORT: f64 = 25.0;
const KOMA: f64 = 30.0;
const BETWEEN_LINES: f64 = 20.0;
/// Gap between layers, in px. A layer's row before omission must not seem to belong to the layer above.
const BETWEEN_BANDS: f64 = 18.0;
/// Maximum number of lanes for the numbers of kept drawings.
const LANES: usize = 3;

/// A number in a circle: koma, role, number, pin and lane of its drawing.
pub(super) struct Badge {
    pub(super) koma: usize,
    pub(super) role: Role,
    pub(super) number: Number,
    pub(super) pinned: bool,
    pub(super) lane: Option<usize>,
}

/// A layer to be drawn.
pub(super) struct Band<'a> {
    pub(super) layer: &'a Layer,
    pub(super) badges: Vec<Badge>,
    /// Koma, role and fate of each drawing before omission, if that row is shown.
    pub(super) before: Option<Vec<(usize, Role, Fate)>>,
}

/// Contents of the timesheet, and its measures in px.
pub(super) struct Paper<'a> {
    pub(super) bands: Vec<Band<'a>>,
    /// Root of the SSD into each koma, if that lane is shown, and the greatest root that has room.
    pub(super) roots: Option<Vec<f64>>,
    pub(super) top: f64,
    /// Whether the SSD is measured in a camera's view.
    pub(super) is_on_screen: bool,
    /// Koma on which actions begin.
    pub(super) splits: &'a [usize],
    pub(super) koma: usize,
    pub(super) in_line: usize,
    pub(super) koma_rate: f64,
    pub(super) slot: f64,
    pub(super) lanes: usize,
}

/// Returns the numbers of the kept drawings, in as many lanes as keep them apart. Genga and ends are one
/// series, as in the key table. A number that fits into no lane gets `None`.
pub(super) fn badges(layer: &Layer, in_line: usize, slot: f64) -> Vec<Badge> {
    let numbers = layer.genga_numbers();
    let badge = |(koma, shown): (usize, Exposure)| {
        let Drawing { role, why, .. } = &layer.drawings[shown.drawing];
        let number = numbers[shown.drawing].clone()?;
        Some(Badge { koma, role: *role, number, pinned: why.pinned.is_some(), lane: None })
    };
    let mut badges: Vec<_> = layer.timed().filter_map(badge).collect();
    // A gap at every line's end, since numbers on different lines are no neighbours.
    let gap = 4.0 * style::BADGE;
    let place = |koma: usize| koma as f64 * slot + (koma / in_line) as f64 * gap;
    let mark = |badge: &Badge| (place(badge.koma), style::badge_reach(&badge.number.to_string()));
    let lanes = style::lanes(badges.iter().map(mark).collect::<Vec<_>>(), LANES);
    for (badge, lane) in badges.iter_mut().zip(lanes) {
        badge.lane = lane;
    }
    badges
}

impl Paper<'_> {
    fn badges_height(&self) -> f64 {
        2.0 * style::BADGE * self.lanes as f64 + 4.0
    }

    fn band_height(&self, band: &Band<'_>) -> f64 {
        let before = if band.before.is_some() { SPACED } else { 0.0 };
        before + self.badges_height() + TALL + 8.0
    }

    fn ssd_height(&self) -> f64 {
        if self.roots.is_some() { SSD + 6.0 } else { 0.0 }
    }

    pub(super) fn line_height(&self) -> f64 {
        let bands: f64 = self.bands.iter().map(|band| self.band_height(band)).sum();
        let between = BETWEEN_BANDS * self.bands.len().saturating_sub(1) as f64;
        SECONDS + self.ssd_height() + bands + between + KOMA + BETWEEN_LINES
    }

    /// Returns the left edge of a koma's slot.
    fn x(&self, koma: usize) -> f64 {
        LEFT + koma as f64 * self.slot
    }

    /// Draws one line of koma, from the seconds above to the koma numbers below.
    pub(super) fn line(&self, canvas: &mut Canvas, at: usize, top: f64) {
        let begin = at * self.in_line;
        let koma = self.in_line.min(self.koma - begin.min(self.koma));
        let bottom = top + self.line_height() - KOMA - BETWEEN_LINES;
        self.grid(canvas, (begin, koma), (top, bottom));
        for split in self.splits.iter().filter(|split| (begin..begin + koma).contains(*split)) {
            let x = self.x(split - begin);
            canvas.dashes((x, top + SECONDS - 3.0), (x, bottom + 9.0), style::INK, 1.25);
        }
        let mut y = top + SECONDS;
        if let Some(roots) = &self.roots {
            let end = roots.len().min(begin + koma);
            self.roots(canvas, &roots[begin.min(end)..end], y + SSD);
            y += self.ssd_height();
        }
        for (at, band) in self.bands.iter().enumerate() {
            if at > 0 {
                let middle = y + 0.5 * BETWEEN_BANDS;
                canvas.line((LEFT, middle), (self.x(koma), middle), style::GRID, 1.0);
                y += BETWEEN_BANDS;
            }
            self.band(canvas, band, (begin, koma), y);
            y += self.band_height(band);
        }
    }

    /// Draws ticks between koma, longer ones every six koma, lines between seconds, and the numbers.
    fn grid(&self, canvas: &mut Canvas, (begin, koma): (usize, usize), (top, bottom): (f64, f64)) {
        let look = Type::new(style::SMALL).align(Align::Center);
        let second = (self.koma_rate.round() as usize).max(1);
        for edge in 0..=koma {
            let (x, whole) = (self.x(edge), (begin + edge) % second == 0);
            let (length, color) = match () {
                () if whole => (9.0, style::FAINT),
                () if (begin + edge) % 6 == 0 => (6.0, style::FAINT),
                () => (3.0, style::RAW),
            };
            canvas.line((x, bottom), (x, bottom + length), color, 1.0);
            if whole {
                canvas.line((x, top + SECONDS - 3.0), (x, bottom), style::GRID, 1.25);
                let seconds = number((begin + edge) as f64 / second as f64);
                canvas.text(&format!("{seconds} s"), (x, top + 10.0), look.color(style::FAINT));
            }
        }
        canvas.line((LEFT, bottom), (self.x(koma), bottom), style::FAINT, 1.0);
        for slot in 0..koma {
            let label = begin + slot + 1;
            if label == 1 || label % self.label_step() == 0 {
                let x = self.x(slot) + 0.5 * self.slot;
                canvas.text(&label.to_string(), (x, bottom + 22.0), look);
            }
        }
        let words = Type::new(style::SMALL).align(Align::Right).color(style::FAINT);
        canvas.text("koma", (LEFT - 10.0, bottom + 22.0), words);
    }

    /// Returns the smallest step between koma labels that leaves them room.
    fn label_step(&self) -> usize {
        [2, 6, 12, 24, 48, 144]
            .into_iter()
            .find(|step| *step as f64 * self.slot > 32.0)
            .unwrap_or(1440)
    }

    /// Draws how far the body moves into each koma, as √SSD, which is proportional to the distance.
    fn roots(&self, canvas: &mut Canvas, roots: &[f64], floor: f64) {
        let words = Type::new(style::SMALL).align(Align::Right).color(style::FAINT);
        canvas.text("√SSD", (LEFT - 10.0, floor), words);
        if self.is_on_screen {
            canvas.text("画面", (LEFT - 10.0, floor - 13.0), words);
        }
        let mut hull = vec![(LEFT, floor)];
        for (koma, root) in roots.iter().enumerate() {
            let is_drawn = self.top > 0.0 && root.is_finite();
            let share = if is_drawn { (root / self.top).min(1.0) } else { 0.0 };
            let y = floor - share * SSD;
            hull.extend([(self.x(koma), y), (self.x(koma + 1), y)]);
        }
        hull.push((self.x(roots.len()), floor));
        canvas.area(&hull, style::GRID);
        canvas.line((LEFT, floor), (self.x(roots.len()), floor), style::RAW, 1.0);
        let mut koma = 0;
        for stretch in roots.chunk_by(|a, b| self.goes_on(*a) == self.goes_on(*b)) {
            if self.goes_on(stretch[0]) {
                let middle = self.x(koma) + 0.5 * self.slot * stretch.len() as f64;
                canvas.cut((middle, floor - SSD + 4.0));
            }
            koma += stretch.len();
        }
    }

    /// Whether a root of SSD goes on beyond its lane.
    fn goes_on(&self, root: f64) -> bool {
        root.is_finite() && root > self.top
    }

    /// Whether a hold that a person set replaces a drawing.
    pub(super) fn is_held_by_hand(&self) -> bool {
        let mut before = self.bands.iter().flat_map(|band| band.before.iter().flatten());
        before.any(|(.., fate)| *fate == Fate::HeldByHand)
    }

    /// Whether a glitch is cut off.
    pub(super) fn is_cut(&self) -> bool {
        self.roots.iter().flatten().any(|root| self.goes_on(*root))
    }

    fn band(&self, canvas: &mut Canvas, band: &Band<'_>, (begin, koma): (usize, usize), top: f64) {
        let here = |at: &usize| (begin..begin + koma).contains(at);
        let mut y = top;
        if let Some(before) = &band.before {
            let middle = y + 10.0;
            let words = Type::new(style::SMALL).align(Align::Right).color(style::FAINT);
            canvas.text("before", (LEFT - 10.0, middle + 4.0), words);
            for (at, role, fate) in before.iter().filter(|(at, ..)| here(at)) {
                self.before(canvas, self.x(at - begin), middle, (*role, *fate));
            }
            y += SPACED;
        }
        let floor = y + self.badges_height() + TALL;
        let name = style::fitted(&band.layer.name, 18.0, LEFT - 20.0);
        let look = Type::new(18.0).bold().align(Align::Right);
        canvas.text(&name, (LEFT - 12.0, floor - 6.0), look);
        for (at, shown) in band.layer.timed() {
            let role = band.layer.drawings[shown.drawing].role;
            self.shown(canvas, role, (at, at + shown.koma), (begin, begin + koma), floor);
        }
        for badge in band.badges.iter().filter(|badge| here(&badge.koma)) {
            let Some(lane) = badge.lane else { continue };
            let x = self.x(badge.koma - begin) + 0.5 * self.slot;
            let low = floor - TALL - 2.0;
            let y = low - style::BADGE - 2.0 * style::BADGE * lane as f64;
            let colour = style::of_role(badge.role);
            canvas.line((x, y), (x, low + 2.0), colour, 1.0);
            canvas.badge((x, y), &badge.number.to_string(), colour, badge.pinned);
        }
    }

    /// Draws a drawing of the sheet before omission: a small stroke if it stays, otherwise the sign of its
    /// fate.
    fn before(&self, canvas: &mut Canvas, x: f64, middle: f64, (role, fate): (Role, Fate)) {
        let x = x + 0.5 * self.slot;
        let radius = (0.42 * self.slot).clamp(1.5, 4.0);
        match fate {
            Fate::Stays => {
                let half = (0.25 * self.slot).clamp(0.75, 2.0);
                let from = (x - half, middle - 5.0);
                canvas.rect(from, (x + half, middle + 5.0), style::of_role(role))
            }
            Fate::LeftOut => canvas.cross((x, middle), radius, style::GENGA, 1.5),
            Fate::Held => canvas.ring((x, middle), 0.8 * radius, style::FAINT, 1.0),
            Fate::HeldByHand => held_by_hand(canvas, (x, middle), 0.8 * radius),
        }
    }

    /// Draws a bar on the first koma and a line over the held koma, as far as they lie on this line.
    fn shown(
        &self,
        canvas: &mut Canvas,
        role: Role,
        (first, past): (usize, usize),
        (begin, end): (usize, usize),
        floor: f64,
    ) {
        let color = style::of_role(role);
        let gap = (0.12 * self.slot).clamp(0.5, 3.0);
        let high = if role == Role::Inbetween { SHORT } else { TALL };
        if (begin..end).contains(&first) {
            let x = self.x(first - begin);
            let corner = (x + self.slot - gap, floor);
            canvas.rect((x + gap, floor - high), corner, color);
        }
        let (from, to) = ((first + 1).max(begin), past.min(end));
        if from < to {
            let (y, left) = (floor - 0.5 * SHORT, self.x(from - begin) - gap);
            let right = self.x(to - begin) - 2.0 * gap;
            canvas.line((left, y), (right, y), color, 2.5);
            if past <= end {
                canvas.line((right, y - 4.0), (right, y + 4.0), color, 1.5);
            }
        }
    }
}
