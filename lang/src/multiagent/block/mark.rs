//! The effects of a group go in; what a block takes down about facts that one part adds and another may delete comes out.

use super::{
    Assembly, Atom, Block, Condition, Draft, Effect, Literal, PredicateId, Stage, Term, VariableId,
};

impl Block<'_> {
    /// The predicates of which one part may add and another delete a fact where one of the two depends on a condition.
    pub(super) fn marks(&self, assembly: &mut Assembly) -> Vec<(PredicateId, [PredicateId; 2])> {
        let literals = |at: usize| {
            let effects = self.schema(at).effects.iter();
            effects.flat_map(|effect| effect.literals.iter().map(move |literal| (effect, literal)))
        };
        let mut marks: Vec<(PredicateId, [PredicateId; 2])> = Vec::new();
        for one in 0..self.group.len() {
            for other in one..self.group.len() {
                for (mine, literal) in literals(one) {
                    for (theirs, against) in literals(other) {
                        let predicate = literal.atom.predicate;
                        let meet = literal.positive != against.positive
                            && !(mine.is_plain() && theirs.is_plain())
                            && marks.iter().all(|(known, _)| *known != predicate)
                            && super::super::schema::may_meet(
                                self.world,
                                (self.schema(one), &literal.atom),
                                (self.schema(other), &against.atom),
                            );
                        if meet {
                            let declared = &self.world.domain.predicates[predicate.index()];
                            let pair = ["added", "deleted"].map(|word| {
                                let name = format!("{word}-{}", declared.name.text);
                                assembly.predicate(&name, declared.parameters.clone())
                            });
                            marks.push((predicate, pair));
                        }
                    }
                }
            }
        }
        marks
    }

    /// Nothing has gone wrong, and what parts have added and deleted need not be known any longer.
    pub(super) fn forget(&self, stage: &Stage, end: &mut Draft) {
        if let Some(broken) = stage.broken {
            end.needs(Atom { predicate: broken, arguments: Vec::new() }, false);
        }
        for (predicate, pair) in &stage.marks {
            let parameters = &self.world.domain.predicates[predicate.index()].parameters;
            let first = end.scope.variables.len() as u32;
            end.scope.variables.extend(parameters.iter().cloned());
            let bound: Vec<VariableId> =
                (first..end.scope.variables.len() as u32).map(VariableId).collect();
            let arguments: Vec<Term> = bound.iter().map(|&id| Term::Variable(id)).collect();
            let marks =
                pair.map(|predicate| (Atom { predicate, arguments: arguments.clone() }, false));
            end.effects.push((bound, Condition::TRUE, marks.to_vec()));
        }
    }

    /// Takes down that a fact is added or deleted, and sees to it that no other part does the opposite.
    #[expect(clippy::unused_self, reason = "it reads like the other parts of an action")]
    pub(super) fn mark(
        &self,
        effect: &Effect,
        literal: &Literal,
        condition: &Condition,
        stage: &Stage,
        literals: &mut Vec<(Atom, bool)>,
        draft: &mut Draft,
    ) {
        let known = stage.marks.iter().find(|(known, _)| *known == literal.atom.predicate);
        let Some((_, [added, deleted])) = known else { return };
        let (own, opposite) =
            if literal.positive { (*added, *deleted) } else { (*deleted, *added) };
        let fact = |predicate| Atom { predicate, arguments: literal.atom.arguments.clone() };
        literals.push((fact(own), true));
        if effect.is_plain() {
            draft.needs(fact(opposite), false);
            return;
        }
        let broken = stage.broken.expect("it is there if there are marks");
        let broken = Atom { predicate: broken, arguments: Vec::new() };
        let clash = Condition::all([condition.clone(), Condition::Atom(fact(opposite), true)]);
        draft.effects.push((effect.variables.clone(), clash, vec![(broken, true)]));
    }
}
