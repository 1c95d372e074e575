//! Omission: naka-nashi (中無し) and koma-dori (コマ撮り) over one layer (KKMFT §3).

use std::ops::Range;

use serde::{Deserialize, Serialize};

use crate::error::Error;
use crate::knob::{Knobs, choices, knob, knobs};
use crate::sheet::Layer;
use crate::timing::drawing_list::Strip;
use crate::timing::naka_nashi::{NakaNashi, Quota};
use crate::timing::report::{Gone, OmissionReport, Shortfall, StageReport};
use crate::timing::{Amount, ByPassage, On, Stills, koma_dori};

#[cfg(test)]
mod tests;

/// Most drawings per action that naka-nashi leaves out by a share: beyond 4 to 6 an action no longer reads as one
/// movement (KKMFT §4). A plain count is not capped.
const MOST_BY_SHARE: usize = 6;

/// Settings of omission: which drawings are left out, and how long the others may stay (KKMFT §3).
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Omission {
    /// Naka-nashi (中無し): inbetweens left out of each action where its movement is fastest. A share is of the action's
    /// koma and gives 6 at most. Default 4%. Higher values make the movement jump, so that it no longer reads as one.
    pub naka_nashi: Amount,
    /// Koma-dori (コマ撮り): inbetweens replaced by the drawing before them where the movement is smallest. A share is of
    /// the inbetweens present when the stage begins. Default 1/3. Higher values lose small movement.
    pub koma_dori: Amount,
    /// Threshold of markedly fast movement (著しく速い), which naka-nashi may leave out: a multiple of the median movement
    /// between drawings of its action; 0 or more, default 2; 0 admits anything that moves. It does not apply on ones
    /// without genga. Lower values take drawings from evenly fast movements.
    pub fast: f64,
    /// Threshold of small movement (微小な動き), which koma-dori may hold: how far a joint goes at most (root mean square),
    /// in % of body height; 0 or more, default 3.3. It does not apply on ones without genga. Higher values hold
    /// drawings in the midst of a movement.
    pub small: f64,
    /// Most koma that koma-dori may let an exposure grow to, 1 or more; never below twice the sheet's fewest koma per
    /// drawing. Default 4. Higher values let the body stand still; lower values leave less out.
    pub max_hold: usize,
    /// Whether the koma freed by naka-nashi go to the drawing from which the movement starts, so that the length and
    /// the koma of the drawing it arrives at stay the same. Default true; otherwise the layer gets shorter.
    pub keep_length: bool,
    /// Whether naka-nashi chooses all drawings by the initial distances (KKMFT §3.4), for comparison. Default false; if
    /// true, the omissions scatter and hardly stress the speed.
    pub all_at_once: bool,
    /// The stage that goes first. Default: naka-nashi. KKMFT §3.4 sees no great difference; the other order shows much
    /// the same drawings at other times.
    pub order: Order,
}

/// The order of the two stages.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum Order {
    /// Naka-nashi, then koma-dori, as in the paper.
    #[default]
    NakaNashiFirst,
    /// Koma-dori, then naka-nashi.
    KomaDoriFirst,
}

choices!(Order { NakaNashiFirst: "naka_nashi_first", KomaDoriFirst: "koma_dori_first" });

/// Facts about a motion beyond its drawings.
#[derive(Debug, Clone, PartialEq)]
pub struct Course {
    /// Koma per drawing of the sheet.
    pub on: ByPassage<On>,
    /// The koma at which all actions but the first begin, in order.
    pub later: Vec<usize>,
    /// Koma in which no drawing is left out or held: those of gaits (歩き), as each step would differ, and those that
    /// show the source as it is.
    pub kept: Vec<Range<usize>>,
    /// Height of the body in the file's unit; infinite if unknown, so that every movement counts as small.
    pub height: f64,
}

impl Default for Course {
    fn default() -> Self {
        let on = On::every(1).into();
        Self { on, later: Vec::new(), kept: Vec::new(), height: f64::INFINITY }
    }
}

/// A layer after omission, with a report.
#[derive(Debug, Clone, PartialEq)]
pub struct Omitted {
    /// The remaining drawings, renumbered.
    pub layer: Layer,
    /// The report.
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
        "Inbetweens left out of each action where its movement is fastest (naka-nashi). More than \
         about 6 in one action make it jump.",
        "動作ごとに、いちばん速い動きから抜く中割りの枚数（中無し）。\
         一つの動作で6枚ほどを超えると飛んで見える。",
    )
    .unit("drawings an action, or a share of its koma (at most 6)"),
    koma_dori: knob(
        "コマ撮り",
        "Inbetweens replaced by holding the drawing before them, where the movement is slowest \
         (koma-dori). Higher values freeze small movements.",
        "いちばん遅い動きで、前の絵の止めに変える中割りの枚数（コマ撮り）。\
         多いほど小さな動きが止まる。",
    )
    .unit("drawings, or a share of the inbetweens"),
    fast: knob(
        "著しく速い動き",
        "How fast a movement must be for naka-nashi to leave a drawing out: its step from drawing \
         to drawing, as a multiple of the median in its action. 0 allows any movement.",
        "中無しで抜いてよい速さ。絵から絵への動きが、その動作の中央値の何倍以上か。\
         0なら動きがあれば抜く。",
    )
    .unit("times the median")
    .slider(0.0, 6.0),
    small: knob(
        "微小な動き",
        "Largest movement from the drawing before that koma-dori may replace by a hold, as the \
         root mean square over the joints. Higher values hold drawings in the middle of movements.",
        "コマ撮りで止めてよい動きの大きさ（部位の二乗平均の平方根）。大きいほど動きの途中でも止まる。",
    )
    .unit("% of body height")
    .slider(0.0, 20.0),
    max_hold: knob(
        "最長の止め",
        "Longest hold that koma-dori may make, but at least the time of two drawings (4 koma on \
         twos). Higher values freeze the body.",
        "コマ撮りで作る止めの長さの上限。ただし絵二枚分（2コマ打ちなら4コマ）を下回らない。\
         長いほど体が固まる。",
    )
    .unit("koma")
    .at_least(1.0)
    .slider(1.0, 12.0),
    keep_length: knob(
        "尺を保つ",
        "Whether the koma of left-out drawings go to their neighbours, so that the length stays \
         the same.",
        "抜いた絵のコマを前後の絵に渡し、尺を保つか。",
    ),
    all_at_once: knob(
        "一度に抜く",
        "Whether the fastest drawings are left out all at once instead of one by one. The effect \
         is weaker; for comparison.",
        "速い絵を一枚ずつでなく一度に抜くか。効果は弱く、比較のためのもの。",
    )
    .for_studies(),
    order: knob(
        "順番",
        "Which comes first, naka-nashi or koma-dori. The other order shows nearly the same \
         drawings at other times.",
        "中無しとコマ撮りのどちらを先にするか。順番を変えても、出る絵はほぼ同じで、\
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

    /// Like [`Omission::apply_to`], with the whole layer as one action, and every movement counted as small.
    ///
    /// # Errors
    /// As for [`Omission::apply_to`].
    ///
    /// ```
    /// use genga::sheet::Sheet;
    /// use genga::timing::{Amount, Omission, Stills};
    ///
    /// # let clip = genga::motion::bvh::open("data/kick.bvh".as_ref())?.clip;
    /// let sheet = Sheet::on_ones(clip.clock(24.0), clip.len());
    /// let layer = &sheet.layers[0];
    /// let omission = Omission { naka_nashi: Amount::Count(4), ..Omission::default() };
    /// let left = omission.apply(layer, &Stills::from_layer(&clip, layer), 1)?.layer;
    /// assert_eq!((left.length(), left.drawings.len()), (92, 59));
    /// # Ok::<(), genga::Error>(())
    /// ```
    pub fn apply(&self, layer: &Layer, stills: &Stills, on: usize) -> Result<Omitted, Error> {
        self.apply_to(layer, stills, &Course { on: On::every(on).into(), ..Course::default() })
    }

    /// Leaves drawings of a layer out. Genga, pinned and end drawings stay; in gaits, all drawings do. With
    /// `keep_length` they also keep their koma, except for fills, which lie in transit. Naka-nashi handles the actions
    /// one by one.
    ///
    /// `stills` are the positions of the layer's drawings. On ones without genga, naka-nashi is Algorithm 1 koma for
    /// koma, except that the first and the last drawing stay, and the thresholds of fast and small do not apply.
    ///
    /// # Errors
    /// [`Error::Setting`] when a setting is invalid; [`Error::Clip`] unless the layer shows each of its drawings once,
    /// in order, there is a still for each, and the actions begin in order.
    pub fn apply_to(
        &self,
        layer: &Layer,
        stills: &Stills,
        course: &Course,
    ) -> Result<Omitted, Error> {
        ByPassage::from(*self).apply_to(layer, stills, course)
    }

    /// Says that a share for naka-nashi is more of an action of `koma` koma than a share leaves out; `None` if it is
    /// not.
    pub fn capped(&self, koma: usize) -> Option<String> {
        let Amount::Share(_) = self.naka_nashi else { return None };
        let wanted = self.naka_nashi.resolve(koma);
        (wanted > MOST_BY_SHARE).then(|| {
            let share = self.naka_nashi;
            format!(
                "naka-nashi: {share} are {wanted} of {koma} koma, and a share leaves out at most {MOST_BY_SHARE}; \
                 a count, such as {wanted}, is not limited"
            )
        })
    }

    /// Returns the number of drawings that naka-nashi leaves out of an action of `koma` koma.
    fn count_in(&self, koma: usize) -> usize {
        match self.naka_nashi {
            Amount::Count(count) => count,
            share => share.resolve(koma).min(MOST_BY_SHARE),
        }
    }
}

impl ByPassage<Omission> {
    /// Like [`Omission::apply_to`]. A drawing is left out or held as on its first koma. Passages of equal settings share
    /// one number of drawings; the order of the stages is that of the first koma.
    ///
    /// # Errors
    /// As for [`Omission::apply_to`].
    pub fn apply_to(
        &self,
        layer: &Layer,
        stills: &Stills,
        course: &Course,
    ) -> Result<Omitted, Error> {
        self.values().try_for_each(Omission::validate)?;
        if !course.later.is_sorted() {
            return Err(Error::clip("actions must begin one after the other: sort their koma"));
        }
        let bound =
            |koma: usize| self.at(koma).max_hold.max(course.on.at(koma).least.saturating_mul(2));
        let mut strip = Strip::new(layer, stills, bound, course)?;
        let parts = self.parts(layer);
        let mut report = OmissionReport::default();
        match self.at(0).order {
            Order::NakaNashiFirst => {
                leave_out(&parts, layer, course, &mut strip, &mut report);
                hold(&parts, layer, course, &mut strip, &mut report);
            }
            Order::KomaDoriFirst => {
                hold(&parts, layer, course, &mut strip, &mut report);
                leave_out(&parts, layer, course, &mut strip, &mut report);
            }
        }
        Ok(Omitted { layer: strip.into_layer(layer), report })
    }

    /// Returns the parts of a layer that have equal settings.
    fn parts(&self, layer: &Layer) -> Vec<Part> {
        let mut parts: Vec<Part> = Vec::new();
        let ends = self.changes().chain([layer.length()]);
        let begins = std::iter::once(0).chain(self.changes());
        for (koma, settings) in begins.zip(ends).map(|(begin, end)| begin..end).zip(self.values()) {
            match parts.iter_mut().find(|part| part.settings == *settings) {
                Some(part) => part.koma.push(koma),
                None => parts.push(Part { settings: *settings, koma: vec![koma] }),
            }
        }
        parts
    }
}

/// The part of a layer for which one setting of omission holds.
struct Part {
    settings: Omission,
    koma: Vec<Range<usize>>,
}

impl Part {
    /// Returns the koma of the part within some koma.
    fn within(&self, koma: &Range<usize>) -> impl Iterator<Item = Range<usize>> {
        let both = |own: &Range<usize>| own.start.max(koma.start)..own.end.min(koma.end);
        self.koma.iter().map(both).filter(|koma| !koma.is_empty())
    }
}

fn leave_out(
    parts: &[Part],
    layer: &Layer,
    course: &Course,
    strip: &mut Strip<'_>,
    report: &mut OmissionReport,
) {
    let quotas = quotas(parts, layer, course, strip);
    quotas.iter().for_each(|quota| strip.tell_slow(&quota.drawings, quota.usual));
    let stage = NakaNashi { quotas };
    let taken = stage.run(strip);
    report.lengthened = taken.given;
    report.naka_nashi = StageReport {
        asked: stage.count(),
        done: taken.done,
        gone: named(layer, &taken.gone),
        shortfall: taken.shortfall,
    };
}

/// Computes how much naka-nashi leaves out of each action; a drawing belongs to the action in which it begins.
fn quotas(parts: &[Part], layer: &Layer, course: &Course, strip: &Strip<'_>) -> Vec<Quota> {
    let begins: Vec<usize> = layer.timed().map(|(begin, _)| begin).collect();
    let length = layer.length();
    let mut bounds = vec![0];
    bounds.extend(course.later.iter().filter(|koma| (1..length).contains(*koma)));
    bounds.dedup();
    bounds.push(length);
    let drawing = |koma: usize| begins.partition_point(|begin| *begin < koma);
    let drawings = |koma: Range<usize>| drawing(koma.start)..drawing(koma.end);
    let quota = |bounds: &[usize]| {
        let action = bounds[0]..bounds[1];
        let usual = strip.usual_way(drawings(action.clone()));
        parts.iter().filter_map(move |part| {
            let Omission { naka_nashi, fast, keep_length, all_at_once, .. } = part.settings;
            let own: Vec<Range<usize>> = part.within(&action).collect();
            let koma: usize = own.iter().map(ExactSizeIterator::len).sum();
            let fast = if strip.by_koma { 0.0 } else { fast };
            // A layer without koma is asked too, and says what it could not do.
            (koma > 0 || action.is_empty()).then(|| Quota {
                drawings: own.into_iter().map(drawings).collect(),
                count: part.settings.count_in(koma),
                is_count: matches!(naka_nashi, Amount::Count(_)),
                usual,
                fast: (fast * usual) * (fast * usual),
                keep_length,
                all_at_once,
            })
        })
    };
    bounds.windows(2).flat_map(quota).collect()
}

fn hold(
    parts: &[Part],
    layer: &Layer,
    course: &Course,
    strip: &mut Strip<'_>,
    report: &mut OmissionReport,
) {
    let begins: Vec<usize> = layer.timed().map(|(begin, _)| begin).collect();
    let mut stage = StageReport::default();
    for part in parts {
        let has = |drawing: usize| part.koma.iter().any(|koma| koma.contains(&begins[drawing]));
        let count = part.settings.koma_dori.resolve(strip.inbetweens(has));
        let small = part.settings.small / 100.0 * course.height;
        let small = match strip.by_koma {
            true => f64::INFINITY,
            false => small * small * strip.stills.joints() as f64,
        };
        let replaced = koma_dori::run(count, small, has, strip);
        stage.asked = stage.asked.saturating_add(count);
        stage.done += replaced.gone.len();
        stage.gone.extend(named(layer, &replaced.gone));
        let shortfall = unmet(part.settings.koma_dori, replaced.shortfall);
        stage.shortfall = shortfall.map(|why| why.after(stage.shortfall)).or(stage.shortfall);
    }
    report.koma_dori = stage;
}

/// Keeps the reason for doing less only if a count was asked for; a share is an upper bound.
fn unmet(asked: Amount, why: Option<Shortfall>) -> Option<Shortfall> {
    why.filter(|_| matches!(asked, Amount::Count(_)))
}

/// Describes drawings, given by index, with their places and koma in their layer.
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
