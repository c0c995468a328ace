//! The `:requirements` of a domain and its words go in; warnings come out about flags that nothing needs, or that stand there twice.
//!
//! Only flags that no problem can need are judged: a goal alone may need `:negative-preconditions`, and so `:adl`.

use hashbrown::HashMap;

use super::text::{Text, Words};
use crate::diagnostic::{Diagnostics, repeated_requirement, unused_requirement};
use crate::source::Span;

/// Each flag with the words of which one stands in every domain that needs it.
const NEEDS: [(&str, &[&str]); 14] = [
    (":conditional-effects", &["when", "forall"]),
    (":derived-predicates", &[":derived", ":axiom"]),
    (":domain-axioms", &[":derived", ":axiom"]),
    (":action-costs", COUNTING),
    (":numeric-fluents", COUNTING),
    (":fluents", COUNTING),
    (":numeric-preconditions", COUNTING),
    (":object-fluents", COUNTING),
    (":durative-actions", &[":durative-action"]),
    (":continuous-effects", &["#t"]),
    (":processes", &[":process", ":event"]),
    (":process", &[":process"]),
    (":events", &[":event", ":process"]),
    (":event", &[":event"]),
];

const COUNTING: &[&str] = &[":functions"];

/// What there is to say about the flags.
pub(super) fn check(text: &Text<'_, '_>, words: &Words, found: &mut Diagnostics) {
    let mut seen: HashMap<String, Span> = HashMap::new();
    let mut unused: Vec<(&str, Span)> = Vec::new();
    for section in text.all(":requirements") {
        for flag in text.tree.children(section.list).skip(1) {
            let (name, span) = (text.tree.slice(flag), text.tree.span(flag));
            if let Some(&first) = seen.get(&name.to_ascii_lowercase()) {
                found.push(repeated_requirement::repeated_requirement(name, span, first));
                continue;
            }
            seen.insert(name.to_ascii_lowercase(), span);
            if !needed(name, words) {
                unused.push((name, span));
            }
        }
    }
    // Facts at a point in time stand in problems, and the definition of PDDL 2.2 lets them need durative actions.
    if seen.contains_key(":timed-initial-literals") {
        unused.retain(|(name, _)| !name.eq_ignore_ascii_case(":durative-actions"));
    }
    if !unused.is_empty() {
        found.push(unused_requirement::unused_requirement(&unused));
    }
}

/// Whether something in the domain may need the flag.
fn needed(flag: &str, words: &Words) -> bool {
    if flag.eq_ignore_ascii_case(":typing") {
        return words.counts(":types") > 0 || words.any(|word| word == "-");
    }
    match NEEDS.iter().find(|(name, _)| name.eq_ignore_ascii_case(flag)) {
        Some((_, needing)) => words.any(|word| needing.contains(&word)),
        None => true,
    }
}
