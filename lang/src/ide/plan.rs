//! A plan goes in; what is wrong with it, step by step, and what its names mean come out.

use super::{Analysis, Workspace};
use crate::diagnostic::{Diagnostic, Diagnostics, Label};
use crate::execute::Executor;
use crate::model::{Domain, Problem};
use crate::plan;
use crate::source::{SourceId, Span};
use crate::symbol::{Namespace, Occurrence, Occurrences, Role, Symbol};
use crate::tree::{NodeId, Tree};
use crate::validate::{Verdict, judge};

/// Reads and validates a plan; nothing can be said of one whose problem is not known or has mistakes.
pub(super) fn analyse(workspace: &Workspace, id: SourceId) -> Analysis {
    let Some(problem) = workspace.problem(id) else { return Analysis::default() };
    let domain = workspace.domain(id);
    let occurrences = occurrences(&workspace.tree(id), domain, problem);
    let diagnostics = if sound(workspace, id) && domain.uses.is_empty() && problem.uses.is_empty() {
        diagnostics(workspace, id, domain, problem)
    } else {
        Diagnostics::default()
    };
    Analysis { occurrences, diagnostics, ..Analysis::default() }
}

/// Whether the domain and the problem have no mistakes.
fn sound(workspace: &Workspace, id: SourceId) -> bool {
    let files = [workspace.partner(id), workspace.home(id)];
    files
        .iter()
        .all(|file| file.is_some_and(|file| !workspace.analysis(file).diagnostics.has_errors()))
}

fn diagnostics(
    workspace: &Workspace,
    id: SourceId,
    domain: &Domain,
    problem: &Problem,
) -> Diagnostics {
    let (listing, mut found) = plan::read(workspace.sources(), id, domain, problem);
    if found.has_errors() {
        return found;
    }
    if let Ok(executor) = Executor::new(domain, problem)
        && let Verdict::Invalid(failure) = judge(&executor, &listing.plan)
    {
        let failure = failure.diagnostic(domain, problem, &listing.plan, &listing.spans);
        let end = listing.spans.last().copied().unwrap_or(Span::new(id, 0, 0));
        found.push(in_plan(failure, id, end));
    }
    found
}

/// A failure as it is seen in the plan: at the step that fails or at `end`, with the condition that is false as a related place.
fn in_plan(mut failure: Diagnostic, id: SourceId, end: Span) -> Diagnostic {
    if failure.primary.span.source == id {
        return failure;
    }
    if let Some(step) = failure.secondary.iter().position(|label| label.span.source == id) {
        std::mem::swap(&mut failure.primary, &mut failure.secondary[step]);
    } else {
        let last = Label { span: end, text: "after the last step".to_owned() };
        failure.secondary.insert(0, std::mem::replace(&mut failure.primary, last));
    }
    failure
}

/// The actions and objects that a plan names.
fn occurrences(tree: &Tree<'_>, domain: &Domain, problem: &Problem) -> Occurrences {
    let mut occurrences = Occurrences::default();
    for step in tree.roots().filter(|&root| tree.is_list(root)) {
        let words = tree.children(step).filter(|&child| !tree.is_list(child));
        for (at, word) in words.enumerate() {
            let symbol =
                if at == 0 { action(tree, word, domain) } else { object(tree, word, problem) };
            occurrences.list.push(Occurrence { span: tree.span(word), symbol, role: Role::Read });
        }
    }
    occurrences
}

fn action(tree: &Tree<'_>, word: NodeId, domain: &Domain) -> Symbol {
    let found = domain
        .actions
        .iter()
        .find(|action| action.name.text.eq_ignore_ascii_case(tree.slice(word)));
    found.map_or(Symbol::Unknown(Namespace::Action), |action| {
        Symbol::at(Namespace::Action, action.name.span)
    })
}

fn object(tree: &Tree<'_>, word: NodeId, problem: &Problem) -> Symbol {
    let found = problem
        .objects
        .iter()
        .position(|object| object.name.text.eq_ignore_ascii_case(tree.slice(word)));
    found.map_or(Symbol::Unknown(Namespace::Object), |at| {
        Symbol::Known(Namespace::Object, at as u32)
    })
}

#[cfg(test)]
mod tests {
    use crate::ide::fixture::{DOMAIN, PROBLEM, workspace};
    use crate::source::SourceId;

    /// Each message about a plan, with what is marked.
    #[track_caller]
    fn said(domain: &str, plan: &str) -> Vec<String> {
        let (workspace, ..) = workspace(&[domain, PROBLEM, plan]);
        let found = workspace.analysis(SourceId(3)).diagnostics.list.iter();
        found
            .map(|one| {
                assert_eq!(one.primary.span.source, SourceId(3), "{one:?}");
                format!("{} {}", one.code, workspace.sources().text(one.primary.span))
            })
            .collect()
    }

    #[test]
    fn valid_plans_are_silent() {
        assert_eq!(said(DOMAIN, "; a plan\n(move mug shelf sink)\n(wash mug)\n"), [""; 0]);
    }

    #[test]
    fn the_step_that_fails_is_marked() {
        assert_eq!(said(DOMAIN, "(wash mug)\n"), ["E0720 (wash mug)"]);
        assert_eq!(said(DOMAIN, "(move mug shelf sink)\n"), ["E0721 (move mug shelf sink)"]);
        assert_eq!(said(DOMAIN, ""), ["E0721 "]);
        assert_eq!(said(DOMAIN, "(wash jug)\n").len(), 1);
    }

    #[test]
    fn nothing_is_said_on_files_with_mistakes() {
        assert_eq!(
            said(&DOMAIN.replace("(clean ?d) (inc", "(claen ?d) (inc"), "(wash mug)\n"),
            [""; 0]
        );
    }
}
