//! Declarations of variables and tables, as files have them, go in; a network comes out, or what is wrong with which declaration.

use crate::graph::Dag;
use crate::network::{Conditional, Network, NetworkError};
use crate::variable::{Variable, VariableId};

/// A table as a file has it.
#[derive(Debug)]
pub struct Stated {
    /// Whose table it is.
    pub child: VariableId,
    /// Its parents, in the order of the file.
    pub parents: Vec<VariableId>,
    /// The probabilities: a row for each combination of the parents in that order, the last of which runs fastest.
    pub probabilities: Vec<f64>,
    /// Where in the file it is.
    pub at: usize,
}

/// Puts a network together. An error is a message, and where in the file.
pub fn assemble(
    variables: Vec<Variable>,
    stated: Vec<Stated>,
    end: usize,
) -> Result<Network, (String, usize)> {
    let mut tables: Vec<Option<Stated>> = variables.iter().map(|_| None).collect();
    for one in stated {
        let at = one.at;
        let name = &variables[one.child.index()].name;
        let slot = &mut tables[one.child.index()];
        if slot.is_some() {
            return Err((format!("`{name}` has a second table"), at));
        }
        *slot = Some(one);
    }
    let mut parents = Vec::with_capacity(variables.len());
    let mut conditionals = Vec::with_capacity(variables.len());
    let mut places = Vec::with_capacity(variables.len());
    for (table, variable) in tables.into_iter().zip(&variables) {
        let Some(table) = table else {
            return Err((
                format!("the file ends, and `{}` has no table of probabilities", variable.name),
                end,
            ));
        };
        places.push(table.at);
        let probabilities = sorted(&table, &variables);
        parents.push(table.parents);
        conditionals.push(Conditional { probabilities, ..Conditional::default() });
    }
    let graph = Dag::new(parents).map_err(|cycle| {
        let place = cycle.0.iter().map(|id| places[id.index()]).min().unwrap_or(0);
        (Network::cycle(&variables, &cycle).to_string(), place)
    })?;
    let names: Vec<String> = variables.iter().map(|one| one.name.clone()).collect();
    Network::new(variables, graph, conditionals).map_err(|error| {
        let whose = match &error {
            NetworkError::Row { variable, .. } | NetworkError::Size { variable, .. } => {
                Some(variable)
            }
            _ => None,
        };
        let place = whose.and_then(|whose| names.iter().position(|name| name == whose));
        (error.to_string(), place.map_or(0, |at| places[at]))
    })
}

/// The probabilities with the parents in rising order.
fn sorted(table: &Stated, variables: &[Variable]) -> Vec<f64> {
    if table.parents.is_sorted() {
        return table.probabilities.clone();
    }
    let arity = |id: VariableId| variables[id.index()].arity();
    let child = arity(table.child);
    let mut order: Vec<usize> = (0..table.parents.len()).collect();
    order.sort_by_key(|&at| table.parents[at]);
    // How far apart the states of each parent lie in the table as it is stated.
    let mut strides = vec![child; table.parents.len()];
    for at in (0..table.parents.len() - 1).rev() {
        strides[at] = strides[at + 1] * arity(table.parents[at + 1]);
    }
    let rows = table.probabilities.len() / child;
    let mut probabilities = Vec::with_capacity(table.probabilities.len());
    for row in 0..rows {
        let (mut rest, mut start) = (row, 0);
        for &at in order.iter().rev() {
            let arity = arity(table.parents[at]);
            start += rest % arity * strides[at];
            rest /= arity;
        }
        probabilities.extend_from_slice(&table.probabilities[start..start + child]);
    }
    probabilities
}
