//! A run of `;@` comments goes in; its lines come out, laid out like code where its parentheses match.

use crate::annotation::{OPENING, Run, content};
use crate::tree::Tree;

/// Narrower than this no annotation is laid out, however deep it stands.
const NARROW: usize = 24;

/// The lines of a run, each with its `;@`; as they are where it is not clear what they say.
pub(super) fn lines(tree: &Tree<'_>, run: &Run, width: usize) -> Vec<String> {
    let content = content(tree, run);
    let clear = content.fault.is_none() && content.loose.is_none();
    let inner: Vec<&str> =
        run.lines.iter().map(|&line| &tree.slice(line)[OPENING.len()..]).collect();
    let width = width.saturating_sub(OPENING.len() + 1).max(NARROW);
    let laid = clear.then(|| laid(&inner, width)).flatten();
    laid.unwrap_or_else(|| {
        let as_it_is = |line: &&str| format!("{OPENING}{}", line.trim_end());
        inner.iter().map(as_it_is).collect()
    })
}

/// Lays out what stands in a run.
fn laid(inner: &[&str], width: usize) -> Option<Vec<String>> {
    let mut text = String::new();
    for line in inner {
        mask(line, &mut text)?;
        text.push('\n');
    }
    let laid = super::lay_out(&text, width, false)?;
    let line = |line: &str| format!("{OPENING} {}", unmask(line)).trim_end().to_owned();
    // What says nothing is kept as one line.
    let laid = if laid.is_empty() { "\n" } else { &laid };
    Some(laid.lines().map(line).collect())
}

/// The characters that would end a word of code, and those that stand for them in texts.
const MASKS: [(char, char); 6] = [
    (' ', '\u{e000}'),
    ('\t', '\u{e001}'),
    ('(', '\u{e002}'),
    (')', '\u{e003}'),
    (';', '\u{e004}'),
    ('?', '\u{e005}'),
];

/// Appends a line in which each text between quotes is one word of code; nothing if it contains what cannot be made so.
fn mask(line: &str, out: &mut String) -> Option<()> {
    let (mut within, mut remark) = (false, false);
    for letter in line.chars() {
        if MASKS.iter().any(|&(_, mask)| mask == letter) {
            return None;
        }
        match letter {
            '"' => within ^= !remark,
            ';' => remark |= !within,
            _ => {}
        }
        let mask = MASKS.iter().find(|&&(masked, _)| within && masked == letter);
        if within && mask.is_none() && (letter.is_whitespace() || letter == '\u{feff}') {
            return None;
        }
        out.push(mask.map_or(letter, |&(_, mask)| mask));
    }
    Some(())
}

fn unmask(line: &str) -> String {
    let letter = |letter| MASKS.iter().find(|&&(_, mask)| mask == letter);
    line.chars().map(|one| letter(one).map_or(one, |&(masked, _)| masked)).collect()
}
