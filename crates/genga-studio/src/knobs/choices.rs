//! Labels for the words of choices.

use crate::words::Words;
use genga::keys::Layers;
use genga::recipe::{Kind, Knob, Recipe};

/// Japanese labels: a knob, or an empty name for all knobs; a word of the recipe; its label.
const JAPANESE: &[(&str, &str, &str)] = &[
    ("", "on", "する"),
    ("", "off", "しない"),
    ("layers", "body", "全身で1枚"),
    ("layers", "limbs", "胴と手足"),
    ("layers", "joints", "部位ごと"),
    ("root", "drawings", "絵のまま"),
    ("root", "ones", "1コマ打ち"),
    ("seen_from", "world", "空間"),
    ("seen_from", "auto", "自動"),
    ("seen_from", "front", "正面"),
    ("seen_from", "side", "側面"),
    ("seen_from", "three-quarter", "斜め"),
    ("feet", "free", "絵のまま"),
    ("feet", "held", "止める"),
    ("exaggerate.cartoon_parts", "upper", "足以外"),
    ("exaggerate.cartoon_parts", "body", "全身"),
    ("speed.measure", "rotation", "回転"),
    ("speed.measure", "displacement", "移動"),
    ("speed.measure", "combined", "回転と移動"),
    ("speed.measure", "angle", "角度の変化"),
    ("filter.kind", "box", "移動平均"),
    ("filter.kind", "gaussian", "ガウス"),
    ("filter.kind", "ideal", "理想"),
    ("filter.kind", "butterworth", "バターワース"),
    ("turns.reading", "event", "止まりと減速"),
    ("turns.reading", "literal", "論文どおり"),
    ("turns.side", "after", "後だけ"),
    ("turns.side", "both", "前後"),
    ("turns.side", "rising", "増え続ける後"),
    ("turns.drawn", "auto", "自動"),
    ("keys.merge", "body", "全身"),
    ("keys.merge", "union", "どれかの部位"),
    ("keys.merge", "vote", "部位の投票"),
    ("keys.rank", "price", "値段"),
    ("keys.rank", "strength", "強さ"),
    ("keys.at_rests", "keys", "原画にする"),
    ("keys.at_rests", "off", "特別扱いしない"),
    ("keys.gaits", "steps", "一歩ごとに揃える"),
    ("keys.gaits", "off", "揃えない"),
    ("keys.contacts", "off", "特別扱いしない"),
    ("keys.contacts", "candidates", "候補にする"),
    ("keys.contacts", "keys", "原画にする"),
    ("spacing.source", "sample", "元の動き"),
    ("spacing.source", "blend", "前後の原画"),
    ("omission.order", "naka_nashi_first", "中無しが先"),
    ("omission.order", "koma_dori_first", "コマ撮りが先"),
];

/// Label of a value in the current language. A list of layers is shown by its names.
pub(super) fn said(knob: &Knob, value: &str, words: Words) -> String {
    if let Some(names) = names_of_layers(knob, value) {
        return names;
    }
    let japanese = words.is_japanese().then(|| japanese(knob, value)).flatten();
    japanese.unwrap_or_else(|| value.replace('_', " "))
}

/// Names of the layers that a person lists. `None` for other values.
fn names_of_layers(knob: &Knob, value: &str) -> Option<String> {
    if knob.name != "layers" || !value.starts_with('[') {
        return None;
    }
    let mut recipe = Recipe::default();
    recipe.set(knob.name, value).ok()?;
    let Layers::Named(layers) = recipe.layers else { return None };
    let names: Vec<&str> = layers.iter().map(|layer| layer.name.as_str()).collect();
    Some(names.join(" · "))
}

fn japanese(knob: &Knob, value: &str) -> Option<String> {
    if knob.kind == Kind::On {
        return Some(format!("{}コマ打ち", value.replace('-', "〜")));
    }
    let of = |name: &str| JAPANESE.iter().find(|(own, word, _)| *own == name && *word == value);
    of(knob.name).or_else(|| of("")).map(|(_, _, said)| (*said).to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::words::Language;
    use genga::recipe::KNOBS;

    #[test]
    fn every_word_of_every_choice_has_a_japanese_one() {
        for knob in KNOBS {
            let Kind::Choice(words) = knob.kind else { continue };
            for word in words {
                assert!(japanese(knob, word).is_some(), "{}: {word}", knob.name);
            }
        }
        let said = |name, value| japanese(Knob::find(name).unwrap(), value);
        assert_eq!(said("turns.drawn", "auto").as_deref(), Some("自動"));
        assert_eq!(said("spacing.on", "1-3").as_deref(), Some("1〜3コマ打ち"));
        assert_eq!(said("seen_from", "0 100 200"), None, "a place is one in any language");
    }

    #[test]
    fn layers_of_a_person_go_by_their_names() {
        let knob = Knob::find("layers").unwrap();
        let list = r#"[{ joints = ["Hips"], name = "A" }, { joints = ["*Arm*"], name = "B" }]"#;
        let words = Words { language: Language::English, has_japanese: false };
        assert_eq!(said(knob, list, words), "A · B");
        assert_eq!(said(knob, "limbs", words), "limbs");
    }
}
