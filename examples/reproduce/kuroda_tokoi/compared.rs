//! Compares several readings of Table 1 with the paper: on the sample, and on windows of real clips as long as the
//! paper's capture.

use genga::motion::Clip;
use genga::signal::{FilterKind, Measure, Side};

use super::fit::{Fit, filtered_away, lost, median, paper};
use super::readings::{self, Counts, STUDY, Six, Way, Width};
use crate::part::Part;
use crate::table::{Table, number, percent, spread};
use crate::takes::Take;
use crate::{Outcome, samples, windows};

/// Length in koma of the paper's 496 frames, and the shortest clip that is compared.
const KOMA: usize = 119;
const LEAST_KOMA: usize = 100;

/// The second rig of a take, left out so that the take counts once.
const AGAIN: &str = "threejs-pirouette";

/// The ways shown: those that differ from the study's in one choice, and those that others found best.
fn shown() -> Vec<Way> {
    let rising = Way { side: Side::Rising, ..STUDY };
    let both = Way { side: Side::Both, ..STUDY };
    let each_side = Way { width: Width::EachSide, ..STUDY };
    let kinds = [FilterKind::Gaussian, FilterKind::Ideal, FilterKind::Butterworth];
    let mut ways = vec![STUDY];
    ways.extend(kinds.map(|kind| Way { kind, ..STUDY }));
    ways.push(each_side);
    ways.extend([0.0, 0.01, 0.05, 0.1].map(|band| Way { band, ..STUDY }));
    ways.push(Way { measure: Measure::Angle, ..STUDY });
    ways.extend([both, rising]);
    ways.push(Way { width: Width::EachSide, ..rising });
    // The best way of an earlier prototype.
    ways.push(Way { measure: Measure::Angle, band: 0.01, side: Side::Both, ..each_side });
    ways
}

/// Makes the sample's table and the numbers of the prose.
pub(super) fn add_sample(part: &mut Part) -> Outcome<()> {
    let counts = Compared::new(&[samples::clip("kuroda-pitch")?])?;
    let mut table = Table::new(&["reading", ">level", ">shape", ">error"]);
    for way in shown() {
        let fit = Fit::new(counts.of_way(&way)[0].union);
        let [level, shape, error] =
            [fit.level(), fit.shape(), fit.error()].map(|value| number(value, 2));
        table.row(&[way.words(), level, shape, error]);
    }
    part.table("table-1-sample", table);
    let study = counts.of_way(&STUDY)[0];
    costs(part, "kt.paper", paper());
    costs(part, "kt.words", study.union);
    let rising = counts.of_way(&Way { side: Side::Rising, ..STUDY })[0];
    costs(part, "kt.rising", rising.union);
    part.number("kt.words.error", number(Fit::new(study.union).error(), 2));
    part.number("kt.rising.error", number(Fit::new(rising.union).error(), 2));
    let total = Fit::new(study.total);
    part.number("kt.total.level", number(total.level(), 1));
    let both = counts.of_way(&Way { side: Side::Both, ..STUDY })[0];
    part.number("kt.both.most", both.union[0]);
    let ideal = Way { kind: FilterKind::Ideal, width: Width::EachSide, ..STUDY };
    part.number("kt.ideal.lost", whole(lost(counts.of_way(&ideal)[0].union)[2]));
    Ok(())
}

/// Formats a share in whole %, for prose.
fn whole(share: f64) -> String {
    number(100.0 * share, 0)
}

/// Adds the shares lost to the longer persistence and to the widest filter.
fn costs(part: &mut Part, name: &str, counts: Six) {
    let [least, _, most] = spread(lost(counts));
    part.number(&format!("{name}.lost.least"), whole(least));
    part.number(&format!("{name}.lost.most"), whole(most));
    part.number(&format!("{name}.filtered"), whole(filtered_away(counts)));
}

/// Makes the tables of the real clips and the numbers of the prose.
pub(super) fn add_takes(part: &mut Part, takes: &[Take]) -> Outcome<()> {
    let koma =
        |take: &Take| take.clip.rate().koma_from_frames(take.clip.len(), genga::time::KOMA_RATE);
    let long = takes.iter().filter(|take| koma(take) >= LEAST_KOMA && take.name != AGAIN);
    let long: Vec<&Take> = long.collect();
    let window = |take: &&Take| windows::window(&take.clip, koma(take).min(KOMA));
    let clips = long.iter().map(window).collect::<Outcome<Vec<_>>>()?;
    let counts = Compared::new(&clips)?;
    part.table("table-1-clips", by_clip(&long, &clips, &counts));
    part.table("table-1-readings", by_way(&counts));
    part.number("kt.clips", clips.len());
    part.number("kt.ways", counts.ways.len());
    let levels = spread(counts.fits(&STUDY).iter().map(Fit::level));
    part.number("kt.clips.level.least", number(levels[0], 1));
    part.number("kt.clips.level", number(levels[1], 1));
    part.number("kt.clips.level.most", number(levels[2], 1));
    part.number("kt.clips.lost", whole(counts.lost(&STUDY)));
    let rising = Way { side: Side::Rising, ..STUDY };
    part.number(
        "kt.clips.rising.level",
        number(median(counts.fits(&rising).iter().map(Fit::level)), 1),
    );
    part.number("kt.clips.rising.lost", whole(counts.lost(&rising)));
    part.number("kt.clips.rising.nearer", counts.nearer(&rising));
    let each_side = Way { width: Width::EachSide, ..STUDY };
    part.number("kt.clips.each-side.nearer", counts.nearer(&each_side));
    let ideal = Way { kind: FilterKind::Ideal, ..each_side };
    part.number("kt.clips.ideal.lost", whole(counts.lost(&ideal)));
    Ok(())
}

fn by_clip(takes: &[&Take], clips: &[Clip], counts: &Compared) -> Table {
    let mut table = Table::new(&["clip", ">frames", ">joints", ">level", ">M costs"]);
    for ((take, clip), of_clip) in takes.iter().zip(clips).zip(counts.of_way(&STUDY)) {
        table.row(&[
            take.name.clone(),
            format!("{}–{}", clip.first(), clip.last()),
            clip.skeleton().len().to_string(),
            number(Fit::new(of_clip.union).level(), 2),
            percents(spread(lost(of_clip.union))),
        ]);
    }
    table
}

/// Formats a range from least to most, without the median.
fn percents([least, _, most]: [f64; 3]) -> String {
    format!("{} to {} %", whole(least), whole(most))
}

fn by_way(counts: &Compared) -> Table {
    let header = ["reading", ">level", ">shape", ">error", ">M costs", ">nearer than the words"];
    let mut table = Table::new(&header);
    for way in shown().into_iter().chain(counts.nearest()) {
        table.row(&counts.row(&way));
    }
    table
}

/// All ways counted on some clips.
struct Compared {
    ways: Vec<Way>,
    /// Per clip, the counts in the order of the ways.
    counts: Vec<Vec<Counts>>,
}

impl Compared {
    fn new(clips: &[Clip]) -> Outcome<Self> {
        let ways = readings::all();
        let counts = clips.iter().map(|clip| readings::count(clip, &ways));
        Ok(Self { counts: counts.collect::<Outcome<_>>()?, ways })
    }

    /// The counts of one way on each clip.
    fn of_way(&self, way: &Way) -> Vec<Counts> {
        let at = self.ways.iter().position(|other| other == way).expect("every way is counted");
        self.counts.iter().map(|counts| counts[at]).collect()
    }

    fn fits(&self, way: &Way) -> Vec<Fit> {
        self.of_way(way).iter().map(|counts| Fit::new(counts.union)).collect()
    }

    /// The median share lost to the longer persistence, over all clips and filter ranges.
    fn lost(&self, way: &Way) -> f64 {
        median(self.of_way(way).iter().flat_map(|counts| lost(counts.union)))
    }

    /// Number of clips on which a way is nearer to the paper than the study's way.
    fn nearer(&self, way: &Way) -> usize {
        let pairs = self.fits(way).into_iter().zip(self.fits(&STUDY));
        pairs.filter(|(fit, words)| fit.error() < words.error()).count()
    }

    /// The three ways with the smallest median error.
    fn nearest(&self) -> Vec<Way> {
        let error = |way: &Way| median(self.fits(way).iter().map(Fit::error));
        let mut ways: Vec<(f64, Way)> = self.ways.iter().map(|way| (error(way), *way)).collect();
        ways.sort_by(|a, b| a.0.total_cmp(&b.0));
        ways.into_iter().take(3).map(|(_, way)| way).collect()
    }

    fn row(&self, way: &Way) -> [String; 6] {
        let fits = self.fits(way);
        let middle = |of: fn(&Fit) -> f64| number(median(fits.iter().map(of)), 2);
        let nearer = if *way == STUDY { "–".into() } else { self.nearer(way).to_string() };
        [
            way.words(),
            middle(Fit::level),
            middle(Fit::shape),
            middle(Fit::error),
            percent(self.lost(way)),
            nearer,
        ]
    }
}
