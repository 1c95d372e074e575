//! Weights of joints, which a person sets by name or pattern.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use crate::error::{Error, did_you_mean};
use crate::motion::Skeleton;

/// Largest weight. Sums of larger ones over the body may overflow.
const MOST: f64 = 1e6;

/// Weights of joints by their names, or by patterns in which `*` stands for any letters and `?` for one.
///
/// If several fit a joint, its whole name wins, then the pattern with the most letters of its own, then the later in
/// the alphabet. A joint that none fits has weight 1. Weight 0 excludes a joint, and 1000000 is the most.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
#[serde(transparent)]
pub struct JointWeights(pub BTreeMap<String, f64>);

impl JointWeights {
    /// Whether no weight is set.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// Checks the values.
    ///
    /// # Errors
    /// [`Error::Setting`] naming the first weight that is not a number from 0 to 1000000.
    pub fn validate(&self) -> Result<(), Error> {
        match self.0.iter().find(|(_, weight)| !(0.0..=MOST).contains(*weight)) {
            None => Ok(()),
            Some((name, weight)) => {
                let message = format!(
                    "expected a number, 0 (no say) or more, at most {MOST}; 1 is usual, found {weight:?}"
                );
                Err(Error::setting(knob(name), message))
            }
        }
    }

    /// Returns the weight of each joint.
    ///
    /// # Errors
    /// [`Error::Setting`] if a name or pattern fits no joint, with a similar name if there is one; or if no joint has a
    /// weight above 0.
    pub fn resolve(&self, skeleton: &Skeleton) -> Result<Vec<f64>, Error> {
        self.validate()?;
        let names = || skeleton.joints.iter().map(|joint| joint.name.as_str());
        if let Some(pattern) =
            self.0.keys().find(|pattern| !names().any(|name| fits(pattern, name)))
        {
            let hint = did_you_mean(pattern, names());
            let message = format!("the clip has no such joint{hint}");
            return Err(Error::setting(knob(pattern), message));
        }
        let weights: Vec<f64> = names().map(|name| self.weight(name)).collect();
        if weights.iter().any(|weight| *weight > 0.0) {
            Ok(weights)
        } else {
            Err(Error::setting("keys.weights", "every joint has 0: leave one that has a say"))
        }
    }

    /// Returns the weight of a joint with that name.
    fn weight(&self, name: &str) -> f64 {
        let fitting = self.0.iter().filter(|(pattern, _)| fits(pattern, name));
        let own = |pattern: &str| pattern.chars().filter(|letter| !"*?".contains(*letter)).count();
        // `max_by_key` takes the last of equals.
        let best = fitting.max_by_key(|(pattern, _)| (*pattern == name, own(pattern)));
        best.map_or(1.0, |(_, weight)| *weight)
    }
}

/// Returns the setting's name for `--set`.
fn knob(name: &str) -> String {
    format!("keys.weights.{name}")
}

/// Whether a pattern fits a name. A name with a `*` or `?` of its own fits itself.
pub(super) fn fits(pattern: &str, name: &str) -> bool {
    pattern == name
        || matches(&pattern.chars().collect::<Vec<_>>(), &name.chars().collect::<Vec<_>>())
}

/// Matches letter by letter. On a mismatch, the last `*` takes one letter more.
fn matches(pattern: &[char], name: &[char]) -> bool {
    let (mut at, mut letter) = (0, 0);
    let mut star = None;
    while letter < name.len() {
        match pattern.get(at) {
            Some('*') => {
                star = Some((at, letter));
                at += 1;
            }
            Some(own) if *own == '?' || *own == name[letter] => {
                at += 1;
                letter += 1;
            }
            _ => {
                let Some((begin, taken)) = star else { return false };
                star = Some((begin, taken + 1));
                (at, letter) = (begin + 1, taken + 1);
            }
        }
    }
    pattern[at..].iter().all(|own| *own == '*')
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::motion::Joint;

    fn weights(texts: &[(&str, f64)]) -> JointWeights {
        JointWeights(texts.iter().map(|(name, weight)| ((*name).to_owned(), *weight)).collect())
    }

    fn skeleton(names: &[&str]) -> Skeleton {
        let joint = |name: &&str| Joint {
            name: (*name).into(),
            parent: None,
            offset: glam::DVec3::X,
            channels: vec![],
            first_channel: 0,
            end_sites: vec![],
        };
        Skeleton { joints: names.iter().map(joint).collect() }
    }

    #[test]
    fn the_most_exact_name_wins() {
        let body = skeleton(&["Hips", "LeftHand", "LeftHandThumb", "RightHand", "left hand"]);
        let set =
            [("*", 0.5), ("*Hand*", 2.0), ("LeftHand", 3.0), ("????", 0.25), ("Left*Thumb", 0.0)];
        assert_eq!(weights(&set).resolve(&body).unwrap(), [0.25, 3.0, 0.0, 2.0, 0.5]);
        assert_eq!(weights(&[("*L*", 2.0), ("L*", 3.0), ("*", 1.0)]).weight("Leg"), 3.0);
        assert_eq!(weights(&[]).resolve(&body).unwrap(), [1.0; 5]);
        let odd = skeleton(&["a*b", "acb"]);
        assert_eq!(weights(&[("a*b", 2.0), ("a?b", 3.0)]).resolve(&odd).unwrap(), [2.0, 3.0]);
    }

    #[test]
    fn what_fits_no_joint_is_said_with_a_similar_name() {
        let body = skeleton(&["Hips", "LeftHand", "RightHand"]);
        let error = |set: &[(&str, f64)]| weights(set).resolve(&body).unwrap_err().to_string();
        let said = error(&[("LeftHnad", 2.0)]);
        assert_eq!(
            said,
            "keys.weights.LeftHnad: the clip has no such joint; did you mean LeftHand?"
        );
        assert!(error(&[("*Foot*", 2.0)]).starts_with("keys.weights.*Foot*: the clip has no such"));
        assert!(error(&[("*", 0.0)]).contains("every joint has 0"));
        for wrong in [-1.0, f64::NAN, f64::INFINITY, 1e308, 1_000_001.0] {
            assert!(error(&[("Hips", wrong)]).contains("0 (no say) or more"));
        }
    }

    /// Matches directly, by each way to read the first letter of the pattern.
    fn slowly(pattern: &[char], name: &[char]) -> bool {
        match pattern.split_first() {
            None => name.is_empty(),
            Some(('*', rest)) => (0..=name.len()).any(|from| slowly(rest, &name[from..])),
            Some((own, rest)) => name.split_first().is_some_and(|(letter, others)| {
                (own == letter || *own == '?') && slowly(rest, others)
            }),
        }
    }

    proptest! {
        #[test]
        fn a_pattern_fits_as_by_its_words(pattern in "[ab*?]{0,7}", name in "[ab]{0,8}") {
            let letters = |text: &str| text.chars().collect::<Vec<_>>();
            let (pattern, name) = (letters(&pattern), letters(&name));
            prop_assert_eq!(matches(&pattern, &name), slowly(&pattern, &name));
        }
    }
}
