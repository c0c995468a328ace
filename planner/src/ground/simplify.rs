//! A ground problem in, the same without what can never matter: facts that always or never hold, operators that never apply.

use std::ops::Range;

use crate::grounded::{Axiom, Effect, Fact, FactId, Grounded, Literal, Operator};

/// What is known of a fact.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Truth {
    Always,
    Never,
    Open,
}

/// Simplifies `grounded` until nothing changes; false if the goal cannot be reached.
///
/// `exact` says that everything in it is known to be reachable under delete relaxation, so that the first check may be left out.
pub fn simplify(grounded: &mut Grounded, exact: bool) -> bool {
    let mut exact = exact;
    loop {
        let reached = if exact { vec![true; grounded.facts.len()] } else { reachable(grounded) };
        let truth = truth(grounded, &reached);
        let Some(goal) = rewrite_all(&grounded.goal, &truth) else { return false };
        grounded.goal = goal;
        let before = (grounded.operators.len(), grounded.axioms.len(), grounded.effects.len());
        rewrite(grounded, &truth);
        exact = before == (grounded.operators.len(), grounded.axioms.len(), grounded.effects.len());
        renumber(grounded, &truth);
        if exact {
            return true;
        }
    }
}

/// Which facts hold when deletes and negative conditions are ignored.
fn reachable(grounded: &Grounded) -> Vec<bool> {
    // Rules: operators, then effects, then axioms. An effect waits for its operator and for its own conditions.
    let (operators, effects) = (grounded.operators.len(), grounded.effects.len());
    let rules = operators + effects + grounded.axioms.len();
    let mut waiting = vec![0_u32; rules];
    let mut uses: Vec<(u32, u32)> = Vec::new();
    let mut owner = vec![0_u32; effects];
    let mut need = |rule: usize, range: &Range<u32>, waiting: &mut [u32]| {
        for literal in slice(&grounded.literals, range).iter().filter(|literal| literal.positive) {
            uses.push((literal.fact.0, rule as u32));
            waiting[rule] += 1;
        }
    };
    for (number, operator) in grounded.operators.iter().enumerate() {
        need(number, &operator.precondition, &mut waiting);
        for effect in operator.effects.clone() {
            owner[effect as usize] = number as u32;
            waiting[operators + effect as usize] = 1;
        }
    }
    for (number, effect) in grounded.effects.iter().enumerate() {
        need(operators + number, &effect.conditions, &mut waiting);
    }
    for (number, axiom) in grounded.axioms.iter().enumerate() {
        need(operators + effects + number, &axiom.conditions, &mut waiting);
    }
    uses.sort_unstable();
    let mut first = vec![0_u32; grounded.facts.len() + 1];
    for &(fact, _) in &uses {
        first[fact as usize + 1] += 1;
    }
    for fact in 0..grounded.facts.len() {
        first[fact + 1] += first[fact];
    }
    let mut reached = grounded.initial.clone();
    let mut queue: Vec<u32> =
        (0..reached.len() as u32).filter(|&fact| reached[fact as usize]).collect();
    let mut fired: Vec<u32> =
        (0..rules as u32).filter(|&rule| waiting[rule as usize] == 0).collect();
    loop {
        while let Some(rule) = fired.pop() {
            let rule = rule as usize;
            let head = if rule < operators {
                for effect in grounded.operators[rule].effects.clone() {
                    waiting[operators + effect as usize] -= 1;
                    if waiting[operators + effect as usize] == 0 {
                        fired.push((operators + effect as usize) as u32);
                    }
                }
                continue;
            } else if rule < operators + effects {
                let literal = grounded.effects[rule - operators].literal;
                if !literal.positive {
                    continue;
                }
                literal.fact
            } else {
                grounded.axioms[rule - operators - effects].head
            };
            if !reached[head.index()] {
                reached[head.index()] = true;
                queue.push(head.0);
            }
        }
        let Some(fact) = queue.pop() else { break };
        for &(_, rule) in &uses[first[fact as usize] as usize..first[fact as usize + 1] as usize] {
            waiting[rule as usize] -= 1;
            if waiting[rule as usize] == 0 {
                fired.push(rule);
            }
        }
    }
    reached
}

/// Which facts always hold: true from the start and never deleted, or derived from nothing but such facts.
fn truth(grounded: &Grounded, reached: &[bool]) -> Vec<Truth> {
    let mut truth: Vec<Truth> = (0..grounded.facts.len())
        .map(|fact| match (reached[fact], grounded.initial[fact]) {
            (false, _) => Truth::Never,
            (true, true) => Truth::Always,
            (true, false) => Truth::Open,
        })
        .collect();
    for effect in grounded.effects.iter().filter(|effect| !effect.literal.positive) {
        let fact = effect.literal.fact.index();
        if truth[fact] == Truth::Always {
            truth[fact] = Truth::Open;
        }
    }
    loop {
        let mut changed = false;
        for axiom in &grounded.axioms {
            let always = slice(&grounded.literals, &axiom.conditions).iter().all(|literal| {
                truth[literal.fact.index()]
                    == if literal.positive { Truth::Always } else { Truth::Never }
            });
            if always && truth[axiom.head.index()] == Truth::Open {
                truth[axiom.head.index()] = Truth::Always;
                changed = true;
            }
        }
        if !changed {
            return truth;
        }
    }
}

fn slice<'a>(literals: &'a [Literal], range: &Range<u32>) -> &'a [Literal] {
    &literals[range.start as usize..range.end as usize]
}

/// The literals that are still open; none if one of them never holds.
fn rewrite_all(literals: &[Literal], truth: &[Truth]) -> Option<Vec<Literal>> {
    let mut open = Vec::with_capacity(literals.len());
    for &literal in literals {
        match (truth[literal.fact.index()], literal.positive) {
            (Truth::Open, _) => open.push(literal),
            (Truth::Always, true) | (Truth::Never, false) => {}
            (Truth::Always, false) | (Truth::Never, true) => return None,
        }
    }
    Some(open)
}

/// Drops operators, effects and axioms that never apply or never change anything, and literals that always hold.
fn rewrite(grounded: &mut Grounded, truth: &[Truth]) {
    let old = std::mem::take(&mut grounded.literals);
    let mut literals = Vec::with_capacity(old.len());
    let mut keep = |range: &Range<u32>| {
        let start = literals.len() as u32;
        for &literal in slice(&old, range) {
            match (truth[literal.fact.index()], literal.positive) {
                (Truth::Open, _) => literals.push(literal),
                (Truth::Always, true) | (Truth::Never, false) => {}
                (Truth::Always, false) | (Truth::Never, true) => {
                    literals.truncate(start as usize);
                    return None;
                }
            }
        }
        Some(start..literals.len() as u32)
    };
    let mut effects: Vec<Effect> = Vec::with_capacity(grounded.effects.len());
    let mut operators: Vec<Operator> = Vec::with_capacity(grounded.operators.len());
    for operator in &grounded.operators {
        let Some(precondition) = keep(&operator.precondition) else { continue };
        let start = effects.len() as u32;
        for effect in
            &grounded.effects[operator.effects.start as usize..operator.effects.end as usize]
        {
            if truth[effect.literal.fact.index()] != Truth::Open {
                continue;
            }
            if let Some(conditions) = keep(&effect.conditions) {
                effects.push(Effect { conditions, literal: effect.literal });
            }
        }
        if effects.len() as u32 > start {
            operators.push(Operator {
                precondition,
                effects: start..effects.len() as u32,
                ..operator.clone()
            });
        }
    }
    let mut axioms = Vec::with_capacity(grounded.axioms.len());
    for axiom in grounded.axioms.iter().filter(|axiom| truth[axiom.head.index()] == Truth::Open) {
        if let Some(conditions) = keep(&axiom.conditions) {
            axioms.push(Axiom { conditions, ..axiom.clone() });
        }
    }
    grounded.literals = literals;
    grounded.effects = effects;
    grounded.operators = operators;
    grounded.axioms = axioms;
}

/// Gives the open facts new numbers without gaps.
fn renumber(grounded: &mut Grounded, truth: &[Truth]) {
    let mut next = 0;
    let new: Vec<u32> = truth
        .iter()
        .map(|&truth| {
            next += u32::from(truth == Truth::Open);
            next.wrapping_sub(1)
        })
        .collect();
    if next as usize == truth.len() {
        return;
    }
    let renamed = |fact: FactId| FactId(new[fact.index()]);
    for literal in grounded.literals.iter_mut().chain(&mut grounded.goal) {
        literal.fact = renamed(literal.fact);
    }
    for effect in &mut grounded.effects {
        effect.literal.fact = renamed(effect.literal.fact);
    }
    for axiom in &mut grounded.axioms {
        axiom.head = renamed(axiom.head);
    }
    let open = |fact: &usize| truth[*fact] == Truth::Open;
    let kept: Vec<usize> = (0..truth.len()).filter(open).collect();
    let facts: Vec<Fact> = kept.iter().map(|&fact| grounded.facts[fact].clone()).collect();
    grounded.initial = kept.iter().map(|&fact| grounded.initial[fact]).collect();
    grounded.derived = kept.iter().map(|&fact| grounded.derived[fact]).collect();
    grounded.facts = facts;
}
