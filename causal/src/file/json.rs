//! The format of our own, in JSON: everything that is known of a network. `docs/network.schema.json` has its schema.

use serde::{Deserialize, Serialize};

use super::Fault;
use crate::graph::Dag;
use crate::network::{About, Conditional, Goal, Network};
use crate::variable::{Variable, VariableId, named, unknown};

/// The version of the format that is read and written.
pub const VERSION: u32 = 1;

#[derive(Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
struct File {
    #[serde(rename = "caveat-network")]
    version: u32,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    goal: Option<Goal>,
    variables: Vec<Variable>,
    tables: Vec<Table>,
    #[serde(default)]
    about: About,
}

#[derive(Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
struct Table {
    variable: String,
    parents: Vec<String>,
    /// A row for each combination of the states of the parents, the last of which runs fastest; null where nothing is known.
    probabilities: Vec<Option<Vec<f64>>>,
    /// How many trials have each state, row by row.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    counts: Option<Vec<Vec<u64>>>,
}

/// Writes a network.
pub fn write(network: &Network) -> String {
    let name = |id: VariableId| network.variable(id).name.clone();
    let tables = network
        .ids()
        .map(|id| {
            let rows = network.rows(id).expect("the rows of a network are numbered");
            Table {
                variable: name(id),
                parents: network.graph().parents(id).iter().map(|&parent| name(parent)).collect(),
                probabilities: (0..rows)
                    .map(|row| network.row(id, row).map(<[f64]>::to_vec))
                    .collect(),
                counts: network.table(id).counts.as_ref().map(|counts| {
                    counts.chunks_exact(network.variable(id).arity()).map(<[u64]>::to_vec).collect()
                }),
            }
        })
        .collect();
    let file = File {
        version: VERSION,
        goal: network.goal.clone(),
        variables: network.variables().to_vec(),
        tables,
        about: network.about.clone(),
    };
    laid_out(&serde_json::to_string(&file).expect("a network is JSON"))
}

/// Dense JSON, laid out so that what fits on a line is on one.
fn laid_out(dense: &str) -> String {
    let mut text = String::new();
    lay_out(dense, 0, &mut text);
    text.push('\n');
    text
}

/// As many characters as a line may have.
const LINE: usize = 100;

fn lay_out(dense: &str, indent: usize, text: &mut String) {
    let composed = dense.starts_with(['{', '[']);
    if !composed || dense.len() + 2 * indent <= LINE {
        text.push_str(dense);
        return;
    }
    text.push_str(&dense[..1]);
    for (at, item) in items(&dense[1..dense.len() - 1]).into_iter().enumerate() {
        text.push_str(if at == 0 { "\n" } else { ",\n" });
        text.push_str(&"  ".repeat(indent + 1));
        let (key, value) = item.split_at(key_length(item));
        text.push_str(key);
        if !key.is_empty() {
            text.push(' ');
        }
        lay_out(value, indent + 1, text);
    }
    text.push('\n');
    text.push_str(&"  ".repeat(indent));
    text.push_str(&dense[dense.len() - 1..]);
}

/// What stands between the commas of dense JSON.
fn items(inside: &str) -> Vec<&str> {
    let (mut items, mut start, mut depth) = (Vec::new(), 0, 0);
    let (mut quoted, mut escaped) = (false, false);
    for (at, one) in inside.bytes().enumerate() {
        match one {
            _ if escaped => escaped = false,
            b'\\' => escaped = true,
            b'"' => quoted = !quoted,
            _ if quoted => {}
            b'{' | b'[' => depth += 1,
            b'}' | b']' => depth -= 1,
            b',' if depth == 0 => {
                items.push(&inside[start..at]);
                start = at + 1;
            }
            _ => {}
        }
    }
    items.push(&inside[start..]);
    items
}

/// How long the key of a field is, with its colon; nothing for what is no field.
fn key_length(item: &str) -> usize {
    let Some(rest) = item.strip_prefix('"') else { return 0 };
    let mut escaped = false;
    let end = rest.bytes().position(|one| {
        let ends = one == b'"' && !escaped;
        escaped = one == b'\\' && !escaped;
        ends
    });
    match end {
        Some(end) if item[end + 2..].starts_with(':') => end + 3,
        _ => 0,
    }
}

/// Reads a network.
pub fn read(text: &str) -> Result<Network, Fault> {
    let file: File = serde_json::from_str(text).map_err(|error| {
        let what = error.to_string();
        // The message ends in the place, which is told apart.
        let what = what.rsplit_once(" at line ").map_or(what.clone(), |(what, _)| what.to_owned());
        Fault { line: error.line(), column: error.column(), what }
    })?;
    let wrong = |what: String| Fault { line: 1, column: 1, what };
    // A network is checked as a whole, so that what is wrong is named and has the place where its name stands first.
    let near = |name: &str, what: String| {
        let spaced = || text.find(&format!("\"variable\": \"{name}\""));
        let place = text.find(&format!("\"variable\":\"{name}\"")).or_else(spaced);
        Fault::at(text, place.unwrap_or(0), what)
    };
    if file.version != VERSION {
        return Err(wrong(format!(
            "this is version {} of the format; version {VERSION} can be read",
            file.version
        )));
    }
    let id = |name: &str, of: &str| {
        named(&file.variables, name).ok_or_else(|| near(of, unknown(name, &file.variables)))
    };
    let mut parents = vec![Vec::new(); file.variables.len()];
    let mut tables: Vec<Option<Conditional>> = vec![None; file.variables.len()];
    for table in &file.tables {
        let child = id(&table.variable, &table.variable)?;
        let own: Vec<VariableId> =
            table.parents.iter().map(|name| id(name, &table.variable)).collect::<Result<_, _>>()?;
        if !own.is_sorted_by(|one, other| one < other) {
            let what = "the parents should be named once each, in the order of the variables";
            return Err(near(&table.variable, format!("`{}`: {what}", table.variable)));
        }
        if tables[child.index()].is_some() {
            return Err(near(&table.variable, format!("`{}` has a second table", table.variable)));
        }
        let arity = file.variables[child.index()].arity();
        let mut conditional = Conditional {
            counts: table.counts.as_ref().map(|rows| rows.concat()),
            ..Conditional::default()
        };
        for (row, probabilities) in table.probabilities.iter().enumerate() {
            match probabilities {
                Some(probabilities) if probabilities.len() == arity => {
                    conditional.probabilities.extend(probabilities);
                }
                Some(probabilities) => {
                    let what = format!(
                        "row {} of the table of `{}` has {} probabilities; there are {arity} states",
                        row + 1,
                        table.variable,
                        probabilities.len()
                    );
                    return Err(near(&table.variable, what));
                }
                None => {
                    conditional.unknown.push(row as u32);
                    conditional.probabilities.extend(std::iter::repeat_n(0.0, arity));
                }
            }
        }
        let rows = table.probabilities.len();
        if table.counts.as_ref().is_some_and(|counts| {
            counts.len() != rows || counts.iter().any(|row| row.len() != arity)
        }) {
            let what = format!(
                "the `counts` of `{}` are not {rows} rows of {arity}, as its probabilities are",
                table.variable
            );
            return Err(near(&table.variable, what));
        }
        parents[child.index()] = own;
        tables[child.index()] = Some(conditional);
    }
    if let Some(at) = tables.iter().position(Option::is_none) {
        let name = &file.variables[at].name;
        return Err(wrong(format!("`{name}` has no table of probabilities")));
    }
    let graph = Dag::new(parents).map_err(|cycle| {
        let first = &file.variables[cycle.0[0].index()].name;
        near(first, Network::cycle(&file.variables, &cycle).to_string())
    })?;
    let mut network = Network::new(file.variables, graph, tables.into_iter().flatten().collect())
        .map_err(|error| wrong(error.to_string()))?;
    network.about = file.about;
    match file.goal {
        None => Ok(network),
        Some(goal) => network.with_goal(goal).map_err(|error| wrong(error.to_string())),
    }
}
