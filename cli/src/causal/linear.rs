//! `caveat causal discover --method notears`: trials of quantities go in; a linear graph comes out, and a model with its arcs.

use ::causal::estimate::estimate;
use ::causal::file::json;
use ::causal::notears::{Config, learn};
use ::causal::recipe::Declared;
use ::causal::sample::{MOST, Sample};
use ::causal::stream;
use ::causal::survey::{Kind, survey};

use super::{discover, model, trials};
use crate::args::causal::{Discover, Format};
use crate::exit::Exit;
use crate::files::{self, Complaint};
use crate::terminal::Terminal;

/// Runs the verb with this learner.
pub fn run(arguments: &Discover, terminal: &mut Terminal) -> Result<Exit, Complaint> {
    let known = &arguments.known;
    let knows = known.knowledge.is_some()
        || [&known.set, &known.tier, &known.require, &known.forbid]
            .iter()
            .any(|some| !some.is_empty());
    if knows || arguments.stream || arguments.bootstrap.is_some() {
        let message = "`notears` takes no knowledge, no `--stream` and no `--bootstrap`";
        return Err(Complaint::with_help(message, "the other learners do"));
    }
    let estimator = model::estimator(&arguments.estimate)?;
    let source = trials::open(&arguments.trials)?;
    let declared = trials::declared(&arguments.trials, None, &*source)?;
    let surveyed = survey(&*source, &declared).map_err(|fault| trials::complain(&fault))?;
    for (one, seen) in declared.iter().zip(&surveyed.variables) {
        if !matches!(seen.kind, Kind::Numbers { .. }) {
            let message =
                format!("`{}` is no quantity, and `notears` takes only quantities", one.name);
            return Err(Complaint::with_help(
                message,
                format!("leave it out: `--leave-out {}`", one.name),
            ));
        }
    }
    let all: Vec<&Declared> = declared.iter().collect();
    let sample = Sample::draw(&*source, &all, MOST).map_err(|fault| trials::complain(&fault))?;
    let columns: Vec<Vec<f64>> = (0..declared.len()).map(|at| sample.numbers(at)).collect();
    let found =
        learn(&columns, &Config::default()).map_err(|error| Complaint::new(error.to_string()))?;
    let variables = trials::states(&arguments.trials, &declared, &*source, terminal)?;
    let (table, dropped) = stream::table(&*source, &variables, trials::policy(&arguments.trials))
        .map_err(|fault| trials::complain(&fault))?;
    trials::tell_dropped(dropped, terminal);
    let mut network = estimate(&table, &found.graph, estimator)
        .map_err(|error| Complaint::new(error.to_string()))?;
    network.about.files = arguments.trials.files.iter().map(|path| files::name(path)).collect();
    network.about.method = Some("notears".to_owned());
    if let Some(goal) = trials::goal(&arguments.trials)? {
        network = discover::with_goal(network, goal, Some(&table))?;
    }
    if let Some(path) = &arguments.output {
        model::write(&network, path)?;
    }
    if let Some(path) = &arguments.svg {
        model::draw(&network, path)?;
    }
    if arguments.output_format == Format::Json {
        terminal.data(json::write(&network));
        return Ok(Exit::Done);
    }
    terminal.line(format_args!(
        "{} variables, {} trials, by notears",
        declared.len(),
        sample.len()
    ));
    for (from, to) in found.graph.arcs() {
        let weight = found.weights[(from.index(), to.index())];
        terminal.line(format_args!(
            "  {} -> {}   {weight:+.3}",
            declared[from.index()].name,
            declared[to.index()].name
        ));
    }
    Ok(Exit::Done)
}
