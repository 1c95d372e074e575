//! Why a drawing is on the sheet (理由): what makes it a genga, which joints turn there, and how the stages changed its
//! timing.

use std::fmt;
use std::ops::Deref;
use std::sync::Arc;

use serde::{Deserialize, Deserializer, Serialize, Serializer};

use super::is_default;

/// The reason why a drawing is a genga.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Reason {
    /// The body turns (変わり目).
    Turn,
    /// The body does not turn, but would stray from its path without a drawing (補い).
    Fill,
    /// A rest (止め) begins or ends.
    Rest,
    /// A contact (接地) begins or ends.
    Contact,
    /// Every step of the gait has this phase (歩み).
    Step,
    /// A person pinned it (固定).
    Pin,
}

impl Reason {
    /// Every reason.
    pub const ALL: [Self; 6] =
        [Self::Turn, Self::Fill, Self::Rest, Self::Contact, Self::Step, Self::Pin];

    /// Returns the word used in files.
    pub fn word(self) -> &'static str {
        match self {
            Self::Turn => "turn",
            Self::Fill => "fill",
            Self::Rest => "rest",
            Self::Contact => "contact",
            Self::Step => "step",
            Self::Pin => "pin",
        }
    }

    /// Returns the Japanese word.
    pub fn japanese(self) -> &'static str {
        match self {
            Self::Turn => "変わり目",
            Self::Fill => "補い",
            Self::Rest => "止め",
            Self::Contact => "接地",
            Self::Step => "歩み",
            Self::Pin => "固定",
        }
    }
}

/// Names shared by many drawings. Cloning a sheet does not copy them.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Names(Arc<[Arc<str>]>);

impl Deref for Names {
    type Target = [Arc<str>];

    fn deref(&self) -> &[Arc<str>] {
        &self.0
    }
}

impl<T: Into<Arc<str>>> FromIterator<T> for Names {
    fn from_iter<I: IntoIterator<Item = T>>(names: I) -> Self {
        Self(names.into_iter().map(Into::into).collect())
    }
}

impl Serialize for Names {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_seq(self.iter().map(|name| &**name))
    }
}

impl<'de> Deserialize<'de> for Names {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        Vec::<String>::deserialize(deserializer).map(Self::from_iter)
    }
}

/// Why a drawing is on the sheet, and how the stages changed its timing.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Why {
    /// Names of the joints that turn at this drawing.
    #[serde(skip_serializing_if = "is_default")]
    pub voters: Names,
    /// Name of the pin, if a person set one here; empty if they gave it no name.
    #[serde(skip_serializing_if = "is_default")]
    pub pinned: Option<String>,
    /// Source frame near which the key was found, if a person moved it.
    #[serde(skip_serializing_if = "is_default")]
    pub moved_from: Option<usize>,
    /// Reason why it is a genga; `None` for other drawings.
    #[serde(skip_serializing_if = "is_default")]
    pub reason: Option<Reason>,
    /// Strength of the turn at this genga, 0 to 1 (all joints together unless `keys.merge` is `body`); `None` for
    /// inbetweens.
    #[serde(skip_serializing_if = "is_default")]
    pub strength: Option<f64>,
    /// Error that the key saves, in % of body height: how far the body would be off without it. `None` for
    /// inbetweens.
    #[serde(skip_serializing_if = "is_default")]
    pub price: Option<f64>,
    /// Number of koma added by naka-nashi.
    #[serde(skip_serializing_if = "is_default")]
    pub lengthened: usize,
    /// Number of drawings just before it that naka-nashi left out.
    #[serde(skip_serializing_if = "is_default")]
    pub omitted_before: usize,
    /// Number of drawings after it that koma-dori, or a person's hold, replaced by it.
    #[serde(skip_serializing_if = "is_default")]
    pub held_for: usize,
    /// Whether a person set its duration.
    #[serde(skip_serializing_if = "is_default")]
    pub hold_set: bool,
}

/// Formats the reasons in words for the reason columns.
impl fmt::Display for Why {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut reasons = Vec::new();
        match self.pinned.as_deref() {
            None => {}
            Some("") => reasons.push("pinned".into()),
            Some(name) => reasons.push(format!("pinned: {name}")),
        }
        if let Some(from) = self.moved_from {
            reasons.push(format!("moved from frame {from}"));
        }
        match self.reason {
            Some(Reason::Fill) => reasons.push("keeps the body on its way".into()),
            Some(Reason::Rest) => reasons.push("a rest begins or ends".into()),
            Some(Reason::Contact) => reasons.push("a foot or a hand comes down or leaves".into()),
            Some(Reason::Step) => reasons.push("every step of the gait has it".into()),
            Some(Reason::Turn | Reason::Pin) | None => {}
        }
        if let [first, ..] = &*self.voters {
            let others = self.voters.len() - 1;
            let more =
                if others > 0 { format!(" and {others} more turn") } else { " turns".into() };
            reasons.push(format!("{first}{more}"));
        }
        if let Some(price) = self.price {
            reasons.push(format!("saves {price:.1} % of body height"));
        }
        let mut count = |count: usize, what: &str, words: &str| {
            if count > 0 {
                let plural = if count > 1 && what == "drawing" { "s" } else { "" };
                reasons.push(format!("{count} {what}{plural} {words}"));
            }
        };
        count(self.omitted_before, "drawing", "left out before it (naka-nashi)");
        count(self.lengthened, "koma", "given to it (naka-nashi)");
        let by = if self.hold_set { "held over" } else { "held over (koma-dori)" };
        count(self.held_for, "drawing", by);
        if self.hold_set {
            reasons.push("stays as long as was set by hand".into());
        }
        f.write_str(&reasons.join("; "))
    }
}

impl Why {
    /// Returns the reasons in Japanese, as many as [`Display`](fmt::Display) has in English.
    ///
    /// ```
    /// use genga::sheet::{Reason, Why};
    ///
    /// let why = Why { reason: Some(Reason::Rest), omitted_before: 1, ..Why::default() };
    /// assert_eq!(why.japanese(), "止めの始まりか終わり、1枚を直前で抜いた（中無し）");
    /// ```
    pub fn japanese(&self) -> String {
        let mut reasons: Vec<String> = Vec::new();
        match self.pinned.as_deref() {
            None => {}
            Some("") => reasons.push("固定".into()),
            Some(name) => reasons.push(format!("固定「{name}」")),
        }
        if let Some(from) = self.moved_from {
            reasons.push(format!("フレーム{from}から移動"));
        }
        match self.reason {
            Some(Reason::Fill) => reasons.push("ないと動きが崩れる".into()),
            Some(Reason::Rest) => reasons.push("止めの始まりか終わり".into()),
            Some(Reason::Contact) => reasons.push("足か手が着く、または離れる".into()),
            Some(Reason::Step) => reasons.push("歩き・走りの一歩ごとの原画".into()),
            Some(Reason::Turn | Reason::Pin) | None => {}
        }
        match &*self.voters {
            [] => {}
            [one] => reasons.push(format!("{one}の変わり目")),
            [first, others @ ..] => {
                reasons.push(format!("{first}ほか{}か所の変わり目", others.len()));
            }
        }
        if let Some(price) = self.price {
            reasons.push(format!("身長の{price:.1}%の誤差を防ぐ"));
        }
        let by = if self.hold_set { "" } else { "（コマ撮り）" };
        for (count, what) in [
            (self.omitted_before, "枚を直前で抜いた（中無し）".to_owned()),
            (self.lengthened, "コマ長くなった（中無し）".to_owned()),
            (self.held_for, format!("枚分止めた{by}")),
        ] {
            if count > 0 {
                reasons.push(format!("{count}{what}"));
            }
        }
        if self.hold_set {
            reasons.push("止めの長さは手動".into());
        }
        reasons.join("、")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn japanese_has_as_many_reasons_as_english() {
        let all = Why {
            voters: ["Hips", "Head"].into_iter().collect(),
            pinned: Some("hit".into()),
            moved_from: Some(12),
            reason: Some(Reason::Rest),
            price: Some(8.25),
            lengthened: 1,
            omitted_before: 2,
            held_for: 3,
            hold_set: true,
            ..Why::default()
        };
        let count = |text: String, between: &str| text.split(between).count();
        assert_eq!(count(all.japanese(), "、"), count(all.to_string(), "; "));
        assert_eq!(Why::default().japanese(), "");
        assert_eq!(
            Why { omitted_before: 1, price: Some(10.0), ..Why::default() }.japanese(),
            "身長の10.0%の誤差を防ぐ、1枚を直前で抜いた（中無し）"
        );
    }
}
