//! Fixes go in with the text that they are for; the mended text comes out.

use crate::diagnostic::{Applicability, Diagnostics};
use crate::source::{SourceId, Sources};

/// The text of `source` after all safe fixes that do not overlap, and how many those are.
///
/// Of fixes that overlap the first in the list of diagnostics wins.
pub fn safely(diagnostics: &Diagnostics, sources: &Sources, source: SourceId) -> (String, usize) {
    let mut taken: Vec<(u32, u32, &str)> = Vec::new();
    let mut count = 0;
    for one in &diagnostics.list {
        let Some(fix) = one.fixes.iter().find(|fix| fix.applicability == Applicability::Safe)
        else {
            continue;
        };
        let free = |start: u32, end: u32| {
            taken.iter().all(|&(from, to, _)| {
                end < from
                    || to < start
                    || (end == from && start < end)
                    || (to == start && from < to)
            })
        };
        if fix.edits.iter().all(|(span, _)| span.source == source && free(span.start, span.end)) {
            taken
                .extend(fix.edits.iter().map(|(span, text)| (span.start, span.end, text.as_str())));
            count += 1;
        }
    }
    taken.sort_unstable();
    let text = &sources.get(source).text;
    let mut out = String::with_capacity(text.len());
    let mut at = 0;
    for (start, end, replacement) in taken {
        out.push_str(&text[at..start as usize]);
        out.push_str(replacement);
        at = end as usize;
    }
    out.push_str(&text[at..]);
    (out, count)
}

#[cfg(test)]
mod tests {
    use super::safely;
    use crate::source::Sources;

    #[test]
    fn what_is_taken_as_meant_is_written() {
        let mut sources = Sources::default();
        let text = "(define (domain d)\n (:requirements :typng)\n (:predicate (p ?x -object) (q))\n (action a :effect (q)))\n";
        let id = sources.add("domain.pddl", text);
        let (_, diagnostics) = crate::read_domain(&sources, id);
        let (mended, count) = safely(&diagnostics, &sources, id);
        assert_eq!(count, 4);
        assert_eq!(
            mended,
            "(define (domain d)\n (:requirements :typing)\n (:predicates (p ?x - object) (q))\n (:action a :effect (q)))\n"
        );
        let id = sources.add("domain.pddl", mended);
        assert_eq!(crate::read_domain(&sources, id).1.list, []);
    }

    #[test]
    fn what_is_a_guess_stays() {
        let mut sources = Sources::default();
        let text = "(define (domain d) (:predicates (lit)) (:action a :effect (lti)))";
        let id = sources.add("domain.pddl", text);
        let (_, diagnostics) = crate::read_domain(&sources, id);
        assert_eq!(diagnostics.list.len(), 1);
        assert_eq!(safely(&diagnostics, &sources, id), (text.to_owned(), 0));
    }
}
