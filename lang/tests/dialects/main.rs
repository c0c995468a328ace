//! Every dialect is read without a word where nothing is wrong, and every name in it is resolved.

use std::fmt::Write;

use lang::ast::Feature::{
    self, Axioms, Constraints, DurativeActions, Hierarchies, Metrics, NumericConditions,
    NumericEffects, ObjectFluents, Preferences, Processes, TimedLiterals,
};
use lang::lexer::{self, TokenKind};
use lang::model::{Domain, Problem};
use lang::source::{SourceId, Sources};
use lang::symbol::{Occurrences, Symbol};
use lang::{diagnostic::Diagnostics, lint, print, render};

/// What one domain and its problem give.
struct Read {
    domain: Domain,
    problem: Problem,
    said: String,
    sources: Sources,
    names: [Occurrences; 2],
}

fn read(domain: &str, problem: &str) -> Read {
    let mut sources = Sources::default();
    let ids = [sources.add("domain", domain), sources.add("problem", problem)];
    let (domain, mut diagnostics, first) = lang::index_domain(&sources, ids[0]);
    let (problem, more, second) = lang::index_problem(&sources, ids[1], &domain);
    diagnostics.append(more);
    diagnostics.append(lint::domain(&domain));
    diagnostics.append(lint::problem(&domain, &problem));
    for id in ids {
        diagnostics.append(lint::text(&sources, id, &domain));
    }
    let said = render::concise(&diagnostics, &sources);
    Read { domain, problem, said, sources, names: [first, second] }
}

/// Words of the language, which are no names; some of them are where they stand.
const WORDS: &str = "define domain problem either number and or not imply forall exists when preference \
    at over start end all always sometime within at-most-once sometime-before sometime-after \
    always-within hold-during hold-after increase decrease assign scale-up scale-down undefined \
    minimize maximize total-time is-violated inf #t ?duration = < > <= >= + - * /";

/// The names of a text that mean nothing although they should, or of which nothing is known.
fn lost(read: &Read) -> String {
    let mut out = String::new();
    for (names, id) in read.names.iter().zip(read.sources.ids()) {
        let text = &read.sources.get(id).text;
        for token in lexer::lex(text) {
            let word = &text[token.start as usize..token.end as usize];
            let named = names.list.iter().find(|one| one.span.start == token.start);
            let silent = token.kind != TokenKind::Atom
                || word.starts_with(':')
                || word.parse::<f64>().is_ok()
                || WORDS.split_whitespace().any(|known| known == word);
            match named {
                Some(one) if matches!(one.symbol, Symbol::Known(..)) => {}
                None if silent => {}
                _ => writeln!(out, "{word} at {}", token.start).expect("a string takes all"),
            }
        }
    }
    out
}

/// Reads a pair that is right, and finds nothing to say and nothing lost; prints both and finds the same.
#[track_caller]
fn right(domain: &str, problem: &str) -> Read {
    let read = read(domain, problem);
    assert_eq!(read.said, "");
    assert_eq!(lost(&read), "");
    printed(&read.sources, SourceId(0), |sources, id| {
        print::domain(&lang::parse_domain(sources, id, &mut Diagnostics::default()))
    });
    printed(&read.sources, SourceId(1), |sources, id| {
        print::problem(&lang::parse_problem(sources, id, &mut Diagnostics::default()))
    });
    read
}

/// What is printed prints as itself.
#[track_caller]
fn printed(sources: &Sources, id: SourceId, print: impl Fn(&Sources, SourceId) -> String) {
    let once = print(sources, id);
    let mut again = Sources::default();
    let id = again.add("printed", once.clone());
    assert_eq!(print(&again, id), once);
}

/// What a pair uses beyond what can be run.
fn features(read: &Read) -> Vec<Feature> {
    let uses = read.domain.uses.iter().chain(&read.problem.uses);
    let mut features: Vec<_> = uses.map(|one| one.feature).collect();
    features.sort_unstable();
    features.dedup();
    features
}

#[test]
fn time() {
    let read = right(include_str!("time-domain.pddl"), include_str!("time-problem.pddl"));
    let wanted = [NumericConditions, NumericEffects, DurativeActions, TimedLiterals, Metrics];
    assert_eq!(features(&read), wanted);
    let signatures: Vec<&str> =
        read.domain.signatures.iter().map(|one| one.name.text.as_str()).collect();
    assert_eq!(signatures, ["drive", "refuel", "unload", "wait"]);
}

#[test]
fn numbers_and_objects_as_values() {
    let read = right(include_str!("fluents-domain.pddl"), include_str!("fluents-problem.pddl"));
    assert_eq!(features(&read), [NumericConditions, NumericEffects, ObjectFluents, Metrics]);
    let home = &read.domain.functions[1];
    assert_eq!(home.name.text, "home");
    assert_eq!(home.values.as_ref().map(Vec::len), Some(1));
    assert!(read.domain.functions[0].read.is_some());
}

#[test]
fn preferences_and_constraints() {
    let read =
        right(include_str!("preferences-domain.pddl"), include_str!("preferences-problem.pddl"));
    assert_eq!(features(&read), [Preferences, Constraints, Metrics]);
    let named: Vec<&str> = read.domain.preferences.iter().map(|name| name.text.as_str()).collect();
    assert_eq!(named, ["no-pile", "dry-hands"]);
}

#[test]
fn processes_and_events() {
    let read = right(include_str!("processes-domain.pddl"), include_str!("processes-problem.pddl"));
    assert_eq!(features(&read), [NumericConditions, NumericEffects, Processes]);
}

#[test]
fn agents_of_all_four_forms() {
    let read = right(include_str!("agents-domain.pddl"), include_str!("agents-problem.pddl"));
    assert_eq!(features(&read), []);
    let agents = read.domain.signatures.iter().map(|one| (one.agent, one.parameters.len()));
    let wanted = [(true, 2), (true, 2), (true, 2), (true, 2), (false, 1)];
    assert_eq!(agents.collect::<Vec<_>>(), wanted);
}

#[test]
fn private_parts_and_concurrency_constraints() {
    let read = right(include_str!("private-domain.pddl"), include_str!("private-problem.pddl"));
    assert_eq!(features(&read), []);
    let holds = read.domain.predicates[1].owner.as_ref().expect("it is private");
    assert_eq!(holds.position, Some(0));
    let objects: Vec<&str> =
        read.problem.objects.iter().map(|object| object.name.text.as_str()).collect();
    assert_eq!(objects, ["table1", "hall", "left", "cup1", "right", "cup2"]);
}

#[test]
fn the_share_of_one_agent() {
    let read = right(include_str!("factored-domain.pddl"), include_str!("factored-problem.pddl"));
    assert_eq!(features(&read), []);
    assert_eq!(read.problem.objects.len(), 3);
}

#[test]
fn task_networks() {
    let read = right(include_str!("tasks-domain.hddl"), include_str!("tasks-problem.hddl"));
    assert_eq!(features(&read), [Hierarchies]);
}

#[test]
fn the_first_pddl() {
    let read = right(include_str!("first-domain.pddl"), include_str!("first-problem.pddl"));
    assert_eq!(features(&read), [Axioms]);
}
