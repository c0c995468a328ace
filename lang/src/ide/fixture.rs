//! Texts with a cursor go in; a workspace and the place of the cursor come out.

use super::Workspace;
use crate::reader::Kind;
use crate::source::SourceId;

/// What stands for the cursor.
const CURSOR: &str = "$0";

/// Texts, of which one may have the cursor. A problem belongs to the first text that is a domain, a plan to the first problem.
#[track_caller]
pub(super) fn workspace(texts: &[&str]) -> (Workspace, SourceId, u32) {
    let mut workspace = Workspace::default();
    let mut cursor = None;
    let (mut domain, mut problem) = (None, None);
    for (at, text) in texts.iter().enumerate() {
        let plan = problem.is_some() && !text.contains("(define");
        let id = workspace.add(format!("{at}.pddl"), text.replacen(CURSOR, "", 1), plan);
        if let Some(offset) = text.find(CURSOR) {
            cursor = Some((id, offset as u32));
        }
        match workspace.kind(id) {
            Some(Kind::Domain { .. }) => domain = domain.or(Some(id)),
            Some(Kind::Problem { .. }) => {
                problem = problem.or(Some(id));
                workspace.pair(id, domain);
            }
            None if plan => workspace.pair(id, problem),
            None => {}
        }
    }
    let (id, offset) = cursor.unwrap_or((SourceId(1), 0));
    (workspace, id, offset)
}

/// Each text after edits.
pub(super) fn edited(
    workspace: &Workspace,
    edits: &[(crate::source::Span, String)],
) -> Vec<String> {
    let mut sorted = edits.to_vec();
    sorted.sort_by_key(|(span, _)| *span);
    let ids = workspace.sources().ids().skip(1);
    ids.map(|id| {
        let mut text = workspace.text(id).to_owned();
        for (span, new) in sorted.iter().rev().filter(|(span, _)| span.source == id) {
            text.replace_range(span.start as usize..span.end as usize, new);
        }
        text
    })
    .collect()
}

/// A domain with something of everything, and a problem of it.
pub(super) const DOMAIN: &str = "(define (domain kitchen)
  (:requirements :typing :action-costs)
  (:types cup plate - dish place)
  (:constants sink - place)
  (:predicates
    (at ?d - dish ?p - place) ; where a dish stands
    ; nothing sticks to it
    (clean ?d - dish))
  (:functions (total-cost) - number (effort ?d - dish) - number)
  ; Water does it.
  (:action wash
    :parameters (?d - dish)
    :precondition (at ?d sink)
    :effect (and (clean ?d) (increase (total-cost) (effort ?d))))
  (:action move
    :parameters (?d - dish ?from ?to - place)
    :precondition (at ?d ?from)
    :effect (and (not (at ?d ?from)) (at ?d ?to))))
";

pub(super) const PROBLEM: &str = "(define (problem breakfast)
  (:domain kitchen)
  (:objects mug - cup shelf - place)
  (:init (at mug shelf) (= (effort mug) 2))
  (:goal (clean mug)))
";
