//! `caveat causal discover --method notears`: trials of quantities go in; a linear graph comes out, and a model with its arcs.

use ::causal::estimate::estimate;
use ::causal::notears::{Config, learn};
use ::causal::recipe::Declared;
use ::causal::sample::{MOST, Sample};
use ::causal::stream;
use ::causal::survey::{Kind, survey};
use ::causal::variable::VariableId;

use super::{discover, model, trials};
use crate::args::causal::Discover;
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
    let surveyed = survey(&*source, &declared)?;
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
    let sample = Sample::draw(&*source, &all, MOST)?;
    let columns: Vec<Vec<f64>> = (0..declared.len()).map(|at| sample.numbers(at)).collect();
    let found = learn(&columns, &Config::default())?;
    let variables = trials::states(&arguments.trials, &declared, &*source, terminal)?;
    let (table, dropped) = stream::table(
        &*source,
        &variables,
        trials::policy(arguments.trials.missing, arguments.trials.outside),
    )?;
    trials::tell_dropped(dropped, terminal);
    let mut network = estimate(&table, &found.graph, estimator)?;
    network.about.files = arguments.trials.files.iter().map(|path| files::name(path)).collect();
    network.about.method = Some("notears".to_owned());
    discover::deliver(network, arguments, terminal, |network, terminal| {
        let name = |id: VariableId| &network.variable(id).name;
        let head = format!("{} variables, {} trials, by notears", declared.len(), sample.len());
        terminal.line(head);
        for (from, to) in found.graph.arcs() {
            let weight = found.weights[(from.index(), to.index())];
            terminal.line(format_args!("  {} -> {}   {weight:+.3}", name(from), name(to)));
        }
    })
}
