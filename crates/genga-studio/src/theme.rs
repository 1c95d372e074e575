//! Colours (色) of the light and the dark theme. The light ones are those of the exported pictures.

use egui::{Color32, Context, Theme};

use genga::sheet::Role;
use genga_plot::parts::{self, BodySide};

/// Colours of everything that the studio paints itself.
#[derive(Debug, Clone, Copy)]
pub(super) struct Look {
    pub(super) genga: Color32,
    pub(super) genga_line: Color32,
    pub(super) wall: Color32,
    pub(super) inbetween: Color32,
    pub(super) end: Color32,
    pub(super) ink: Color32,
    /// Grey words. They can be read on every ground.
    pub(super) faint: Color32,
    pub(super) grid: Color32,
    pub(super) raw: Color32,
    pub(super) filtered: Color32,
    /// Bands in which a joint counts as steady.
    pub(super) steady: Color32,
    pub(super) left: Color32,
    pub(super) right: Color32,
    pub(super) paper: Color32,
    pub(super) ground: Color32,
    pub(super) shadow: Color32,
    pub(super) before: Color32,
    pub(super) after: Color32,
    /// Lines at which an action begins.
    pub(super) action: Color32,
    pub(super) playhead: Color32,
    pub(super) chosen: Color32,
}

const fn gray(value: u8) -> Color32 {
    Color32::from_gray(value)
}

/// Gives egui's own grey words the colour of the studio's, which egui draws too pale to be read, and a button with the
/// keyboard the ground of every button: it has a ring, and on egui's darker ground grey words are lost.
pub(super) fn dress(context: &Context) {
    for theme in [Theme::Light, Theme::Dark] {
        let faint = Look::from_theme(theme).faint;
        context.style_mut_of(theme, |style| {
            style.visuals.weak_text_color = Some(faint);
            let widgets = &mut style.visuals.widgets;
            widgets.active.weak_bg_fill = widgets.inactive.weak_bg_fill;
        });
    }
}

impl Look {
    pub(super) fn from_theme(theme: Theme) -> Self {
        match theme {
            Theme::Light => Self::day(),
            Theme::Dark => Self::night(),
        }
    }

    fn day() -> Self {
        let of = |color: plotters::style::RGBColor| Color32::from_rgb(color.0, color.1, color.2);
        Self {
            genga: of(parts::GENGA),
            genga_line: of(parts::GENGA_LINE),
            wall: of(parts::WALL),
            inbetween: gray(122),
            end: of(parts::END),
            ink: of(parts::INK),
            faint: Color32::from_rgb(94, 99, 107),
            grid: Color32::from_rgb(218, 222, 226),
            raw: of(parts::RAW),
            filtered: of(parts::FILTERED),
            steady: Color32::from_rgb(232, 237, 241),
            left: of(parts::LEFT),
            right: of(parts::RIGHT),
            paper: of(parts::PAPER),
            ground: Color32::from_rgb(240, 242, 244),
            shadow: Color32::from_rgb(219, 223, 227),
            before: Color32::from_rgb(214, 150, 110),
            after: Color32::from_rgb(110, 160, 214),
            action: Color32::from_rgb(120, 84, 160),
            playhead: Color32::from_rgb(0, 128, 96),
            chosen: Color32::from_rgb(214, 240, 230),
        }
    }

    fn night() -> Self {
        Self {
            genga: Color32::from_rgb(240, 108, 72),
            genga_line: Color32::from_rgb(122, 62, 46),
            wall: Color32::from_rgb(92, 170, 236),
            inbetween: gray(150),
            end: gray(208),
            ink: gray(222),
            faint: gray(168),
            grid: gray(54),
            raw: gray(92),
            filtered: gray(214),
            steady: Color32::from_rgb(36, 42, 48),
            left: Color32::from_rgb(92, 170, 236),
            right: Color32::from_rgb(240, 164, 56),
            paper: gray(24),
            ground: gray(30),
            shadow: gray(16),
            before: Color32::from_rgb(150, 104, 44),
            after: Color32::from_rgb(60, 96, 160),
            action: Color32::from_rgb(176, 140, 220),
            playhead: Color32::from_rgb(72, 208, 160),
            chosen: Color32::from_rgb(24, 62, 50),
        }
    }

    /// Colour of a drawing's role.
    pub(super) fn of_role(&self, role: Role) -> Color32 {
        match role {
            Role::Genga => self.genga,
            Role::Inbetween => self.inbetween,
            Role::End => self.end,
        }
    }

    /// Colour of a side of the body.
    pub(super) fn of_side(&self, side: BodySide) -> Color32 {
        match side {
            BodySide::Left => self.left,
            BodySide::Right => self.right,
            BodySide::Trunk => self.ink,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Vision of normal eyes and of eyes without one kind of cones, as matrices of linear red, green and blue (Machado,
    /// Oliveira and Fernandes 2009).
    const EYES: [[[f64; 3]; 3]; 4] = [
        [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
        [
            [0.152286, 1.052583, -0.204868],
            [0.114503, 0.786281, 0.099216],
            [-0.003882, -0.048116, 1.051998],
        ],
        [
            [0.367322, 0.860646, -0.227968],
            [0.280085, 0.672501, 0.047413],
            [-0.01182, 0.04294, 0.968881],
        ],
        [
            [1.255528, -0.076749, -0.178779],
            [-0.078411, 0.930809, 0.147602],
            [0.004733, 0.691367, 0.3039],
        ],
    ];

    fn times(matrix: [[f64; 3]; 3], color: [f64; 3]) -> [f64; 3] {
        matrix.map(|row| row.iter().zip(color).map(|(a, b)| a * b).sum())
    }

    /// Converts a colour to linear light: red, green, blue.
    fn light(color: Color32) -> [f64; 3] {
        [color.r(), color.g(), color.b()].map(|channel| {
            let value = f64::from(channel) / 255.0;
            if value <= 0.04045 { value / 12.92 } else { ((value + 0.055) / 1.055).powf(2.4) }
        })
    }

    /// Contrast ratio of two colours (WCAG 2).
    fn contrast(a: Color32, b: Color32, eye: [[f64; 3]; 3]) -> f64 {
        let bright = |color| {
            let [red, green, blue] = times(eye, light(color)).map(|light| light.clamp(0.0, 1.0));
            0.2126 * red + 0.7152 * green + 0.0722 * blue + 0.05
        };
        let (a, b): (f64, f64) = (bright(a), bright(b));
        a.max(b) / a.min(b)
    }

    /// Converts a colour, as an eye sees it, to CIE L*a*b*.
    fn seen(color: Color32, eye: [[f64; 3]; 3]) -> [f64; 3] {
        let light = times(eye, light(color));
        let xyz = [[0.4124, 0.3576, 0.1805], [0.2126, 0.7152, 0.0722], [0.0193, 0.1192, 0.9505]];
        let [x, y, z] = times(xyz, light.map(|value| value.clamp(0.0, 1.0)));
        let root = |t: f64| if t > 0.008856 { t.cbrt() } else { 7.787 * t + 16.0 / 116.0 };
        let [x, y, z] = [root(x / 0.9505), root(y), root(z / 1.089)];
        [116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)]
    }

    #[test]
    fn what_is_told_apart_by_colour_is_so_for_every_eye() {
        for look in [Look::day(), Look::night()] {
            for (a, b) in [
                (look.genga, look.wall),
                (look.genga, look.inbetween),
                (look.genga, look.end),
                (look.genga, look.playhead),
                (look.genga, look.action),
                (look.action, look.playhead),
                (look.left, look.right),
                (look.before, look.after),
                (look.raw, look.filtered),
                (look.genga, look.filtered),
                (look.wall, look.filtered),
                (look.playhead, look.chosen),
            ] {
                for eye in EYES {
                    let (a, b) = (seen(a, eye), seen(b, eye));
                    let apart: f64 = a.iter().zip(b).map(|(a, b)| (a - b).powi(2)).sum();
                    assert!(apart.sqrt() > 20.0, "{a:?} {b:?}: {:.0}", apart.sqrt());
                }
            }
        }
    }

    #[test]
    fn words_and_numbers_can_be_read_by_every_eye() {
        for look in [Look::day(), Look::night()] {
            for (words, ground, least) in [
                (look.ink, look.paper, 7.0),
                (look.ink, look.ground, 7.0),
                (look.faint, look.paper, 4.5),
                (look.faint, look.ground, 4.5),
                (look.genga, look.paper, 4.0),
                (look.playhead, look.paper, 4.0),
                (look.playhead, look.chosen, 3.0),
                (look.genga, look.chosen, 2.9),
                (look.faint, look.chosen, 4.0),
                (look.inbetween, look.paper, 3.0),
            ] {
                for eye in EYES {
                    let contrast = contrast(words, ground, eye);
                    assert!(contrast >= least, "{words:?} on {ground:?}: {contrast:.1}");
                }
            }
        }
    }

    #[test]
    fn grey_words_can_be_read_on_every_ground_in_both_themes() {
        let context = Context::default();
        dress(&context);
        for theme in [Theme::Light, Theme::Dark] {
            let (look, style) = (Look::from_theme(theme), context.style_of(theme));
            let visuals = &style.visuals;
            assert_eq!(visuals.weak_text_color(), look.faint, "egui's own grey words");
            let grounds = [
                ("paper", look.paper),
                ("ground", look.ground),
                ("chosen", look.chosen),
                ("steady", look.steady),
                ("panel", visuals.panel_fill),
                ("field", visuals.text_edit_bg_color()),
                ("button", visuals.widgets.inactive.weak_bg_fill),
                ("button with the keyboard", visuals.widgets.active.weak_bg_fill),
            ];
            for (name, ground) in grounds {
                for (words, color) in [("grey", look.faint), ("usual", visuals.text_color())] {
                    let contrast = contrast(color, ground, EYES[0]);
                    // Usual words of egui stand on panels and fields only.
                    let is_there = words == "grey" || ["panel", "field"].contains(&name);
                    assert!(
                        !is_there || contrast >= 4.5,
                        "{theme:?} {words} on {name}: {contrast:.2}"
                    );
                }
            }
        }
    }
}
