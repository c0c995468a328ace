//! Domains and traces from text.

use lang::model::Domain;
use lang::source::Sources;
use learner::rule::{Action, Learned};
use learner::trace::{self, Reading, Trace};

#[track_caller]
pub fn domain(text: &str) -> Domain {
    let mut sources = Sources::default();
    let id = sources.add("domain.pddl", text);
    let (domain, diagnostics) = lang::read_domain(&sources, id);
    assert!(!diagnostics.has_errors(), "{text}\n{}", lang::render::concise(&diagnostics, &sources));
    domain
}

#[track_caller]
pub fn trace(name: &str, domain: &Domain, text: &str) -> Trace {
    let (trace, faults) = trace::read(text, domain, &Reading { name, ..Reading::default() });
    assert_eq!(faults, []);
    trace
}

/// The learned action of this name.
#[track_caller]
pub fn action<'l>(learned: &'l Learned, name: &str) -> &'l Action {
    let is = |one: &&Action| learned.domain.actions[one.action.index()].name.text == name;
    learned.actions.iter().find(is).unwrap_or_else(|| panic!("{name} is not learned"))
}

/// What `caveat check` would say of a domain.
pub fn warnings(text: &str) -> Vec<String> {
    let mut sources = Sources::default();
    let id = sources.add("learned.pddl", text);
    let (domain, mut found) = lang::read_domain(&sources, id);
    found.append(lang::lint::domain(&domain));
    found.append(lang::lint::text(&sources, id, &domain));
    lang::allow::apply(&mut found, &sources);
    let lines = lang::render::concise(&found, &sources);
    lines.lines().map(str::to_owned).collect()
}
