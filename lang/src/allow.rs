//! Diagnostics go in; those come out that no comment `; caveat: allow(NAME, …)` silences.
//!
//! At the end of a line the comment speaks of that line, on a line of its own of the form that follows,
//! and before the definition of the whole file. Only warnings can be silenced.

use crate::diagnostic::{Diagnostics, RULES, Rule, Severity, unknown_allow};
use crate::near::nearest;
use crate::source::{SourceId, Sources, Span};
use crate::tree::{self, NodeId, NodeKind, Tree};

/// What such a comment starts with, after its semicolons and blanks.
const OPENING: &str = "caveat: allow(";

/// Takes out what is silenced in its own file, and reports comments that name no warning.
pub fn apply(diagnostics: &mut Diagnostics, sources: &Sources) {
    apply_in(diagnostics, sources, sources.ids());
}

/// As [`apply`], for comments in the files `ids` alone.
pub fn apply_in(
    diagnostics: &mut Diagnostics,
    sources: &Sources,
    ids: impl IntoIterator<Item = SourceId>,
) {
    let mut allowed: Vec<(Span, &'static str)> = Vec::new();
    let mut wrong = Diagnostics::default();
    for id in ids {
        let text = &sources.get(id).text;
        if !text.contains(OPENING) {
            continue;
        }
        let tree = tree::parse(id, text, &mut Diagnostics::default());
        for (index, node) in tree.nodes().iter().enumerate() {
            let comment = NodeId(index as u32);
            if node.kind == NodeKind::Comment && names(&tree, comment).next().is_some() {
                let scope = scope(&tree, comment);
                for (name, span) in names(&tree, comment) {
                    match rule(name) {
                        Some(rule) if rule.severity == Severity::Warning => {
                            allowed.push((scope, rule.code));
                        }
                        found => wrong.push(report(name, span, found)),
                    }
                }
            }
        }
    }
    diagnostics.list.retain(|one| {
        let at = one.primary.span;
        !allowed.iter().any(|&(scope, code)| {
            one.severity == Severity::Warning
                && code == one.code
                && scope.source == at.source
                && (scope.start..scope.end).contains(&at.start)
        })
    });
    diagnostics.append(wrong);
}

/// The kind that has this code or this name.
fn rule(name: &str) -> Option<&'static Rule> {
    RULES.iter().find(|rule| rule.code.eq_ignore_ascii_case(name) || rule.name == name)
}

fn report(name: &str, span: Span, rule: Option<&Rule>) -> crate::diagnostic::Diagnostic {
    let warnings = RULES.iter().filter(|rule| rule.severity == Severity::Warning);
    let near = nearest(name, warnings.map(|rule| rule.name));
    unknown_allow::unknown_allow(name, span, rule.is_some(), near)
}

/// The names that a comment allows, each with its place; none if it is another comment.
fn names<'a>(tree: &Tree<'a>, comment: NodeId) -> impl Iterator<Item = (&'a str, Span)> {
    let text = tree.slice(comment);
    let start = tree.span(comment).start;
    let source = tree.source;
    let inner = text.trim_start_matches([';', ' ', '\t']).strip_prefix(OPENING);
    let inner = inner.and_then(|rest| rest.split(')').next()).unwrap_or("");
    inner.split(',').map(str::trim).filter(|name| !name.is_empty()).map(move |name| {
        // Both are parts of one text, so the distance of their starts is a place in it.
        let offset = (name.as_ptr() as usize - text.as_ptr() as usize) as u32;
        (name, Span::new(source, start + offset, start + offset + name.len() as u32))
    })
}

/// The part of the text that a comment speaks of.
fn scope(tree: &Tree<'_>, comment: NodeId) -> Span {
    let (input, at) = (tree.input(), tree.span(comment));
    let line = input[..at.start as usize].rfind('\n').map_or(0, |end| end as u32 + 1);
    let before = &input[line as usize..at.start as usize];
    if !before.trim_start_matches('\u{feff}').trim().is_empty() {
        return Span { start: line, ..at };
    }
    let whole = Span::new(tree.source, 0, input.len() as u32);
    let first = tree.roots().next().map_or(whole.end, |root| tree.span(root).start);
    if at.start < first {
        return whole;
    }
    let follows = tree.nodes()[comment.0 as usize + 1..]
        .iter()
        .find(|node| !matches!(node.kind, NodeKind::Space | NodeKind::Comment));
    // From the comment on, for the annotations between the two.
    follows.map_or(Span { start: at.end, ..whole }, |node| Span::new(tree.source, at.end, node.end))
}

#[cfg(test)]
mod tests {
    use super::apply;
    use crate::source::Sources;

    #[track_caller]
    fn left(text: &str) -> Vec<&'static str> {
        let mut sources = Sources::default();
        let id = sources.add("domain.pddl", text);
        let (_, mut diagnostics) = crate::read_domain(&sources, id);
        apply(&mut diagnostics, &sources);
        diagnostics.list.iter().map(|one| one.code).collect()
    }

    const TWO: [&str; 2] =
        ["(:action a :parameters (?x) :effect (p))", "(:action b :parameters (?y) :effect (p))"];

    #[test]
    fn nothing_is_silenced_without_a_comment() {
        let [a, b] = TWO;
        assert_eq!(
            left(&format!("(define (domain d) (:predicates (p))\n {a}\n {b})")),
            ["W0101", "W0101"]
        );
    }

    #[test]
    fn a_line_a_form_or_the_file() {
        let [a, b] = TWO;
        let head = "(define (domain d) (:predicates (p))";
        let line = format!("{head}\n {a} ; caveat: allow(unused-parameter)\n {b})");
        assert_eq!(left(&line), ["W0101"]);
        let form = format!("{head}\n ;; caveat: allow(W0101)\n ; why\n {a}\n {b})");
        assert_eq!(left(&form), ["W0101"]);
        let file = format!("; caveat: allow(W0401, unused-parameter) both\n{head}\n {a}\n {b})");
        assert_eq!(left(&file), [""; 0]);
    }

    #[test]
    fn an_annotation_is_silenced_from_above() {
        let text = |above: &str| {
            format!("(define (domain d) (:predicates (p))\n {above}\n ;@ (:author)\n)")
        };
        assert_eq!(left(&text("; who")), ["W1001"]);
        assert_eq!(left(&text("; caveat: allow(unknown-annotation)")), [""; 0]);
    }

    #[test]
    fn errors_stay_and_wrong_names_are_said() {
        assert_eq!(
            left("; caveat: allow(unknown-predicate)\n(define (domain d) (:action a :effect (p)))"),
            ["E0101", "W0008"]
        );
        assert_eq!(
            left("; caveat: allow(unused-paramter)\n(define (domain d) (:predicates (p)))"),
            ["W0008"]
        );
    }
}
