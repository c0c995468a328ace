//! A schema goes in; what keeps its precondition true while all other parts have their effects comes out, as conditions on the joint action.
//!
//! A condition holds after the others if it does with, in place of each fact, what makes the fact true then:
//! it is true and no other part deletes it, or another part adds it. This is regression, through the effects of whoever stands in the joint action.

use super::interact::Feeds;
use super::schema::{Effect, Schema, may_meet, never};
use super::world::World;
use crate::condition::{self, Condition};
use crate::model::{ActionAtom, Atom, Literal, PredicateId, Scope, Term, VariableId};

/// Derived predicates are replaced by their rules so many times in one another; a deeper or a recursive one is kept from any change.
const UNFOLDINGS: usize = 4;

/// Protects the precondition of one schema.
pub(super) struct Protector<'a> {
    pub(super) world: &'a World<'a>,
    /// All schemas, as the domain has them.
    pub(super) schemas: &'a [Schema],
    pub(super) feeds: &'a Feeds,
    /// The schema to be protected; its scope grows.
    pub(super) own: Schema,
    /// Whether nothing more is demanded than must be.
    pub(super) exact: bool,
}

impl Protector<'_> {
    /// What to add to the precondition.
    pub(super) fn demands(&mut self) -> Vec<Condition> {
        let mut added = Vec::new();
        for part in self.own.precondition.conjuncts().to_vec() {
            let part = self.unfold(part, &mut Vec::new());
            self.keep_derived(&part, &mut added);
            if let Condition::Atom(atom, holds) = &part
                && self.is_simple(atom, *holds)
            {
                self.forbid(atom, *holds, &mut added);
            } else if part.some(|leaf| self.is_changed(leaf)) {
                let after = part.map(&mut |leaf| self.after(leaf));
                added.push(after);
            }
        }
        added
    }

    /// The schemas that can stand beside the own one.
    fn others(&self) -> impl Iterator<Item = &Schema> {
        self.schemas.iter().filter(|other| self.own.agent || other.agent)
    }

    /// The literals of the others that make a fact true, or false.
    fn literals(&self, positive: bool) -> impl Iterator<Item = (&Schema, &Effect, &Literal)> {
        self.others().flat_map(move |other| {
            other.effects.iter().flat_map(move |effect| {
                let literals = effect.literals.iter();
                literals
                    .filter(move |literal| literal.positive == positive)
                    .map(move |literal| (other, effect, literal))
            })
        })
    }

    fn meets(&self, atom: &Atom, other: &Schema, literal: &Literal) -> bool {
        may_meet(self.world, (&self.own, atom), (other, &literal.atom))
    }

    /// Whether another part may change what a leaf says.
    fn is_changed(&self, leaf: &Condition) -> bool {
        let Condition::Atom(atom, _) = leaf else { return false };
        [true, false].into_iter().any(|positive| {
            self.literals(positive).any(|(other, _, literal)| self.meets(atom, other, literal))
        })
    }

    /// Whether a fact survives exactly where nobody does the opposite: no part that deletes it may add it as well.
    fn is_simple(&self, atom: &Atom, holds: bool) -> bool {
        !holds || self.literals(true).all(|(other, _, literal)| !self.meets(atom, other, literal))
    }

    /// That no other part makes the fact the opposite.
    fn forbid(&mut self, atom: &Atom, holds: bool, added: &mut Vec<Condition>) {
        let mut scope = self.own.scope.clone();
        for (other, effect, literal) in self.literals(!holds) {
            if self.meets(atom, other, literal) {
                let mine = (Vec::new(), Condition::TRUE);
                let theirs = (other, effect, &literal.atom);
                added.push(never(&mut scope, &self.own, mine, atom, theirs));
            }
        }
        self.own.scope = scope;
    }

    /// The leaf as it is when all others have had their effects.
    fn after(&mut self, leaf: Condition) -> Condition {
        let Condition::Atom(atom, holds) = leaf else { return leaf };
        // It is as wanted and is not changed, or it is changed to be so.
        let mut scope = self.own.scope.clone();
        let stays = Condition::all(self.changes(&atom, !holds, false, &mut scope));
        let comes = Condition::any(self.changes(&atom, holds, true, &mut scope));
        self.own.scope = scope;
        Condition::any([Condition::all([Condition::Atom(atom, holds), stays]), comes])
    }

    /// For each effect of the others that makes `atom` true, or false, that it happens, or does not.
    fn changes(
        &self,
        atom: &Atom,
        positive: bool,
        happens: bool,
        scope: &mut Scope,
    ) -> Vec<Condition> {
        let meeting =
            self.literals(positive).filter(|(other, _, literal)| self.meets(atom, other, literal));
        meeting.map(|change| self.change(atom, change, happens, scope)).collect()
    }

    /// That another part has this effect on the fact `atom`, or has not: adds it, or deletes it and does not add it as well.
    fn change(
        &self,
        atom: &Atom,
        (other, effect, literal): (&Schema, &Effect, &Literal),
        happens: bool,
        scope: &mut Scope,
    ) -> Condition {
        let first = scope.variables.len() as u32;
        scope.variables.extend(other.scope.variables.iter().cloned());
        let new = |variable: VariableId| Term::Variable(VariableId(first + variable.0));
        let parameters = || (0..other.scope.parameters).map(VariableId);
        let arguments: Vec<Term> = parameters().map(new).collect();
        let mut effects = vec![effect.condition.clone().rename(&new)];
        effects.push(same(atom, &literal.atom, &new));
        if !literal.positive {
            for adding in &other.effects {
                let literals = adding.literals.iter().filter(|one| one.positive);
                for one in literals.filter(|one| one.atom.predicate == atom.predicate) {
                    effects.push(added(atom, (adding, &one.atom), scope, first).not());
                }
            }
        }
        let effects = Condition::all(effects);
        let bound = parameters().chain(effect.variables.iter().copied());
        let bound = bound.map(|variable| VariableId(first + variable.0)).collect();
        // An atom that must be false does not count the own action; of one that must be true it is to be said.
        let own = Term::Variable(VariableId(0));
        let apart = happens && self.own.agent && other.agent;
        let apart = apart.then(|| condition::equal(arguments[0], own, false));
        let acts = Condition::Action(ActionAtom { action: other.id, arguments }, happens);
        if happens {
            let parts = apart.into_iter().chain([acts, counting_own(effects, &self.own)]);
            Condition::exists(bound, Condition::all(parts.collect::<Vec<_>>()))
        } else {
            Condition::forall(bound, Condition::any([acts, counting_own(effects.not(), &self.own)]))
        }
    }

    /// A condition with the rules of derived predicates in their place, where that comes to an end.
    fn unfold(&mut self, condition: Condition, within: &mut Vec<PredicateId>) -> Condition {
        condition.map(&mut |leaf| {
            let Condition::Atom(atom, holds) = &leaf else { return leaf };
            let derived = self.world.domain.predicates[atom.predicate.index()].derived;
            if !derived || within.contains(&atom.predicate) || within.len() >= UNFOLDINGS {
                return leaf;
            }
            within.push(atom.predicate);
            let rules = self.rules(atom);
            let rules = rules.map(|rules| self.unfold(rules, within));
            within.pop();
            match rules {
                // Half of a recursion in place of it would say no more.
                Some(rules) if !rules.some(|leaf| self.is_derived(leaf)) => {
                    if *holds {
                        rules
                    } else {
                        rules.not()
                    }
                }
                _ => leaf,
            }
        })
    }

    fn is_derived(&self, leaf: &Condition) -> bool {
        matches!(leaf, Condition::Atom(atom, _) if self.world.domain.predicates[atom.predicate.index()].derived)
    }

    /// When a derived fact holds: one of the bodies of its rules.
    fn rules(&mut self, atom: &Atom) -> Option<Condition> {
        let mut bodies = Vec::new();
        for axiom in self.world.domain.axioms.iter().filter(|axiom| axiom.head == atom.predicate) {
            let first = self.own.scope.variables.len() as u32;
            self.own.scope.variables.extend(axiom.scope.variables.iter().cloned());
            let bound: Vec<VariableId> =
                (0..axiom.scope.parameters).map(|at| VariableId(first + at)).collect();
            let body = Condition::new(&axiom.body)?
                .rename(&|variable| Term::Variable(VariableId(first + variable.0)));
            // A rule may be of narrower types than the predicate.
            let pins = bound.iter().zip(&atom.arguments);
            let pins =
                pins.map(|(&one, &other)| condition::equal(Term::Variable(one), other, true));
            let parts = Condition::all(pins.chain([body]).collect::<Vec<_>>());
            bodies.push(Condition::exists(bound, parts));
        }
        Some(Condition::any(bodies))
    }

    /// Keeps others from changing anything that the derived predicates left in a condition depend on.
    fn keep_derived(&mut self, part: &Condition, added: &mut Vec<Condition>) {
        let mut derived = Vec::new();
        part.visit(&mut |leaf| {
            if let Condition::Atom(atom, _) = leaf
                && self.is_derived(leaf)
            {
                derived.push(atom.clone());
            }
        });
        let (mut scope, mut exact) = (self.own.scope.clone(), self.exact);
        for other in self.others() {
            let literals = || other.effects.iter().flat_map(|effect| &effect.literals);
            let touches = derived.iter().any(|atom| {
                literals().any(|literal| {
                    self.feeds.touches(self.world, (other, literal), (&self.own, atom))
                })
            });
            if touches {
                let first = scope.variables.len() as u32;
                scope.variables.extend(other.parameters().iter().cloned());
                let bound: Vec<VariableId> =
                    (first..scope.variables.len() as u32).map(VariableId).collect();
                let arguments = bound.iter().map(|&variable| Term::Variable(variable)).collect();
                let acts = ActionAtom { action: other.id, arguments };
                added.push(Condition::forall(bound, Condition::Action(acts, false)));
                exact = false;
            }
        }
        (self.own.scope, self.exact) = (scope, exact);
    }
}

/// That two atoms are the same fact, the second with other variables.
fn same(atom: &Atom, other: &Atom, new: &dyn Fn(VariableId) -> Term) -> Condition {
    let term = |term: Term| match term {
        Term::Variable(variable) => new(variable),
        object @ Term::Object(_) => object,
    };
    let pairs = atom.arguments.iter().zip(&other.arguments);
    Condition::all(pairs.map(|(&left, &right)| condition::equal(left, term(right), true)))
}

/// That an effect of the instance whose variables begin at `first` adds `atom`. What the effect binds is bound anew.
fn added(
    atom: &Atom,
    (effect, literal): (&Effect, &Atom),
    scope: &mut Scope,
    first: u32,
) -> Condition {
    let copies: Vec<(VariableId, VariableId)> = effect
        .variables
        .iter()
        .map(|&variable| {
            let copy = scope.variables[(first + variable.0) as usize].clone();
            scope.variables.push(copy);
            (variable, VariableId(scope.variables.len() as u32 - 1))
        })
        .collect();
    let new = |variable: VariableId| {
        let copy = copies.iter().find(|(old, _)| *old == variable);
        Term::Variable(copy.map_or(VariableId(first + variable.0), |&(_, copy)| copy))
    };
    let parts = [effect.condition.clone().rename(&new), same(atom, literal, &new)];
    let bound = copies.iter().map(|&(_, copy)| copy).collect();
    Condition::exists(bound, Condition::all(parts))
}

/// A condition on the joint action in which negative action atoms count the own action too, as conditions of effects do.
pub(super) fn counting_own(condition: Condition, own: &Schema) -> Condition {
    condition.map(&mut |leaf| {
        let Condition::Action(atom, false) = &leaf else { return leaf };
        if atom.action != own.id {
            return leaf;
        }
        let parameters = (0..own.scope.parameters).map(|at| Term::Variable(VariableId(at)));
        let differs = atom.arguments.iter().zip(parameters);
        let differs =
            differs.map(|(&one, other)| condition::equal(one, other, false)).collect::<Vec<_>>();
        Condition::all([leaf, Condition::any(differs)])
    })
}
