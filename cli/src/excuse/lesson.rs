//! Guided demonstration (definition 4 of the thesis): an excuse goes in; what a human should show comes out, and afterwards whether that was shown and whether
//! the robot can do its task now.

use std::path::Path;

use lang::execute::Executor;
use lang::model::{ActionId, Fact, Formula, ObjectId, PredicateId, Problem, Scope};
use lang::plan::{self, Plan};
use lang::validate::{self, Verdict};
use lang::write::{self, Style};
use planner::excuse::{self, Outcome};
use planner::solve::{Answer, solve};
use serde_json::json;

use super::report::Report;
use super::words::{Mood, Words, add, listed};
use crate::args::excuse::{AnswerFormat, Excuse};
use crate::exit::Exit;
use crate::files::{self, Complaint};
use crate::input::{self, Input, Reader};
use crate::limits::Watch;
use crate::terminal::Terminal;

/// The first excuse that a human can show: one without new objects.
fn shown(list: &[excuse::Excuse]) -> Option<&excuse::Excuse> {
    list.iter().find(|one| one.changes.iter().all(|change| change.object.is_none()))
}

/// What has to hold after a demonstration of an excuse, and what must not.
fn target(excuse: &excuse::Excuse) -> (Vec<&Fact>, Vec<&Fact>) {
    let made = excuse.changes.iter().filter_map(|change| change.to.as_ref()).collect();
    let gone = excuse.changes.iter().filter_map(|change| change.from.as_ref()).collect();
    (made, gone)
}

/// Writes `lesson.txt` and `lesson.pddl` into a folder.
pub fn write(
    report: &Report<'_>,
    missing: &[Fact],
    list: &[excuse::Excuse],
    folder: &Path,
) -> Result<(), Complaint> {
    let input = report.input;
    let Some(excuse) = shown(list) else {
        return Err(Complaint::with_help(
            "every excuse asks for an object that there is not, which nobody can show",
            "`--new-objects 0` looks for others",
        ));
    };
    let words = Words { domain: &input.domain, problem: &input.problem };
    let (made, gone) = target(excuse);
    let mut text = format!("What to show the robot\n\n{}\n\n", report.sentence(missing, excuse));
    let objects: Vec<_> = made.iter().chain(&gone).flat_map(|fact| fact.arguments.iter()).collect();
    let about = input
        .problem
        .init
        .iter()
        .filter(|fact| fact.arguments.iter().any(|object| objects.contains(&object)));
    text.push_str("Begin where these hold:\n");
    for fact in about {
        add(&mut text, format_args!("  {}\n", words.clause(fact, Mood::Is, false)));
    }
    text.push_str("Reach a state where these hold:\n");
    for fact in &made {
        add(&mut text, format_args!("  {}\n", words.clause(fact, Mood::Is, false)));
    }
    for fact in &gone {
        add(&mut text, format_args!("  {}\n", words.clause(fact, Mood::IsNot, false)));
    }
    text.push_str("Leave everything else as it is. From there the robot can go on:\n");
    for step in &excuse.plan.steps {
        add(&mut text, format_args!("  {}\n", plan::line(step, &input.domain, &excuse.problem)));
    }
    let style = Style {
        head: "What to demonstrate: from this initial state reach this goal.".to_owned(),
        ..Style::default()
    };
    let problem = Problem {
        goal: wanted(&made, &gone, &input.problem),
        goal_scope: Scope::default(),
        metric: None,
        ..input.problem.clone()
    };
    std::fs::create_dir_all(folder).map_err(|error| {
        Complaint::new(format!("the folder `{}` cannot be made: {error}", folder.display()))
    })?;
    files::write(&folder.join("lesson.txt"), text.as_bytes())?;
    let problem = write::problem(&input.domain, &problem, &style);
    files::write(&folder.join("lesson.pddl"), problem.as_bytes())
}

/// The goal that these hold and those do not.
fn wanted(made: &[&Fact], gone: &[&Fact], problem: &Problem) -> Formula {
    let atom = |fact: &Fact, holds| {
        let arguments =
            fact.arguments.iter().map(|&object| lang::model::Term::Object(object)).collect();
        let atom = lang::model::Atom { predicate: fact.predicate, arguments };
        lang::condition::Condition::Atom(atom, holds)
    };
    let parts =
        made.iter().map(|fact| atom(fact, true)).chain(gone.iter().map(|fact| atom(fact, false)));
    lang::condition::Condition::all(parts).formula(problem.name.span)
}

/// The task as the extended domain has it, and the demonstration.
struct Taught {
    input: Input,
    plan: Plan,
    /// The actions that the domain did not have.
    new: Vec<ActionId>,
}

/// Judges a demonstration: whether it can be carried out, reaches an excuse, and lets the robot plan.
pub fn check(
    arguments: &Excuse,
    original: &Input,
    outcome: &Outcome,
    watch: &Watch,
    terminal: &mut Terminal,
) -> Exit {
    let Outcome::Excuses { list, .. } = outcome else {
        terminal.say("There is no excuse that a demonstration could remove.");
        return Exit::Findings;
    };
    let taught = match read(arguments, original, terminal) {
        Ok(taught) => taught,
        Err(Some(complaint)) => {
            terminal.say(complaint);
            return Exit::Failed;
        }
        Err(None) => return Exit::Failed,
    };
    let (domain, problem) = (&taught.input.domain, &taught.input.problem);
    let names: Vec<String> =
        taught.new.iter().map(|id| domain.actions[id.index()].name.text.clone()).collect();
    let (reached, story) = match reached(original, &taught, list) {
        Ok(reached) => (reached, None),
        Err(story) => (Vec::new(), Some(story)),
    };
    let plan = match solve(domain, problem, true, 20_000_000, &watch.limits) {
        Ok(Answer::Plan(plan)) => Some(plan),
        Ok(_) => None,
        Err(unsupported) => {
            let format = arguments.output_format.of_diagnostics();
            taught.input.report(input::unsupported(&unsupported), format, terminal);
            return Exit::Failed;
        }
    };
    let uses = |plan: &Plan| plan.steps.iter().any(|step| taught.new.contains(&step.action));
    let used = plan.as_ref().is_some_and(uses);
    let good = story.is_none() && !reached.is_empty() && used;
    let steps: Option<Vec<String>> = plan
        .as_ref()
        .map(|plan| plan.steps.iter().map(|step| plan::line(step, domain, problem)).collect());
    if arguments.output_format == AnswerFormat::Json {
        let document = json!({
            "demonstration": { "valid": story.is_none(), "reaches": reached },
            "new_operators": names,
            "plan": steps,
            "uses_new_operator": used,
            "learned": good,
        });
        terminal.line(serde_json::to_string_pretty(&document).expect("it is plain data"));
        return if good { Exit::Done } else { Exit::Findings };
    }
    match (&story, reached.as_slice()) {
        (Some(story), _) => {
            terminal.data(format_args!(
                "The demonstration cannot be carried out.
{story}"
            ));
        }
        (None, []) => terminal.line("The demonstration reaches no excuse of the task."),
        (None, [one]) => terminal.line(format_args!("The demonstration reaches excuse {one}.")),
        (None, several) => {
            let several: Vec<String> = several.iter().map(ToString::to_string).collect();
            terminal.line(format_args!("The demonstration reaches excuses {}.", listed(&several)));
        }
    }
    match (&steps, used) {
        (None, _) => terminal.line("No plan was found with the extended domain."),
        (Some(_), false) if names.is_empty() => {
            terminal.line("The extended domain has no new operator.");
        }
        (Some(_), false) => {
            terminal.line("There is a plan with the extended domain, and it uses no new operator.");
        }
        (Some(steps), true) => {
            terminal.line(format_args!("With {} the task has a plan:", listed(&names)));
            for step in steps {
                terminal.line(format_args!("  {step}"));
            }
        }
    }
    if good { Exit::Done } else { Exit::Findings }
}

/// Reads the extended domain with the problem, and the demonstration.
fn read(
    arguments: &Excuse,
    original: &Input,
    terminal: &mut Terminal,
) -> Result<Taught, Option<Complaint>> {
    let (Some(extended), Some(demonstration), Some(problem)) =
        (&arguments.check_demo, &arguments.demonstration, arguments.files.last())
    else {
        return Err(None);
    };
    let format = arguments.output_format.of_diagnostics();
    let paths = [extended.clone(), problem.clone()];
    let mut input =
        input::load(Reader::default(), "excuse", &paths, format, terminal).map_err(|_| None)?;
    let id = input.reader.take(demonstration).map_err(Some)?;
    let (listing, found) = plan::read(&input.reader.sources, id, &input.domain, &input.problem);
    if found.has_errors() {
        let text = input::rendered(&input.reader.sources, &found, format, terminal.colour);
        terminal.talk(text);
        return Err(None);
    }
    let known = |name: &str| {
        original.domain.actions.iter().any(|action| action.name.text.eq_ignore_ascii_case(name))
    };
    let new = (0..input.domain.actions.len() as u32)
        .map(ActionId)
        .filter(|id| !known(&input.domain.actions[id.index()].name.text))
        .collect();
    Ok(Taught { input, plan: listing.plan, new })
}

/// Which excuses, by number, hold after a plan; the story of why it fails if it does.
fn reached(
    original: &Input,
    taught: &Taught,
    list: &[excuse::Excuse],
) -> Result<Vec<usize>, String> {
    let (domain, problem) = (&taught.input.domain, &taught.input.problem);
    let goalless = Problem {
        goal: Formula::truth(problem.name.span),
        goal_scope: Scope::default(),
        ..problem.clone()
    };
    let broken = |_| "The derived predicates of this domain have no meaning.\n".to_owned();
    let executor = Executor::new(domain, &goalless).map_err(broken)?;
    let verdict = validate::judge(&executor, &taught.plan);
    if let Verdict::Invalid(_) = verdict {
        return Err(validate::story(&verdict, domain, &goalless, &taught.plan));
    }
    let mut state = executor.initial();
    for step in &taught.plan.steps {
        executor.apply(&mut state, step);
    }
    let holds = |fact: &&Fact| {
        let there = translated(fact, original, &taught.input);
        there.is_some_and(|fact| executor.contains(&state, &fact))
    };
    let reaches = |excuse: &excuse::Excuse| {
        let (made, gone) = target(excuse);
        let real = excuse.changes.iter().all(|change| change.object.is_none());
        real && made.iter().all(holds) && !gone.iter().any(holds)
    };
    Ok((0..list.len()).filter(|&number| reaches(&list[number])).map(|one| one + 1).collect())
}

/// A fact in terms of another reading of the same problem.
fn translated(fact: &Fact, from: &Input, to: &Input) -> Option<Fact> {
    let name = &from.domain.predicates[fact.predicate.index()].name.text;
    let same = |other: &str, name: &str| other.eq_ignore_ascii_case(name);
    let predicate = to.domain.predicates.iter().position(|one| same(&one.name.text, name))?;
    let object = |object: &ObjectId| {
        let name = &from.problem.objects.get(object.index())?.name.text;
        let found = to.problem.objects.iter().position(|one| same(&one.name.text, name))?;
        Some(ObjectId(found as u32))
    };
    let arguments = fact.arguments.iter().map(object).collect::<Option<Vec<ObjectId>>>()?;
    Some(Fact { predicate: PredicateId(predicate as u32), arguments: arguments.into() })
}
