//! Tables of numbers over the states of some variables go in; products, sums and maxima of them come out.

use super::{Evidence, InferError, MOST_CELLS};
use crate::network::Network;
use crate::variable::{State, VariableId};

/// A number for each combination of the states of some variables.
#[derive(Debug, Clone, PartialEq)]
pub struct Factor {
    /// The variables in rising order, the last of which runs fastest, each with its number of states.
    pub scope: Vec<(VariableId, usize)>,
    /// The numbers.
    pub values: Vec<f64>,
}

impl Factor {
    /// The factor of no variable.
    pub fn constant(value: f64) -> Self {
        Self { scope: Vec::new(), values: vec![value] }
    }

    /// The table of a variable of a network, with the numbers as they are, where the evidence holds: what is seen is no variable of it
    /// any more.
    pub fn of_table(network: &Network, id: VariableId, evidence: &Evidence) -> Self {
        let seen = |id: VariableId| {
            evidence.iter().find(|(other, _)| *other == id).map(|&(_, state)| state)
        };
        let arity = network.variable(id).arity();
        let parents = network.graph().parents(id);
        // The variables of the table as it is stored: the parents, then the variable itself.
        let stored: Vec<(VariableId, usize)> = parents
            .iter()
            .map(|&parent| (parent, network.variable(parent).arity()))
            .chain([(id, arity)])
            .collect();
        let mut strides = vec![1; stored.len()];
        for at in (0..stored.len() - 1).rev() {
            strides[at] = strides[at + 1] * stored[at + 1].1;
        }
        let mut start = 0;
        let mut free: Vec<(VariableId, usize, usize)> = Vec::with_capacity(stored.len());
        for (&(id, arity), &stride) in stored.iter().zip(&strides) {
            match seen(id) {
                Some(state) => start += usize::from(state) * stride,
                None => free.push((id, arity, stride)),
            }
        }
        free.sort_unstable();
        let table = &network.table(id).probabilities;
        let mut values = Vec::with_capacity(free.iter().map(|&(_, arity, _)| arity).product());
        walk(&free, start, &mut |cell| values.push(table[cell]));
        Self { scope: free.into_iter().map(|(id, arity, _)| (id, arity)).collect(), values }
    }

    /// Whether a variable is in it.
    pub fn has(&self, id: VariableId) -> bool {
        self.scope.iter().any(|&(one, _)| one == id)
    }

    /// The variables of several factors.
    pub fn union(factors: &[&Self]) -> Vec<(VariableId, usize)> {
        let mut scope: Vec<(VariableId, usize)> =
            factors.iter().flat_map(|factor| factor.scope.iter().copied()).collect();
        scope.sort_unstable();
        scope.dedup();
        scope
    }

    /// How far apart the states of each variable of a scope lie here; nothing where it is not one of these.
    fn strides(&self, scope: &[(VariableId, usize)]) -> Vec<usize> {
        let mut strides = vec![0; scope.len()];
        let mut stride = 1;
        for &(id, arity) in self.scope.iter().rev() {
            if let Some(at) = scope.iter().position(|&(one, _)| one == id) {
                strides[at] = stride;
            }
            stride *= arity;
        }
        strides
    }

    /// The product of factors, with one variable summed out, or maximised out together with the states at which the maxima lie.
    pub fn eliminate(
        factors: &[&Self],
        id: VariableId,
        maximise: bool,
    ) -> Result<(Self, Vec<State>), InferError> {
        let mut scope = Self::union(factors);
        let place =
            scope.iter().position(|&(one, _)| one == id).expect("some factor has the variable");
        let (_, arity) = scope.remove(place);
        let size = cells(&scope)?;
        scope.push((id, arity));
        let strides: Vec<Vec<usize>> =
            factors.iter().map(|factor| factor.strides(&scope)).collect();
        scope.pop();
        let inner: Vec<usize> = strides.iter().map(|strides| strides[scope.len()]).collect();
        let mut values = Vec::with_capacity(size);
        let mut chosen = Vec::new();
        let mut at = vec![0; factors.len()];
        let mut states = vec![0; scope.len()];
        for _ in 0..size {
            let (mut sum, mut best) = (0.0, (f64::NEG_INFINITY, 0));
            for state in 0..arity {
                let mut product = 1.0;
                for (factor, (&at, &inner)) in factors.iter().zip(at.iter().zip(&inner)) {
                    product *= factor.values[at + state * inner];
                }
                sum += product;
                if product > best.0 {
                    best = (product, state as State);
                }
            }
            if maximise {
                values.push(best.0);
                chosen.push(best.1);
            } else {
                values.push(sum);
            }
            advance(&scope, &strides, &mut states, &mut at);
        }
        Ok((Self { scope, values }, chosen))
    }

    /// The product of factors over the variables of a scope, which has all of theirs.
    pub fn product(factors: &[&Self], scope: &[(VariableId, usize)]) -> Result<Self, InferError> {
        let size = cells(scope)?;
        let strides: Vec<Vec<usize>> = factors.iter().map(|factor| factor.strides(scope)).collect();
        let mut at = vec![0; factors.len()];
        let mut states = vec![0; scope.len()];
        let mut values = Vec::with_capacity(size);
        for _ in 0..size {
            values.push(factors.iter().zip(&at).map(|(factor, &at)| factor.values[at]).product());
            advance(scope, &strides, &mut states, &mut at);
        }
        Ok(Self { scope: scope.to_vec(), values })
    }

    /// The sums over all other variables than some.
    #[must_use]
    pub fn onto(&self, scope: &[(VariableId, usize)]) -> Self {
        let strides: Vec<usize> =
            Self { scope: scope.to_vec(), values: Vec::new() }.strides(&self.scope);
        let mut values = vec![0.0; scope.iter().map(|&(_, arity)| arity).product()];
        let free: Vec<(VariableId, usize, usize)> = self
            .scope
            .iter()
            .zip(&strides)
            .map(|(&(id, arity), &stride)| (id, arity, stride))
            .collect();
        let mut mine = 0;
        walk(&free, 0, &mut |cell| {
            values[cell] += self.values[mine];
            mine += 1;
        });
        Self { scope: scope.to_vec(), values }
    }
}

/// How many cells a scope has.
pub fn cells(scope: &[(VariableId, usize)]) -> Result<usize, InferError> {
    let product = scope.iter().map(|&(_, arity)| arity as u128).fold(1_u128, u128::saturating_mul);
    if product > MOST_CELLS as u128 {
        Err(InferError::TooLarge(product))
    } else {
        Ok(product as usize)
    }
}

/// Moves on to the next combination of states, the last variable first, and the places of all factors with it.
fn advance(
    scope: &[(VariableId, usize)],
    strides: &[Vec<usize>],
    states: &mut [usize],
    at: &mut [usize],
) {
    for place in (0..scope.len()).rev() {
        states[place] += 1;
        for (at, strides) in at.iter_mut().zip(strides) {
            *at += strides[place];
        }
        if states[place] < scope[place].1 {
            return;
        }
        states[place] = 0;
        for (at, strides) in at.iter_mut().zip(strides) {
            *at -= strides[place] * scope[place].1;
        }
    }
}

/// Visits the cells of all combinations of states, the last variable running fastest; each variable with its stride.
fn walk(free: &[(VariableId, usize, usize)], start: usize, visit: &mut dyn FnMut(usize)) {
    let total: usize = free.iter().map(|&(_, arity, _)| arity).product();
    let mut states = vec![0; free.len()];
    let mut cell = start;
    for _ in 0..total {
        visit(cell);
        for place in (0..free.len()).rev() {
            let (_, arity, stride) = free[place];
            states[place] += 1;
            cell += stride;
            if states[place] < arity {
                break;
            }
            states[place] = 0;
            cell -= stride * arity;
        }
    }
}
