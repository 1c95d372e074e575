//! Checks that README and guide show what the program does: each of their commands is run as by a reader.
//!
//! All blocks of a page are run from top to bottom in one folder with `data/` in it.
//!
//! - `console`: a line `$ command` is run. The lines after it are the program's exact output, in which `…` stands for a
//!   number that differs on each run.
//! - `sh`: each line is run and has to succeed.
//! - below `<!-- file: NAME -->`: the block is written to that file.
//! - `rust`: each line occurs in a test below.
//!
//! `GENGA_PAGES=write cargo test --test all readme` writes the program's output into the pages.

use std::fmt::Write;
use std::fs;
use std::path::Path;
use std::process::Command;

use genga::motion::{bvh, clean::Cleaning};
use genga::{edits::Edits, pipeline::Engine, recipe::Recipe};

use crate::clips::here;

mod formats;
mod page;
mod prose;
mod reader;

use page::{Block, Piece, bare, commands, page, pieces};
use reader::{TESTS, UNINSTALLED, place, said};

/// The pages, each with its translation.
const PAGES: [[&str; 2]; 3] = [
    ["README.md", "README.ja.md"],
    ["docs/guide.md", "docs/guide.ja.md"],
    ["docs/for-me.md", "docs/for-me.ja.md"],
];

/// Runs a command and returns its output.
type Say<'a> = &'a mut dyn FnMut(&str) -> Result<String, String>;

/// Whether a line matches the shown one, in which each `…` may be any number.
fn is_as_shown(line: &str, shown: &str) -> bool {
    let mut pieces = shown.split('…');
    let Some(rest) = pieces.next().and_then(|begin| line.strip_prefix(begin)) else {
        return false;
    };
    let number = |text: char| text.is_ascii_digit() || text == '.';
    let after = pieces.try_fold(rest, |rest, piece| {
        let past = rest.trim_start_matches(number);
        (past.len() < rest.len()).then(|| past.strip_prefix(piece)).flatten()
    });
    after == Some("")
}

/// Fills a block of commands with their output. A shown line is kept if it still matches.
fn answered(block: &Block, say: Say<'_>) -> Result<String, String> {
    let mut text = String::new();
    let mut lines = block.lines.iter().peekable();
    while let Some(line) = lines.next() {
        let Some(command) = line.strip_prefix("$ ") else {
            return Err(format!("{line}: a block begins with a command"));
        };
        let mut shown = Vec::new();
        while let Some(line) = lines.next_if(|line| !line.starts_with("$ ")) {
            shown.push(*line);
        }
        writeln!(text, "{line}").unwrap();
        for (at, line) in say(&bare(command))?.lines().enumerate() {
            let shown = shown.get(at).filter(|shown| is_as_shown(line, shown));
            writeln!(text, "{}", shown.unwrap_or(&line)).unwrap();
        }
    }
    Ok(text)
}

/// Returns the page with the program's current output.
fn made(page: &str) -> Result<String, String> {
    let place = place();
    made_in(place.path(), page, &mut |command| said(command, place.path()))
}

/// Fills a page and its translation. Both have the same commands in the same order, so each is run once.
fn made_both([page, translation]: [&str; 2]) -> Result<[String; 2], String> {
    let place = place();
    let mut answers = Vec::new();
    let made = made_in(place.path(), page, &mut |command| {
        let answer = said(command, place.path())?;
        answers.push((command.to_owned(), answer.clone()));
        Ok(answer)
    })?;
    let mut answers = answers.into_iter();
    let translated = made_in(place.path(), translation, &mut |command| {
        let answer = answers.next().filter(|(meant, _)| meant == command);
        answer.map(|(_, answer)| answer).ok_or_else(|| format!("{command}: another stands here"))
    })?;
    Ok([made, translated])
}

fn made_in(place: &Path, page: &str, say: Say<'_>) -> Result<String, String> {
    let mut text = String::new();
    for piece in pieces(page) {
        let block = match piece {
            Piece::Prose(line) => {
                writeln!(text, "{line}").unwrap();
                continue;
            }
            Piece::Block(block) => block,
        };
        let mut body = block.lines.iter().map(|line| format!("{line}\n")).collect::<String>();
        match (block.file, block.language) {
            (Some(name), _) => fs::write(place.join(name), &body).unwrap(),
            (None, "console") => body = answered(&block, say)?,
            (None, "sh") => {
                for line in &block.lines {
                    say(&bare(line))?;
                }
            }
            (None, "rust") => are_of_the_test(&block)?,
            (None, other) => return Err(format!("```{other}: nothing checks such a block")),
        }
        write!(text, "```{}\n{body}```\n", block.language).unwrap();
    }
    Ok(text)
}

fn are_of_the_test(block: &Block) -> Result<(), String> {
    let bare = |line: &str| line.split("//").next().unwrap_or_default().trim().to_owned();
    let tested: Vec<_> = include_str!("readme.rs").lines().map(bare).collect();
    let missing = block.lines.iter().find(|line| !tested.contains(&bare(line)));
    missing.map_or(Ok(()), |line| Err(format!("{line}: no test has this line")))
}

/// Describes the first line in which a page differs from what it should be. Empty if there is none.
fn difference(name: &str, shown: &str, made: &str) -> String {
    if shown == made {
        return String::new();
    }
    let same = shown.lines().zip(made.lines()).take_while(|(shown, made)| shown == made).count();
    let line = |text: &str| text.lines().nth(same).unwrap_or("(nothing)").to_owned();
    format!("{name}:{}\n  shows {}\n  it is {}\n", same + 1, line(shown), line(made))
}

#[test]
fn commands_of_the_pages_say_what_the_pages_show() {
    let mut off = String::new();
    for names in PAGES {
        let shown = names.map(page);
        let made = made_both(shown.each_ref().map(|page| &page[..]));
        let made = made.unwrap_or_else(|error| panic!("{names:?}: {error}"));
        for ((name, shown), made) in names.into_iter().zip(shown).zip(made) {
            if std::env::var_os("GENGA_PAGES").is_some_and(|wish| wish == "write") {
                fs::write(here(name), made).unwrap();
            } else {
                off += &difference(name, &shown, &made);
            }
        }
    }
    assert!(off.is_empty(), "\n{off}GENGA_PAGES=write cargo test --test all readme\n");
}

#[test]
fn a_page_and_its_translation_have_the_same_commands_in_one_order() {
    for [english, japanese] in PAGES {
        let [meant, shown] = [english, japanese].map(|name| commands(&page(name)).join("\n"));
        let off = difference("command", &shown, &meant);
        assert!(off.is_empty(), "{japanese}, {off}");
    }
}

#[test]
fn the_readme_begins_with_the_main_job_and_the_tests() {
    for name in PAGES[0] {
        let commands = commands(&page(name));
        let main_job = UNINSTALLED.to_owned() + "run data/kick.bvh --out kick-genga";
        assert_eq!(commands[..2], [main_job, TESTS.to_owned()], "{name}");
    }
}

#[test]
fn the_readme_has_at_most_150_lines() {
    for name in PAGES[0] {
        assert!(page(name).lines().count() <= 150, "{name}");
    }
}

#[test]
fn the_pictures_of_the_readme_are_in_the_package() {
    let mut cargo = Command::new(env!("CARGO"));
    cargo.args(["package", "--list", "--allow-dirty", "--offline"]).current_dir(here(""));
    let output = cargo.output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let files = String::from_utf8(output.stdout).unwrap();
    for name in PAGES[0] {
        let page = page(name);
        let after = page.split("![").skip(1).filter_map(|rest| rest.split_once("]("));
        let pictures: Vec<_> =
            after.filter_map(|(_, rest)| rest.split_once(')')).map(|(path, _)| path).collect();
        assert!(!pictures.is_empty(), "{name}");
        for picture in pictures {
            assert!(files.lines().any(|file| file == picture), "{name} shows {picture}");
        }
    }
}

#[test]
fn what_the_readme_writes_is_no_part_of_the_repository() {
    let ignored = fs::read_to_string(here(".gitignore")).unwrap();
    let endings: Vec<_> = ignored.lines().filter_map(|line| line.strip_prefix('*')).collect();
    let place = place();
    let english = page(PAGES[0][0]);
    made_in(place.path(), &english, &mut |command| said(command, place.path())).unwrap();
    let entries = fs::read_dir(place.path()).unwrap().map(|entry| entry.unwrap());
    for entry in entries.filter(|entry| entry.file_name() != "data") {
        let mut written = entry.file_name().to_string_lossy().into_owned();
        written += if entry.path().is_dir() { "/" } else { "" };
        assert!(endings.iter().any(|end| written.ends_with(end)), "the README writes {written}");
    }
}

/// Pictures of the documentation, each with the run that draws it and its file there. `docs/pictures/make` makes them.
const PICTURES: [(&str, &str, &str); 9] = [
    ("kick-poses", "", "poses.svg"),
    ("kick-sheet", "", "sheet.svg"),
    ("kick-speed", "", "speed.svg"),
    ("kick-strip", "--deliver strip", "strip.svg"),
    ("kick-contact", "--deliver contact", "contact.svg"),
    ("kick-onion", "--deliver onion", "onion.svg"),
    ("kick-xsheet", "--deliver xsheet", "xsheet/0001.svg"),
    ("kick-layers", "--layers limbs", "sheet.svg"),
    (
        "kick-exaggerated",
        "--set exaggerate.cartoon=0.5 --set exaggerate.cartoon_parts=body",
        "poses.svg",
    ),
];

#[test]
fn pictures_of_the_documentation_are_those_that_the_program_draws() {
    let place = place();
    let is_other = |(name, options, file): &(&str, &str, &str)| {
        said(&format!("genga run data/kick.bvh --fresh {options}"), place.path()).unwrap();
        let made = fs::read(place.path().join("kick-genga").join(file)).unwrap();
        made != fs::read(here("docs/pictures").join(format!("{name}.svg"))).unwrap()
    };
    let others: Vec<_> = PICTURES.iter().filter(|picture| is_other(picture)).collect();
    assert!(others.is_empty(), "docs/pictures/make draws others: {others:?}");
}

#[test]
fn the_library_does_what_the_guide_shows() -> Result<(), Box<dyn std::error::Error>> {
    std::env::set_current_dir(here(""))?;
    let read = bvh::read(&std::fs::read("data/kick.bvh")?)?;
    let (clip, _notes) = Cleaning::default().apply(read.clip)?;
    let mut engine = Engine::new(clip)?;
    let result = engine.run(&Recipe::default(), &Edits::default())?;
    #[allow(clippy::print_stdout, reason = "as the guide shows it")]
    {
        println!("{} drawings", result.sheet.layers[0].drawings.len());
    }
    assert!(!result.sheet.layers[0].drawings.is_empty());
    Ok(())
}

#[test]
fn a_line_is_as_shown_where_its_numbers_were_left_out() {
    assert!(is_as_shown("time 0.129 ms", "time … ms"));
    assert!(!is_as_shown("time ms", "time … ms"));
    assert!(!is_as_shown("time 0.129 s", "time … ms"));
    assert!(!is_as_shown("time 0.129 ms more", "time … ms"));
    assert!(!is_as_shown("13 genga", "12 genga"));
}

#[test]
fn a_wrong_output_is_seen() {
    let page = "Before.\n\n```console\n$ genga recipe | head -1\nnot this\n```\n";
    let right = made(page).unwrap();
    assert!(!right.contains("not this"), "{right}");
    assert!(difference("x.md", page, &right).contains("x.md:5\n  shows not this\n"));
    for wrong in
        ["```sh\ngenga run none.bvh\n```\n", "```text\nsaid\n```\n", "```rust\nlet x;\n```\n"]
    {
        assert!(made(wrong).is_err(), "{wrong}");
    }
}
