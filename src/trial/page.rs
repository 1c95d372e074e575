//! The page (設問ページ): one file that shows the films, asks, and keeps the answers until they are saved.

use std::collections::BTreeSet;

use serde::Serialize;

use crate::deliver::Manifest;
use crate::error::Error;
use crate::motion::{Camera, Clip, Composite};
use crate::plain::cell;
use crate::plot::FigureBody;
use crate::plot::browser;
use crate::plot::films::Films;
use crate::sheet::Sheet;
use crate::trial::conditions::{Condition, STUCK, stuck};
use crate::trial::plan::{Plan, Planned, Shown};

/// A blind test: which conditions are laid side by side, and how they are shown.
#[derive(Debug, Clone, PartialEq)]
pub struct Trial {
    /// The conditions besides sheets of a person's own; default all.
    pub conditions: Vec<Condition>,
    /// Pairs that a person is asked of in each question, 1 to 200; default 20.
    pub pairs: usize,
    /// From where all films are seen; default auto.
    pub camera: Camera,
    /// How figures are drawn; default mannequin.
    pub body: FigureBody,
}

/// A motion that the trial shows.
#[derive(Debug, Clone)]
pub struct Take<'a> {
    /// What it is called in the answers. The person does not see it.
    pub name: &'a str,
    /// The motion as it was captured.
    pub source: &'a Clip,
    /// The motion that the sheet of the program is of: the source, or what was exaggerated.
    pub drawn: &'a Clip,
    /// The sheet of the program.
    pub sheet: &'a Sheet,
    /// Sheets of a person's own, the same names in the same order in each take.
    pub own: Vec<OwnSheet<'a>>,
}

/// A sheet of a person's own.
#[derive(Debug, Clone)]
pub struct OwnSheet<'a> {
    /// What the condition is called in the answers.
    pub name: &'a str,
    /// The motion that its drawings are of.
    pub drawn: &'a Clip,
    /// The sheet.
    pub sheet: &'a Sheet,
}

/// The files of a trial.
#[derive(Debug, Clone, PartialEq)]
pub struct Files {
    /// `index.html`: the page.
    pub page: String,
    /// `trial.json`: the plan as the page has it.
    pub json: String,
    /// The same.
    pub plan: Plan,
}

/// What the page gets.
#[derive(Serialize)]
struct Data<'a> {
    plan: &'a Plan,
    clips: &'a [Films],
}

/// Koma of the longest film, 20 seconds: nobody remembers the first of two longer ones.
const MOST_KOMA: usize = 480;
/// Pairs at most: nobody looks at more with the same eyes.
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
    /// [`Error::Setting`] for no pairs or too many, and for a condition that is named twice.
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

    /// Makes the page and the plan of some motions.
    ///
    /// # Errors
    /// [`Error::Setting`] as [`Trial::validate`] and for fewer than two conditions; [`Error::Sheet`] for motions and
    /// sheets that cannot be laid side by side, [`Error::Picture`] for what cannot be drawn.
    ///
    /// ```
    /// # use genga::{edits::Edits, pipeline::Engine, recipe::Recipe};
    /// use genga::trial::{Take, Trial};
    ///
    /// # let clip = genga::motion::bvh::open("data/kick.bvh".as_ref())?.clip;
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
        // The drawings are a part of what people judge.
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

    /// The conditions of all takes.
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

    /// The films of a take, that of catch pairs last.
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
        let films = Films::of(take.source, &sheets, self.camera, self.body)?;
        let name = cell(name).into_owned();
        Ok(Reel { shown: Shown { name, koma, drawings: names.zip(counts).collect() }, films })
    }
}

/// The films of a take.
struct Reel {
    shown: Shown,
    films: Films,
}

/// How often another drawing comes on screen.
fn changes(clip: &Clip, sheet: &Sheet) -> Result<usize, Error> {
    Ok(Composite::of(clip, sheet)?.layer().changes().count())
}

/// Checks that a sheet shows the same time as the take.
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

/// Refuses two conditions that are the same film in every take: nobody could tell them apart.
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
