//! The files and declarations of a command line go in; trials with the states of their variables come out.

use std::fs::File;
use std::io::Read;
use std::path::{Path, PathBuf};

use ::causal::discretize::{Discretized, declare, discretize};
use ::causal::knowledge::Knowledge;
use ::causal::network::Goal;
use ::causal::place::{Policy, Unfit};
use ::causal::recipe::{Cuts, Declared, Recipe};
use ::causal::source::Source;
use ::causal::source::csv::{Csv, Open};
use ::causal::source::parquet::{self, Parquet};
use ::causal::survey::survey;
use ::causal::variable::{Role, Variable};

use crate::args::causal::{Known, Trials, Unfit as Choice};
use crate::files::{self, Complaint};
use crate::terminal::Terminal;

/// Opens the files of trials.
pub fn open(arguments: &Trials) -> Result<Box<dyn Source>, Complaint> {
    open_files(&arguments.files)
}

/// Opens files, all of one kind.
pub fn open_files(paths: &[PathBuf]) -> Result<Box<dyn Source>, Complaint> {
    let is_parquet =
        |path: &Path| path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("parquet"));
    let parquets = paths.iter().filter(|path| is_parquet(path)).count();
    if parquets == paths.len() {
        let files = paths.iter().map(|path| {
            let own = path.clone();
            let open: parquet::Open<File> = Box::new(move || File::open(&own));
            (files::name(path), open)
        });
        let files = files.collect();
        return Ok(Box::new(Parquet::new(files)?));
    }
    if parquets > 0 {
        return Err(Complaint::new(
            "some of the files are CSV and some Parquet; one table is of one kind",
        ));
    }
    let files = paths.iter().map(|path| Ok((files::name(path), opener(path)?)));
    let files = files.collect::<Result<Vec<(String, Open)>, Complaint>>()?;
    Ok(Box::new(Csv::new(files)?))
}

/// Opens a file of CSV again and again; the standard input is kept, since it comes only once.
fn opener(path: &Path) -> Result<Open, Complaint> {
    if files::is_stdin(path) {
        let mut bytes = Vec::new();
        std::io::stdin().read_to_end(&mut bytes).map_err(|error| unreadable(path, &error))?;
        let bytes: std::sync::Arc<[u8]> = bytes.into();
        return Ok(Box::new(move || {
            Ok(Box::new(std::io::Cursor::new(bytes.clone())) as Box<dyn Read + Send>)
        }));
    }
    File::open(path).map_err(|error| unreadable(path, &error))?;
    let path = path.to_owned();
    Ok(Box::new(move || {
        Ok(Box::new(std::io::BufReader::new(File::open(&path)?)) as Box<dyn Read + Send>)
    }))
}

fn unreadable(path: &Path, error: &std::io::Error) -> Complaint {
    Complaint::new(format!("{}: {error}", files::name(path)))
}

/// What is declared of the variables: by the recipe or the columns, with what else is said of them.
pub fn declared(
    arguments: &Trials,
    known: Option<&Known>,
    source: &dyn Source,
) -> Result<Vec<Declared>, Complaint> {
    let mut declared = match &arguments.recipe {
        None => declare(source),
        Some(path) => {
            let text = files::read(path)?.text;
            let recipe = Recipe::read(&text)
                .map_err(|what| Complaint::new(format!("{}: {what}", files::name(path))))?;
            recipe.variables
        }
    };
    for name in &arguments.leave_out {
        find(&declared, name)?;
        declared.retain(|one| one.name != *name);
    }
    for text in &arguments.cuts {
        let (name, cuts) = pair(text, '=', "NAME=CUTS")?;
        let at = find(&declared, name)?;
        let cuts =
            Cuts::parse(cuts).map_err(|what| Complaint::new(format!("--cuts {text}: {what}")))?;
        declared[at].cuts = Some(cuts);
    }
    for name in known.into_iter().flat_map(|known| &known.set) {
        let at = find(&declared, name)?;
        declared[at].role = Some(Role::Treatment);
    }
    Ok(declared)
}

fn find(declared: &[Declared], name: &str) -> Result<usize, Complaint> {
    declared
        .iter()
        .position(|one| one.name == name)
        .ok_or_else(|| no_variable(name, declared.iter().map(|one| one.name.as_str())))
}

/// What to say of a name that no variable has.
pub fn no_variable<'n>(name: &str, names: impl IntoIterator<Item = &'n str>) -> Complaint {
    Complaint::misspelt(format!("there is no variable `{name}`"), name, names)
}

/// The two sides of a sign.
pub fn pair<'a>(text: &'a str, sign: char, form: &str) -> Result<(&'a str, &'a str), Complaint> {
    text.split_once(sign)
        .map(|(one, other)| (one.trim(), other.trim()))
        .filter(|(one, other)| !one.is_empty() && !other.is_empty())
        .ok_or_else(|| Complaint::new(format!("`{text}` is not of the form {form}")))
}

/// The goal, as it is written.
pub fn goal(arguments: &Trials) -> Result<Option<Goal>, Complaint> {
    let Some(text) = &arguments.goal else { return Ok(None) };
    let (variable, state) = pair(text, '=', "NAME=STATE")?;
    Ok(Some(Goal { variable: variable.to_owned(), state: state.to_owned() }))
}

/// The states of the variables, with what a person should know of them.
pub fn states(
    arguments: &Trials,
    declared: &[Declared],
    source: &dyn Source,
    terminal: &mut Terminal,
) -> Result<Vec<Variable>, Complaint> {
    let survey = survey(source, declared)?;
    for (one, surveyed) in declared.iter().zip(&survey.variables) {
        if let (Some((shard, row)), 1..) = (surveyed.first_missing, surveyed.missing)
            && arguments.missing == Choice::Refuse
        {
            let more = match surveyed.missing {
                1 => String::new(),
                all => format!(", here and in {} more trials", all - 1),
            };
            let message = format!("{}: `{}` is missing{more}", source.place(shard, row), one.name);
            return Err(Complaint::with_help(message, "`--missing drop` leaves such trials out"));
        }
    }
    let outcome = goal(arguments)?.map(|goal| goal.variable);
    let found = discretize(source, declared, &survey, outcome.as_deref())?;
    tell(&found, terminal);
    Ok(found.variables)
}

fn tell(found: &Discretized, terminal: &mut Terminal) {
    for note in &found.notes {
        terminal.say(format_args!("note: {note}"));
    }
    let Some(search) = &found.searched else { return };
    terminal.say(format_args!(
        "intervals that predict the outcome best, with {}:",
        search.predictors.join(", ")
    ));
    terminal.say("  variable         intervals  log-likelihood  accuracy  unseen");
    for trial in &search.trials {
        let chosen = search
            .variables
            .iter()
            .any(|variable| variable.name == trial.name && variable.arity() == trial.states);
        terminal.say(format_args!(
            "{} {:<16} {:>9}  {:>14.4}  {:>7.1} %  {:>4.1} %",
            if chosen { '>' } else { ' ' },
            trial.name,
            trial.states,
            trial.skill.likelihood,
            trial.skill.accuracy * 100.0,
            trial.skill.unseen * 100.0
        ));
    }
}

/// What becomes of trials that do not fit.
pub fn policy(missing: Choice, outside: Choice) -> Policy {
    let unfit = |choice| if choice == Choice::Drop { Unfit::Drop } else { Unfit::Refuse };
    Policy { missing: unfit(missing), outside: unfit(outside) }
}

/// The policy that leaves out whatever does not fit.
#[cfg(feature = "datafusion")]
pub fn dropping() -> Policy {
    Policy { missing: Unfit::Drop, outside: Unfit::Drop }
}

/// What is known before, from the command line and its file.
pub fn knowledge(known: &Known) -> Result<Knowledge, Complaint> {
    let mut knowledge = match &known.knowledge {
        None => Knowledge::default(),
        Some(path) => serde_json::from_str(&files::read(path)?.text)
            .map_err(|error| Complaint::new(format!("{}: {error}", files::name(path))))?,
    };
    for tier in &known.tier {
        knowledge.tiers.push(tier.split(',').map(|name| name.trim().to_owned()).collect());
    }
    let arc = |text: &String| {
        pair(text, ':', "CAUSE:EFFECT").map(|(one, other)| (one.to_owned(), other.to_owned()))
    };
    for text in &known.require {
        knowledge.required.push(arc(text)?);
    }
    for text in &known.forbid {
        knowledge.forbidden.push(arc(text)?);
    }
    Ok(knowledge)
}

/// Says how many trials were left out.
pub fn tell_dropped(dropped: u64, terminal: &mut Terminal) {
    if dropped > 0 {
        terminal.say(format_args!(
            "note: {dropped} trials were left out, since they have no state for some variable"
        ));
    }
}
