//! Parses a page of Markdown: prose, fenced blocks, and the commands in them.

use std::fs;

use crate::clips::here;

/// The text of a page.
pub(super) fn page(name: &str) -> String {
    fs::read_to_string(here(name)).unwrap()
}

/// A fenced block of a page.
pub(super) struct Block<'a> {
    pub(super) language: &'a str,
    /// File name in the comment above the block, if any.
    pub(super) file: Option<&'a str>,
    pub(super) lines: Vec<&'a str>,
}

/// Prose and fenced blocks of a page, in order.
pub(super) enum Piece<'a> {
    Prose(&'a str),
    Block(Block<'a>),
}

pub(super) fn pieces(page: &str) -> Vec<Piece<'_>> {
    let mut pieces = Vec::new();
    let mut lines = page.lines();
    let mut before = "";
    while let Some(line) = lines.next() {
        if let Some(language) = line.strip_prefix("```") {
            let file =
                before.strip_prefix("<!-- file: ").and_then(|name| name.strip_suffix(" -->"));
            let lines = lines.by_ref().take_while(|line| *line != "```").collect();
            pieces.push(Piece::Block(Block { language, file, lines }));
        } else {
            pieces.push(Piece::Prose(line));
        }
        before = line;
    }
    pieces
}

pub(super) fn blocks(page: &str) -> Vec<Block<'_>> {
    let block = |piece| match piece {
        Piece::Block(block) => Some(block),
        Piece::Prose(_) => None,
    };
    pieces(page).into_iter().filter_map(block).collect()
}

/// The commands of a page in order, without trailing comments.
pub(super) fn commands(page: &str) -> Vec<String> {
    let of = |block: Block| -> Vec<String> {
        let lines = block.lines.into_iter();
        match block.language {
            "console" => lines.filter_map(|line| line.strip_prefix("$ ")).map(bare).collect(),
            "sh" => lines.map(bare).collect(),
            _ => Vec::new(),
        }
    };
    blocks(page).into_iter().flat_map(of).collect()
}

pub(super) fn bare(command: &str) -> String {
    command.split(" # ").next().unwrap_or_default().trim_end().to_owned()
}
