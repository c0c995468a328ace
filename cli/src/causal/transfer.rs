//! `caveat causal transfer`: a model that knows something and one that is to know it go in; the second with a prior from the first comes
//! out, or how much that prior is worth.

mod comparison;

use std::path::PathBuf;

use ::causal::count::Counter;
use ::causal::estimate::{Estimator, estimate};
use ::causal::network::{About, Network};
use ::causal::stream;
use ::causal::table::Table;
use ::causal::transfer::curve::columns;
use ::causal::transfer::relation::{Pair, Relation};
use ::causal::transfer::{
    Ends, Provenance, Strategy, TransferError, estimated, prior, related, with_table,
};
use ::causal::variable::{Variable, VariableId};

use super::{discover, model, trials};
use crate::args::causal::Trials;
use crate::args::causal::transfer::Transfer;
use crate::exit::Exit;
use crate::files::{self, Complaint};
use crate::terminal::Terminal;

/// Runs the verb.
pub fn run(arguments: &Transfer, terminal: &mut Terminal) -> Result<Exit, Complaint> {
    let source = model::read(&arguments.source)?;
    let of = files::name(&arguments.source);
    let said = arguments.source_goal.as_deref();
    let source_goal = model::goal(&source, said, &format!("{of}: "), "--source-goal")?;
    let (target, by_hand) = target(arguments, terminal)?;
    let name =
        arguments.target.as_ref().map_or_else(|| "the trials".to_owned(), |path| files::name(path));
    let said = arguments.goal.as_deref();
    let target_goal = model::goal(&target, said, &format!("{name}: "), "--goal")?;
    let ends = Ends { source: &source, source_goal, target: &target, target_goal };
    let relation = match &arguments.relate {
        None => related::relation(&ends),
        Some(path) => Relation::read(&files::read(path)?.text)
            .map_err(|what| Complaint::new(format!("{}: {what}", files::name(path))))?,
    };
    if arguments.relations_only {
        terminal.data(relation.write());
        if relation.direct.is_empty() && relation.cross.is_empty() {
            terminal.say("note: no cause of the one was found among those of the other");
        }
        return Ok(Exit::Done);
    }
    let own = if arguments.trials.is_empty() || arguments.zero_shot {
        None
    } else {
        Some(read(arguments, &arguments.trials, &ends, terminal)?)
    };
    if !arguments.test.is_empty() {
        comparison::run(arguments, &ends, &relation, own.as_ref(), terminal)?;
        if arguments.output.is_none() {
            return Ok(Exit::Done);
        }
    }
    let counts: Option<Vec<u64>> = match &own {
        _ if arguments.zero_shot => None,
        Some(table) => {
            let all: Vec<VariableId> = table.ids().collect();
            Some(table.count(&[all])?.remove(0))
        }
        None => target.table(target_goal.0).counts.clone(),
    };
    let strategy = arguments.strategy.map_or(Strategy::Minimal, |strategy| strategy.0);
    let prior = prior(&ends, &relation, strategy).map_err(explained)?;
    let arity = target.variable(target_goal.0).arity();
    let table = estimated(&prior, arguments.weight, counts.as_deref(), arity)?;
    let unknown = table.unknown.len();
    let mut network = with_table(&target, target_goal.0, table)?;
    let without = prior.rows.iter().filter(|row| row.is_none()).count();
    let state = target.variable(target_goal.0).label(target_goal.1);
    let goal_name = target.variable(target_goal.0).name.clone();
    network.goal = Some(::causal::network::Goal { variable: goal_name.clone(), state });
    network.about.transfer = Some(Provenance {
        source: files::name(&arguments.source),
        goal: source.variable(source_goal.0).name.clone(),
        variable: goal_name.clone(),
        strategy,
        weight: arguments.weight,
        rows: prior.rows.len() - without,
        without,
        relation: relation.clone(),
    });
    if own.is_some() && !by_hand {
        network.about.notes.push(format!(
            "the trials of `{goal_name}` are those of {}; all other tables are those of {name}",
            arguments.trials.iter().map(|path| files::name(path)).collect::<Vec<_>>().join(", ")
        ));
    }
    if arguments.test.is_empty() {
        let total: u64 = counts.as_ref().map_or(0, |counts| counts.iter().sum());
        terminal.line(format_args!(
            "`{goal_name}` of {name} from `{}` of {}, by {} replacement, worth {} trials in each row",
            source.variable(source_goal.0).name,
            files::name(&arguments.source),
            strategy.name(),
            arguments.weight
        ));
        tell(&relation, &prior.summed_out, terminal);
        terminal.line(format_args!(
            "{} rows: {} with a prior, {without} outside what the source knows; {total} trials of the target",
            prior.rows.len(),
            prior.rows.len() - without
        ));
        if unknown > 0 {
            terminal.line(format_args!(
                "{unknown} rows stay unknown: neither the source nor a trial says anything of them"
            ));
        }
    }
    if let Some(path) = &arguments.output {
        model::write(&network, path)?;
    }
    Ok(Exit::Done)
}

/// The target: a model, or trials with a graph by hand. Whether it is the latter.
fn target(arguments: &Transfer, terminal: &mut Terminal) -> Result<(Network, bool), Complaint> {
    if let Some(path) = &arguments.target {
        return Ok((model::read(path)?, false));
    }
    if arguments.arcs.is_empty() {
        return Err(Complaint::with_help(
            "nothing says what causes success in the target",
            "name its model after the source (`caveat causal discover` learns one), or its arcs: `--arcs xOff:onTop,yOff:onTop`",
        ));
    }
    let given = Trials {
        files: arguments.trials.clone(),
        recipe: arguments.recipe.clone(),
        cuts: arguments.cuts.clone(),
        leave_out: Vec::new(),
        missing: arguments.missing,
        outside: arguments.outside,
        goal: arguments.goal.clone(),
    };
    let source = trials::open(&given)?;
    let declared = trials::declared(&given, None, &*source)?;
    let variables = trials::states(&given, &declared, &*source, terminal)?;
    let graph = model::graph(&variables, &arguments.arcs)?;
    let (table, dropped) =
        stream::table(&*source, &variables, trials::policy(given.missing, given.outside))?;
    trials::tell_dropped(dropped, terminal);
    let mut network = estimate(&table, &graph, Estimator::Bdeu(1.0))?;
    if let Some(goal) = trials::goal(&given)? {
        network = discover::with_goal(network, goal)?;
    }
    network.about = About {
        files: arguments.trials.iter().map(|path| files::name(path)).collect(),
        method: Some("hand".to_owned()),
        ..network.about
    };
    Ok((network, true))
}

/// Reads trials over the variables that matter.
fn read(
    arguments: &Transfer,
    paths: &[PathBuf],
    ends: &Ends,
    terminal: &mut Terminal,
) -> Result<Table, Complaint> {
    let variables: Vec<Variable> =
        columns(ends).into_iter().map(|id| ends.target.variable(id).clone()).collect();
    let policy = trials::policy(arguments.missing, arguments.outside);
    let (table, dropped) = stream::table(&*trials::open_files(paths)?, &variables, policy)?;
    trials::tell_dropped(dropped, terminal);
    Ok(table)
}

/// Says which variable stands for which.
fn tell(relation: &Relation, summed_out: &[String], terminal: &mut Terminal) {
    let all = || relation.direct.iter().chain(relation.cross.iter().flatten());
    let width = |of: &dyn Fn(&Pair) -> usize| all().map(of).max().unwrap_or(0);
    let (from, to) =
        (width(&|pair| pair.source.chars().count()), width(&|pair| pair.target.chars().count()));
    let mut way = |title: String, pairs: &[Pair]| {
        if pairs.is_empty() {
            return;
        }
        terminal.line(title);
        for pair in pairs {
            let score = pair.score.map_or_else(|| "    ".to_owned(), |score| format!("{score:.2}"));
            let line = format!(
                "  {:<from$}  for  {:<to$}  {score}  {}",
                pair.source,
                pair.target,
                pair.why.as_deref().unwrap_or_default()
            );
            terminal.line(line.trim_end());
        }
    };
    way("the same".to_owned(), &relation.direct);
    for (number, pairs) in relation.cross.iter().enumerate() {
        let title = match relation.cross.len() {
            1 => "related".to_owned(),
            all => format!("related, way {} of {all}", number + 1),
        };
        way(title, pairs);
    }
    if relation.cross.is_empty() {
        terminal.line("nothing is related that is not the same: cross replacement is direct");
    }
    if !summed_out.is_empty() {
        terminal.line(format_args!(
            "nothing stands for {} of the source: it is summed out",
            summed_out.join(", ")
        ));
    }
}

/// An error with the way out, where there is one.
fn explained(error: TransferError) -> Complaint {
    match &error {
        TransferError::Unrelated { .. } => Complaint::with_help(
            error.to_string(),
            "say which stands for which: `--relations-only` prints the form, `--relate FILE` reads it",
        ),
        _ => error.into(),
    }
}
