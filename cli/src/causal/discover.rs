//! `caveat causal discover`: trials go in; a model comes out, with what it does not know.

use ::causal::bootstrap::strengths;
use ::causal::count::Counter;
use ::causal::discover::{Config, Discovery, discover};
use ::causal::estimate::estimate;
use ::causal::file::json;
use ::causal::knowledge::Knowledge;
use ::causal::network::{Goal, Network};
use ::causal::pattern::question;
use ::causal::score::Score;
use ::causal::stream::{self, Stream};
use ::causal::variable::{State, VariableId};

use super::{linear, model, trials};
use crate::args::causal::{Discover, Format, Learner, Method};
use crate::exit::Exit;
use crate::files::{self, Complaint};
use crate::terminal::Terminal;

/// Runs the verb.
pub fn run(arguments: &Discover, terminal: &mut Terminal) -> Result<Exit, Complaint> {
    if arguments.learner.method == Method::Notears {
        return linear::run(arguments, terminal);
    }
    let config = config(&arguments.learner)?;
    let estimator = model::estimator(&arguments.estimate)?;
    if arguments.stream && arguments.bootstrap.is_some() {
        return Err(Complaint::new(
            "what is not held cannot be resampled: `--bootstrap` needs the trials in memory",
        ));
    }
    let source = trials::open(&arguments.trials)?;
    let declared = trials::declared(&arguments.trials, Some(&arguments.known), &*source)?;
    let variables = trials::states(&arguments.trials, &declared, &*source, terminal)?;
    let knowledge = trials::knowledge(&arguments.known)?.with_roles(&variables);
    let policy = trials::policy(arguments.trials.missing, arguments.trials.outside);
    let learn = |counter: &dyn Counter| -> Result<(Discovery, Network), Complaint> {
        let found = discover(counter, &knowledge, &config)?;
        let network = estimate(counter, &found.graph, estimator)?;
        Ok((found, network))
    };
    #[cfg(feature = "datafusion")]
    let elsewhere =
        super::cluster::counted(&arguments.engine, &arguments.trials, &variables, terminal, learn)?;
    #[cfg(not(feature = "datafusion"))]
    let elsewhere: Option<(Discovery, Network)> = None;
    let (found, mut network, table) = if let Some((found, network)) = elsewhere {
        (found, network, None)
    } else if arguments.stream {
        let stream = Stream::new(&*source, &variables, policy)?;
        trials::tell_dropped(stream.dropped(), terminal);
        let (found, network) = learn(&stream)?;
        terminal.say(format_args!("the trials were read {} times", stream.readings()));
        (found, network, None)
    } else {
        let (table, dropped) = stream::table(&*source, &variables, policy)?;
        trials::tell_dropped(dropped, terminal);
        let (found, network) = learn(&table)?;
        (found, network, Some(table))
    };
    describe(&mut network, &found, &knowledge, arguments);
    if let (Some(samples), Some(table)) = (arguments.bootstrap, &table) {
        network.about.strengths = strengths(table, &knowledge, &config, samples, arguments.seed)?;
    }
    deliver(network, arguments, terminal, |network, terminal| tell(network, &found, terminal))
}

/// Gives a learned network its goal, writes and draws it where that was asked for, and tells it.
pub fn deliver(
    mut network: Network,
    arguments: &Discover,
    terminal: &mut Terminal,
    tell: impl FnOnce(&Network, &mut Terminal),
) -> Result<Exit, Complaint> {
    if let Some(goal) = trials::goal(&arguments.trials)? {
        network = with_goal(network, goal)?;
    }
    if let Some(path) = &arguments.output {
        model::write(&network, path)?;
    }
    if let Some(path) = &arguments.svg {
        model::draw(&network, false, path)?;
    }
    match arguments.output_format {
        Format::Json => terminal.data(json::write(&network)),
        Format::Full => tell(&network, terminal),
    }
    Ok(Exit::Done)
}

/// Writes into a network where it comes from.
fn describe(network: &mut Network, found: &Discovery, knowledge: &Knowledge, arguments: &Discover) {
    let name = |id: VariableId| network.variable(id).name.clone();
    let undirected =
        found.pattern.undirected().iter().map(|&(one, other)| (name(one), name(other))).collect();
    let about = &mut network.about;
    about.undirected = undirected;
    about.files = arguments.trials.files.iter().map(|path| files::name(path)).collect();
    about.method = Some(found.method.to_string());
    about.score = Some(found.score);
    about.knowledge = (*knowledge != Knowledge::default()).then(|| knowledge.clone());
    about.notes.clone_from(&found.notes);
}

/// Says what success is; an outcome that never or always succeeds is no goal to learn for.
pub fn with_goal(network: Network, goal: Goal) -> Result<Network, Complaint> {
    let id = model::find(&network, &goal.variable)?;
    let variable = network.variable(id);
    let state = variable.state_of_word(&goal.state);
    let counts = network.table(id).counts.as_deref().unwrap_or_default();
    let seen = |state: State| {
        counts.is_empty()
            || counts.chunks_exact(variable.arity()).any(|row| row[usize::from(state)] > 0)
    };
    if !state.is_some_and(seen) {
        let message = format!("`{}` is never {} in these trials", goal.variable, goal.state);
        let states = variable.labels().join(", ");
        let help = format!(
            "its states are {states}; without a success nothing can be learned of how to succeed"
        );
        return Err(Complaint::with_help(message, help));
    }
    Ok(network.with_goal(goal)?)
}

fn tell(network: &Network, found: &Discovery, terminal: &mut Terminal) {
    let name = |id: VariableId| network.variable(id).name.as_str();
    let trials = network.about.trials.unwrap_or(0);
    terminal.line(format_args!(
        "{} variables, {trials} trials, by {}: score {:.3}",
        network.variables().len(),
        network.about.method.as_deref().unwrap_or("hand"),
        found.score
    ));
    if let Some(most) = found.narrowed(network.variables().len()) {
        terminal.line(format_args!(
            "  best among graphs in which a variable has at most {most} causes"
        ));
    }
    let strength = |from: &str, to: &str| {
        let same = |one: &&::causal::network::Strength| {
            (one.from == from && one.to == to) || (one.from == to && one.to == from)
        };
        network.about.strengths.iter().find(same).map_or_else(String::new, |one| {
            format!("   in {:.0} % of the resampled tables", one.joined * 100.0)
        })
    };
    for (from, to) in found.graph.arcs() {
        let sure = found.pattern.parents(to).contains(from);
        let sign = if sure { "->" } else { "--" };
        terminal.line(format_args!(
            "  {} {sign} {}{}",
            name(from),
            name(to),
            strength(name(from), name(to))
        ));
    }
    let alone: Vec<&str> = network
        .ids()
        .filter(|&id| found.graph.arcs().all(|(from, to)| from != id && to != id))
        .map(name)
        .collect();
    if !alone.is_empty() {
        terminal.line(format_args!("  without an arc: {}", alone.join(", ")));
    }
    for (one, other) in found.pattern.undirected() {
        terminal.line(question(name(one), name(other)));
    }
    for note in &found.notes {
        terminal.line(format_args!("note: {note}"));
    }
}

/// How to learn, from the command line.
pub fn config(learner: &Learner) -> Result<Config, Complaint> {
    let score = match learner.score.split_once(':') {
        None if learner.score == "bic" => Score::Bic,
        None if learner.score == "aic" => Score::Aic,
        None if learner.score == "k2" => Score::K2,
        None if learner.score == "bdeu" => Score::Bdeu(1.0),
        Some(("bdeu", weight)) => Score::Bdeu(
            weight
                .parse()
                .map_err(|_| Complaint::new(format!("`{weight}` is no number of trials")))?,
        ),
        _ => {
            return Err(Complaint::with_help(
                format!("nobody knows the score `{}`", learner.score),
                "there are bic, aic, k2 and bdeu:WEIGHT",
            ));
        }
    };
    let Method::Of(method) = learner.method else {
        let message = "`notears` learns from quantities, not from states";
        return Err(Complaint::with_help(message, "`caveat causal discover` takes it"));
    };
    Ok(Config {
        method,
        score,
        test: learner.test.0,
        alpha: learner.alpha,
        max_parents: learner.max_parents,
    })
}
