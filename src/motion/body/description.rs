//! Describes a body in words (体の説明): the known facts about a performer, and their evidence.

use std::ops::RangeInclusive;

use super::limbs::NamedLimbs;
use super::members::is_still;
use super::role::Role;
use super::upright::By;
use crate::error::Warning;
use crate::motion::landmarks::above;
use crate::motion::{Axis, Build, Clip, MannequinParts, Skeleton, Unit};

/// Code of the warning that a fact about the body is a guess.
pub const BODY_GUESS: &str = "W_BODY_GUESS";

/// Code of the warning that a file has more than one person.
pub const PEOPLE: &str = "W_PEOPLE";

/// Code of the warning that nothing moves.
pub const STILL: &str = "W_STILL";

/// Known facts about a body, for people to read.
#[derive(Debug, Clone, PartialEq)]
pub struct Description {
    /// Facts with their subject: `up`, `height`, `head`, a limb, `not body`.
    pub lines: Vec<(&'static str, String)>,
    /// Warnings: a fact rests on the body's shape alone, or the file has other people.
    pub notes: Vec<Warning>,
}

/// Names of the limbs, left before right.
const LIMBS: [[&str; 2]; 2] = [["left arm", "right arm"], ["left leg", "right leg"]];

impl Description {
    /// Describes the performer of a clip.
    ///
    /// ```
    /// let clip = genga::motion::bvh::open("data/kick.bvh".as_ref())?.clip;
    /// let body = genga::motion::Description::new(&clip);
    /// assert_eq!(body.lines[0], ("up", "Y, as the body stands".into()));
    /// assert_eq!(body.lines[3], ("left arm", "LeftArm LeftForeArm LeftHand, by names".into()));
    /// assert_eq!(body.notes, []);
    /// # Ok::<(), genga::Error>(())
    /// ```
    pub fn new(clip: &Clip) -> Self {
        Self::of_build(clip, &Build::new(clip))
    }

    /// Returns the notes alone, which costs less without any.
    pub fn notes(clip: &Clip) -> Vec<Warning> {
        let build = Build::new(clip);
        let is_up_known = !matches!(build.up_by, By::Shape | By::Custom | By::Turned);
        let is_known = build.limbs.are_whole()
            && is_up_known
            && odd_height(clip, &build).is_none()
            && contradicted(clip, &build).is_none();
        match is_known {
            true => people(clip, &build).into_iter().chain(still(clip)).collect(),
            false => Self::of_build(clip, &build).notes,
        }
    }

    fn of_build(clip: &Clip, build: &Build) -> Self {
        let mut guesses = Vec::new();
        let mut lines = vec![("up", up(build, &mut guesses)), ("height", height(build))];
        match MannequinParts::of_build(clip, build) {
            Some(figure) => lines.extend(limbs(clip, build, &figure, &mut guesses)),
            None => {
                let (limbs, guess) = no_limbs(&build.limbs);
                guesses.push(guess);
                lines.push(("limbs", limbs));
            }
        }
        lines.extend(not_body(build).map(|joints| ("not body", joints)));
        guesses.extend(odd_height(clip, build));
        guesses.extend(contradicted(clip, build));
        let guess = (!guesses.is_empty()).then(|| {
            let message = format!("of the body {}; genga inspect tells more", guesses.join("; "));
            Warning::new(BODY_GUESS, message)
        });
        let notes = guess.into_iter().chain(people(clip, build)).chain(still(clip));
        Self { lines, notes: notes.collect() }
    }
}

/// Warns if nothing moves.
fn still(clip: &Clip) -> Option<Warning> {
    let message = "nothing moves in this clip: all of it is one drawing";
    is_still(clip).then(|| Warning::new(STILL, message.to_owned()))
}

/// Warns about other people in the file, and names the person that the keys belong to.
fn people(clip: &Clip, build: &Build) -> Option<Warning> {
    let others: Vec<&str> = build.members.others(clip).collect();
    let own = clip.skeleton().joints.get(top(clip, build.members.root()))?;
    let roots: Vec<String> = others.iter().map(|root| format!("--root {root}")).collect();
    let message = format!(
        "{} people are in the file, and the keys, and the body of a VMD or VRMA, are those of {}; {} takes another alone",
        others.len() + 1,
        own.name,
        roots.join(" or ")
    );
    (!others.is_empty()).then(|| Warning::new(PEOPLE, message))
}

/// Returns the root of a joint's tree in the file.
fn top(clip: &Clip, joint: usize) -> usize {
    above(clip.skeleton(), joint).last().unwrap_or(joint)
}

fn up(build: &Build, guesses: &mut Vec<String>) -> String {
    let axis = if build.stature.up == Axis::Z { "Z" } else { "Y" };
    let why = match build.up_by {
        By::Person => "as --up says",
        By::File => "as the file says",
        By::Motion => "as the body stands",
        By::Turned => "as the body stands; its rest pose stands along the other axis",
        By::Shape => "by the longest side of the body, which does not stand upright",
        By::Custom => "as at rest: the body does not stand upright",
    };
    if matches!(build.up_by, By::Shape | By::Custom | By::Turned) && build.mannequin.is_some() {
        guesses.push(format!("{axis} is taken to be up (--up y, --up z)"));
    }
    format!("{axis}, {why}")
}

fn height(build: &Build) -> String {
    let (height, why) = match &build.mannequin {
        Some(mannequin) => (mannequin.height(), "by its legs from hip to ankle"),
        None => (build.landmarks.height, "the longest side of its joints, most of the time"),
    };
    format!("{:.0} cm, {why}", 100.0 * height * build.stature.metres)
}

/// Reports arms or legs whose joints differ between shape and names. The names are used.
fn contradicted(clip: &Clip, build: &Build) -> Option<String> {
    if !build.limbs.are_whole() {
        return None;
    }
    let shape = build.by_shape(clip);
    let skeleton = build.members.skeleton();
    let hangs = |end: usize, limbs: [Option<[usize; 3]>; 2]| {
        let tops = limbs.into_iter().flatten().map(|[top, ..]| top);
        above(skeleton, end).any(|joint| tops.clone().any(|top| top == joint))
    };
    let feet = shape.feet.iter().all(|foot| hangs(foot.ankle.joint.0, build.limbs.legs));
    let hands = shape.wrists.iter().all(|wrist| hangs(wrist.joint.0, build.limbs.arms));
    let what = match (feet, hands) {
        (true, true) => return None,
        (false, true) => "legs",
        (true, false) => "arms",
        (false, false) => "arms and legs",
    };
    Some(format!("its {what} are others by its shape than by names, which were taken (--bones)"))
}

/// Heights of a person in metres, children included.
const PERSON: RangeInclusive<f64> = 0.8..=2.5;

/// Reports a body with limbs whose height is no person's: either the unit is another, or it is no person.
fn odd_height(clip: &Clip, build: &Build) -> Option<String> {
    let height = build.mannequin.as_ref()?.height();
    let metres = height * build.stature.metres;
    let is_unknown = clip.declared().metres.is_none() && Unit::of_size(height).is_none();
    match () {
        () if !PERSON.contains(&metres) => {
            Some(format!("it is {:.0} cm tall: no person, or the unit is another", 100.0 * metres))
        }
        () if is_unknown => Some(format!("{height:.1} is a person's height in no unit")),
        () => None,
    }
}

/// Says of a body without head, two arms and two legs which of them are missing, in a line and as a guess.
fn no_limbs(limbs: &NamedLimbs) -> (String, String) {
    let stand = "the ends of its chains stand for them";
    if limbs.joints().next().is_none() {
        let none = format!("none: no head, two arms and two legs are found; {stand}");
        return (none, "it has no limbs that are known".to_owned());
    }
    let named = LIMBS.as_flattened().iter().zip(limbs.arms.iter().chain(&limbs.legs));
    let missing = named.filter(|(_, limb)| limb.is_none()).map(|(word, _)| *word);
    let missing: Vec<&str> =
        limbs.head.is_none().then_some("head").into_iter().chain(missing).collect();
    let missing = missing.join(", ");
    (format!("not all: no whole {missing}; {stand}"), format!("no whole {missing} is known"))
}

fn limbs(
    clip: &Clip,
    build: &Build,
    figure: &MannequinParts,
    guesses: &mut Vec<String>,
) -> Vec<(&'static str, String)> {
    let skeleton = clip.skeleton();
    let mut by_shape = Vec::new();
    let head = build.limbs.head.unwrap_or(figure.head_joint);
    let said = clip.declared();
    let is_named = build.limbs.head.is_some();
    by_shape.extend((!is_named).then_some("head"));
    let mut lines = vec![("head", told(skeleton, &[head], (is_named, said.head.is_some())))];
    for (words, limbs) in LIMBS.iter().zip([figure.arms, figure.legs]) {
        for (word, [upper, middle, lower, _]) in words.iter().zip(limbs) {
            let has_end = lower < skeleton.len();
            let joints = if has_end { &[upper, middle, lower][..] } else { &[upper, middle] };
            let end = joints[joints.len() - 1];
            let is_named = build.limbs.ending_at(end).is_some();
            by_shape.extend((!is_named).then_some(*word));
            let is_said = said.limbs.iter().flatten().any(|own| own[2].0 == end);
            lines.push((*word, told(skeleton, joints, (is_named, is_said))));
        }
    }
    if !by_shape.is_empty() {
        guesses
            .push(format!("its shape alone says {} (--bones names joints)", by_shape.join(", ")));
    }
    lines
}

fn told(skeleton: &Skeleton, joints: &[usize], (is_named, is_said): (bool, bool)) -> String {
    let mut names: Vec<&str> =
        joints.iter().map(|joint| &skeleton.joints[*joint].name[..]).collect();
    // A limb that is cut short ends at the joint in its middle.
    let is_cut = joints.windows(2).any(|pair| pair[0] == pair[1]);
    names.dedup();
    let by = match (is_named, joints.len()) {
        _ if is_said => "as --bones says",
        (false, _) => "by shape",
        (true, 1) => "by name",
        (true, _) => "by names",
    };
    let end = match (is_cut, joints.len()) {
        (true, _) => " and no joint beyond",
        (false, 2) => " and its End Site",
        _ => "",
    };
    format!("{}{end}, {by}", names.join(" "))
}

/// Counts the joints outside the body by role.
fn not_body(build: &Build) -> Option<String> {
    let kinds = [
        (Role::Guide, "that only carry it"),
        (Role::Still, "that never move"),
        (Role::Hair, "of hair or cloth"),
        (Role::Prop, "props"),
        (Role::Helper, "helpers"),
        (Role::Far, "that reach too far"),
        (Role::Other, "of somebody else"),
    ];
    let count = |role: Role| build.members.count(role);
    let all: usize = kinds.iter().map(|(role, _)| count(*role)).sum();
    let told = kinds.iter().filter(|(role, _)| count(*role) > 0);
    let told: Vec<String> = told.map(|(role, what)| format!("{} {what}", count(*role))).collect();
    let joints = if all == 1 { "joint" } else { "joints" };
    (all > 0).then(|| format!("{all} {joints}: {}", told.join(", ")))
}
