//! Variable elimination: what a question does not ask for is summed out, one variable after another (Zhang and Poole 1994).
//!
//! First goes everything that cannot matter: what is neither asked for nor seen nor causes any of that (Shachter 1986), and what the
//! evidence cuts off from the question. Of what is left the variable goes first whose neighbours need the fewest new joins (min-fill).

use super::factor::Factor;
use super::{Evidence, InferError, check, refuse_unknown};
use crate::network::Network;
use crate::variable::{State, VariableId};

/// The joint probabilities of some variables, given evidence; the last target runs fastest.
pub fn joint(
    network: &Network,
    targets: &[VariableId],
    evidence: &Evidence,
) -> Result<Vec<f64>, InferError> {
    check(network, evidence)?;
    let relevant = relevant(network, targets, evidence);
    refuse_unknown(network, relevant.iter().copied(), evidence)?;
    if evidence.iter().any(|&(id, state)| is_impossible(network, id, state, evidence)) {
        return Err(InferError::Impossible);
    }
    let mut factors: Vec<Factor> =
        relevant.iter().map(|&id| Factor::of_table(network, id, evidence)).collect();
    let seen = |id: VariableId| evidence.iter().any(|&(other, _)| other == id);
    let mut hidden: Vec<VariableId> =
        relevant.into_iter().filter(|&id| !seen(id) && !targets.contains(&id)).collect();
    while let Some(next) = cheapest(&factors, &hidden) {
        hidden.retain(|&id| id != next);
        sum_out(&mut factors, next)?;
    }
    answer(network, targets, evidence, &factors)
}

/// Whether the model holds a seen state impossible among causes that are all seen. Of evidence that the question does not depend on,
/// only this is looked at.
fn is_impossible(network: &Network, id: VariableId, state: State, evidence: &Evidence) -> bool {
    let seen =
        |id: &VariableId| evidence.iter().find(|(other, _)| other == id).map(|&(_, state)| state);
    let Some(parents) =
        network.graph().parents(id).iter().map(seen).collect::<Option<Vec<State>>>()
    else {
        return false;
    };
    let row = network.row(id, network.row_of(id, &parents));
    row.is_some_and(|row| row[usize::from(state)] <= 0.0)
}

/// The probabilities of the states of one variable, given evidence.
pub fn posterior(
    network: &Network,
    target: VariableId,
    evidence: &Evidence,
) -> Result<Vec<f64>, InferError> {
    joint(network, &[target], evidence)
}

/// The probability of evidence.
pub fn probability(network: &Network, evidence: &Evidence) -> Result<f64, InferError> {
    check(network, evidence)?;
    let ids: Vec<VariableId> = network.graph().ancestors(evidence.iter().map(|&(id, _)| id));
    refuse_unknown(network, ids.iter().copied(), evidence)?;
    let mut factors: Vec<Factor> =
        ids.iter().map(|&id| Factor::of_table(network, id, evidence)).collect();
    let mut hidden: Vec<VariableId> =
        ids.into_iter().filter(|id| evidence.iter().all(|(other, _)| other != id)).collect();
    while let Some(next) = cheapest(&factors, &hidden) {
        hidden.retain(|&id| id != next);
        sum_out(&mut factors, next)?;
    }
    Ok(factors.iter().map(|factor| factor.values[0]).product())
}

/// The most probable states of all variables, given evidence, and the logarithm of their probability together with it (max-product
/// elimination). Of several, those whose first variables have the lowest states are not promised.
pub fn most_probable(
    network: &Network,
    evidence: &Evidence,
) -> Result<(Vec<State>, f64), InferError> {
    check(network, evidence)?;
    refuse_unknown(network, network.ids(), evidence)?;
    let mut factors: Vec<Factor> =
        network.ids().map(|id| Factor::of_table(network, id, evidence)).collect();
    let mut hidden: Vec<VariableId> =
        network.ids().filter(|id| evidence.iter().all(|(other, _)| other != id)).collect();
    let mut chosen: Vec<(VariableId, Factor, Vec<State>)> = Vec::new();
    let mut logarithm = 0.0;
    while let Some(next) = cheapest(&factors, &hidden) {
        hidden.retain(|&id| id != next);
        let (with, without): (Vec<Factor>, Vec<Factor>) =
            factors.into_iter().partition(|factor| factor.has(next));
        let with: Vec<&Factor> = with.iter().collect();
        let (mut best, states) = Factor::eliminate(&with, next, true)?;
        // Products of many probabilities would vanish: the largest becomes one, and its logarithm is kept.
        let largest = best.values.iter().copied().fold(0.0, f64::max);
        if largest > 0.0 {
            logarithm += largest.ln();
            best.values.iter_mut().for_each(|value| *value /= largest);
        }
        factors = without;
        factors.push(best.clone());
        chosen.push((next, best, states));
    }
    let rest: f64 = factors.iter().map(|factor| factor.values[0]).product();
    if rest <= 0.0 {
        return Err(InferError::Impossible);
    }
    let mut states = vec![0; network.variables().len()];
    for &(id, state) in evidence {
        states[id.index()] = state;
    }
    for (id, factor, best) in chosen.into_iter().rev() {
        let cell = factor
            .scope
            .iter()
            .fold(0, |cell, &(other, arity)| cell * arity + usize::from(states[other.index()]));
        states[id.index()] = best[cell];
    }
    Ok((states, logarithm + rest.ln()))
}

/// Multiplies what is left, and puts it into the order of the targets.
fn answer(
    network: &Network,
    targets: &[VariableId],
    evidence: &Evidence,
    factors: &[Factor],
) -> Result<Vec<f64>, InferError> {
    let factors: Vec<&Factor> = factors.iter().collect();
    let product = Factor::product(&factors, &Factor::union(&factors))?;
    let sum: f64 = product.values.iter().sum();
    if sum <= 0.0 {
        return Err(InferError::Impossible);
    }
    let arities: Vec<usize> = targets.iter().map(|&id| network.variable(id).arity()).collect();
    let total: usize = arities.iter().product();
    let mut states = vec![0; targets.len()];
    let answer = (0..total).map(|cell| {
        let mut rest = cell;
        for place in (0..targets.len()).rev() {
            states[place] = rest % arities[place];
            rest /= arities[place];
        }
        // A target that is seen is in its state, and a target that is named twice agrees with itself.
        let state =
            |id: VariableId| targets.iter().position(|&one| one == id).map(|place| states[place]);
        let agrees = targets.iter().zip(&states).all(|(&id, &own)| {
            state(id) == Some(own)
                && evidence.iter().all(|&(other, seen)| other != id || usize::from(seen) == own)
        });
        if !agrees {
            return 0.0;
        }
        let cell = product
            .scope
            .iter()
            .fold(0, |cell, &(id, arity)| cell * arity + state(id).expect("only targets are left"));
        product.values[cell] / sum
    });
    Ok(answer.collect())
}

/// Multiplies all factors of a variable, and sums it out.
fn sum_out(factors: &mut Vec<Factor>, id: VariableId) -> Result<(), InferError> {
    let with: Vec<Factor> = factors.extract_if(.., |factor| factor.has(id)).collect();
    let with: Vec<&Factor> = with.iter().collect();
    let (sum, _) = Factor::eliminate(&with, id, false)?;
    factors.push(sum);
    Ok(())
}

/// The variable that needs the fewest new joins; of several, the one with the smallest table, then the first.
fn cheapest(factors: &[Factor], hidden: &[VariableId]) -> Option<VariableId> {
    hidden.iter().copied().min_by_key(|&id| {
        let with: Vec<&Factor> = factors.iter().filter(|factor| factor.has(id)).collect();
        let scope = Factor::union(&with);
        let size: u128 = scope.iter().map(|&(_, arity)| arity as u128).product();
        let joined = |one: VariableId, other: VariableId| {
            factors.iter().any(|factor| factor.has(one) && factor.has(other))
        };
        let mut fill = 0;
        // With a single factor all its variables are joined already.
        if with.len() > 1 {
            for (at, &(one, _)) in scope.iter().enumerate() {
                fill += scope[..at]
                    .iter()
                    .filter(|&&(other, _)| one != id && other != id && !joined(one, other))
                    .count();
            }
        }
        (fill, size, id)
    })
}

/// The variables whose tables matter: among what causes the targets and the evidence, what is joined to a target without passing
/// something seen.
fn relevant(network: &Network, targets: &[VariableId], evidence: &Evidence) -> Vec<VariableId> {
    let all = network
        .graph()
        .ancestors(targets.iter().copied().chain(evidence.iter().map(|&(id, _)| id)));
    let many = network.variables().len();
    let mut seen = vec![false; many];
    for (id, _) in evidence {
        seen[id.index()] = true;
    }
    // Tables are joined where they share a variable that is not seen.
    let mut of_variable: Vec<Vec<VariableId>> = vec![Vec::new(); many];
    for &id in &all {
        for &one in network.graph().parents(id).iter().chain([&id]) {
            if !seen[one.index()] {
                of_variable[one.index()].push(id);
            }
        }
    }
    let mut found = vec![false; many];
    let mut visited = vec![false; many];
    let mut open: Vec<VariableId> =
        targets.iter().copied().filter(|id| !seen[id.index()]).collect();
    while let Some(variable) = open.pop() {
        if std::mem::replace(&mut visited[variable.index()], true) {
            continue;
        }
        for &table in &of_variable[variable.index()] {
            if !std::mem::replace(&mut found[table.index()], true) {
                let scope = network.graph().parents(table).iter().chain([&table]);
                open.extend(scope.copied().filter(|one| !seen[one.index()]));
            }
        }
    }
    all.into_iter().filter(|id| found[id.index()]).collect()
}
