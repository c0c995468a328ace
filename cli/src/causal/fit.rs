//! `caveat causal fit`: a graph and trials go in; the model with the probabilities of these trials comes out.

use ::causal::count::Counter;
use ::causal::estimate::{Estimator, estimate};
use ::causal::graph::Dag;
use ::causal::network::Network;
use ::causal::stream::{self, Stream};
use ::causal::variable::Variable;

use super::{discover, model, trials};
use crate::args::causal::Fit;
use crate::exit::Exit;
use crate::files::{self, Complaint};
use crate::terminal::Terminal;

/// Runs the verb.
pub fn run(arguments: &Fit, terminal: &mut Terminal) -> Result<Exit, Complaint> {
    let given = arguments.model.as_deref().map(model::read).transpose()?;
    let prior = arguments.prior.as_deref().map(model::read).transpose()?;
    let (variables, graph): (Vec<Variable>, Dag) = if let Some(network) = &given {
        (network.variables().to_vec(), network.graph().clone())
    } else {
        let source = trials::open(&arguments.trials)?;
        let declared = trials::declared(&arguments.trials, None, &*source)?;
        let variables = trials::states(&arguments.trials, &declared, &*source, terminal)?;
        let graph = model::graph(&variables, &arguments.arcs)?;
        (variables, graph)
    };
    let estimator = match (&prior, arguments.weight) {
        (Some(prior), Some(weight)) => Estimator::Weighted { weight, prior },
        _ => model::estimator(&arguments.estimate)?,
    };
    let policy = trials::policy(arguments.trials.missing, arguments.trials.outside);
    let fit = |counter: &dyn Counter| -> Result<Network, Complaint> {
        Ok(estimate(counter, &graph, estimator)?)
    };
    #[cfg(feature = "datafusion")]
    let elsewhere =
        super::cluster::counted(&arguments.engine, &arguments.trials, &variables, terminal, fit)?;
    #[cfg(not(feature = "datafusion"))]
    let elsewhere: Option<Network> = None;
    let network = if let Some(network) = elsewhere {
        network
    } else if arguments.stream {
        let source = trials::open(&arguments.trials)?;
        let stream = Stream::unread(&*source, &variables, policy)?;
        let network = fit(&stream)?;
        trials::tell_dropped(stream.dropped(), terminal);
        network
    } else {
        let source = trials::open(&arguments.trials)?;
        let (table, dropped) = stream::table(&*source, &variables, policy)?;
        trials::tell_dropped(dropped, terminal);
        fit(&table)?
    };
    let goal = trials::goal(&arguments.trials)?
        .or_else(|| given.as_ref().and_then(|given| given.goal.clone()));
    let mut network = match goal {
        Some(goal) => discover::with_goal(network, goal)?,
        None => network,
    };
    network.about.files = arguments.trials.files.iter().map(|path| files::name(path)).collect();
    if let Some(given) = &given {
        let (rows, estimated) = (network.about.trials, network.about.estimate.clone());
        let files = std::mem::take(&mut network.about.files);
        network.about = ::causal::network::About {
            files,
            trials: rows,
            estimate: estimated,
            transfer: None,
            ..given.about.clone()
        };
    } else {
        network.about.method = Some("hand".to_owned());
    }
    model::write(&network, &arguments.output)?;
    let unseen: usize = network
        .ids()
        .filter_map(|id| Some((network.table(id).counts.as_ref()?, network.variable(id).arity())))
        .map(|(counts, arity)| {
            counts.chunks_exact(arity).filter(|row| row.iter().all(|&count| count == 0)).count()
        })
        .sum();
    let rows: usize = network.ids().filter_map(|id| network.rows(id)).sum();
    terminal.line(format_args!(
        "{} trials, {} probabilities in {rows} rows, of which {unseen} no trial shows",
        network.about.trials.unwrap_or(0),
        network.parameters()
    ));
    Ok(Exit::Done)
}
