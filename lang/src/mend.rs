//! Fixes go in with the text that they are for; the mended text comes out.

use crate::diagnostic::{Applicability, Diagnostics, Fix};
use crate::source::{SourceId, Sources, Span};

/// The text of `source` after all safe fixes that do not overlap, and how many those are.
///
/// Fixes are taken in the order of the text; one that begins before the last one ends is left for another round.
pub fn safely(diagnostics: &Diagnostics, sources: &Sources, source: SourceId) -> (String, usize) {
    let safe = |one: &'_ &Fix| one.applicability == Applicability::Safe;
    let fixes = diagnostics.list.iter().filter_map(|one| one.fixes.iter().find(safe));
    let mut fixes: Vec<Vec<&(Span, String)>> = fixes
        .filter(|fix| fix.edits.iter().all(|(span, _)| span.source == source))
        .map(|fix| {
            let mut edits: Vec<_> = fix.edits.iter().collect();
            edits.sort_by_key(|(span, _)| *span);
            edits
        })
        .collect();
    fixes.sort_by_key(|edits| edits.first().map(|(span, _)| *span));
    let text = &sources.get(source).text;
    let mut out = String::with_capacity(text.len());
    let (mut at, mut count) = (0, 0);
    let mut last: Option<Span> = None;
    for edits in fixes {
        let Some((first, _)) = edits.first() else { continue };
        if last.is_some_and(|last| first.start < last.end || *first == last) {
            continue;
        }
        for (span, replacement) in edits {
            out.push_str(&text[at..span.start as usize]);
            out.push_str(replacement);
            at = span.end as usize;
            last = Some(*span);
        }
        count += 1;
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
