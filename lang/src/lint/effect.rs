//! The effects of an action go in; warnings come out about those that change nothing, stand there twice or are decided beforehand.

use hashbrown::{HashMap, HashSet};

use super::condition::{self, Literal};
use crate::diagnostic::{
    Diagnostics, decided_condition, effect_without_change, overridden_effect, repeated_effect,
};
use crate::model::{self, Action, Atom, Domain, Effect, PredicateId};
use crate::source::Span;

/// What is known to hold where an effect happens, and where it is demanded.
type Known<'m> = HashMap<&'m Atom, (bool, Span)>;

/// What there is to say about the effects.
pub(super) fn check(
    action: &Action,
    guarded: &HashSet<(PredicateId, bool)>,
    found: &mut Diagnostics,
) {
    let demanded: Known<'_> = known(&condition::conjuncts(&action.precondition).0);
    let always = always(action);
    let changed = changed(action);
    for effect in &action.effects {
        repeated(effect, found);
        if !is_always(effect) {
            if decided(effect, &demanded, found) {
                continue;
            }
            overridden(effect, &always, found);
        }
        let inner = condition::conjuncts(&effect.condition).0;
        let inner = known(&inner);
        for literal in &effect.literals {
            let before = demanded.get(&literal.atom).or_else(|| inner.get(&literal.atom));
            // Where something else may have become of it, writing it out keeps it as it is.
            let kept = changed.contains(&(literal.atom.predicate, !literal.positive));
            // Another agent cannot delete in the same step what is added, nor add what is deleted.
            let guards = guarded.contains(&(literal.atom.predicate, !literal.positive));
            if let Some(&(positive, span)) = before
                && positive == literal.positive
                && !kept
                && !guards
            {
                found.push(effect_without_change::effect_without_change(
                    positive,
                    literal.span,
                    span,
                ));
            }
        }
    }
}

/// The predicates that actions of agents add, and those that they delete: what one agent does, it may do beside another.
pub(super) fn guarded(domain: &Domain) -> HashSet<(PredicateId, bool)> {
    domain.actions.iter().filter(|action| action.agent).flat_map(changed).collect()
}

fn known<'m>(literals: &[Literal<'m>]) -> Known<'m> {
    literals.iter().map(|literal| (literal.atom, (literal.positive, literal.span))).collect()
}

/// Whether an effect happens whenever the action does, and once.
fn is_always(effect: &Effect) -> bool {
    effect.condition.is_truth() && effect.variables.is_empty()
}

/// What happens whenever the action does; of what is both added and deleted, what is added.
fn always(action: &Action) -> HashMap<&Atom, &model::Literal> {
    let mut always: HashMap<&Atom, &model::Literal> = HashMap::new();
    for literal in action.effects.iter().filter(|one| is_always(one)).flat_map(|one| &one.literals)
    {
        let one = always.entry(&literal.atom).or_insert(literal);
        if literal.positive {
            *one = literal;
        }
    }
    always
}

/// The predicates that are added, and those that are deleted.
fn changed(action: &Action) -> HashSet<(PredicateId, bool)> {
    let literals = action.effects.iter().flat_map(|effect| &effect.literals);
    literals.map(|literal| (literal.atom.predicate, literal.positive)).collect()
}

/// Warns of literals that a group contains twice.
fn repeated(effect: &Effect, found: &mut Diagnostics) {
    let mut seen: HashMap<(&Atom, bool), Span> = HashMap::new();
    for literal in &effect.literals {
        let first = *seen.entry((&literal.atom, literal.positive)).or_insert(literal.span);
        if first != literal.span {
            found.push(repeated_effect::repeated_effect(literal.span, first));
        }
    }
}

/// Warns of a condition whose value the precondition settles; says whether it does.
fn decided(effect: &Effect, demanded: &Known<'_>, found: &mut Diagnostics) -> bool {
    let (literals, whole) = condition::conjuncts(&effect.condition);
    let settled = |literal: &Literal<'_>| {
        demanded.get(literal.atom).map(|&(positive, span)| (positive == literal.positive, span))
    };
    for literal in &literals {
        if let Some((false, span)) = settled(literal) {
            found.push(decided_condition::never(literal.span, span));
            return true;
        }
    }
    let all = whole && !literals.is_empty();
    let holds: Option<Vec<_>> =
        literals.iter().map(|literal| settled(literal).map(|(_, span)| span)).collect();
    if let Some(spans) = holds.filter(|_| all) {
        let condition = literals.iter().map(|literal| literal.span);
        let span = condition.reduce(Span::to).expect("there is a literal");
        found.push(decided_condition::always(span, spans[0]));
        return true;
    }
    false
}

/// Warns of literals under a condition that happen anyway, or that what happens anyway undoes.
fn overridden(effect: &Effect, always: &HashMap<&Atom, &model::Literal>, found: &mut Diagnostics) {
    for literal in &effect.literals {
        match always.get(&literal.atom) {
            Some(anyway) if anyway.positive == literal.positive => {
                found.push(overridden_effect::anyway(literal.span, anyway.span));
            }
            // What is added is true afterwards, whatever is deleted.
            Some(anyway) if anyway.positive => {
                found.push(overridden_effect::in_vain(literal.span, anyway.span));
            }
            _ => {}
        }
    }
}
