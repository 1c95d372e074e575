//! Assigns joints to bones by name: the table of dialects, a person's own rows, and the matches in a clip.

pub mod bones;

use std::collections::{BTreeMap, HashMap, HashSet};

use serde::Deserialize;
use toml::Spanned;

use crate::error::{Error, in_words};
use crate::motion::body::members::joints_of_others;
use crate::motion::body::side::{DASHES, own_name};
use crate::motion::body::{limbs, structure};
use crate::motion::{Clip, Declared, JointId, Skeleton, plain_name};
use bones::{LONGEST_NAME, Model, Side, cp932};

/// The built-in table of names.
const DIALECTS: &str = include_str!("names/dialects.toml");

/// Dialect reported if no name is known and the body's shape alone assigns the joints.
pub const SHAPE: &str = "by shape";

/// The bone table (ボーン対応表): the names that programs give the joints of each MMD bone, overridden by a person's own
/// rows.
#[derive(Debug, Clone, PartialEq)]
pub struct BoneMap {
    /// Bones that joints are assigned to.
    pub model: Model,
    dialects: Vec<Dialect>,
    /// Rows of a person.
    own: BTreeMap<String, Vec<String>>,
    /// Number of dialects added by a person; they come first.
    added: usize,
}

/// Naming scheme of one program.
#[derive(Debug, Clone, PartialEq)]
struct Dialect {
    name: String,
    /// Joints that form each bone, from the body outward.
    rows: BTreeMap<String, Vec<String>>,
    /// Plain names of these joints.
    plain: BTreeMap<String, Vec<String>>,
}

/// Match between a skeleton and the bone table.
#[derive(Debug, Clone, PartialEq)]
pub struct Found {
    /// Dialect of the names, or [`SHAPE`].
    pub dialect: String,
    /// Joints of each bone of the model, from the body outward; empty if the bone is not driven.
    pub joints: Vec<Vec<JointId>>,
    /// Bones whose joints come from the body's shape, because names gave none or wrong ones.
    pub by_shape: Vec<String>,
    /// Names in a person's own rows that no joint of the body has.
    pub missing: Vec<String>,
}

impl Default for BoneMap {
    /// The built-in table.
    fn default() -> Self {
        let mut map =
            Self { model: Model::standard(), dialects: vec![], own: BTreeMap::new(), added: 0 };
        map.take(DIALECTS).expect("the table that comes with the program is tested");
        map.added = 0;
        map
    }
}

impl BoneMap {
    /// Adds a person's file to the built-in table. Rows under `[bones]` replace those of any dialect, `[[dialect]]`
    /// adds a dialect, and `[extra."NAME"]` adds a bone to the standard ones. `docs/input.md` shows each.
    ///
    /// # Errors
    ///
    /// [`Error::Setting`] with line and column, if the file is not TOML, has an unknown key or bone, or a name longer
    /// than a VMD can hold.
    pub fn parse(text: &str) -> Result<Self, Error> {
        let mut map = Self::default();
        map.take(text)?;
        Ok(map)
    }

    /// Returns head and limbs of a clip's body as a person's rows and dialects give them.
    pub fn limbs_said(&self, clip: &Clip) -> Declared {
        limbs::said(self, clip)
    }

    /// Names of the dialects, in order of precedence.
    pub fn dialects(&self) -> impl Iterator<Item = &str> {
        self.dialects.iter().map(|dialect| &dialect.name[..])
    }

    /// Returns the name of a bone in a dialect: that of the first joint that forms it.
    pub fn first_name(&self, dialect: &str, bone: &str) -> Option<&str> {
        let dialect = self.dialects.iter().find(|own| own.name == dialect)?;
        dialect.rows.get(bone)?.first().map(String::as_str)
    }

    fn take(&mut self, text: &str) -> Result<(), Error> {
        let failed = |span: Option<std::ops::Range<usize>>, message: &str| {
            let place = span.map(|span| place(text, span.start)).unwrap_or_default();
            Error::setting("bones", format!("{place}{message}"))
        };
        let file: File = toml::from_str(text)
            .map_err(|error| failed(error.span(), &in_words(error.message())))?;
        for (name, extra) in &file.extra {
            let bytes = cp932(name.get_ref(), LONGEST_NAME).map(drop);
            bytes
                .and_then(|()| self.model.add(name.get_ref(), &extra.parent))
                .map_err(|error| failed(Some(name.span()), said(&error)))?;
            self.own.insert(name.get_ref().clone(), extra.joints.list());
        }
        let known = |rows: &Rows| {
            let unknown = rows.keys().find(|bone| self.model.find(bone.get_ref()).is_none());
            unknown.map_or(Ok(()), |bone| {
                let message = format!(
                    "there is no bone {0} to map; [extra.\"{0}\"] adds one (docs/input.md)",
                    bone.get_ref()
                );
                Err(failed(Some(bone.span()), &message))
            })
        };
        known(&file.bones)?;
        file.dialect.iter().try_for_each(|dialect| known(&dialect.bones))?;
        // A person's dialects come first, so that they win against equally good ones.
        self.added += file.dialect.len();
        let dialects = file.dialect.into_iter().map(Dialect::from);
        self.dialects.splice(0..0, dialects.collect::<Vec<_>>());
        let own = file.bones.into_iter();
        self.own.extend(own.map(|(bone, joints)| (bone.into_inner(), joints.list())));
        Ok(())
    }

    /// Matches a clip with the dialect that names most of its bones and, of equal ones, most joints. If a limb is
    /// missing or does not fit the body, the body's shape assigns its joints.
    ///
    /// # Errors
    ///
    /// [`Error::Clip`] if no joint is known; the message names the joints and the remedy.
    pub fn locate(&self, clip: &Clip) -> Result<Found, Error> {
        let mut found = self.find(clip);
        let is_unknown = found.joints.iter().all(Vec::is_empty);
        found.by_shape = structure::settle(&self.model, &mut found.joints, clip, |bone| {
            self.own.contains_key(bone)
        });
        if is_unknown && found.by_shape.is_empty() {
            return Err(unknown(clip.skeleton()));
        }
        if is_unknown {
            found.dialect = SHAPE.into();
        }
        Ok(found)
    }

    /// Whether a person assigned a joint to one of some bones, by rows or by a dialect of their own.
    pub(super) fn says(&self, found: &Found, bones: &[&str]) -> bool {
        let mut added = self.dialects[..self.added].iter();
        let is_own = added.any(|dialect| dialect.name == found.dialect);
        is_own || bones.iter().any(|bone| self.own.contains_key(*bone))
    }

    /// Matches a clip without the joints of other people than the one whose keys are found.
    pub(super) fn find(&self, clip: &Clip) -> Found {
        let is_of_others = joints_of_others(clip);
        self.find_among(clip.skeleton(), |joint| !is_of_others[joint])
    }

    /// Matches some joints of a skeleton, such as those of one tree, with the dialect that names most of its bones and,
    /// of equal ones, most joints.
    pub(crate) fn find_among(
        &self,
        skeleton: &Skeleton,
        is_among: impl Fn(usize) -> bool,
    ) -> Found {
        let names = Names::new(skeleton, is_among);
        let nothing = Dialect::new("own".into(), BTreeMap::new());
        let mut best = self.joints(&nothing, &names);
        let mut dialect = &nothing;
        for other in &self.dialects {
            let joints = self.joints(other, &names);
            if score(&self.model, &joints) > score(&self.model, &best) {
                (best, dialect) = (joints, other);
            }
        }
        let own = self.own.values().flatten();
        let missing = own.filter(|name| names.find(name).is_none()).cloned().collect();
        Found { dialect: dialect.name.clone(), joints: best, by_shape: Vec::new(), missing }
    }

    fn joints(&self, dialect: &Dialect, names: &Names) -> Vec<Vec<JointId>> {
        let bones = self.model.bones.iter().map(|bone| match self.own.get(&bone.name) {
            Some(own) => own.iter().filter_map(|name| names.find(name)).collect(),
            None => {
                let row = dialect.plain.get(&bone.name).map_or(&[][..], Vec::as_slice);
                row.iter().filter_map(|name| names.0.get(name).copied()).collect()
            }
        });
        bones.collect()
    }
}

/// Counts the driven limb bones, all driven bones, and the joints that drive them, in order of importance: fingers of
/// another dialect are many.
fn score(model: &Model, joints: &[Vec<JointId>]) -> [usize; 3] {
    let driven = || model.bones.iter().zip(joints).filter(|(_, joints)| !joints.is_empty());
    let of_limbs = driven().filter(|(bone, _)| structure::is_of_limb(&bone.name)).count();
    [of_limbs, driven().count(), joints.iter().flatten().collect::<HashSet<_>>().len()]
}

fn unknown(skeleton: &Skeleton) -> Error {
    const SHOWN: usize = 12;
    let names: Vec<_> = skeleton.joints.iter().map(|joint| &joint.name[..]).collect();
    let more = if names.len() > SHOWN { ", …" } else { "" };
    let shown = names[..names.len().min(SHOWN)].join(", ");
    Error::clip(format!(
        "vmd: no joint has a name that is known to belong to an MMD bone: {shown}{more}. Say which is which in a file of rows such as \"左腕\" = \"LeftArm\" under [bones]"
    ))
}

/// Joints of a skeleton by their plain names.
struct Names(HashMap<String, JointId>);

impl Names {
    fn new(skeleton: &Skeleton, is_among: impl Fn(usize) -> bool) -> Self {
        let joints = || skeleton.iter().filter(|(id, _)| is_among(id.0));
        let own: Vec<&str> = joints().map(|(_, joint)| own_name(&joint.name)).collect();
        let mut names = HashMap::new();
        for (id, joint) in joints() {
            names.entry(plain_name(&joint.name)).or_insert(id);
        }
        // Two people in one file: A_Hips and B_Hips, or Hips and Hips.2.
        let (prefix, suffix) =
            (shared(&own, prefixes, str::starts_with), shared(&own, suffixes, str::ends_with));
        for ((id, _), own) in joints().zip(&own) {
            let bare = own.strip_prefix(prefix).unwrap_or(own);
            names.entry(plain_name(bare.strip_suffix(suffix).unwrap_or(bare))).or_insert(id);
        }
        Self(names)
    }

    fn find(&self, name: &str) -> Option<JointId> {
        self.0.get(&plain_name(name)).copied()
    }
}

/// Fewest joints at which a shared part of names is removed.
const FEWEST: usize = 8;

/// Finds the longest part of the first two names that nearly all names share; empty if there is none.
fn shared<'a, Parts: Iterator<Item = &'a str>>(
    names: &[&'a str],
    parts: impl Fn(&'a str) -> Parts,
    has: impl Fn(&'a str, &'a str) -> bool,
) -> &'a str {
    let is_shared = |part: &&'a str| {
        let having = names.iter().filter(|name| has(name, part)).count();
        names.len() >= FEWEST && 10 * having >= 9 * names.len()
    };
    // The root's name may differ from all others.
    let some = names.iter().take(2).flat_map(|name| parts(name));
    some.filter(is_shared).max_by_key(|part| part.len()).unwrap_or_default()
}

/// Returns the beginnings of a name, each up to a separator.
fn prefixes(name: &str) -> impl Iterator<Item = &str> {
    name.char_indices().filter(|(_, letter)| DASHES.contains(letter)).map(|(at, _)| &name[..=at])
}

/// Returns the ends of a name, each from a separator on.
fn suffixes(name: &str) -> impl Iterator<Item = &str> {
    name.char_indices().filter(|(_, letter)| DASHES.contains(letter)).map(|(at, _)| &name[at..])
}

/// Formats the position of a byte in a text as `line:column: `, from 1.
fn place(text: &str, byte: usize) -> String {
    let before = &text[..byte.min(text.len())];
    let line = before.matches('\n').count() + 1;
    let column = before.len() - before.rfind('\n').map_or(0, |newline| newline + 1) + 1;
    format!("{line}:{column}: ")
}

/// Returns the message of a setting's error without the setting's name.
fn said(error: &Error) -> &str {
    match error {
        Error::Setting { message, .. } => message,
        _ => "cannot be used",
    }
}

type Rows = BTreeMap<Spanned<String>, Joints>;

/// The TOML file.
#[derive(Default, Deserialize)]
#[serde(default, deny_unknown_fields)]
struct File {
    dialect: Vec<DialectText>,
    bones: Rows,
    extra: BTreeMap<Spanned<String>, Extra>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct DialectText {
    name: String,
    /// Description for readers of the file.
    #[serde(default, rename = "about")]
    _about: String,
    #[serde(default)]
    sides: Option<[String; 2]>,
    bones: Rows,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Extra {
    parent: String,
    joints: Joints,
}

#[derive(Deserialize)]
#[serde(untagged)]
enum Joints {
    One(String),
    Chain(Vec<String>),
}

impl Joints {
    fn list(&self) -> Vec<String> {
        match self {
            Self::One(name) => vec![name.clone()],
            Self::Chain(names) => names.clone(),
        }
    }
}

impl Dialect {
    fn new(name: String, rows: BTreeMap<String, Vec<String>>) -> Self {
        let plain = |joints: &Vec<String>| joints.iter().map(|joint| plain_name(joint)).collect();
        let plain = rows.iter().map(|(bone, joints)| (bone.clone(), plain(joints))).collect();
        Self { name, rows, plain }
    }
}

impl From<DialectText> for Dialect {
    fn from(text: DialectText) -> Self {
        let mut rows = BTreeMap::new();
        for (bone, joints) in text.bones {
            let (bone, joints) = (bone.into_inner(), joints.list());
            let (Some(sides), Some(stem)) = (&text.sides, bone.strip_prefix(Side::Left.word()))
            else {
                rows.insert(bone, joints);
                continue;
            };
            for (side, word) in Side::BOTH.into_iter().zip(sides) {
                let joints = joints.iter().map(|joint| joint.replace('@', word)).collect();
                rows.insert(format!("{}{stem}", side.word()), joints);
            }
        }
        Self::new(text.name, rows)
    }
}

#[cfg(test)]
mod tests;
