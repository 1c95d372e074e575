//! Knobs measured in one of two units: frames or seconds, a count or a share.

use egui::{Button, Slider, SliderClamping, Ui};

use genga::recipe::{Kind, Knob};

/// A unit: its suffix and the range of its slider.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Scale {
    suffix: &'static str,
    most: f64,
    is_whole: bool,
}

const SECONDS: Scale = Scale { suffix: "s", most: 1.0, is_whole: false };
const FRAMES: Scale = Scale { suffix: "", most: 60.0, is_whole: true };
const PERCENT: Scale = Scale { suffix: "%", most: 100.0, is_whole: false };
const COUNT: Scale = Scale { suffix: "", most: 60.0, is_whole: true };
const ACCELERATION: Scale = Scale { suffix: "", most: 1000.0, is_whole: false };

/// The two units of a kind of knob.
fn scales(kind: Kind) -> [Scale; 2] {
    match kind {
        Kind::Span => [SECONDS, FRAMES],
        Kind::Band => [PERCENT, ACCELERATION],
        _ => [PERCENT, COUNT],
    }
}

/// Symbol of a unit on its button.
fn symbol(scale: Scale, kind: Kind) -> &'static str {
    match kind {
        Kind::Span if scale.suffix.is_empty() => "fr",
        Kind::Band if scale.suffix.is_empty() => "°/s²",
        _ if scale.suffix.is_empty() => "×",
        _ => scale.suffix,
    }
}

/// Parses a value into number and unit. A fraction (`1/3`) becomes a percentage.
fn read(value: &str, kind: Kind) -> (f64, Scale) {
    let [with, without] = scales(kind);
    let number = |text: &str| text.trim().parse().unwrap_or(0.0);
    match (value.strip_suffix(with.suffix), value.split_once('/')) {
        (Some(text), _) => (number(text), with),
        (None, Some((taken, parts))) => (100.0 * number(taken) / number(parts), with),
        // A share that is no whole percentage is written as a fraction of 1, without a unit.
        (None, None) if kind == Kind::Amount && value.contains('.') => {
            (100.0 * number(value), with)
        }
        (None, None) => (number(value), without),
    }
}

/// Shows a slider, and a button that switches the unit.
pub(super) fn show(ui: &mut Ui, knob: &Knob, value: &str, set: &mut impl FnMut(String)) {
    let (own, scale) = read(value, knob.kind);
    let mut number = own;
    let slider = Slider::new(&mut number, 0.0..=scale.most).clamping(SliderClamping::Never);
    let slider = if scale.is_whole { slider.integer() } else { slider.max_decimals(2) };
    let slider = ui.add(slider).accessible_name(knob.name);
    if slider.changed() && is_other(number, own) {
        set(format!("{}{}", written(number), scale.suffix));
    }
    let unit = ui.add(Button::new(symbol(scale, knob.kind)).small());
    let unit = unit.on_hover_text(knob.takes());
    if unit.accessible_name(format!("unit of {}", knob.name)).clicked() {
        let [a, b] = scales(knob.kind);
        let other = if scale == a { b } else { a };
        // Without the clip a value cannot be converted, so the slider keeps its relative position.
        let share = (number / scale.most).clamp(0.0, 1.0);
        let number = share * other.most;
        let number = if other.is_whole { number.round() } else { number };
        set(format!("{}{}", written(number), other.suffix));
    }
}

/// Writes a number as a person would, rounded to thousandths.
pub(super) fn written(number: f64) -> String {
    ((number * 1000.0).round() / 1000.0).to_string()
}

/// Whether a number differs from an earlier one as shown. A field that the focus merely passes returns the number it
/// shows, which may be rounded.
pub(crate) fn is_other(number: f64, before: f64) -> bool {
    (number - before).abs() >= 0.005
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_value_is_read_with_its_unit() {
        for (kind, value, number, scale) in [
            (Kind::Span, "0.2s", 0.2, SECONDS),
            (Kind::Span, "20", 20.0, FRAMES),
            (Kind::Amount, "4%", 4.0, PERCENT),
            (Kind::Amount, "4", 4.0, COUNT),
            (Kind::Amount, "1/4", 25.0, PERCENT),
            (Kind::Amount, "0.1234567", 12.34567, PERCENT),
            (Kind::Band, "100", 100.0, ACCELERATION),
            (Kind::Band, "5%", 5.0, PERCENT),
        ] {
            let (found, unit) = read(value, kind);
            assert!((found - number).abs() < 1e-12 && unit == scale, "{value}: {found} {unit:?}");
        }
    }
}
