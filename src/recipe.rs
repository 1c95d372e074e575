//! The recipe: every setting of the chain, one settings struct per stage, in one small TOML file together with a
//! person's corrections.

mod doubts;
mod file;
mod footage;
mod knobs;
mod scopes;
mod timing;

use serde::{Deserialize, Serialize};

use crate::error::Error;
use crate::exaggerate::Exaggerate;
use crate::keys::{ActionFinder, Choose, Layers};
use crate::knob::{Knobs, knob, knobs};
use crate::motion::SeenFrom;
use crate::sheet::{Feet, RootMotion};
use crate::signal::{LowPass, Speed, TurnFinder};
use crate::time::KOMA_RATE;
use crate::timing::{Omission, Spacing};

use scopes::Scope;

pub use crate::knob::{Kind, Knob, Who};
pub use footage::Footage;
pub use knobs::{KNOBS, unknown_beside};
pub use scopes::{Frames, Outside, Overrides, Passage, Scopes};
pub use timing::LayerTiming;

/// The prefix of a setting that weights a joint, followed by the joint's name.
const WEIGHTS: &str = "keys.weights.";

/// All settings of the chain. The defaults alone give a sheet that an animator can use.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Recipe {
    /// Koma per second of the sheet, 2 to 1000; default 24.
    pub rate: f64,
    /// The layers (セル) of the sheet, each with its own keys, spacing and omission. Default: one, the whole body. With
    /// several, hands and feet can be held on their own, but the body comes apart a little: its parts on one koma are
    /// not all from the same instant.
    pub layers: Layers,
    /// The source of the body's travel while a drawing is held. Default: the drawings themselves. With `ones`, the
    /// source moves the body on every koma: the travel is smooth, but planted feet slide with the body as long as their
    /// drawing is held.
    pub root: RootMotion,
    /// Camera in which movement is measured; default `world`. A camera's screen counts for speeds of displacement, for
    /// the keys and rests of the body, and for what omission leaves out.
    pub seen_from: SeenFrom,
    /// Whether a standing foot is held in place. Default: it stays as drawn. A held foot does not slide as far as the
    /// leg reaches, but the leg's angles then differ from the performer's.
    pub feet: Feet,
    /// Whether the sheet is a round of a loop (リピート), default no. The clip's last pose must be its first; the sheet
    /// then goes on with its first drawing.
    pub r#loop: bool,
    /// How many rounds of the loop the sheet has, 1 to 1000; default 1.
    pub cycles: usize,
    /// Exaggeration, applied before all other stages. Default: off.
    pub exaggerate: Exaggerate,
    /// Measures the speed of each joint.
    pub speed: Speed,
    /// Smooths the speeds.
    pub filter: LowPass,
    /// Finds the turns of the speeds.
    pub turns: TurnFinder,
    /// Chooses which turns become keys of the layer.
    pub keys: Choose,
    /// Splits the take into actions.
    pub actions: ActionFinder,
    /// Places the inbetweens and picks the poses they show.
    pub spacing: Spacing,
    /// Leaves drawings out.
    pub omission: Omission,
    /// Settings of single layers and of passages, over all others.
    #[serde(skip_serializing_if = "Scopes::is_empty")]
    pub scopes: Scopes,
}

impl Default for Recipe {
    fn default() -> Self {
        Self {
            rate: KOMA_RATE,
            layers: Layers::default(),
            root: RootMotion::default(),
            seen_from: SeenFrom::World,
            feet: Feet::default(),
            r#loop: false,
            cycles: 1,
            exaggerate: Exaggerate::default(),
            speed: Speed::default(),
            filter: LowPass::default(),
            turns: TurnFinder::default(),
            keys: Choose::default(),
            actions: ActionFinder::default(),
            spacing: Spacing::default(),
            omission: Omission::default(),
            scopes: Scopes::default(),
        }
    }
}

knobs!(Recipe {
    rate: knob(
        "コマ数",
        "Koma per second of the sheet. Film and TV animation use 24.",
        "シートの毎秒コマ数。映画やテレビアニメは24。",
    )
    .unit("koma a second")
    // Fewer would be written as a frame time that reads as a rate; the table of more would not fit into memory.
    .at_least(2.0)
    .at_most(1000.0)
    .slider(2.0, 60.0),
    layers: knob(
        "セル分け",
        "Layers of the sheet, each with its own keys and timing: the whole body (body), the trunk \
         and each limb (limbs), or every moving joint (joints). A recipe can also name layers: [{ \
         name = \"A\", joints = [\"Hips\", \"*Arm*\"] }].",
        "シートのセル分け。全身を一枚（body）、胴と手足（limbs）、動く部位ごと（joints）。\
         セルごとに原画とタイミングを持つ。レシピでは名前を付けて分けることもできる。",
    ),
    root: knob(
        "移動",
        "How the body travels through space. drawings: with its drawings. ones: on every koma as \
         in the source (1コマ打ち), so held drawings slide.",
        "体の移動。drawingsでは絵とともに動く。onesでは元の動きのまま1コマ打ちで動き、\
         止めた絵のまま体が滑っていく。",
    ),
    seen_from: knob(
        "見る位置",
        "Where movement is measured: in the world, or on the screen of a camera, where movement \
         towards the camera is small. It affects displacements, keys, rests and omission, but not \
         rotations.",
        "動きを測る場所。空間（world）か、カメラの画面の上か。画面では、\
         カメラへ向かう動きは小さい。移動・原画・止め・省略に効き、回転には効かない。",
    )
    .unit("world | auto | front | side | three-quarter, or X,Y,Z:X,Y,Z (where a camera stands : what it looks at)"),
    feet: knob(
        "接地",
        "Position of a standing foot. free: as in its drawing. held: in one place for as long as \
         it stands in the source; hip and knee adapt.",
        "接地した足の位置。freeは絵のまま。heldは素材で接地している間一か所に止め、\
         股と膝で合わせる。",
    ),
    r#loop: knob(
        "リピート",
        "Whether the sheet is a round that repeats: the clip's last pose is its first, and after the \
         last drawing the first comes again.",
        "シートをリピートの一周分にするか。素材の最後のポーズが最初と同じで、最後の絵の次に最初の絵が来る。",
    ),
    cycles: knob(
        "リピートの回数",
        "How many rounds of the loop the sheet has. All show the same drawings.",
        "シートに入れるリピートの回数。どの周も同じ絵を使う。",
    )
    .unit("rounds")
    .at_least(1.0)
    .at_most(1000.0),
    ..[exaggerate, speed, filter, turns, keys, actions, spacing, omission], ..scopes
});

impl Recipe {
    /// Checks every setting.
    ///
    /// # Errors
    /// [`Error::Setting`] naming the first knob that is out of its range.
    pub fn validate(&self) -> Result<(), Error> {
        self.check()?;
        self.layers.validate()?;
        self.keys.weights.validate()?;
        self.scopes.validate(self)
    }

    /// Sets one knob from text, as `--set KEY=VALUE` does. The text `none` clears an optional one.
    ///
    /// `B/spacing.on` is the knob of layer B, `120..240:spacing.on` that of a passage of source frames (the last not
    /// included), `B/120..240:spacing.on` that of a passage of one layer; `none` takes such a setting back. `passages`
    /// is the list of all, and `outside` what is shown elsewhere.
    ///
    /// # Errors
    /// [`Error::Setting`] when there is no such knob, it holds for the whole take, or does not accept the value.
    ///
    /// ```
    /// use genga::recipe::Recipe;
    ///
    /// let mut recipe = Recipe::default();
    /// recipe.set("filter.width", "0.2s")?;
    /// assert_eq!(recipe.get("filter.width")?, "0.2s");
    /// assert!(recipe.set("filter.width", "-1").is_err(), "and nothing is changed");
    /// # Ok::<(), genga::Error>(())
    /// ```
    pub fn set(&mut self, name: &str, text: &str) -> Result<(), Error> {
        if let Some(joint) = name.strip_prefix(WEIGHTS).filter(|joint| !joint.is_empty()) {
            return self.set_weight(joint, text.trim());
        }
        match name {
            "passages" => return self.set_passages(text.trim()),
            "outside" => return self.set_outside(text.trim()),
            _ => {}
        }
        if let Some((scope, knob)) = Scope::split(name)? {
            return self.set_of(&scope, knob, text.trim());
        }
        let mut changed = self.clone();
        changed.turn(name, text).ok_or_else(|| knobs::unknown(name))??;
        changed.validate()?;
        *self = changed;
        Ok(())
    }

    /// Sets the weight of the joints that a name or pattern matches; `none` removes it.
    fn set_weight(&mut self, joint: &str, text: &str) -> Result<(), Error> {
        let mut weights = self.keys.weights.clone();
        if text == "none" {
            weights.0.remove(joint);
        } else {
            let weight = text.parse().map_err(|_| {
                let message = format!("expected a number, 0 (no say) or more, found \"{text}\"");
                Error::setting(format!("{WEIGHTS}{joint}"), message)
            })?;
            weights.0.insert(joint.into(), weight);
        }
        weights.validate()?;
        self.keys.weights = weights;
        Ok(())
    }

    /// Sets a knob of a layer or a passage.
    fn set_of(&mut self, scope: &Scope, name: &str, text: &str) -> Result<(), Error> {
        scope.admit(name)?;
        let knob = Knob::find(name).map_err(|error| scope.named(error))?;
        let word = match text {
            "none" if !knob.is_optional() => None,
            text => {
                let mut own = self.without_scopes();
                own.set(name, text).map_err(|error| scope.named(error))?;
                Some(own.get(name)?)
            }
        };
        let mut changed = self.clone();
        changed.scopes.of(scope).put(name, word);
        changed.scopes.layers.retain(|_, own| !own.is_empty());
        changed.validate()?;
        *self = changed;
        Ok(())
    }

    /// Adds a passage as on the command line: `[LAYER/]A..B`, with a setting behind it or without, as in
    /// `120..240:spacing.on=1`. Without one it has the settings of its layer. The same range again adds a setting.
    ///
    /// # Errors
    /// [`Error::Setting`] as [`Recipe::set`], and if there is no range.
    ///
    /// ```
    /// use genga::recipe::Recipe;
    ///
    /// let mut recipe = Recipe::default();
    /// recipe.add_passage("120..240:spacing.on=1")?;
    /// recipe.add_passage("B/120..240")?;
    /// assert_eq!(recipe.scopes.passages.len(), 2);
    /// # Ok::<(), genga::Error>(())
    /// ```
    pub fn add_passage(&mut self, text: &str) -> Result<(), Error> {
        let (name, word) =
            text.split_once('=').map_or((text, None), |(name, word)| (name, Some(word)));
        let wrong = || {
            let message = format!(
                "expected [LAYER/]A..B[:KEY=VALUE], as in 120..240:spacing.on=1, found \"{text}\""
            );
            Error::setting("passages", message)
        };
        let (scope, knob) = Scope::split(name.trim())?.ok_or_else(wrong)?;
        match (scope.frames, word, knob) {
            (Some(_), Some(word), knob) if !knob.is_empty() => {
                self.set_of(&scope, knob, word.trim())
            }
            (Some(_), None, "") => self.add(&scope),
            _ => Err(wrong()),
        }
    }

    /// Adds a layer or passage without settings, unless it is there.
    fn add(&mut self, scope: &Scope) -> Result<(), Error> {
        let mut changed = self.clone();
        changed.scopes.of(scope);
        changed.validate()?;
        *self = changed;
        Ok(())
    }

    fn set_passages(&mut self, text: &str) -> Result<(), Error> {
        let mut changed = self.clone();
        changed.scopes.passages.clear();
        if text != "none" {
            let read = changed.overlaid(&format!("passages = {text}"));
            (changed, _) = read.map_err(|error| match error {
                Error::Recipe { message, .. } => Error::setting("passages", message),
                other => other,
            })?;
        }
        *self = changed;
        Ok(())
    }

    fn set_outside(&mut self, text: &str) -> Result<(), Error> {
        self.scopes.outside = text.parse().map_err(|message| Error::setting("outside", message))?;
        Ok(())
    }

    /// Returns the recipe without settings of layers and passages.
    fn without_scopes(&self) -> Self {
        Self { scopes: Scopes::default(), ..self.clone() }
    }

    /// Returns every setting with its value, in the words of [`Recipe::set`]: all of [`KNOBS`], the weights given to
    /// joints, and the settings of layers and passages.
    pub fn settings(&self) -> Vec<(String, String)> {
        let mut values = self.values();
        values.sort_by_key(|(knob, _)| knob.who);
        let knobs = values.into_iter().map(|(knob, value)| (knob.name.to_owned(), value.text()));
        let weights = self.keys.weights.0.iter();
        let weights =
            weights.map(|(joint, weight)| (format!("{WEIGHTS}{joint}"), weight.to_string()));
        knobs.chain(weights).chain(self.scopes.settings()).collect()
    }

    /// Returns a knob's value as text that [`Recipe::set`] reads back.
    ///
    /// # Errors
    /// [`Error::Setting`] when there is no such knob.
    pub fn get(&self, name: &str) -> Result<String, Error> {
        if name == "outside" {
            return Ok(self.scopes.outside.to_string());
        }
        let own = self.values().into_iter().find(|(knob, _)| knob.name == name);
        let of_scope = || self.scopes.settings().find(|(own, _)| own == name).map(|(_, word)| word);
        let own = own.map(|(_, value)| value.text()).or_else(of_scope);
        own.ok_or_else(|| knobs::unknown(name))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_knob_gives_what_it_takes() {
        let recipe = Recipe::default();
        for knob in KNOBS {
            let mut again = recipe.clone();
            let value = recipe.get(knob.name).unwrap();
            again.set(knob.name, &value).unwrap_or_else(|error| panic!("{}: {error}", knob.name));
            assert_eq!(again, recipe, "{}", knob.name);
        }
    }

    #[test]
    fn settings_are_in_the_order_of_the_knobs() {
        let settings = Recipe::default().settings().into_iter();
        let names: Vec<String> = settings.map(|(name, _)| name).collect();
        assert_eq!(names, KNOBS.iter().map(|knob| knob.name).collect::<Vec<_>>());
    }

    #[test]
    fn wrong_settings_say_what_would_be_right() {
        let mut recipe = Recipe::default();
        let mut error = |name, value| recipe.set(name, value).unwrap_err().to_string();
        assert!(error("filter.widht", "1").contains("filter.width"), "the nearest name is offered");
        assert!(error("filter.kind", "blur").contains("box, gaussian, ideal, butterworth"));
        assert!(error("layers", "limb").contains("one of body, limbs, joints, found \"limb\""));
        assert!(error("layers", "[]").contains("the list has no layer"));
        assert!(error("spacing.on", "0").contains("1 (ones)"));
        assert!(error("spacing.on", "two").contains("spacing.on"));
        for rate in ["-1", "0.9", "1001", "nan"] {
            assert!(error("rate", rate).contains("2 to 1000"), "{rate}");
        }
        assert!(error("omission.naka_nashi", "none").contains("share of its koma"), "0 is none");
        assert_eq!(recipe, Recipe::default(), "nothing was changed");
    }
}
