//! Poses in a row as stick figures (棒人間).

use glam::DVec3;
use plotters::style::RGBColor;
use serde::{Deserialize, Serialize};

use crate::error::Error;
use crate::motion::{Body, Clip, Joint, Pose, Skeleton};
use crate::plot::axis::number;
use crate::plot::canvas::{Align, Canvas, Point, Type, paint};
use crate::plot::style;
use crate::plot::view::{View, extent};
use crate::sheet::Role;

/// Stick figures (棒人間) of some drawings, side by side, on one floor and of one scale.
///
/// Each figure stands in the middle of its own cell: where it is in the world is not shown.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct PoseRow {
    /// Width in px at most, 200 to 20000; default 1200.
    pub width: u32,
    /// Height of the tallest figure in px, 40 to 2000; default 170.
    pub figure_height: u32,
    /// Figures on a line at most, 1 or more; default 12. Wide poses get fewer.
    pub in_line: usize,
}

impl Default for PoseRow {
    fn default() -> Self {
        Self { width: 1200, figure_height: 170, in_line: 12 }
    }
}

const HEAD: f64 = 60.0;
const GAP: f64 = 14.0;
const LABELS: f64 = 42.0;
const BETWEEN_LINES: f64 = 16.0;
/// The narrowest picture: its title has to fit.
const NARROWEST: f64 = 380.0;

/// Which side of the body a joint belongs to.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum BodySide {
    Left,
    Right,
    Trunk,
}

impl BodySide {
    /// Reads it from the usual names: LeftArm, r_hand, LThumb, Arm.L.
    pub(crate) fn of(name: &str) -> Self {
        let lower = name.to_lowercase();
        let mut letters = name.chars();
        let (first, second) = (letters.next(), letters.next());
        let begins = second.is_some_and(|second| second.is_uppercase() || "_-. ".contains(second));
        let marked = |side: char| {
            let ends = ['_', '.', '-', ' ']
                .iter()
                .any(|dash| lower.ends_with([*dash, side].iter().collect::<String>().as_str()));
            ends || begins && first.is_some_and(|first| first.eq_ignore_ascii_case(&side))
        };
        if lower.contains("left") {
            Self::Left
        } else if lower.contains("right") {
            Self::Right
        } else if marked('l') {
            Self::Left
        } else if marked('r') {
            Self::Right
        } else {
            Self::Trunk
        }
    }

    fn color(self) -> RGBColor {
        match self {
            Self::Left => style::LEFT,
            Self::Right => style::RIGHT,
            Self::Trunk => style::INK,
        }
    }
}

/// A line from one point of a pose to another.
struct Bone {
    from: usize,
    to: usize,
    side: BodySide,
}

/// What the figures have in common.
struct Figures {
    bones: Vec<Bone>,
    /// The joint of the head and the point that ends it.
    head: Option<(usize, usize)>,
    view: View,
    floor: f64,
    /// px for a unit of the file.
    scale: f64,
    /// The body's height in units of the file, at rest in the first pose.
    height: f64,
}

impl PoseRow {
    /// Checks the settings.
    ///
    /// # Errors
    /// [`Error::Setting`] for a size that cannot be drawn or no figure on a line.
    pub fn validate(&self) -> Result<(), Error> {
        style::check_size("width", self.width, 200)?;
        if !(40..=2000).contains(&self.figure_height) {
            let message = format!("{} px; it must be between 40 and 2000", self.figure_height);
            return Err(Error::setting("figure_height", message));
        }
        if self.in_line == 0 {
            return Err(Error::setting("in_line", "0 figures; it must be 1 or more"));
        }
        Ok(())
    }

    /// Draws poses of a clip as SVG, each given by its place in the source, its label and its role.
    ///
    /// The view is from the side from which most of the movement is seen.
    ///
    /// # Errors
    /// [`Error::Setting`] as [`PoseRow::validate`]; [`Error::Picture`] when there is no joint, no
    /// frame or no pose, or a place is not finite.
    pub fn draw(&self, clip: &Clip, frames: &[(f64, String, Role)]) -> Result<String, Error> {
        self.validate()?;
        if clip.is_empty() || clip.skeleton().is_empty() {
            return Err(style::cannot("a clip without frames or joints has no pose to draw"));
        }
        if frames.is_empty() {
            return Err(style::cannot("no pose to draw"));
        }
        if !frames.iter().all(|(place, ..)| place.is_finite()) {
            return Err(style::cannot("a pose's place in the source must be a number"));
        }
        let poses = points(clip, frames);
        let mut figures = figures(clip.skeleton(), &poses);
        let (widest, tallest) = figures.size(&poses);
        let room = f64::from(self.width) - 2.0 * style::MARGIN - GAP;
        figures.scale =
            (f64::from(self.figure_height) / tallest.max(1e-9)).min(room / widest.max(1e-9));
        let high = tallest * figures.scale;
        let least = (widest * figures.scale + GAP).max(70.0);
        let fit = ((room + GAP) / least).floor().max(1.0) as usize;
        let in_line = fit.min(self.in_line).min(frames.len());
        let cell = if frames.len() >= in_line.max(8) {
            (room + GAP) / in_line as f64
        } else {
            least + GAP
        };
        let lines = frames.len().div_ceil(in_line);
        let line = high + LABELS + BETWEEN_LINES + 12.0;
        let width = (cell * in_line as f64 + 2.0 * style::MARGIN).max(NARROWEST);
        let width = width.min(f64::from(self.width).max(NARROWEST));
        let height = HEAD + line * lines as f64 + 10.0;
        paint((width.ceil() as u32, height.ceil() as u32), |canvas| {
            head(canvas)?;
            for (at, row) in frames.chunks(in_line).enumerate() {
                let floor = HEAD + line * at as f64 + 12.0 + high;
                let end = style::MARGIN + cell * row.len() as f64;
                canvas.line((style::MARGIN, floor), (end, floor), style::RAW, 1.25)?;
                for (column, frame) in row.iter().enumerate() {
                    let x = style::MARGIN + cell * (column as f64 + 0.5);
                    figures.draw(canvas, &poses[at * in_line + column], (x, floor))?;
                    label(canvas, frame, (x, floor), cell)?;
                }
            }
            Ok(())
        })
    }
}

/// The points of every pose: the joints, then the tips in the order of their joints.
fn points(clip: &Clip, frames: &[(f64, String, Role)]) -> Vec<Vec<DVec3>> {
    let skeleton = clip.skeleton();
    let mut pose = Pose::rest(skeleton);
    let mut body = Body::new(skeleton);
    let mut joints = vec![DVec3::ZERO; skeleton.len()];
    let mut place = |place: f64| {
        pose.take_place(clip, place);
        body.place(&pose, &mut joints);
        let mut points = joints.clone();
        for (joint, data) in skeleton.iter() {
            let tip = |offset: DVec3| joints[joint.0] + body.rotations()[joint.0] * offset;
            points.extend(data.end_sites.iter().map(|end| tip(end.offset)));
        }
        points
    };
    frames.iter().map(|frame| place(frame.0)).collect()
}

fn figures(skeleton: &Skeleton, poses: &[Vec<DVec3>]) -> Figures {
    let mut bones = Vec::new();
    for (joint, data) in skeleton.iter() {
        if let Some(parent) = data.parent {
            bones.push(Bone { from: parent.0, to: joint.0, side: BodySide::of(&data.name) });
        }
    }
    let mut tip = skeleton.len();
    for (joint, data) in skeleton.iter() {
        for _ in &data.end_sites {
            bones.push(Bone { from: joint.0, to: tip, side: BodySide::of(&data.name) });
            tip += 1;
        }
    }
    let is_head = |joint: &Joint| joint.name.to_lowercase().contains("head");
    let head = skeleton.joints.iter().position(is_head);
    let end = |joint: usize| bones.iter().find(|bone| bone.from == joint).map(|bone| bone.to);
    let head = head.map(|joint| (joint, end(joint).unwrap_or(joint)));
    let view = View::of(poses);
    let up = |point: &DVec3| view.see(*point).1;
    let floor = poses.iter().flatten().map(up).fold(f64::INFINITY, f64::min);
    let height = extent(&poses[0]).dot(view.up).abs();
    Figures { bones, head, view, floor, scale: 1.0, height }
}

/// The title and which colour is which side.
fn head(canvas: &mut Canvas<'_>) -> Result<(), Error> {
    canvas.text("Poses ポーズ", (style::MARGIN, 34.0), Type::new(style::TITLE).bold())?;
    let mut x = 170.0;
    for (side, word) in [(BodySide::Left, "left 左"), (BodySide::Right, "right 右")] {
        canvas.line((x, 29.0), (x + 20.0, 29.0), side.color(), 4.0)?;
        canvas.text(word, (x + 26.0, 34.0), Type::new(style::WORDS))?;
        x += style::text_width(word, style::WORDS) + 46.0;
    }
    Ok(())
}

/// The label in its role's colour and the frame below.
fn label(
    canvas: &mut Canvas<'_>,
    (place, label, role): &(f64, String, Role),
    (x, floor): Point,
    cell: f64,
) -> Result<(), Error> {
    let color = if *role == Role::Inbetween { style::FAINT } else { style::of_role(*role) };
    let look = Type::new(style::WORDS).color(color).align(Align::Center);
    let look = if *role == Role::Inbetween { look } else { look.bold() };
    let text = style::fitted(label, style::WORDS, cell - 4.0);
    canvas.text(&text, (x, floor + 18.0), look)?;
    let frame = format!("frame {}", number((place * 10.0).round() / 10.0));
    let look = Type::new(style::SMALL).color(style::FAINT).align(Align::Center);
    canvas.text(&frame, (x, floor + 34.0), look)
}

impl Figures {
    /// The largest width of a figure and the largest height over the floor, in units of the file.
    fn size(&self, poses: &[Vec<DVec3>]) -> (f64, f64) {
        let radius = self.head_radius(&poses[0]);
        let size = |pose: &Vec<DVec3>| {
            let (low, high) = self.sides(pose);
            let top = pose.iter().map(|point| self.view.see(*point).1 - self.floor);
            (high - low, top.fold(0.0, f64::max))
        };
        let sizes = poses.iter().map(size);
        let (wide, high) = sizes.fold((0.0, 0.0), |(wide, high): (f64, f64), size| {
            (wide.max(size.0), high.max(size.1))
        });
        (wide + radius, high + radius)
    }

    /// The leftmost and the rightmost point of a figure.
    fn sides(&self, pose: &[DVec3]) -> (f64, f64) {
        let start = (f64::INFINITY, f64::NEG_INFINITY);
        pose.iter().fold(start, |(low, high), point| {
            let x = self.view.see(*point).0;
            (low.min(x), high.max(x))
        })
    }

    fn head_radius(&self, pose: &[DVec3]) -> f64 {
        let length = self.head.map_or(0.0, |(joint, end)| (pose[end] - pose[joint]).length());
        (0.55 * length).clamp(0.045 * self.height, 0.085 * self.height)
    }

    /// One figure, its middle over `x`, its bones from the far to the near.
    fn draw(
        &self,
        canvas: &mut Canvas<'_>,
        pose: &[DVec3],
        (x, floor): Point,
    ) -> Result<(), Error> {
        let (low, high) = self.sides(pose);
        let middle = 0.5 * (low + high);
        let at = |point: DVec3| {
            let (right, up, _) = self.view.see(point);
            (x + (right - middle) * self.scale, floor - (up - self.floor) * self.scale)
        };
        let depth = |bone: &&Bone| self.view.see(pose[bone.from] + pose[bone.to]).2;
        let mut bones: Vec<&Bone> = self.bones.iter().collect();
        bones.sort_by(|a, b| depth(a).total_cmp(&depth(b)));
        for bone in bones {
            let (from, to) = (pose[bone.from], pose[bone.to]);
            let width = self.width(bone.side, (to - from).length());
            canvas.line(at(from), at(to), bone.side.color(), width)?;
            canvas.disc(at(to), 0.5 * width, bone.side.color())?;
        }
        if let Some((joint, end)) = self.head {
            let radius = self.head_radius(pose) * self.scale;
            canvas.ring(at(0.5 * (pose[joint] + pose[end])), radius, style::INK, 2.0)?;
        }
        if self.bones.is_empty() {
            canvas.disc(at(pose[0]), 4.0, style::INK)?;
        }
        Ok(())
    }

    /// px: the trunk is thick, fingers and toes are thin.
    fn width(&self, side: BodySide, length: f64) -> f64 {
        let size = (self.scale * self.height / 170.0).clamp(0.4, 3.0);
        let width = match side {
            BodySide::Trunk => 5.0,
            _ if length < 0.035 * self.height => 1.5,
            _ => 3.25,
        };
        (width * size).max(1.0)
    }
}
