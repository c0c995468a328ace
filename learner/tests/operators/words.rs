//! What every test here does with a record: find its deeds, learn from it, and read what was written.

use lang::lint;
use lang::model::Domain;
use lang::source::Sources;
use learner::observe::Vocabulary;
use learner::operators::deed::{self, Deeds};
use learner::operators::record::Record;
use learner::operators::words::Words;
use learner::operators::{Options, Taught, learn};
use learner::write;

use super::script;

/// The deeds of a script, in which everything can be taken but drawers.
pub fn deeds(text: &str) -> (Record, Deeds) {
    let record = script::record("shown", text);
    let found =
        deed::deeds(&record, |_, object| record.header.objects[object.index()].kind != "drawer");
    (record, found)
}

/// The deeds of a script as lines.
pub fn told(text: &str) -> Vec<String> {
    let (record, found) = deeds(text);
    script::lines(&record, &found)
}

/// Options with a title.
pub fn options() -> Options {
    Options { title: "learned".to_owned(), ..Options::default() }
}

/// What scripts teach, in words of their own.
pub fn taught(texts: &[&str], options: &Options) -> Taught {
    learn(&records(texts), None, options)
}

/// The records of scripts, each hand acting for itself.
pub fn records(texts: &[&str]) -> Vec<(Record, Words)> {
    let names = ["monday", "tuesday", "wednesday"];
    let record = |(name, text): (&&str, &&str)| {
        let record = script::record(name, text);
        let words = Words::of(&record.header, Vocabulary::default());
        (record, words)
    };
    names.iter().zip(texts).map(record).collect()
}

/// What was learned as a domain, which must be one without a warning and evenly laid out.
#[track_caller]
pub fn text(taught: &Taught) -> String {
    let text = write::text(&taught.learned);
    assert_eq!(warnings(&text), [""; 0], "{text}");
    assert_eq!(lang::format::format(&text).as_deref(), Some(text.as_str()));
    text
}

/// A domain that is read from text, without errors.
#[track_caller]
pub fn domain(text: &str) -> Domain {
    let mut sources = Sources::default();
    let id = sources.add("domain.pddl", text);
    let (domain, found) = lang::read_domain(&sources, id);
    assert!(!found.has_errors(), "{}", lang::render::concise(&found, &sources));
    domain
}

/// Everything that the program says of a domain, a line each.
pub fn warnings(text: &str) -> Vec<String> {
    let mut sources = Sources::default();
    let id = sources.add("domain.pddl", text);
    let (domain, mut found) = lang::read_domain(&sources, id);
    found.append(lint::domain(&domain));
    found.append(lint::text(&sources, id, &domain));
    lang::allow::apply(&mut found, &sources);
    lang::render::concise(&found, &sources).lines().map(str::to_owned).collect()
}

/// The names of what was learned, each with how often it was seen.
pub fn names(taught: &Taught) -> Vec<String> {
    let name = |action: &learner::rule::Action| {
        let name = &taught.learned.domain.actions[action.action.index()].name.text;
        format!("{name} {}", action.count)
    };
    taught.learned.actions.iter().map(name).collect()
}
