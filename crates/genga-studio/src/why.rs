//! Explains why a drawing is there (理由), in a few words and in a sentence.

use super::column::KeyedCell;
use super::words::Words;
use genga::keys::Origin;
use genga::sheet::Why;

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
        let out = why.omitted_before;
        reasons.push(match (words.is_japanese(), out) {
            (true, _) => format!("抜いた中割 {out}"),
            (false, 1) => "1 inbetween out".into(),
            (false, _) => format!("{out} inbetweens out"),
        });
    }
    if reasons.is_empty() {
        reasons.extend(why.voters.first().map(ToString::to_string));
    }
    reasons.join(" · ")
}

/// The whole reason, as in the reason columns of the tables.
pub(super) fn sentence(why: &Why, words: Words) -> String {
    if words.is_japanese() { why.japanese() } else { why.to_string() }
}
