//! Reads the skeleton (.asf): bones, their directions and axes, and the hierarchy.

use std::collections::{HashMap, HashSet};

use glam::{DQuat, DVec3};

use super::lines::{Line, Word, lines};
use genga::error::Error;
use genga::motion::Axis;

/// The name of the root in both files.
const ROOT: &str = "root";

const AXES: [(char, Axis); 3] = [('x', Axis::X), ('y', Axis::Y), ('z', Axis::Z)];

/// The degree of freedom that a value of a bone's row controls.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Freedom {
    /// Rotation about an axis.
    Turn(Axis),
    /// Translation along an axis.
    Move(Axis),
    /// Stretching of the bone, which a clip cannot represent.
    Length,
}

/// A bone, or the root.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Bone {
    pub name: String,
    /// The vector from its start to its end at rest, in world axes; for the root, its position.
    pub(super) way: DVec3,
    /// Its own axes at rest, relative to the world.
    pub(super) axes: DQuat,
    /// Degree of freedom of each value of its row, in order.
    pub(super) freedoms: Vec<Freedom>,
    /// Index of the parent, which precedes this bone in the list; `None` for the root.
    pub parent: Option<usize>,
}

/// The contents of an `.asf`.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Asf {
    /// The bones: the root first, then parents before children.
    pub(super) bones: Vec<Bone>,
    /// Length of an inch in the file's unit.
    pub(super) length: f64,
    /// Whether angles are in degrees.
    pub(super) in_degrees: bool,
}

/// The section of the file that contains a line.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Part {
    Other,
    Units,
    Root,
    Bones,
    Hierarchy,
}

/// A bone under construction.
#[derive(Default)]
struct Draft {
    name: String,
    direction: DVec3,
    length: f64,
    angles: DVec3,
    order: Vec<Axis>,
    freedoms: Vec<Freedom>,
}

/// The reader of the lines of an `.asf`.
struct Reader<'a> {
    part: Part,
    length: f64,
    in_degrees: bool,
    root: Draft,
    bone: Option<(Draft, Word<'a>)>,
    bones: Vec<(Draft, Word<'a>)>,
    by_name: HashMap<String, usize>,
    /// Children by the name of their parent, in the order of the file.
    children: HashMap<String, Vec<Word<'a>>>,
    hung: HashSet<String>,
}

impl Asf {
    /// Reads the text of an `.asf`.
    ///
    /// # Errors
    /// [`Error::Motion`] with line and column if the text is no skeleton.
    pub(super) fn read(text: &str) -> Result<Self, Error> {
        let root = Draft { name: ROOT.into(), ..Draft::default() };
        let mut reader = Reader {
            part: Part::Other,
            length: 1.0,
            in_degrees: true,
            root,
            bone: None,
            bones: Vec::new(),
            by_name: HashMap::new(),
            children: HashMap::new(),
            hung: HashSet::new(),
        };
        let mut last = Word { text: "", line: 1, column: 1 };
        for line in lines(text) {
            reader.line(&line)?;
            last = line.end();
        }
        if let Some((_, begin)) = &reader.bone {
            return Err(begin.wrong("this bone has no end"));
        }
        reader.finish(last)
    }
}

impl<'a> Reader<'a> {
    fn line(&mut self, line: &Line<'a>) -> Result<(), Error> {
        let first = line.first();
        if first.text.starts_with(':') {
            self.part = match &first.text.to_ascii_lowercase()[..] {
                ":units" => Part::Units,
                ":root" => Part::Root,
                ":bonedata" => Part::Bones,
                ":hierarchy" => Part::Hierarchy,
                _ => Part::Other,
            };
            return Ok(());
        }
        match self.part {
            Part::Other => Ok(()),
            Part::Units => self.unit(line),
            Part::Root => entry(&mut self.root, line),
            Part::Bones => self.bone(line),
            Part::Hierarchy => self.hang(line),
        }
    }

    fn unit(&mut self, line: &Line<'a>) -> Result<(), Error> {
        let mut words = line.words();
        let (what, value) = (line.first(), words.nth(1).unwrap_or(line.end()));
        if what.is("length") {
            self.length = value.number()?;
            if self.length <= 0.0 {
                return Err(value.instead_of("a length above 0"));
            }
        } else if what.is("angle") {
            self.in_degrees = degrees(&value)?;
        }
        Ok(())
    }

    fn bone(&mut self, line: &Line<'a>) -> Result<(), Error> {
        let first = line.first();
        match &mut self.bone {
            None if first.is("begin") => {
                self.bone = Some((Draft::default(), first));
                Ok(())
            }
            None => Err(first.instead_of("begin")),
            Some(_) if first.is("begin") => Err(first.instead_of("end")),
            Some((draft, _)) if !first.is("end") => entry(draft, line),
            Some(_) => {
                let Some((draft, begin)) = self.bone.take() else { return Ok(()) };
                if draft.name.is_empty() {
                    return Err(begin.wrong("this bone has no name"));
                }
                if draft.name == ROOT || self.by_name.contains_key(&draft.name) {
                    return Err(begin.wrong(format!("there are two bones {}", draft.name)));
                }
                self.by_name.insert(draft.name.clone(), self.bones.len());
                self.bones.push((draft, begin));
                Ok(())
            }
        }
    }

    fn hang(&mut self, line: &Line<'a>) -> Result<(), Error> {
        let parent = line.first();
        if parent.is("begin") || parent.is("end") {
            return Ok(());
        }
        for word in std::iter::once(parent).chain(line.words().skip(1)) {
            if word.text != ROOT && !self.by_name.contains_key(word.text) {
                return Err(word.instead_of("a bone of :bonedata"));
            }
        }
        for child in line.words().skip(1) {
            if child.text == ROOT || !self.hung.insert(child.text.to_owned()) {
                return Err(child.wrong(format!("{} hangs on something already", child.text)));
            }
            self.children.entry(parent.text.to_owned()).or_default().push(child);
        }
        Ok(())
    }

    /// Builds the skeleton, with the bones in hierarchy order.
    fn finish(self, end: Word<'a>) -> Result<Asf, Error> {
        if self.bones.is_empty() {
            return Err(end.wrong("this skeleton has no bones: expected :bonedata"));
        }
        let unit = if self.in_degrees { 1f64.to_radians() } else { 1.0 };
        let mut drafts: Vec<Option<Draft>> = Vec::with_capacity(self.bones.len());
        let mut places = Vec::with_capacity(self.bones.len());
        for (draft, place) in self.bones {
            drafts.push(Some(draft));
            places.push(place);
        }
        let children = |name: &str| self.children.get(name).map_or(&[][..], Vec::as_slice);
        let mut bones = vec![self.root.built(None, unit)];
        let mut open: Vec<(usize, &str)> =
            children(ROOT).iter().rev().map(|child| (0, child.text)).collect();
        while let Some((parent, name)) = open.pop() {
            let draft = self.by_name.get(name).and_then(|bone| drafts[*bone].take());
            let Some(draft) = draft else { continue };
            let at = bones.len();
            bones.push(draft.built(Some(parent), unit));
            open.extend(children(name).iter().rev().map(|child| (at, child.text)));
        }
        let lost =
            drafts.iter().zip(&places).find_map(|(draft, place)| Some((draft.as_ref()?, place)));
        if let Some((draft, place)) = lost {
            let message = format!("{} does not hang on the root: see :hierarchy", draft.name);
            return Err(place.wrong(message));
        }
        Ok(Asf { bones, length: self.length, in_degrees: self.in_degrees })
    }
}

impl Draft {
    fn built(self, parent: Option<usize>, unit: f64) -> Bone {
        let way = match parent {
            Some(_) => self.length * self.direction.normalize_or_zero(),
            None => self.direction,
        };
        let turn = |axis: &Axis| about(*axis, unit * axis.unit().dot(self.angles));
        let plain = AXES.map(|(_, axis)| axis);
        let order = if self.order.is_empty() { &plain[..] } else { &self.order };
        let axes = in_order(order.iter().map(turn));
        Bone { name: self.name, way, axes, freedoms: self.freedoms, parent }
    }
}

/// Parses a line of a bone or of the root.
fn entry<'a>(draft: &mut Draft, line: &Line<'a>) -> Result<(), Error> {
    let first = line.first();
    let mut words = line.words().skip(1);
    let mut number = || words.next().unwrap_or(line.end()).number();
    match &first.text.to_ascii_lowercase()[..] {
        "name" => draft.name = line.words().nth(1).unwrap_or(line.end()).text.to_owned(),
        "direction" | "position" => draft.direction = DVec3::new(number()?, number()?, number()?),
        "length" => draft.length = number()?,
        "orientation" => draft.angles = DVec3::new(number()?, number()?, number()?),
        "axis" => {
            let words: Vec<Word<'a>> = line.words().skip(1).take(4).collect();
            // The axis line of the root has only an order; that of a bone has angles before it.
            let order = *words.last().unwrap_or(&line.end());
            draft.order = axes(&order)?;
            if let [x, y, z, _] = words[..] {
                draft.angles = DVec3::new(x.number()?, y.number()?, z.number()?);
            }
        }
        "dof" | "order" => {
            draft.freedoms =
                line.words().skip(1).map(|word| freedom(&word)).collect::<Result<_, _>>()?;
        }
        // Ids, limits and masses have no effect on a motion.
        _ => {}
    }
    Ok(())
}

fn axis(letter: char) -> Option<Axis> {
    let letter = letter.to_ascii_lowercase();
    AXES.iter().find(|(own, _)| *own == letter).map(|(_, axis)| *axis)
}

fn axes(order: &Word<'_>) -> Result<Vec<Axis>, Error> {
    let found: Option<Vec<Axis>> = order.text.chars().map(axis).collect();
    let found = found.filter(|axes| (1..=3).contains(&axes.len()));
    found.ok_or_else(|| order.instead_of("an order of axes such as XYZ"))
}

fn freedom(word: &Word<'_>) -> Result<Freedom, Error> {
    let mut letters = word.text.chars();
    let (kind, of, rest) = (letters.next(), letters.next().and_then(axis), letters.next());
    let found = match (kind.map(|kind| kind.to_ascii_lowercase()), of, rest) {
        (Some('r'), Some(axis), None) => Some(Freedom::Turn(axis)),
        (Some('t'), Some(axis), None) => Some(Freedom::Move(axis)),
        (Some('l'), None, None) => Some(Freedom::Length),
        _ => None,
    };
    found.ok_or_else(|| word.instead_of("one of rx, ry, rz, tx, ty, tz, l"))
}

/// Whether a word says that angles are in degrees.
pub(super) fn degrees(word: &Word<'_>) -> Result<bool, Error> {
    let lower = word.text.to_ascii_lowercase();
    match (lower.starts_with("deg"), lower.starts_with("rad")) {
        (true, _) => Ok(true),
        (_, true) => Ok(false),
        _ => Err(word.instead_of("deg or rad")),
    }
}

/// The rotation about an axis by an angle in radians.
pub(super) fn about(axis: Axis, angle: f64) -> DQuat {
    DQuat::from_axis_angle(axis.unit(), angle)
}

/// Composes rotations about fixed axes, the first applied first.
pub(super) fn in_order(turns: impl Iterator<Item = DQuat>) -> DQuat {
    turns.fold(DQuat::IDENTITY, |before, turn| turn * before)
}
