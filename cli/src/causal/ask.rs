//! A model and what a command line says of a situation go in; the question comes out that explanation and prevention ask.

use std::path::Path;

use ::causal::contrast::{Answer, Question};
use ::causal::derive::Derivation;
use ::causal::network::Network;
use ::causal::situation::{Known, Situation, column, situations, state, typical};
use ::causal::variable::{Role, State, VariableId};
use ::causal::words::{Audience, Time, Vocabulary, explain, rounded};
use serde_json::{Value, json};

use super::{model, trials};
use crate::args::causal::{Ask, Listener};
use crate::files::{self, Complaint};

/// As many situations as a search looks at.
const MOST: usize = 1_000_000;

/// What the answers to a question are told with.
pub struct Asked {
    /// The model.
    pub network: Network,
    /// What success is.
    pub goal: (VariableId, State),
    /// What may be changed, with the cost of a step.
    pub free: Vec<(VariableId, f64)>,
    /// The words of variables.
    pub vocabulary: Vocabulary,
    /// To whom it is told.
    pub audience: Audience,
}

impl Asked {
    /// Reads the model, and what is said of its variables.
    pub fn new(arguments: &Ask) -> Result<Self, Complaint> {
        if !(0.0..1.0).contains(&arguments.threshold) {
            let message =
                format!("the threshold is {}; it is a probability below 1", arguments.threshold);
            return Err(Complaint::new(message));
        }
        let network = model::read(&arguments.model)?;
        let goal = model::goal(&network, arguments.goal.as_deref(), "", "--goal")?;
        let free = free(&network, goal.0, arguments)?;
        let vocabulary = vocabulary(arguments)?;
        let audience = match arguments.audience {
            Listener::User => Audience::User,
            Listener::Engineer => Audience::Engineer,
        };
        Ok(Self { network, goal, free, vocabulary, audience })
    }

    /// The question for a situation.
    pub fn question<'a>(&'a self, arguments: &Ask, situation: &'a Situation) -> Question<'a> {
        Question {
            network: &self.network,
            goal: self.goal,
            situation,
            free: self.free.clone(),
            threshold: arguments.threshold,
            least_trials: arguments.least_trials,
            most: MOST,
        }
    }

    /// The columns that variables come from.
    fn columns(&self) -> Vec<&str> {
        let own = self.network.variables().iter().map(column);
        let made = self.network.variables().iter().filter_map(|one| one.from.as_ref());
        own.chain(made.flat_map(Derivation::columns)).collect()
    }

    /// Whether the situation is one in which the goal was reached.
    pub fn succeeded(&self, situation: &Situation) -> bool {
        let reached = state(self.network.variable(self.goal.0), situation);
        reached == Ok(Some(self.goal.1))
    }

    /// Success in words: `onTop = 1`.
    pub fn success(&self) -> String {
        let variable = self.network.variable(self.goal.0);
        format!("{} = {}", variable.name, variable.label(self.goal.1))
    }

    /// What was wrong, as a sentence.
    pub fn sentence(&self, answer: &Answer, time: Time) -> String {
        explain(&self.network, &answer.changes, &self.vocabulary, self.audience, time)
    }

    /// An answer as JSON.
    pub fn json(&self, answer: &Answer, time: Time) -> Value {
        let changes: Vec<Value> = answer
            .changes
            .iter()
            .map(|change| {
                let variable = self.network.variable(change.variable);
                json!({
                    "variable": variable.name,
                    "from": variable.label(change.from),
                    "to": variable.label(change.to),
                    "value": value(&typical(variable, change.to)),
                })
            })
            .collect();
        json!({
            "sentence": self.sentence(answer, time),
            "changes": changes,
            "probability": answer.probability,
            "cost": answer.cost,
        })
    }
}

/// A value as JSON.
pub fn value(known: &Known) -> Value {
    match known {
        Known::Number(number) => json!(number),
        Known::Word(word) => json!(word),
        Known::Series(series) => json!(series),
    }
}

/// A value for a person.
pub fn text(known: &Known) -> String {
    match known {
        Known::Number(number) => rounded(*number),
        Known::Word(word) => word.clone(),
        Known::Series(series) => {
            let values: Vec<String> = series.iter().map(|one| rounded(*one)).collect();
            format!("[{}]", values.join(", "))
        }
    }
}

/// What may be changed: what is named, or else what is set before a trial, or else whatever nothing causes; less what is fixed. What is
/// made of other variables follows them.
fn free(
    network: &Network,
    goal: VariableId,
    arguments: &Ask,
) -> Result<Vec<(VariableId, f64)>, Complaint> {
    let find = |name: &String| model::find(network, name);
    let named = arguments.free.iter().map(find).collect::<Result<Vec<_>, _>>()?;
    let fixed = arguments.fixed.iter().map(find).collect::<Result<Vec<_>, _>>()?;
    let own = |id: &VariableId| {
        !matches!(&network.variable(*id).from, Some(Derivation::Of(_))) && *id != goal
    };
    let set = |id: &VariableId| network.variable(*id).role == Some(Role::Treatment);
    let mut free: Vec<VariableId> = if !named.is_empty() {
        named
    } else if network.ids().any(|id| set(&id)) {
        network.ids().filter(|id| set(id) && own(id)).collect()
    } else {
        network.ids().filter(|id| network.graph().parents(*id).is_empty() && own(id)).collect()
    };
    free.retain(|id| !fixed.contains(id));
    if free.is_empty() {
        let message = "there is no variable that anybody may change";
        return Err(Complaint::with_help(
            message,
            "`--free` names some, `--fixed` takes some away",
        ));
    }
    let mut costs = vec![1.0; network.variables().len()];
    for text in &arguments.weight {
        let (name, cost) = trials::pair(text, '=', "NAME=COST")?;
        let id = model::find(network, name)?;
        let cost = cost.parse().ok().filter(|cost: &f64| cost.is_finite() && *cost > 0.0);
        costs[id.index()] =
            cost.ok_or_else(|| Complaint::new(format!("`{text}`: a step costs more than 0")))?;
    }
    Ok(free.into_iter().map(|id| (id, costs[id.index()])).collect())
}

/// The words: of the file that is named, or of `cube.words.json` beside `cube.cbn.json`, or none.
fn vocabulary(arguments: &Ask) -> Result<Vocabulary, Complaint> {
    let beside = || {
        let name = arguments.model.file_name()?.to_str()?;
        let stem = name
            .strip_suffix(".cbn.json")
            .or_else(|| name.rsplit_once('.').map(|(stem, _)| stem))?;
        Some(arguments.model.with_file_name(format!("{stem}.words.json")))
            .filter(|path| path.is_file())
    };
    let Some(path) = arguments.words.clone().or_else(beside) else {
        return Ok(Vocabulary::default());
    };
    serde_json::from_str(&files::read(&path)?.text)
        .map_err(|error| Complaint::new(format!("{}: {error}", files::name(&path))))
}

/// The situation that a command line names: values, a row of a file, or values in place of some of a row.
pub fn situation(
    asked: &Asked,
    arguments: &Ask,
    row: Option<usize>,
) -> Result<Situation, Complaint> {
    let mut situation = match (&arguments.trials, row) {
        (Some(path), Some(row)) => {
            let all = rows(path)?;
            let many = all.len();
            row.checked_sub(1).and_then(|at| all.into_iter().nth(at)).ok_or_else(|| {
                Complaint::new(format!(
                    "{} has {many} trials, and none with number {row}",
                    files::name(path)
                ))
            })?
        }
        (Some(_), None) => {
            let message = "which of the trials is it?";
            return Err(Complaint::with_help(message, "`--row 1` is the first"));
        }
        (None, _) => Situation::new(),
    };
    for text in &arguments.at {
        let (name, value) = trials::pair(text, '=', "NAME=VALUE")?;
        if !asked.columns().contains(&name) {
            return Err(trials::no_variable(name, asked.columns()));
        }
        situation.insert(name.to_owned(), Known::read(value));
    }
    if situation.is_empty() {
        let message = "nothing is known of the situation";
        return Err(Complaint::with_help(
            message,
            "name its values with `--at`, or a trial with `--trials` and `--row`",
        ));
    }
    Ok(situation)
}

/// The trials of a file.
pub fn rows(path: &Path) -> Result<Vec<Situation>, Complaint> {
    Ok(situations(&*trials::open_files(&[path.to_owned()])?)?)
}
