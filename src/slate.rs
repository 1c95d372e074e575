//! The slate (カチンコ): which work, episode, scene and cut a sheet belongs to, and who draws it.

use std::fmt;

use serde::{Deserialize, Serialize};

use crate::error::Error;
use crate::sanitize::is_hidden;

/// Most digits of a number in a file name. A longer run of digits is a date or a serial number.
const MOST_DIGITS: usize = 4;

/// The slate of a cut. A field is empty if it is not known.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(
    default,
    deny_unknown_fields,
    expecting = "a slate {\"title\", \"episode\", \"scene\", \"cut\", …}"
)]
pub struct Slate {
    /// The title of the work (作品).
    #[serde(skip_serializing_if = "String::is_empty")]
    pub title: String,
    /// The episode (話数).
    #[serde(skip_serializing_if = "String::is_empty")]
    pub episode: String,
    /// The scene (シーン).
    #[serde(skip_serializing_if = "String::is_empty")]
    pub scene: String,
    /// The cut (カット), possibly with a letter: `45A`.
    #[serde(skip_serializing_if = "String::is_empty")]
    pub cut: String,
    /// The take (テイク).
    #[serde(skip_serializing_if = "String::is_empty")]
    pub take: String,
    /// The name of the key animator (原画).
    #[serde(skip_serializing_if = "String::is_empty")]
    pub animator: String,
}

impl Slate {
    /// Reads the numbers in a file name, as in `ep03_s12_c045_t2`: words `ep`, `s` or `sc`, `c`, and `t` or `tk`, each
    /// followed by 1 to 4 digits, between underscores, hyphens or blanks. A letter may follow the number of the cut
    /// (`c045a`). A name without a cut has an empty slate, because its numbers may mean anything. So has `c3d`, which
    /// is a file format.
    ///
    /// ```
    /// use genga::slate::Slate;
    ///
    /// let slate = Slate::from_name("EP03_s12_c045a-t2");
    /// assert_eq!(slate.to_string(), "episode 03, scene 12, cut 045a, take 2");
    /// assert!(Slate::from_name("s12_walk_2024-05-01.c3d").is_empty(), "there is no cut");
    /// ```
    pub fn from_name(name: &str) -> Self {
        let mut slate = Self::default();
        for word in name.split(['_', '-', ' ', '.']) {
            let letters = word.bytes().take_while(u8::is_ascii_alphabetic).count();
            let (kind, number) = word.split_at(letters);
            let field = match kind.to_ascii_lowercase().as_str() {
                "ep" => &mut slate.episode,
                "s" | "sc" => &mut slate.scene,
                "c" if !word.eq_ignore_ascii_case("c3d") => &mut slate.cut,
                "t" | "tk" => &mut slate.take,
                _ => continue,
            };
            let digits = match kind {
                "c" | "C" => number.strip_suffix(|letter: char| letter.is_ascii_alphabetic()),
                _ => None,
            };
            let digits = digits.unwrap_or(number);
            let is_number = digits.bytes().all(|digit| digit.is_ascii_digit());
            // Of two numbers of one kind the first stays: the second is usually a version.
            if is_number && (1..=MOST_DIGITS).contains(&digits.len()) && field.is_empty() {
                *field = number.into();
            }
        }
        if slate.cut.is_empty() { Self::default() } else { slate }
    }

    /// Whether no field is known.
    pub fn is_empty(&self) -> bool {
        *self == Self::default()
    }

    /// Lays this slate over another one: fields that are empty here come from there.
    #[must_use]
    pub fn over(mut self, other: Self) -> Self {
        for (field, other) in self.fields_mut().into_iter().zip(other.into_fields()) {
            if field.is_empty() {
                *field = other;
            }
        }
        self
    }

    /// The numbers of cut and scene, as digits without leading zeros; `None` unless both have 1 to 4 digits. Other text
    /// round the digits is left out, because a timesheet's header holds digits alone.
    pub fn numbers(&self) -> Option<(String, String)> {
        Some((number(&self.cut)?, number(&self.scene)?))
    }

    /// Checks the fields.
    ///
    /// # Errors
    /// [`Error::Edits`] for a line break or a letter that is not seen.
    pub fn validate(&self) -> Result<(), Error> {
        match self.named().into_iter().find(|(_, field)| field.chars().any(is_hidden)) {
            None => Ok(()),
            Some((name, _)) => Err(Error::Edits {
                message: format!(
                    "the slate's {name} has a line break or a letter that is not seen: write it on one line"
                ),
            }),
        }
    }

    /// The fields with their names, in the order of the slate.
    pub fn named(&self) -> [(&'static str, &str); 6] {
        [
            ("title", &self.title),
            ("episode", &self.episode),
            ("scene", &self.scene),
            ("cut", &self.cut),
            ("take", &self.take),
            ("animator", &self.animator),
        ]
    }

    fn fields_mut(&mut self) -> [&mut String; 6] {
        [
            &mut self.title,
            &mut self.episode,
            &mut self.scene,
            &mut self.cut,
            &mut self.take,
            &mut self.animator,
        ]
    }

    fn into_fields(self) -> [String; 6] {
        [self.title, self.episode, self.scene, self.cut, self.take, self.animator]
    }
}

/// Formats the known fields: `episode 3, scene 12, cut 45A`.
impl fmt::Display for Slate {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let known = self.named().into_iter().filter(|(_, field)| !field.is_empty());
        for (at, (name, field)) in known.enumerate() {
            let comma = if at == 0 { "" } else { ", " };
            write!(f, "{comma}{name} {field}")?;
        }
        Ok(())
    }
}

/// The only run of digits in a field, without leading zeros.
fn number(field: &str) -> Option<String> {
    let mut runs =
        field.split(|letter: char| !letter.is_ascii_digit()).filter(|run| !run.is_empty());
    let (run, None) = (runs.next()?, runs.next()) else { return None };
    let number = run.trim_start_matches('0');
    let number = if number.is_empty() { "0" } else { number };
    (number.len() <= MOST_DIGITS).then(|| number.into())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_name_tells_its_cut_by_the_words_of_the_trade() {
        for (name, said) in [
            ("ep03_s12_c045_t2", "episode 03, scene 12, cut 045, take 2"),
            ("EP3-SC1-C7A", "episode 3, scene 1, cut 7A"),
            ("show_ep12_c034", "episode 12, cut 034"),
            ("s3 c045 tk11 walk", "scene 3, cut 045, take 11"),
            ("c001", "cut 001"),
            ("c045_c046", "cut 045"),
            ("s1_c2_genga_ts", "scene 1, cut 2"),
        ] {
            assert_eq!(Slate::from_name(name).to_string(), said, "{name}");
        }
    }

    #[test]
    fn a_name_without_a_cut_tells_nothing() {
        for name in [
            "kick",
            "",
            "walk_c3d",
            "s12_walk.C3D",
            "ep03_s12",
            "2024-05-01",
            "cmu-11_01-soccer-kick",
            "take20240501",
            "c20240501",
            "c",
            "c045ab",
            "c4a5",
            "s3_cut45",
            "カット45",
            "c４５",
        ] {
            assert!(Slate::from_name(name).is_empty(), "{name}: {}", Slate::from_name(name));
        }
    }

    #[test]
    fn a_header_has_the_digits_of_cut_and_scene_if_it_has_both() {
        let numbers = |scene: &str, cut: &str| {
            let slate = Slate { scene: scene.into(), cut: cut.into(), ..Slate::default() };
            slate.numbers().map(|(cut, scene)| format!("{cut} {scene}"))
        };
        assert_eq!(numbers("12", "045a").as_deref(), Some("45 12"));
        assert_eq!(numbers("S3", "000").as_deref(), Some("0 3"));
        for (scene, cut) in [("", "45"), ("12", ""), ("12", "45-46"), ("12", "12345"), ("A", "1")] {
            assert_eq!(numbers(scene, cut), None, "{scene} {cut}");
        }
    }

    #[test]
    fn fields_that_are_given_go_over_those_of_the_name() {
        let given = Slate { cut: "46".into(), animator: "アキ".into(), ..Slate::default() };
        let both = given.clone().over(Slate::from_name("ep03_s12_c045"));
        assert_eq!(both.to_string(), "episode 03, scene 12, cut 46, animator アキ");
        assert_eq!(given.clone().over(Slate::default()), given);
        assert!(given.validate().is_ok());
        assert!(Slate { title: "a\nb".into(), ..given }.validate().is_err());
    }
}
