//! Explains why a drawing is there (理由), in a few words and in a sentence.

use super::column::KeyedCell;
use super::words::Words;
use genga::keys::Origin;
use genga::sheet::{Reason, Why};

/// The reason in a few words. A person's decisions come first. If there is nothing else, names the first joint that
/// voted.
pub(super) fn in_short(cell: &KeyedCell<'_>, words: Words) -> String {
    let mut reasons: Vec<String> = Vec::new();
    if let Some(key) = cell.key {
        match (&key.name, key.origin) {
            (Some(name), _) => reasons.push(name.clone()),
            (None, Origin::Pinned) => reasons.push(words.say("pinned", "固定").into()),
            _ => {}
        }
        match key.origin {
            Origin::Moved { from } => reasons.push(match words.is_japanese() {
                true => format!("フレーム{from}から"),
                false => format!("from frame {from}"),
            }),
            Origin::Fill | Origin::Rest | Origin::Contact | Origin::Step => {
                let reason = key.origin.reason();
                reasons.push(words.say(reason.word(), reason.japanese()).into());
            }
            Origin::Turn | Origin::Pinned => {}
        }
    }
    let why = &cell.drawing.why;
    if why.hold_set {
        reasons.push(format!("{} {}", words.say("held", "止め"), cell.held));
    }
    if why.omitted_before > 0 {
        reasons.push(format!("{} {}", words.say("left out", "抜いた中割"), why.omitted_before));
    }
    if reasons.is_empty() {
        reasons.extend(why.voters.first().map(ToString::to_string));
    }
    reasons.join(" · ")
}

/// The whole reason, as in the reason columns of the tables.
pub(super) fn sentence(why: &Why, words: Words) -> String {
    if words.is_japanese() { japanese(why) } else { why.to_string() }
}

/// Japanese translation of the text of [`Why`].
fn japanese(why: &Why) -> String {
    let mut reasons: Vec<String> = Vec::new();
    match why.pinned.as_deref() {
        None => {}
        Some("") => reasons.push("固定".into()),
        Some(name) => reasons.push(format!("固定「{name}」")),
    }
    if let Some(from) = why.moved_from {
        reasons.push(format!("フレーム{from}から移動"));
    }
    match why.reason {
        Some(Reason::Fill) => reasons.push("ないと動きが崩れる".into()),
        Some(Reason::Rest) => reasons.push("止めの始まりか終わり".into()),
        Some(Reason::Contact) => reasons.push("足か手が着く、または離れる".into()),
        Some(Reason::Step) => reasons.push("歩き・走りの一歩ごとの原画".into()),
        Some(Reason::Turn | Reason::Pin) | None => {}
    }
    match &*why.voters {
        [] => {}
        [one] => reasons.push(format!("{one}の変わり目")),
        [first, others @ ..] => reasons.push(format!("{first}ほか{}か所の変わり目", others.len())),
    }
    if let Some(price) = why.price {
        reasons.push(format!("身長の{price:.1}%の誤差を防ぐ"));
    }
    let by = if why.hold_set { "" } else { "（コマ撮り）" };
    for (count, what) in [
        (why.omitted_before, "枚を直前で抜いた（中無し）".to_owned()),
        (why.lengthened, "コマ長くなった（中無し）".to_owned()),
        (why.held_for, format!("枚分止めた{by}")),
    ] {
        if count > 0 {
            reasons.push(format!("{count}{what}"));
        }
    }
    if why.hold_set {
        reasons.push("止めの長さは手動".into());
    }
    reasons.join("、")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn japanese_has_as_many_reasons_as_english() {
        let all = Why {
            voters: ["Hips", "Head"].into_iter().collect(),
            pinned: Some("hit".into()),
            moved_from: Some(12),
            reason: Some(Reason::Rest),
            price: Some(8.25),
            lengthened: 1,
            omitted_before: 2,
            held_for: 3,
            hold_set: true,
            ..Why::default()
        };
        let count = |text: String, between: &str| text.split(between).count();
        assert_eq!(count(japanese(&all), "、"), count(all.to_string(), "; "));
        assert_eq!(japanese(&Why::default()), "");
        assert_eq!(
            japanese(&Why { omitted_before: 1, price: Some(10.0), ..Why::default() }),
            "身長の10.0%の誤差を防ぐ、1枚を直前で抜いた（中無し）"
        );
    }
}
