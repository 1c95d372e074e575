//! The recipe: every setting of the chain, one settings struct per stage, in one small TOML file together with a
//! person's corrections.

mod file;
mod footage;
mod knobs;

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

pub use crate::knob::{Kind, Knob, Who};
pub use footage::Footage;
pub use knobs::KNOBS;

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
    ..[exaggerate, speed, filter, turns, keys, actions, spacing, omission]
});

impl Recipe {
    /// Checks every setting.
    ///
    /// # Errors
    /// [`Error::Setting`] naming the first knob that is out of its range.
    pub fn validate(&self) -> Result<(), Error> {
        self.check()?;
        self.layers.validate()?;
        self.keys.weights.validate()
    }

    /// Sets one knob from text, as `--set KEY=VALUE` does. The text `none` clears an optional one.
    ///
    /// # Errors
    /// [`Error::Setting`] when there is no such knob, or the knob does not accept the value.
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

    /// Returns every setting with its value, in the words of [`Recipe::set`]: all of [`KNOBS`], and the weights given
    /// to joints.
    pub fn settings(&self) -> Vec<(String, String)> {
        let mut values = self.values();
        values.sort_by_key(|(knob, _)| knob.who);
        let knobs = values.into_iter().map(|(knob, value)| (knob.name.to_owned(), value.text()));
        let weights = self.keys.weights.0.iter();
        let weights =
            weights.map(|(joint, weight)| (format!("{WEIGHTS}{joint}"), weight.to_string()));
        knobs.chain(weights).collect()
    }

    /// Returns a knob's value as text that [`Recipe::set`] reads back.
    ///
    /// # Errors
    /// [`Error::Setting`] when there is no such knob.
    pub fn get(&self, name: &str) -> Result<String, Error> {
        let own = self.values().into_iter().find(|(knob, _)| knob.name == name);
        own.map(|(_, value)| value.text()).ok_or_else(|| knobs::unknown(name))
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
