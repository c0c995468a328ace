//! Small ground problems: read from one line of text, or drawn.

use lang::model::{ActionId, PredicateId};
use proptest::collection::vec;
use proptest::prelude::*;

use crate::grounded::{Axiom, Effect, Fact, FactId, Grounded, Literal, Operator};

/// A fact and whether it is positive.
pub(crate) type Sign = (u32, bool);

/// Conditions and what is added or deleted under them.
type Change = (Vec<Sign>, Sign);

#[derive(Debug, Clone, Default)]
pub(crate) struct Draft {
    facts: u32,
    initial: Vec<u32>,
    derived: Vec<u32>,
    /// Precondition, effects, cost.
    operators: Vec<(Vec<Sign>, Vec<Change>, u32)>,
    axioms: Vec<(u32, Vec<Sign>)>,
    goal: Vec<Sign>,
}

impl Draft {
    /// `init f0 f1; f0 -f1 -> f2 -f0 [f1 > f3] cost 2; derived f4; f4 <= f2 -f3; goal f3`.
    pub(crate) fn parse(text: &str) -> Self {
        let mut draft = Self::default();
        let mut most = 0;
        let mut sign = |word: &str| {
            let (name, positive) =
                word.strip_prefix('-').map_or((word, true), |name| (name, false));
            let fact: u32 = name
                .strip_prefix('f')
                .expect("facts start with f")
                .parse()
                .expect("facts end in a number");
            most = most.max(fact + 1);
            (fact, positive)
        };
        for item in text.split(';').map(str::trim) {
            if let Some((before, after)) = item.split_once("->") {
                let (after, cost) = after.split_once("cost").map_or((after, 1), |(after, cost)| {
                    (after, cost.trim().parse().expect("a number"))
                });
                let mut effects = Vec::new();
                let mut rest = after.trim();
                while !rest.is_empty() {
                    if let Some(inner) = rest.strip_prefix('[') {
                        let (inner, behind) = inner.split_once(']').expect("a bracket is closed");
                        let (conditions, effect) =
                            inner.split_once('>').expect("a conditional effect has an arrow");
                        effects.push((
                            conditions.split_whitespace().map(&mut sign).collect(),
                            sign(effect.trim()),
                        ));
                        rest = behind.trim();
                    } else {
                        let (word, behind) = rest.split_once(' ').unwrap_or((rest, ""));
                        effects.push((Vec::new(), sign(word)));
                        rest = behind.trim();
                    }
                }
                draft.operators.push((
                    before.split_whitespace().map(&mut sign).collect(),
                    effects,
                    cost,
                ));
            } else if let Some((head, body)) = item.split_once("<=") {
                draft
                    .axioms
                    .push((sign(head.trim()).0, body.split_whitespace().map(&mut sign).collect()));
            } else if let Some(facts) = item.strip_prefix("init") {
                draft.initial = facts.split_whitespace().map(|word| sign(word).0).collect();
            } else if let Some(facts) = item.strip_prefix("derived") {
                draft.derived = facts.split_whitespace().map(|word| sign(word).0).collect();
            } else if let Some(facts) = item.strip_prefix("goal") {
                draft.goal = facts.split_whitespace().map(&mut sign).collect();
            } else {
                panic!("not an item: {item}");
            }
        }
        draft.facts = most;
        draft
    }

    pub(crate) fn grounded(&self) -> Grounded {
        let mut grounded = Grounded { uses_metric: true, ..Grounded::default() };
        for fact in 0..self.facts {
            grounded.facts.push(Fact { predicate: PredicateId(fact), arguments: 0..0 });
            grounded.initial.push(self.initial.contains(&fact));
            grounded.derived.push(self.derived.contains(&fact));
        }
        for (index, (precondition, effects, cost)) in self.operators.iter().enumerate() {
            let precondition = push(&mut grounded, precondition);
            let start = grounded.effects.len() as u32;
            for (conditions, literal) in effects {
                let conditions = push(&mut grounded, conditions);
                grounded.effects.push(Effect {
                    conditions,
                    literal: Literal { fact: FactId(literal.0), positive: literal.1 },
                });
            }
            let effects = start..grounded.effects.len() as u32;
            let action = ActionId(index as u32);
            grounded.operators.push(Operator {
                action,
                arguments: 0..0,
                bound: 0..0,
                precondition,
                effects,
                cost: *cost,
            });
        }
        for (head, body) in &self.axioms {
            let conditions = push(&mut grounded, body);
            grounded.axioms.push(Axiom { head: FactId(*head), bound: 0..0, conditions });
        }
        grounded.goal = self
            .goal
            .iter()
            .map(|&(fact, positive)| Literal { fact: FactId(fact), positive })
            .collect();
        grounded
    }
}

/// Appends literals, sorted and without repetitions.
fn push(grounded: &mut Grounded, signs: &[Sign]) -> std::ops::Range<u32> {
    let mut literals: Vec<Literal> =
        signs.iter().map(|&(fact, positive)| Literal { fact: FactId(fact), positive }).collect();
    literals.sort_unstable();
    literals.dedup();
    let start = grounded.literals.len() as u32;
    grounded.literals.extend(literals);
    start..grounded.literals.len() as u32
}

/// At most five facts that change, then two derived ones of which the second may negate the first.
pub(crate) fn draft() -> impl Strategy<Value = Draft> {
    (2u32..6, 0u32..3).prop_flat_map(|(fluents, derived)| {
        let facts = fluents + derived;
        let sign = move || (0..facts, prop::bool::weighted(0.7));
        let effect = (
            prop_oneof![3 => Just(Vec::new()), 1 => vec(sign(), 1..3)],
            (0..fluents, any::<bool>()),
        );
        let operator = (vec(sign(), 0..3), vec(effect, 1..5), 0u32..4);
        let body = move |head: u32| {
            vec((0..facts, any::<bool>()), 0..3).prop_map(move |body| {
                // A derived fact may use itself and those before it; only those before it negated.
                let allowed = |&(fact, positive): &Sign| fact < head || (fact == head && positive);
                (head, body.into_iter().filter(allowed).collect::<Vec<Sign>>())
            })
        };
        let axioms = if derived == 0 {
            Just(Vec::new()).boxed()
        } else {
            vec((fluents..facts).prop_flat_map(body), 0..4).boxed()
        };
        (vec(0..fluents, 0..3), vec(operator, 1..7), axioms, vec(sign(), 1..3)).prop_map(
            move |(initial, operators, axioms, goal)| Draft {
                facts,
                initial,
                derived: (fluents..facts).collect(),
                operators,
                axioms,
                goal,
            },
        )
    })
}
