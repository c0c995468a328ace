//! A domain and what was learned in its words go in; the text of the domain with what is new comes out, and what became of each operator is said.

use lang::diagnostic::{Diagnostics, Severity};
use lang::model::Domain;
use learner::extend::{self, Extension};
use learner::rule::Learned;

use super::times;
use crate::args::OutputFormat;
use crate::input::{self, Reader};
use crate::terminal::Terminal;

/// Merges, and says what came of it.
pub fn merged(
    source: &str,
    known: &Domain,
    learned: &Learned,
    terminal: &mut Terminal,
) -> Extension {
    let extension = extend::extend(source, known, learned);
    for (name, count) in &extension.known {
        terminal.say(format_args!("`{name}` was known, and {}.", times(*count)));
    }
    for (name, dropped) in &extension.refined {
        let dropped = dropped.join(", ");
        terminal.say(format_args!("`{name}` was refined: it was done without {dropped}."));
    }
    for conflict in &extension.conflicts {
        terminal.say(format_args!("note: {conflict}."));
    }
    match extension.added.as_slice() {
        [] => terminal.say("Nothing new was added."),
        names => terminal.say(format_args!("Added: {}.", names.join(", "))),
    }
    extension
}

/// Says what is wrong with a file that was to be used.
pub fn refuse(reader: &Reader, mut found: Diagnostics, terminal: &mut Terminal) {
    reader.settle(&mut found);
    found.list.retain(|diagnostic| diagnostic.severity == Severity::Error);
    let text = input::rendered(&reader.sources, &found, OutputFormat::Full, terminal.colour);
    terminal.talk(text);
}
