//! The page (設問ページ): one file that shows the films, asks the questions, and keeps the answers until they are saved.

use std::collections::BTreeSet;

use serde::Serialize;

use crate::conditions::{Condition, STUCK, stuck};
use crate::plan::{Plan, Planned, Shown};
use genga::error::Error;
use genga::motion::{Camera, Clip, Composite};
use genga::sanitize::cell;
use genga::sheet::Sheet;
use genga_files::Manifest;
use genga_plot::FigureBody;
use genga_plot::browser;
use genga_plot::films::Films;

/// A blind test: the compared conditions and how they are shown.
#[derive(Debug, Clone, PartialEq)]
pub struct Trial {
    /// The conditions besides a person's own sheets; default all.
    pub conditions: Vec<Condition>,
    /// Number of pairs that a person sees for each question, 1 to 200; default 20.
    pub pairs: usize,
    /// The camera of all films; default auto.
    pub camera: Camera,
    /// Style of the figures; default mannequin.
    pub body: FigureBody,
}

/// A motion shown in the trial.
#[derive(Debug, Clone)]
pub struct Take<'a> {
    /// Its name in the answers, hidden from the person.
    pub name: &'a str,
    /// The captured motion.
    pub source: &'a Clip,
    /// The motion that the program's sheet shows: the source, or the exaggerated motion.
    pub drawn: &'a Clip,
    /// The program's sheet.
    pub sheet: &'a Sheet,
    /// A person's own sheets, with the same names in the same order in each take.
    pub own: Vec<OwnSheet<'a>>,
}

/// A person's own sheet.
#[derive(Debug, Clone)]
pub struct OwnSheet<'a> {
    /// The name of the condition in the answers.
    pub name: &'a str,
    /// The motion that its drawings show.
    pub drawn: &'a Clip,
    /// The sheet.
    pub sheet: &'a Sheet,
}

/// The files of a trial.
#[derive(Debug, Clone, PartialEq)]
pub struct Files {
    /// `index.html`: the page.
    pub page: String,
    /// `trial.json`: the plan, as embedded in the page.
    pub json: String,
    /// The plan.
    pub plan: Plan,
}

/// The data embedded in the page.
#[derive(Serialize)]
struct Data<'a> {
    plan: &'a Plan,
    clips: &'a [Films],
}

/// Length of the longest film in koma, 20 seconds. Of two longer films nobody remembers the first.
const MOST_KOMA: usize = 480;
/// Largest number of pairs. Beyond it, attention fades.
const MOST_PAIRS: usize = 200;

const PAGE: &str = include_str!("page/page.html");
const LOOK: &str = include_str!("page/look.css");
const SCRIPTS: [&str; 7] = [
    include_str!("page/words.js"),
    browser::FIGURE,
    include_str!("page/order.js"),
    include_str!("page/screen.js"),
    include_str!("page/film.js"),
    include_str!("page/answers.js"),
    include_str!("page/trial.js"),
];

impl Default for Trial {
    fn default() -> Self {
        Self {
            conditions: Condition::ALL.into(),
            pairs: 20,
            camera: Camera::default(),
            body: FigureBody::default(),
        }
    }
}

impl Trial {
    /// Checks the settings.
    ///
    /// # Errors
    /// [`Error::Setting`] for no pairs or too many, and for a condition listed twice.
    pub fn validate(&self) -> Result<(), Error> {
        if !(1..=MOST_PAIRS).contains(&self.pairs) {
            let message = format!("expected 1 to {MOST_PAIRS} pairs, found {}", self.pairs);
            return Err(Error::setting("pairs", message));
        }
        let mut seen = BTreeSet::new();
        match self.conditions.iter().find(|condition| !seen.insert(**condition)) {
            None => Ok(()),
            Some(twice) => {
                Err(Error::setting("conditions", format!("{twice} is named twice; once is enough")))
            }
        }
    }

    /// Creates the page and the plan from some motions.
    ///
    /// # Errors
    /// [`Error::Setting`] as in [`Trial::validate`] and for fewer than two conditions; [`Error::Sheet`] for motions and
    /// sheets that cannot be compared; [`Error::Picture`] for figures that cannot be drawn.
    ///
    /// ```
    /// # use genga::{edits::Edits, pipeline::Engine, recipe::Recipe};
    /// use genga_trial::{Take, Trial};
    ///
    /// # let clip = genga::motion::bvh::open("../../data/kick.bvh".as_ref())?.clip;
    /// # let mut engine = Engine::new(clip)?;
    /// let made = engine.run(&Recipe::default(), &Edits::default())?;
    /// let take = Take { name: "kick", source: made.source, drawn: made.clip, sheet: made.sheet, own: vec![] };
    /// let files = Trial::default().files(&[take])?;
    /// let drawings = &files.plan.clips[0].drawings;
    /// assert_eq!((drawings["genga"], drawings["uniform"], drawings["twos"]), (26, 26, 47));
    /// # Ok::<(), genga::Error>(())
    /// ```
    pub fn files(&self, takes: &[Take<'_>]) -> Result<Files, Error> {
        self.validate()?;
        let conditions = self.planned(takes)?;
        let reels = takes.iter().map(|take| self.reel(take)).collect::<Result<Vec<_>, _>>()?;
        differ(&conditions, &reels)?;
        let koma_rate = takes[0].sheet.clock.koma_rate;
        if let Some(other) = takes.iter().find(|take| take.sheet.clock.koma_rate != koma_rate) {
            let (name, rate) = (other.name, other.sheet.clock.koma_rate);
            let message =
                format!("{name} has {rate} koma a second, {} has {koma_rate}", takes[0].name);
            return Err(Error::sheet(message));
        }
        let (clips, films): (Vec<_>, Vec<_>) =
            reels.into_iter().map(|reel| (reel.shown, reel.films)).unzip();
        let mut plan = Plan::new((koma_rate, self.camera.word()), conditions, clips, self.pairs);
        let data = |plan: &Plan| browser::json_in_script(&Data { plan, clips: &films });
        // The digest covers the films as well, as people judge those.
        plan.trial = Manifest::digest(data(&plan)?.as_bytes());
        let json = serde_json::to_string_pretty(&plan)
            .map_err(|source| Error::Encoding { what: "the plan", source: source.into() })?
            + "\n";
        let filled = [
            ("{{look}}", LOOK.to_owned()),
            ("{{data}}", data(&plan)?),
            ("{{script}}", SCRIPTS.concat()),
        ];
        Ok(Files { page: browser::fill(PAGE, &filled), json, plan })
    }

    /// Collects the conditions of all takes.
    fn planned(&self, takes: &[Take<'_>]) -> Result<Vec<Planned>, Error> {
        let first = takes.first().ok_or_else(|| Error::sheet("a trial needs a motion"))?;
        let own = |take: &Take<'_>| take.own.iter().map(|own| own.name.to_owned()).collect();
        let names: Vec<String> = own(first);
        if let Some(other) = takes.iter().find(|take| own(take) != names) {
            let message =
                format!("{} has other sheets of your own than {}", other.name, first.name);
            return Err(Error::sheet(message));
        }
        let given = self.conditions.iter().map(|condition| Planned {
            name: condition.to_string(),
            what: condition.sentence().to_owned(),
        });
        let own = names.iter().map(|name| Planned {
            name: name.clone(),
            what: "A sheet of the asker's own.".to_owned(),
        });
        let planned: Vec<Planned> = given.chain(own).collect();
        let is_plain = |letter: char| letter.is_alphanumeric() || "-_".contains(letter);
        if let Some(name) = names.iter().find(|name| name.is_empty() || !name.chars().all(is_plain))
        {
            let message = format!("expected a name of letters and digits, found \"{name}\"");
            return Err(Error::setting("sheet", message));
        }
        let mut seen = BTreeSet::from([STUCK]);
        if let Some(twice) = planned.iter().find(|planned| !seen.insert(&planned.name)) {
            let message = format!("there is a condition {} already; take another name", twice.name);
            return Err(Error::setting("sheet", message));
        }
        match planned.len() {
            0 | 1 => Err(Error::setting("conditions", "a pair needs two of them at the least")),
            _ => Ok(planned),
        }
    }

    /// Draws the films of a take, the one of catch pairs last.
    fn reel(&self, take: &Take<'_>) -> Result<Reel, Error> {
        let (clock, koma) = (take.sheet.clock, take.sheet.length());
        let name = take.name;
        fits(take, (take.source, take.sheet), "its sheet")?;
        if koma > MOST_KOMA {
            return Err(Error::sheet(format!(
                "{name} has {koma} koma, too long to be judged in pairs: {MOST_KOMA} at the most, or better 100; see \
                 --trim, or genga split"
            )));
        }
        let drawings = changes(take.drawn, take.sheet)?;
        let even = self.conditions.iter().map(|condition| condition.sheet(clock, koma, drawings));
        let even: Vec<Option<Sheet>> = even.collect();
        let still = stuck(clock, koma);
        let given = even.iter().map(|sheet| match sheet {
            Some(sheet) => (take.source, sheet),
            None => (take.drawn, take.sheet),
        });
        let own = take.own.iter().map(|own| (own.drawn, own.sheet));
        let sheets: Vec<_> = given.chain(own).chain([(take.source, &still)]).collect();
        for (own, sheet) in take.own.iter().zip(&sheets[self.conditions.len()..]) {
            fits(take, *sheet, own.name)?;
        }
        let counts = sheets.iter().map(|(clip, sheet)| changes(clip, sheet));
        let counts = counts.collect::<Result<Vec<_>, _>>()?;
        let names = self.conditions.iter().map(ToString::to_string);
        let names = names.chain(take.own.iter().map(|own| own.name.to_owned()));
        let films = Films::new(take.source, &sheets, self.camera, self.body)?;
        let name = cell(name).into_owned();
        Ok(Reel { shown: Shown { name, koma, drawings: names.zip(counts).collect() }, films })
    }
}

/// The films of a take.
struct Reel {
    shown: Shown,
    films: Films,
}

/// Counts how often the drawing on screen changes.
fn changes(clip: &Clip, sheet: &Sheet) -> Result<usize, Error> {
    Ok(Composite::new(clip, sheet)?.layer().changes().count())
}

/// Checks that a sheet covers the same time as the take.
fn fits(take: &Take<'_>, (clip, sheet): (&Clip, &Sheet), what: &str) -> Result<(), Error> {
    let name = take.name;
    let clock = take.source.clock(sheet.clock.koma_rate);
    let koma = clock.frame_rate.koma_from_frames(take.source.len(), clock.koma_rate);
    if sheet.clock != clock || sheet.clock != take.sheet.clock {
        return Err(Error::sheet(format!(
            "{name}: {what} begins elsewhere, or has another rate, than the motion: make it of the same frames"
        )));
    }
    if sheet.length() != koma {
        let length = sheet.length();
        return Err(Error::sheet(format!(
            "{name}: {what} has {length} koma and the motion {koma}; films of a pair last as long as each other"
        )));
    }
    if clip.skeleton().len() != take.source.skeleton().len() {
        return Err(Error::sheet(format!("{name}: {what} is of another skeleton")));
    }
    Ok(())
}

/// Rejects two conditions with the same film in every take, as nobody could tell them apart.
fn differ(conditions: &[Planned], reels: &[Reel]) -> Result<(), Error> {
    for (a, one) in conditions.iter().enumerate() {
        for (b, other) in conditions.iter().enumerate().skip(a + 1) {
            if reels.iter().all(|reel| reel.films.is_same(a, b)) {
                return Err(Error::setting(
                    "conditions",
                    format!(
                        "{} and {} are the same films; leave one of them out",
                        one.name, other.name
                    ),
                ));
            }
        }
    }
    Ok(())
}
