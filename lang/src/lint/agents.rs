//! A domain in which agents act goes in; warnings come out about joint actions that are surely not meant,
//! and about action atoms that are never true, say nothing or may mean something else.

mod part;
mod invariant;
mod together;
mod clash;
mod atom;

use hashbrown::{HashMap, HashSet};
use invariant::Trust;
use part::Part;

use crate::diagnostic::{Diagnostics, ambiguous_action};
use crate::execute::joint::Concurrency;
use crate::model::{ActionId, Domain, NodeKind, Predicate, Problem};

/// What there is to say about the agents of a domain and what they do together.
pub(super) fn check(domain: &Domain, found: &mut Diagnostics) {
    if !domain.is_multi_agent() {
        return;
    }
    names(domain, found);
    let parts: Option<Vec<Part<'_>>> = domain
        .actions
        .iter()
        .enumerate()
        .map(|(id, action)| Part::new(ActionId(id as u32), action))
        .collect();
    let Some(parts) = parts else { return };
    atom::check(domain, &parts, found);
    // Where parts must not interfere, nobody expects the ones that do to be taken together.
    if Concurrency::of(domain) == Concurrency::Liberal {
        let mut invariants = invariant::find(domain, &parts, Trust::Demanded);
        invariants.extend(invariant::find(domain, &parts, Trust::Deleted));
        let agents: Vec<&Part<'_>> = parts.iter().filter(|part| part.action.agent).collect();
        clash::check(domain, &agents, &invariants, found);
    }
}

/// What there is to say about the agents of a problem.
pub(super) fn problem(domain: &Domain, problem: &Problem, found: &mut Diagnostics) {
    atom::alone(domain, problem, found);
}

/// Warns of actions that have the name of a predicate, so that a condition may mean either:
/// where both have as many arguments, or where some condition means the action.
fn names(domain: &Domain, found: &mut Diagnostics) {
    let lower = |name: &str| name.to_ascii_lowercase();
    let predicates: HashMap<String, &Predicate> =
        domain.predicates.iter().map(|one| (lower(&one.name.text), one)).collect();
    let named: HashSet<ActionId> = domain
        .actions
        .iter()
        .flat_map(|action| {
            let effects = action.effects.iter().map(|effect| &effect.condition);
            effects.chain([&action.precondition])
        })
        .flat_map(|formula| &formula.nodes)
        .filter_map(|node| match &node.kind {
            NodeKind::Action(atom) => Some(atom.action),
            _ => None,
        })
        .collect();
    for signature in &domain.signatures {
        if let Some(predicate) = predicates.get(&lower(&signature.name.text)) {
            let arities = [signature.parameters.len(), predicate.parameters.len()];
            let asked = signature.action.is_some_and(|action| named.contains(&action));
            if arities[0] != arities[1] && !asked {
                continue;
            }
            let spans = [signature.name.span, predicate.name.span];
            found.push(ambiguous_action::ambiguous_action(&signature.name.text, arities, spans));
        }
    }
}

#[cfg(test)]
mod tests {
    use std::time::{Duration, Instant};

    use crate::source::Sources;

    /// How long the lints may take in a build without optimisation.
    const LONGEST: Duration = Duration::from_secs(20);

    fn lint(precondition: &str) {
        let mut sources = Sources::default();
        let text = format!(
            "(define (domain d) (:requirements :adl :multi-agent) (:types arm)
  (:predicates (free ?a - arm ?b - arm) (has ?a - arm ?b - arm))
  (:action take :agent ?a - arm :parameters (?b - arm)
    :precondition (and (free ?a ?b) {precondition})
    :effect (and (not (free ?a ?b)) (has ?a ?b))))"
        );
        let id = sources.add("domain.pddl", text);
        let (domain, found) = crate::read_domain(&sources, id);
        assert!(!found.has_errors(), "{}", crate::render::concise(&found, &sources));
        let start = Instant::now();
        crate::lint::domain(&domain);
        assert!(start.elapsed() < LONGEST, "it took {:?}", start.elapsed());
    }

    #[test]
    fn deep_and_wide_conditions_take_no_long_time() {
        for (open, close) in [
            ("(forall (?x - arm) (or (free ?a ?x) ", "))"),
            ("(forall (?x - arm) (and (free ?x ?a) ", "))"),
            ("(forall (?x - arm) ", ")"),
            ("(exists (?x - arm) (and (not (= ?x ?a)) ", "))"),
        ] {
            let atom = "(not (take ?x ?b))";
            for depth in [90, 3000] {
                lint(&format!("{}{atom}{}", open.repeat(depth), close.repeat(depth)));
            }
        }
        let wide =
            "(free ?a ?a) (not (free ?b ?a)) (not (= ?a ?b)) (not (take ?b ?a)) ".repeat(3000);
        lint(&wide);
        lint(&format!(
            "(forall (?x - arm) (or {}))",
            "(take ?x ?b) (not (take ?x ?a)) ".repeat(3000)
        ));
    }
}
