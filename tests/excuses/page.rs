//! `docs/excuses.md` goes in; each command of it runs, and must print what the page shows.

use std::path::Path;

use super::{Desk, untimed};
use crate::unsolvable::read;

/// The commands of the page's `console` blocks, each with its line and what is shown below it.
fn session(page: &str) -> Vec<(usize, String, String)> {
    let mut session: Vec<(usize, String, String)> = Vec::new();
    let mut inside = false;
    for (number, line) in page.lines().enumerate() {
        if line.starts_with("```") {
            inside = line == "```console";
        } else if let Some(command) = line.strip_prefix("$ ").filter(|_| inside) {
            session.push((number + 1, command.to_owned(), String::new()));
        } else if let Some((_, _, shown)) = session.last_mut().filter(|_| inside) {
            shown.push_str(line);
            shown.push('\n');
        }
    }
    session
}

#[test]
fn the_page_shows_what_is_printed() {
    let page = read(&Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs/excuses.md"));
    let session = session(&page);
    assert!(session.len() >= 6, "the page shows {} commands: has its form changed?", session.len());
    let desk = Desk::with(&[]);
    let mut wrong = Vec::new();
    for (line, command, shown) in session {
        let printed = if let Some(file) = command.strip_prefix("cat ") {
            desk.file(file)
        } else {
            let run = desk.run(&command);
            run.data + &run.talk
        };
        if untimed(&printed) != untimed(&shown) {
            wrong.push(format!("line {line}: `{command}` prints\n{printed}"));
        }
    }
    assert_eq!(wrong.join("\n"), "");
}
