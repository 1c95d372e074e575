//! The expert settings (詳細設定): every knob of the recipe as a slider or a choice with the first sentence of its help,
//! made from [`KNOBS`](genga::recipe::KNOBS).

mod choices;
mod measured;

use egui::{
    CollapsingHeader, ComboBox, Label, RichText, ScrollArea, Slider, SliderClamping, TextEdit, Ui,
};

pub(super) use self::measured::is_other;
use self::measured::written;
use super::command::Command;
use super::focus::{self, Part};
use super::icon::{self, Icon};
use super::smoothing_map::Map;
use super::view_state::Shown;
use super::words::Words;
use genga::recipe::{KNOBS, Kind, Knob, Recipe, Who};

/// Numbers of koma per drawing on offer. A recipe may have others.
const ON: [&str; 8] = ["1", "2", "3", "4", "1-2", "1-3", "2-3", "2-4"];
/// Sides to look from on offer. A recipe may have a place.
const SEEN_FROM: [&str; 5] = ["world", "auto", "front", "side", "three-quarter"];
/// Shares on offer. A recipe may have others.
const OR_AUTO: [&str; 4] = ["auto", "0", "0.5", "1"];
/// Layers on offer. A recipe may name its own.
const LAYERS: [&str; 3] = ["body", "limbs", "joints"];
/// Knobs that find fewer turns. Their help adds that genga hardly become fewer while fills are on.
const FEWER_TURNS: [&str; 2] = ["filter.width", "turns.persistence"];
const FILLED: (&str, &str) = (
    "Where the body would go astray, fills take the place of turns that go (keys.fill): genga hardly become fewer. \
     keys.min_price and keys.per_second make them fewer.",
    "変わり目が減っても、動きが崩れるところには補いの原画が入るので（keys.fill）、枚数はほとんど減らない。\
     減らすのは keys.min_price と keys.per_second。",
);
/// Least and greatest width of the labels.
const LABEL: f32 = 108.0;
const WIDEST_LABEL: f32 = 150.0;
/// Size of the first sentence of a help, in points.
const SENTENCE: f32 = 11.0;

/// The values of all knobs as text. They are updated only if the recipe has changed.
#[derive(Debug, Clone)]
pub(super) struct Knobs {
    of: Recipe,
    values: Vec<String>,
    defaults: Vec<String>,
}

impl Default for Knobs {
    fn default() -> Self {
        let of = Recipe::default();
        Self { values: texts(&of), defaults: texts(&of), of }
    }
}

fn texts(recipe: &Recipe) -> Vec<String> {
    let settings = recipe.settings().into_iter().map(|(_, value)| value);
    settings.take(KNOBS.len()).collect()
}

impl Knobs {
    /// Shows the knobs section by section.
    pub(super) fn show(
        &mut self,
        ui: &mut Ui,
        map: &mut Map,
        shown: &Shown<'_>,
        commands: &mut Vec<Command>,
    ) {
        let recipe = &shown.wanted.recipe;
        if self.of != *recipe {
            (self.of, self.values) = (recipe.clone(), texts(recipe));
        }
        let words = shown.words;
        ScrollArea::vertical().id_salt("knobs").auto_shrink(false).show(ui, |ui| {
            ui.spacing_mut().slider_width = 92.0;
            let wide = label_width(ui, words);
            for section in sections() {
                let (name, is_open) = named(section, words);
                let header = CollapsingHeader::new(RichText::new(name).strong());
                let header = header.id_salt(("section", section)).default_open(is_open);
                let header = header.show_unindented(ui, |ui| {
                    for (at, knob) in KNOBS.iter().enumerate() {
                        if section_of(knob) == section {
                            self.row(ui, (at, wide), knob, words, commands);
                            first_sentence(ui, knob, shown);
                        }
                    }
                });
                if section == sections()[0] {
                    Part::Knobs.begins(&header.header_response);
                }
                if section == Some("turns") {
                    map.show(ui, shown, commands);
                }
            }
            focus::bring_into_view(ui);
        });
    }

    fn row(
        &self,
        ui: &mut Ui,
        (at, wide): (usize, f32),
        knob: &'static Knob,
        words: Words,
        commands: &mut Vec<Command>,
    ) {
        let (value, default) = (&self.values[at], &self.defaults[at]);
        let name = label(knob, words);
        let mut set = |text: String| commands.push(Command::Set(knob.name, text));
        ui.horizontal(|ui| {
            let is_own = value != default;
            let text = RichText::new(&name);
            let text = if is_own { text.strong() } else { text };
            let text = egui::Label::new(text).truncate();
            let label = ui.scope(|ui| {
                ui.set_width(wide);
                ui.add(text)
            });
            help(label.response, knob, default, words);
            ui.name_inputs(knob.name, |ui| control(ui, knob, value, words, &mut set));
            let unit = short(knob, words);
            if !unit.is_empty() {
                ui.label(RichText::new(unit).size(10.5).weak());
            }
            if is_own {
                let back = words.say("Reset to default", "初期値に戻す");
                let name = format!("{back}: {} ({default})", knob.name);
                if icon::button(ui, Icon::Back, &name).clicked() {
                    set(default.clone());
                }
            }
        });
    }
}

/// Shows the first sentence of a knob's help below it; the rest is in the tooltip of its name.
fn first_sentence(ui: &mut Ui, knob: &Knob, shown: &Shown<'_>) {
    let words = shown.words;
    let sentence = match words.is_japanese() {
        true => first_of(knob.japanese_help, "。").to_owned(),
        false => words.english(first_of(knob.help, ". ")),
    };
    let text = RichText::new(sentence).size(SENTENCE).color(shown.look.faint);
    ui.add(Label::new(text).wrap());
    ui.add_space(3.0);
}

/// The text up to and including the first end of a sentence.
fn first_of<'a>(text: &'a str, end: &str) -> &'a str {
    text.find(end).map_or(text, |at| text[..at + end.len()].trim_end())
}

/// Explains a knob in a tooltip on its name.
pub(super) fn help(response: egui::Response, knob: &Knob, default: &str, words: Words) {
    response.on_hover_ui(|ui| {
        ui.set_max_width(320.0);
        ui.strong(knob.name);
        if words.has_japanese {
            ui.label(knob.japanese);
        }
        ui.label(words.say(knob.help, knob.japanese_help));
        if FEWER_TURNS.contains(&knob.name) {
            ui.label(words.say(FILLED.0, FILLED.1));
        }
        // In Japanese the row shows the unit. A choice still lists its words, since they are those of the recipe.
        if !words.is_japanese() || matches!(knob.kind, Kind::Choice(_)) {
            ui.weak(knob.takes());
        }
        if !default.is_empty() {
            ui.weak(format!("{} {default}", words.say("default", "初期値")));
        }
    });
}

/// Shows the control for a kind of knob. Calls `set` with the text for [`Recipe::set`].
pub(super) fn control(
    ui: &mut Ui,
    knob: &'static Knob,
    value: &str,
    words: Words,
    set: &mut impl FnMut(String),
) {
    match knob.kind {
        Kind::Number { min, max, whole, optional } => {
            number(ui, knob, value, (min, max, whole, optional), set);
        }
        Kind::Span | Kind::Amount | Kind::Band => measured::show(ui, knob, value, set),
        Kind::On => choice(ui, (knob, words), value, &ON, set),
        Kind::OrAuto => choice(ui, (knob, words), value, &OR_AUTO, set),
        Kind::SeenFrom => choice(ui, (knob, words), value, &SEEN_FROM, set),
        Kind::Choice(choices) => choice(ui, (knob, words), value, choices, set),
        Kind::Text if knob.name != "layers" => words_of(ui, knob, value, set),
        Kind::Text => choice(ui, (knob, words), value, &LAYERS, set),
        Kind::Flag => {
            let mut is_on = value == "true";
            if ui.checkbox(&mut is_on, "").accessible_name(knob.name).changed() {
                set(is_on.to_string());
            }
        }
    }
}

/// A field for any text. A trailing blank is kept while typing, since the next word is yet to follow.
fn words_of(ui: &mut Ui, knob: &Knob, value: &str, set: &mut impl FnMut(String)) {
    let id = ui.make_persistent_id(knob.name);
    let typed = ui.data(|data| data.get_temp::<String>(id)).filter(|typed| typed.trim() == value);
    let mut text = typed.unwrap_or_else(|| value.to_owned());
    let field = ui.add(TextEdit::singleline(&mut text).desired_width(128.0));
    if field.accessible_name(knob.name).changed() {
        set(text.clone());
    }
    ui.data_mut(|data| data.insert_temp(id, text));
}

fn number(
    ui: &mut Ui,
    knob: &Knob,
    value: &str,
    (min, max, whole, optional): (f64, f64, bool, bool),
    set: &mut impl FnMut(String),
) {
    let mut is_set = value != "none";
    if optional && ui.checkbox(&mut is_set, "").accessible_name(knob.name).changed() {
        set(if is_set { min.to_string() } else { "none".into() });
    }
    if !is_set {
        return;
    }
    // `inf` is shown as it is, at the slider's end.
    let own = value.parse().unwrap_or(min);
    let mut number = own;
    let slider = Slider::new(&mut number, min..=max).clamping(SliderClamping::Never);
    let slider = if whole { slider.integer() } else { slider.max_decimals(2) };
    let slider = ui.add(slider).accessible_name(knob.name);
    if slider.changed() && is_other(number, own) {
        set(written(number));
    }
}

fn choice(
    ui: &mut Ui,
    (knob, words): (&'static Knob, Words),
    value: &str,
    choices: &[&str],
    set: &mut impl FnMut(String),
) {
    let shown = choices::said(knob, value, words);
    let combo = ComboBox::from_id_salt(knob.name).selected_text(shown).width(128.0).truncate();
    let combo = combo.show_ui(ui, |ui| {
        for choice in choices {
            let name = choices::said(knob, choice, words);
            if ui.selectable_label(value == *choice, name).clicked() {
                set((*choice).to_owned());
            }
        }
    });
    combo.response.accessible_name(knob.name);
}

/// Width of the labels, chosen so that no label of an animator's knob is cut.
fn label_width(ui: &Ui, words: Words) -> f32 {
    let font = egui::TextStyle::Body.resolve(ui.style());
    let ink = ui.visuals().text_color();
    let own = KNOBS.iter().filter(|knob| knob.who == Who::Animator);
    let wide = own.map(|knob| {
        ui.painter().layout_no_wrap(label(knob, words), font.clone(), ink).size().x.ceil() + 2.0
    });
    wide.fold(LABEL, f32::max).min(WIDEST_LABEL)
}

/// The section of the knobs that only studies use.
const STUDIES: &str = "studies";

/// The section in which a knob is shown.
fn section_of(knob: &Knob) -> Option<&'static str> {
    match knob.who {
        Who::Animator => knob.path().0,
        Who::Researcher => Some(STUDIES),
    }
}

/// The sections in order, each once.
fn sections() -> Vec<Option<&'static str>> {
    let mut sections: Vec<_> = KNOBS.iter().map(section_of).collect();
    sections.dedup();
    sections
}

/// Title of a section, and whether it is open by default. Only the sections that animators turn most are.
fn named(section: Option<&'static str>, words: Words) -> (&'static str, bool) {
    match section {
        None => (words.say("Sheet", "シート"), false),
        Some("exaggerate") => (words.say("Exaggeration", "誇張"), false),
        Some("filter") => (words.say("Smoothing", "ローパスフィルタ"), true),
        Some("turns") => (words.say("Turns of joints", "部位の動きの変わり目"), false),
        Some("keys") => (words.say("Genga", "原画"), true),
        Some("actions") => (words.say("Actions", "動作"), false),
        Some("spacing") => (words.say("Inbetweens", "中割りと詰め"), true),
        Some("omission") => (words.say("Left out and held", "中無しとコマ撮り"), true),
        Some(STUDIES) => (words.say("For studies", "研究用"), false),
        Some(other) => (other, false),
    }
}

/// Abbreviated unit for a row. Empty for knobs that have a button for the unit.
fn short(knob: &Knob, words: Words) -> String {
    let Kind::Number { .. } = knob.kind else { return String::new() };
    let unit = knob.unit.split(',').next().unwrap_or_default();
    let word = match unit.split(' ').next().unwrap_or_default() {
        "koma" => words.say("koma", "コマ"),
        "keys" => words.say("genga", "枚"),
        "drawings" => words.say("drawings", "枚"),
        "%" => "%",
        _ => return String::new(),
    };
    let per = if unit.ends_with(" a second") { words.say("/s", "/秒") } else { "" };
    format!("{word}{per}")
}

/// Label of a knob.
pub(super) fn label(knob: &Knob, words: Words) -> String {
    if words.is_japanese() {
        return knob.japanese.into();
    }
    let (section, field) = knob.path();
    let mut label = match (knob.who, section) {
        // Research knobs of all sections stand in one list, so each names its own.
        (Who::Researcher, Some(section)) => format!("{section}: {field}"),
        _ => field.to_owned(),
    }
    .replace('_', " ");
    if let Some(first) = label.get_mut(..1) {
        first.make_ascii_uppercase();
    }
    label
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_unit_is_said_in_a_word() {
        let words = Words { language: Default::default(), has_japanese: false };
        let short = |name| short(Knob::find(name).unwrap(), words);
        assert_eq!(short("rate"), "koma/s");
        assert_eq!(short("keys.min_price"), "%");
        assert_eq!(short("keys.rest"), "%/s");
        assert_eq!(short("keys.per_second"), "genga/s");
        assert_eq!(short("spacing.weight"), "");
        assert_eq!(short("filter.width"), "", "its button says it");
    }

    #[test]
    fn every_knob_has_a_first_sentence_in_both_languages() {
        for knob in KNOBS {
            for (text, end) in [(knob.help, ". "), (knob.japanese_help, "。")] {
                let first = first_of(text, end);
                let is_whole = first.ends_with(['.', '。']) && text.starts_with(first);
                assert!(is_whole && first.chars().count() <= 240, "{}: {first}", knob.name);
            }
            let words = Words { language: Default::default(), has_japanese: false };
            let english = words.english(first_of(knob.help, ". "));
            let is_known = |letter: char| letter.is_ascii() || "°²×–".contains(letter);
            assert!(english.chars().all(is_known), "{}: {english}", knob.name);
        }
    }

    #[test]
    fn a_label_is_the_field_in_words() {
        let words = Words { language: Default::default(), has_japanese: false };
        assert_eq!(label(Knob::find("omission.naka_nashi").unwrap(), words), "Naka nashi");
    }
}
