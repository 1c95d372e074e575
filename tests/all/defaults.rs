//! Checks that the method page states default, words and range of every setting, once and as in the program.

use std::fs;

use genga::recipe::{KNOBS, Kind, Recipe};

use crate::clips::here;

/// Header of a table of settings, which distinguishes it from the page's other tables.
const HEADER: &str = "| setting | default | takes |";

/// Lists what is wrong with the settings of a page, one a line.
fn mistakes(page: &str) -> Vec<String> {
    let rows = rows(page);
    let recipe = Recipe::default();
    let mut found = Vec::new();
    for [name, default, takes] in &rows {
        let Some(knob) = KNOBS.iter().find(|knob| knob.name == name) else {
            found.push(format!("{name}: there is no such setting"));
            continue;
        };
        let own = recipe.get(knob.name).unwrap();
        if *default != own {
            found.push(format!("{name}: the page has {default}, the program {own}"));
        }
        if let Kind::Choice(words) = knob.kind {
            let missing = words.iter().filter(|word| !takes.contains(&format!("`{word}`")));
            found.extend(missing.map(|word| format!("{name}: the page does not name {word}")));
        }
        let range = knob.range.to_string();
        let is_said = match knob.kind {
            Kind::Number { .. } => takes.contains(&range),
            // A span is 0 or more unless the page says otherwise.
            Kind::Span => takes.contains(&range) || range == "0 or more",
            _ => true,
        };
        if !is_said {
            found.push(format!("{name}: the page does not say {range}"));
        }
    }
    for knob in KNOBS {
        let count = rows.iter().filter(|[name, ..]| name == knob.name).count();
        if count != 1 {
            found.push(format!("{}: the page states it {count} times", knob.name));
        }
    }
    found
}

/// Name, default and accepted values in each row of the tables of settings.
fn rows(page: &str) -> Vec<[String; 3]> {
    let mut rows = Vec::new();
    let mut lines = page.lines();
    while lines.any(|line| line.trim() == HEADER) {
        // The separator line under the header comes first.
        let table = lines.by_ref().skip(1).take_while(|line| line.starts_with('|'));
        rows.extend(table.map(row));
    }
    rows
}

/// Splits a row into cells. Name and default are in backticks, and neither contains a bar.
fn row(line: &str) -> [String; 3] {
    let mut cells = line.trim_start_matches('|').splitn(3, '|');
    let mut cell = || cells.next().unwrap_or_default().trim();
    let [name, default, takes] = [cell(), cell(), cell()];
    [name.trim_matches('`').into(), default.trim_matches('`').into(), takes.into()]
}

fn page() -> String {
    fs::read_to_string(here("docs/method.md")).unwrap()
}

#[test]
fn the_method_states_every_default_once_as_the_program_has_it() {
    let found = mistakes(&page());
    assert!(found.is_empty(), "docs/method.md:\n{}", found.join("\n"));
}

#[test]
fn a_default_that_is_wrong_missing_doubled_or_of_nothing_is_found() {
    let page = page();
    let all = rows(&page);
    assert_eq!(all.len(), KNOBS.len());
    let line = |name: &str| {
        let begin = format!("| `{name}` |");
        let lines = page.lines().find(|line| line.starts_with(&begin));
        lines.unwrap_or_else(|| panic!("{name} has no row")).to_owned()
    };
    for [name, default, _] in &all {
        let own = line(name);
        let with = |other: &str| mistakes(&page.replacen(&own, other, 1));
        let wrong = own.replacen(&format!("| `{default}` |"), "| `7 bananas` |", 1);
        let said = format!("{name}: the page has 7 bananas, the program {default}");
        assert_eq!(with(&wrong), [said]);
        let lacking = own.replacen(name, "speed.colour", 1);
        let found = with(&lacking);
        let [nothing, missing] = &found[..] else { panic!("{name}: {found:?}") };
        assert_eq!(nothing.split_once(": ").unwrap().0, "speed.colour");
        assert_eq!(*missing, format!("{name}: the page states it 0 times"));
        let twice = format!("{own}\n{own}");
        assert_eq!(with(&twice), [format!("{name}: the page states it 2 times")]);
    }
    let side = line("turns.side");
    let found = mistakes(&page.replacen(&side, &side.replacen("`both`", "", 1), 1));
    assert_eq!(found, ["turns.side: the page does not name both"]);
    let rate = line("rate");
    let found = mistakes(&page.replacen(&rate, &rate.replacen("1000", "60", 1), 1));
    assert_eq!(found, ["rate: the page does not say 2 to 1000"]);
}
