//! Omission: naka-nashi (中無し) and koma-dori (コマ撮り) over one layer (KKMFT §3).

use std::ops::Range;

use serde::{Deserialize, Serialize};

use crate::error::Error;
use crate::knob::{Knobs, choices, knob, knobs};
use crate::sheet::Layer;
use crate::timing::naka_nashi::{NakaNashi, Quota};
use crate::timing::report::{Gone, OmissionReport, Shortfall, StageReport};
use crate::timing::strip::Strip;
use crate::timing::{Amount, On, Stills, koma_dori};

#[cfg(test)]
mod tests;

/// A share for naka-nashi gives at most this many an action: beyond 4 to 6 it no longer reads as one
/// movement (KKMFT §4). A plain count is not capped.
const MOST_BY_SHARE: usize = 6;

/// Which drawings are left out, and how long the others may stay for it (KKMFT §3).
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Omission {
    /// Naka-nashi (中無し): inbetweens left out of each action where its movement is fastest; a share is
    /// of the action's koma and gives 6 at most. Default 4%. Raised, the movement jumps and no longer
    /// reads as one.
    pub naka_nashi: Amount,
    /// Koma-dori (コマ撮り): inbetweens replaced by the drawing before them where the movement is
    /// smallest; a share is of the inbetweens there are when it begins. Default 1/3. Raised, small
    /// movement is lost.
    pub koma_dori: Amount,
    /// What is markedly fast (著しく速い), so that naka-nashi may leave it out: so many times the movement from drawing to
    /// drawing in the middle of its action (the median); 0 or more, default 2, 0 for anything that moves. It does not
    /// count on ones without genga. Lowered, evenly fast movements lose drawings.
    pub fast: f64,
    /// What is a small movement (微小な動き), so that koma-dori may hold the drawing before it: so far at the most a joint
    /// goes (root mean square), in % of body height; 0 or more, default 3.3. It does not count on ones without genga.
    /// Raised, drawings are held in the midst of a movement.
    pub small: f64,
    /// Koma that koma-dori may let an exposure grow to, 1 or more; never below twice the sheet's fewest koma a drawing.
    /// Default 4. Raised, the body stands still; lowered, less can be left out.
    pub max_hold: usize,
    /// Whether koma freed by naka-nashi are given to the drawing from which the movement starts, so that the length
    /// stays and what it arrives at stays on its koma. Default true; without it the layer gets shorter.
    pub keep_length: bool,
    /// Whether naka-nashi chooses all drawings by the distances at its beginning (KKMFT §3.4), for
    /// comparison. Default false; with it the omissions scatter and the speed is hardly stressed.
    pub all_at_once: bool,
    /// Which of the two goes first. Default naka-nashi. KKMFT §3.4 sees no great difference; the other order shows much the same
    /// drawings at other times.
    pub order: Order,
}

/// Which of the two stages goes first.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum Order {
    /// Naka-nashi, then koma-dori, as in the paper.
    #[default]
    NakaNashiFirst,
    /// Koma-dori, then naka-nashi.
    KomaDoriFirst,
}

choices!(Order { NakaNashiFirst: "naka_nashi_first", KomaDoriFirst: "koma_dori_first" });

/// What is known of a motion beside its drawings.
#[derive(Debug, Clone, PartialEq)]
pub struct Course {
    /// For how many koma the sheet has a drawing.
    pub on: On,
    /// The koma on which each action but the first begins, in order.
    pub later: Vec<usize>,
    /// Koma of gaits (歩き), in which no drawing is left out or held: each step would be another.
    pub gaits: Vec<Range<usize>>,
    /// The height of the body in the file's unit; infinite where it is not known, and every movement is small.
    pub height: f64,
}

impl Default for Course {
    fn default() -> Self {
        Self { on: On::every(1), later: Vec::new(), gaits: Vec::new(), height: f64::INFINITY }
    }
}

/// A layer with drawings left out, and what was done to it.
#[derive(Debug, Clone, PartialEq)]
pub struct Omitted {
    /// The drawings that are left, numbered anew.
    pub layer: Layer,
    /// What was done.
    pub report: OmissionReport,
}

impl Default for Omission {
    fn default() -> Self {
        Self {
            naka_nashi: Amount::Share(0.04),
            koma_dori: Amount::Share(1.0 / 3.0),
            fast: 2.0,
            small: 3.3,
            max_hold: 4,
            keep_length: true,
            all_at_once: false,
            order: Order::default(),
        }
    }
}

knobs!(omission::Omission {
    naka_nashi: knob(
        "中無し",
        "How many inbetweens of the fastest movement are left out of each action (naka-nashi). \
         More than about 6 in one and it jumps.",
        "動作ごとに、いちばん速い動きの中割りを何枚抜くか（中無し）。\
         一つの動作で6枚ほどを超えると飛んで見える。",
    )
    .unit("drawings an action, or a share of its koma (at most 6)"),
    koma_dori: knob(
        "コマ撮り",
        "How many inbetweens of the slowest movement are held over (koma-dori). More stills small \
         movements.",
        "いちばん遅い動きの中割りを何枚止めに変えるか（コマ撮り）。多いほど小さな動きが止まる。",
    )
    .unit("drawings, or a share of the inbetweens"),
    fast: knob(
        "著しく速い動き",
        "How many times as far as usual in its action the body must go from drawing to drawing for \
         naka-nashi to leave one out. 0 is anything that moves.",
        "中無しで抜いてよい速さ。絵から絵への動きが、その動作のふつう（中央値）の何倍以上か。0なら動きがあれば抜く。",
    )
    .unit("times the median")
    .slider(0.0, 6.0),
    small: knob(
        "微小な動き",
        "How far a joint may go in the mean from the drawing before for koma-dori to hold that one. \
         More holds drawings in the midst of movements.",
        "コマ撮りで止めてよい動きの大きさ（部位の平均）。大きいほど動きの途中でも止まる。",
    )
    .unit("% of body height")
    .slider(0.0, 20.0),
    max_hold: knob(
        "最長の止め",
        "How long koma-dori may let a drawing stay, though never less than two drawings' time (4 \
         koma on twos). Longer freezes the body.",
        "コマ撮りで一枚をどこまで長く見せてよいか。\
         ただし絵二枚分（2コマ打ちなら4コマ）を下回らない。長いほど体が固まる。",
    )
    .unit("koma")
    .at_least(1.0)
    .slider(1.0, 12.0),
    keep_length: knob(
        "尺を保つ",
        "Whether the koma of left-out drawings are given to their neighbours.",
        "抜いた絵のコマを前後の絵に渡し、尺を保つかどうか。",
    ),
    all_at_once: knob(
        "一度に抜く",
        "Leave out the fastest drawings all at once instead of one by one: weaker, for comparison.",
        "速い絵を一枚ずつでなく一度に抜く。効果は弱く、比較のためのもの。",
    )
    .for_studies(),
    order: knob(
        "順番",
        "Which of naka-nashi and koma-dori comes first. The other order shows much the same \
         drawings at other times.",
        "中無しとコマ撮りのどちらを先にするか。変えると、出る絵はおおむね同じで、\
         出る時刻が変わる。",
    )
    .for_studies(),
});

impl Omission {
    /// Checks the settings.
    ///
    /// # Errors
    /// [`Error::Setting`] for a share outside 0 to 1 or a `max_hold` of 0.
    pub fn validate(&self) -> Result<(), Error> {
        self.check()
    }

    /// [`Omission::apply_to`] where the whole layer is one action, and no movement too large to be small.
    ///
    /// # Errors
    /// Those of [`Omission::apply_to`].
    ///
    /// ```
    /// use genga::sheet::Sheet;
    /// use genga::timing::{Amount, Omission, Stills};
    ///
    /// # let clip = genga::motion::bvh::open("data/kick.bvh".as_ref())?.clip;
    /// let sheet = Sheet::on_ones(clip.clock(24.0), clip.len());
    /// let layer = &sheet.layers[0];
    /// let omission = Omission { naka_nashi: Amount::Count(4), ..Omission::default() };
    /// let left = omission.apply(layer, &Stills::of(&clip, layer), 1)?.layer;
    /// assert_eq!((left.length(), left.drawings.len()), (92, 59));
    /// # Ok::<(), genga::Error>(())
    /// ```
    pub fn apply(&self, layer: &Layer, stills: &Stills, on: usize) -> Result<Omitted, Error> {
        self.apply_to(layer, stills, &Course { on: On::every(on), ..Course::default() })
    }

    /// Leaves drawings of a layer out: genga, pinned and end drawings stay. With `keep_length` they stay on their koma
    /// too, but for fills, which lie in transit, and in gaits all drawings do. Naka-nashi goes through the actions one by one.
    ///
    /// `stills` are the positions of the layer's drawings. On ones without genga naka-nashi is Algorithm 1 koma for koma,
    /// but that the first and the last drawing stay, and what is fast or small does not count.
    ///
    /// # Errors
    /// [`Error::Setting`] when a setting cannot be; [`Error::Clip`] unless the layer shows each of its
    /// drawings once, in order, there is a still for each, and the actions begin in order.
    pub fn apply_to(
        &self,
        layer: &Layer,
        stills: &Stills,
        course: &Course,
    ) -> Result<Omitted, Error> {
        self.validate()?;
        if !course.later.is_sorted() {
            return Err(Error::clip("actions must begin one after the other: sort their koma"));
        }
        let bound = self.max_hold.max(course.on.least.saturating_mul(2));
        let mut strip = Strip::new(layer, stills, bound, course)?;
        let mut report = OmissionReport::default();
        match self.order {
            Order::NakaNashiFirst => {
                self.leave_out(layer, course, &mut strip, &mut report);
                self.hold(layer, course, &mut strip, &mut report);
            }
            Order::KomaDoriFirst => {
                self.hold(layer, course, &mut strip, &mut report);
                self.leave_out(layer, course, &mut strip, &mut report);
            }
        }
        Ok(Omitted { layer: strip.into_layer(layer), report })
    }

    fn leave_out(
        &self,
        layer: &Layer,
        course: &Course,
        strip: &mut Strip<'_>,
        report: &mut OmissionReport,
    ) {
        let quotas = self.quotas(layer, course, strip);
        quotas.iter().for_each(|quota| strip.tell_slow(quota.drawings.clone(), quota.usual));
        let stage =
            NakaNashi { quotas, keep_length: self.keep_length, all_at_once: self.all_at_once };
        let taken = stage.run(strip);
        report.lengthened = taken.given;
        report.naka_nashi = StageReport {
            asked: stage.count(),
            done: taken.done,
            gone: named(layer, &taken.gone),
            shortfall: unmet(self.naka_nashi, taken.shortfall),
        };
    }

    /// What naka-nashi leaves out of each action: a drawing belongs to the one in which it begins.
    fn quotas(&self, layer: &Layer, course: &Course, strip: &Strip<'_>) -> Vec<Quota> {
        let begins: Vec<usize> = layer.timed().map(|(begin, _)| begin).collect();
        let length = layer.length();
        let mut bounds = vec![0];
        bounds.extend(course.later.iter().filter(|koma| (1..length).contains(*koma)));
        bounds.dedup();
        bounds.push(length);
        let drawing = |koma: usize| begins.partition_point(|begin| *begin < koma);
        let quota = |bounds: &[usize]| {
            let drawings = drawing(bounds[0])..drawing(bounds[1]);
            let fast = if strip.by_koma { 0.0 } else { self.fast };
            let usual = strip.usual_way(drawings.clone());
            let count = self.count_in(bounds[1] - bounds[0]);
            Quota { drawings, count, usual, fast: (fast * usual) * (fast * usual) }
        };
        bounds.windows(2).map(quota).collect()
    }

    /// Drawings that naka-nashi leaves out of an action of so many koma.
    fn count_in(&self, koma: usize) -> usize {
        match self.naka_nashi {
            Amount::Count(count) => count,
            share => share.of(koma).min(MOST_BY_SHARE),
        }
    }

    fn hold(
        &self,
        layer: &Layer,
        course: &Course,
        strip: &mut Strip<'_>,
        report: &mut OmissionReport,
    ) {
        let count = self.koma_dori.of(strip.inbetweens());
        let small = self.small / 100.0 * course.height;
        let small = match strip.by_koma {
            true => f64::INFINITY,
            false => small * small * strip.stills.joints() as f64,
        };
        let replaced = koma_dori::run(count, small, strip);
        report.koma_dori = StageReport {
            asked: count,
            done: replaced.gone.len(),
            gone: named(layer, &replaced.gone),
            shortfall: unmet(self.koma_dori, replaced.shortfall),
        };
    }
}

/// Why less was done than asked for; a share is the most that may go.
fn unmet(asked: Amount, why: Option<Shortfall>) -> Option<Shortfall> {
    why.filter(|_| matches!(asked, Amount::Count(_)))
}

/// Drawings by their index, with their places and koma in the layer they stood in.
fn named(layer: &Layer, drawings: &[usize]) -> Vec<Gone> {
    if drawings.is_empty() {
        return Vec::new();
    }
    let begins: Vec<usize> = layer.timed().map(|(begin, _)| begin).collect();
    let gone = |&drawing: &usize| Gone {
        drawing,
        place: layer.drawings[drawing].source.place(),
        koma: begins[drawing],
    };
    drawings.iter().map(gone).collect()
}
