//! The action atoms of a domain go in; warnings come out about those that are never true, and about those that say nothing.

use std::rc::Rc;

use super::part::{self, Part};
use super::together::{Obstacle, Proof, Side, Together};
use crate::condition::Condition;
use crate::diagnostic::{Diagnostics, idle_action_atom, impossible_action_atom};
use crate::model::{
    ActionAtom, ActionId, Domain, Formula, NodeKind, Problem, Term, Variable, VariableId,
};
use crate::source::Span;

/// What holds where an action atom matters.
#[derive(Clone, Default)]
struct Context {
    /// Which terms are equal, or are not.
    equal: Rc<Vec<(Term, Term, bool)>>,
    /// What quantifiers say there is.
    some: Rc<Vec<VariableId>>,
    /// Whether the whole condition demands what stands here.
    needed: bool,
    /// Whether nothing but equations stands beside.
    alone: bool,
}

/// An action atom, whether it has to be true, and what holds there.
struct Found<'c> {
    atom: &'c ActionAtom,
    holds: bool,
    context: Context,
}

/// The action atoms of a condition.
fn atoms(condition: &Condition) -> Vec<Found<'_>> {
    let mut found = Vec::new();
    let top = Context { needed: true, alone: true, ..Context::default() };
    walk(condition, top, &mut found);
    found
}

fn walk<'c>(condition: &'c Condition, context: Context, found: &mut Vec<Found<'c>>) {
    match condition {
        Condition::Action(atom, holds) => found.push(Found { atom, holds: *holds, context }),
        Condition::All(parts) | Condition::Any(parts) => {
            let all = matches!(condition, Condition::All(_));
            // One of several matters where all others fail.
            let beside = parts.iter().filter_map(|part| match part {
                Condition::Equal(left, right, holds) => Some((*left, *right, *holds == all)),
                _ => None,
            });
            let mut inner = context;
            let count = inner.equal.len();
            Rc::make_mut(&mut inner.equal).extend(beside);
            inner.needed &= all;
            inner.alone &= all && inner.equal.len() - count + 1 >= parts.len();
            for part in parts {
                walk(part, inner.clone(), found);
            }
        }
        Condition::Exists(variables, body) => {
            let mut inner = Context { alone: true, ..context };
            Rc::make_mut(&mut inner.some).extend(variables);
            walk(body, inner, found);
        }
        Condition::Forall(_, body) => {
            walk(body, Context { needed: false, alone: false, ..context }, found);
        }
        Condition::Atom(..) | Condition::Equal(..) => {}
    }
}

/// What there is to say about the action atoms of each of `parts`, of which there is one for each action.
pub(super) fn check(domain: &Domain, parts: &[Part<'_>], found: &mut Diagnostics) {
    for own in parts.iter().filter(|part| part.action.agent) {
        let action = own.action;
        judge(domain, parts, own, (&own.precondition, &action.precondition), false, found);
        for (change, effect) in own.changes.iter().zip(&action.effects) {
            judge(domain, parts, own, (&change.condition, &effect.condition), true, found);
        }
    }
}

/// Judges the action atoms of one condition; in that of an effect, the own atom counts.
fn judge(
    domain: &Domain,
    parts: &[Part<'_>],
    own: &Part<'_>,
    (condition, formula): (&Condition, &Formula),
    effect: bool,
    found: &mut Diagnostics,
) {
    let nothing = Condition::TRUE;
    for one in atoms(condition) {
        let Some(span) = span(formula, one.atom, own.action.name.span) else { continue };
        let target = &parts[one.atom.action.index()];
        let name = &target.action.name.text;
        let mut pair = Together::new(domain, [own, target], [&nothing; 2], Proof::Certain);
        pair.unify(&one.atom.arguments, &target.parameters().collect::<Vec<_>>());
        let (same, unlike): (Vec<_>, Vec<_>) =
            one.context.equal.iter().partition(|(_, _, holds)| *holds);
        for &(left, right, _) in same {
            pair.equate(left, right);
        }
        let is = |one: Term, other: Term| {
            pair.object(Side::First, one) == pair.object(Side::First, other)
        };
        // What contradicts itself anyway is another matter.
        if unlike.into_iter().any(|&(left, right, _)| is(left, right)) {
            continue;
        }
        let itself = one.atom.action == own.id;
        let agent = &own.action.scope.variables[0].name.text;
        if one.holds && itself && supports_itself(&one, own, &is) {
            found.push(idle_action_atom::own(name, span));
        } else if one.holds && !itself {
            if let Some(obstacle) = pair.settle(&[]) {
                let why = reason(obstacle, [&own.action.name.text, name], agent);
                found.push(impossible_action_atom::impossible_action_atom(name, &why, span));
            }
        } else if !one.holds && pair.one_agent() && !(itself && effect) {
            found.push(idle_action_atom::of_one_agent(name, agent, span));
        }
    }
}

/// Whether the action itself makes an action atom true: each argument is its own, or may be.
fn supports_itself(one: &Found<'_>, own: &Part<'_>, is: &dyn Fn(Term, Term) -> bool) -> bool {
    let pairs: Vec<(Term, Term)> =
        one.atom.arguments.iter().copied().zip(own.parameters()).collect();
    let chosen = |term: Term| match term {
        Term::Variable(id) => one.context.some.contains(&id),
        Term::Object(_) => false,
    };
    let may_be = |&(term, own): &(Term, Term)| is(term, own) || (chosen(term) && one.context.alone);
    // A choice that is compared with something is a choice among others.
    let free = |&(term, own): &(Term, Term)| {
        is(term, own)
            || one.context.equal.iter().all(|&(left, right, _)| left != term && right != term)
    };
    pairs.iter().all(|pair| may_be(pair) && free(pair))
}

/// Why the second of two actions is never taken beside the first.
fn reason(obstacle: Obstacle, [own, other]: [&str; 2], agent: &str) -> String {
    match obstacle {
        Obstacle::Agent => format!("`{agent}` does `{own}` in that step, and one thing at a time"),
        Obstacle::Types => format!("no object fits both `{own}` and `{other}`"),
        Obstacle::Opposite => {
            format!("`{own}` and `{other}` demand the opposite of one another")
        }
        Obstacle::Refused(Side::First) => format!("`{own}` forbids it"),
        Obstacle::Refused(Side::Second) => format!("`{other}` forbids `{own}`"),
    }
}

/// Where an action atom stands, unless it comes of a concurrency constraint and so stands nowhere.
fn span(formula: &Formula, atom: &ActionAtom, action: Span) -> Option<Span> {
    let is = |kind: &NodeKind| matches!(kind, NodeKind::Action(other) if other == atom);
    let node = formula.nodes.iter().find(|node| is(&node.kind))?;
    (node.span != action).then_some(node.span)
}

/// Warns of actions that need another agent beside their own where a problem has only one.
pub(super) fn alone(domain: &Domain, problem: &Problem, found: &mut Diagnostics) {
    for (id, action) in domain.actions.iter().enumerate().filter(|(_, action)| action.agent) {
        let Some(condition) = part::condition(&action.precondition) else { continue };
        let own = Term::Variable(VariableId(0));
        for one in atoms(&condition) {
            let agent = one.atom.arguments[0];
            let apart = one.context.equal.iter().any(|&(left, right, holds)| {
                !holds && ((left, right) == (agent, own) || (left, right) == (own, agent))
            });
            let another = apart || (one.atom.action != ActionId(id as u32) && agent != own);
            let target = &domain.actions[one.atom.action.index()].scope.variables[0];
            let mut wanted = vec![target];
            if let Term::Variable(id) = agent {
                wanted.push(&action.scope.variables[id.index()]);
            }
            let fits = |variables: &[&Variable]| -> Vec<&str> {
                let fit = problem.objects.iter().filter(|object| {
                    variables.iter().all(|variable| domain.has_type(object, &variable.types))
                });
                fit.map(|object| object.name.text.as_str()).collect()
            };
            let (others, owners) = (fits(&wanted), fits(&[&action.scope.variables[0]]));
            let needed = one.holds && one.context.needed && another;
            if needed && owners.len() == 1 && others == owners {
                let Some(span) = span(&action.precondition, one.atom, action.name.span) else {
                    continue;
                };
                found.push(impossible_action_atom::alone(
                    &action.name.text,
                    owners[0],
                    (&problem.name.text, problem.name.span),
                    span,
                ));
                break;
            }
        }
    }
}
