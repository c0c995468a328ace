//! The actions of agents go in; warnings come out about pairs of which one undoes what the other does,
//! and about pairs that both use up one fact and each make something else of it.

use super::invariant::{About, Invariant, Trust};
use super::part::{Change, Part};
use super::together::{Proof, Side, Together};
use crate::check::describe_parameters;
use crate::condition::Condition;
use crate::diagnostic::{Diagnostics, conflicting_effects, shared_fact};
use crate::lint::condition::Place;
use crate::model::{Atom, Domain, Literal, Term, Variable};

/// How many pairs of effects are looked at.
const PAIRS: usize = 5_000;

/// What there is to say about each pair of `parts`.
pub(super) fn check(
    domain: &Domain,
    parts: &[&Part<'_>],
    invariants: &[Invariant],
    found: &mut Diagnostics,
) {
    let mut left = PAIRS;
    let mut fixed = vec![true; domain.predicates.len()];
    for literal in
        domain.actions.iter().flat_map(|action| &action.effects).flat_map(|one| &one.literals)
    {
        fixed[literal.atom.predicate.index()] = false;
    }
    for (at, &first) in parts.iter().enumerate() {
        for &second in &parts[at..] {
            let pair = Pair { domain, parts: [first, second], invariants, fixed: &fixed };
            if let Some(diagnostic) = pair.taken_twice(&mut left) {
                found.push(diagnostic);
            }
            if let Some(diagnostic) = pair.conflicting(&mut left) {
                found.push(diagnostic);
            }
        }
    }
}

/// Two actions, or one that two agents take.
struct Pair<'p, 'm> {
    domain: &'m Domain,
    parts: [&'p Part<'m>; 2],
    invariants: &'p [Invariant],
    /// The predicates that no action changes.
    fixed: &'p [bool],
}

impl<'p, 'm> Pair<'p, 'm> {
    fn is_one(&self) -> bool {
        self.parts[0].id == self.parts[1].id
    }

    /// The two in one step when two literals are about one fact, if that can be.
    fn meet(
        &self,
        parts: [&'p Part<'m>; 2],
        changes: [&'p Change<'m>; 2],
        literals: [&Literal; 2],
        left: &mut usize,
    ) -> Option<Together<'p, 'm>> {
        if literals[0].atom.predicate != literals[1].atom.predicate {
            return None;
        }
        *left = left.checked_sub(1)?;
        let beside = changes.map(|change| &change.condition);
        let mut together = Together::new(self.domain, parts, beside, Proof::Likely);
        together.unify(&literals[0].atom.arguments, &literals[1].atom.arguments);
        together.settle(self.invariants).is_none().then_some(together)
    }

    /// A fact that one always adds and the other always deletes.
    fn conflicting(&self, left: &mut usize) -> Option<crate::diagnostic::Diagnostic> {
        let [first, second] = self.parts;
        let orders = [[first, second], [second, first]];
        for parts in &orders[..if self.is_one() { 1 } else { 2 }] {
            for adding in parts[0].changes.iter().filter(|change| change.is_always()) {
                for deleting in parts[1].changes.iter().filter(|change| change.is_always()) {
                    for [add, delete] in literals([adding, deleting], [true, false]) {
                        // What is demanded and added all the same is kept from others on purpose.
                        let kept = parts[0].demands(adding, &add.atom)
                            || !parts[1].demands(deleting, &delete.atom)
                            || parts[1]
                                .along(deleting)
                                .any(|literal| literal.positive && literal.atom == delete.atom);
                        if kept {
                            continue;
                        }
                        let changes = [adding, deleting];
                        let together = self.meet(*parts, changes, [add, delete], left);
                        // What holds already is not added by a step that is meant.
                        let new = |together: &Together<'_, '_>| {
                            !together.holds(Side::First, (Side::First, &add.atom))
                        };
                        if let Some(together) = together.filter(new) {
                            let names = parts.map(|part| part.action.name.text.as_str());
                            return Some(conflicting_effects::conflicting_effects(
                                names,
                                &self.text(parts[0], &add.atom),
                                [add.span, delete.span],
                                &forbid(self.domain, &together),
                            ));
                        }
                    }
                }
            }
        }
        None
    }

    /// A fact that both demand and delete, and of which each makes something else.
    fn taken_twice(&self, left: &mut usize) -> Option<crate::diagnostic::Diagnostic> {
        let [first, second] = self.parts;
        for one in &first.changes {
            for other in &second.changes {
                for literals in literals([one, other], [false, false]) {
                    let [taken, again] = literals;
                    let consumed =
                        first.demands(one, &taken.atom) && second.demands(other, &again.atom);
                    if !consumed {
                        continue;
                    }
                    let changes = [one, other];
                    let Some(together) = self.meet(self.parts, changes, literals, left) else {
                        continue;
                    };
                    let tied = |&term: &Term| {
                        together.is_tied(together.object(Side::First, term), self.fixed)
                    };
                    if undo(&together, changes) || taken.atom.arguments.iter().any(tied) {
                        continue;
                    }
                    if let Some(made) = self.made(&together, changes, taken) {
                        return Some(shared_fact::shared_fact(
                            self.parts.map(|part| part.action.name.text.as_str()),
                            &self.text(first, &taken.atom),
                            [taken.span, again.span],
                            [
                                (&self.text(first, &made[0].atom), made[0].span),
                                (&self.text(second, &made[1].atom), made[1].span),
                            ],
                            &forbid(self.domain, &together),
                        ));
                    }
                }
            }
        }
        None
    }

    /// Two different facts that come of `taken`: no action alone makes both of it.
    fn made(
        &self,
        together: &Together<'_, 'm>,
        changes: [&Change<'m>; 2],
        taken: &Literal,
    ) -> Option<[&'m Literal; 2]> {
        let object = |side, about: About| about.object().map(|term| together.object(side, term));
        let sure = self.invariants.iter().filter(|one| one.trust == Trust::Demanded);
        sure.into_iter().find_map(|invariant| {
            let about = object(Side::First, invariant.about(&taken.atom)?);
            // Of the whole state there is much that two may take at once; what stands alone they share.
            if about.is_none() && !taken.atom.arguments.is_empty() {
                return None;
            }
            let made = |side: Side| {
                let change = changes[side as usize];
                let part = self.parts[side as usize];
                part.along(change).find(|literal| {
                    literal.positive
                        && !together.holds(side, (side, &literal.atom))
                        && invariant.about(&literal.atom).map(|about| object(side, about))
                            == Some(about)
                })
            };
            let (one, other) = (made(Side::First)?, made(Side::Second)?);
            let same = together.same_fact((Side::First, &one.atom), (Side::Second, &other.atom));
            (!same).then_some([one, other])
        })
    }

    /// An atom as the text has it.
    fn text(&self, part: &Part<'_>, atom: &Atom) -> String {
        let scope = &part.action.scope;
        let place = Place { domain: self.domain, objects: &self.domain.constants, scope };
        let mut text = format!("({}", self.domain.predicates[atom.predicate.index()].name.text);
        for &term in &atom.arguments {
            text.push(' ');
            text.push_str(place.describe(term));
        }
        text + ")"
    }
}

/// Whether one adds what the other deletes.
fn undo<'m>(together: &Together<'_, 'm>, changes: [&Change<'m>; 2]) -> bool {
    let sides = [(Side::First, Side::Second), (Side::Second, Side::First)];
    sides.into_iter().any(|(adds, deletes)| {
        let of = |side: Side| together.part(side).along(changes[side as usize]);
        of(adds).filter(|literal| literal.positive).any(|add| {
            of(deletes).any(|delete| {
                !delete.positive && together.same_fact((adds, &add.atom), (deletes, &delete.atom))
            })
        })
    })
}

/// The pairs of literals of two changes that are added, or else deleted.
fn literals<'m>(
    changes: [&Change<'m>; 2],
    positive: [bool; 2],
) -> impl Iterator<Item = [&'m Literal; 2]> {
    let [first, second] = changes.map(|change| change.literals);
    let of = |literals: &'m [Literal], positive| {
        literals.iter().filter(move |literal| literal.positive == positive)
    };
    of(first, positive[0])
        .flat_map(move |one| of(second, positive[1]).map(move |other| [one, other]))
}

/// What the first of two would have to demand for the second not to be taken with it.
fn forbid(domain: &Domain, together: &Together<'_, '_>) -> String {
    let [own, other] = [Side::First, Side::Second].map(|side| together.part(side));
    let names = &own.action.scope.variables;
    let parameters = &names[..own.action.scope.parameters as usize];
    let taken = |name: &str| parameters.iter().any(|one| one.name.text.eq_ignore_ascii_case(name));
    let fresh = |variable: &Variable, name: &str| {
        let mut variable = variable.clone();
        name.clone_into(&mut variable.name.text);
        while taken(&variable.name.text) {
            variable.name.text = format!("?other-{}", variable.name.text.trim_start_matches('?'));
        }
        variable
    };
    let declared = &other.action.scope.variables;
    let mut bound = vec![fresh(&declared[0], "?other")];
    // Whoever needs another one for the same must not be kept from having it.
    let needs = own.id == other.id
        && own
            .precondition
            .some(|leaf| matches!(leaf, Condition::Action(atom, true) if atom.action == own.id));
    let mut unlike = Vec::new();
    let mut text = format!("(not ({} {}", other.action.name.text, bound[0].name.text);
    for (parameter, term) in declared.iter().zip(other.parameters()).skip(1) {
        let object = together.object(Side::Second, term);
        let own = own.parameters().find(|&own| together.object(Side::First, own) == object);
        let name = if let Some(Term::Variable(id)) = own {
            names[id.index()].name.text.clone()
        } else {
            let name = format!("?other-{}", parameter.name.text.trim_start_matches('?'));
            let variable = fresh(parameter, &name);
            let name = variable.name.text.clone();
            unlike.push(format!("(= {} {name})", parameter.name.text));
            bound.push(variable);
            name
        };
        text.push(' ');
        text.push_str(&name);
    }
    text.push_str("))");
    if needs && !unlike.is_empty() {
        text = format!("(or (and {}) {text})", unlike.join(" "));
        if let [only] = unlike.as_slice() {
            text = text.replacen(&format!("(and {only})"), only, 1);
        }
    }
    format!("(forall ({}) {text})", describe_parameters(&domain.types, &bound))
}
