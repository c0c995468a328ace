//! A domain, a problem and what was demonstrated, all as text, go in; whether the demonstration is a plan in these words comes out.

use std::collections::BTreeMap;
use std::fmt::Write;

use lang::execute::Executor;
use lang::execute::joint::Concurrency;
use lang::model::{Domain, Problem};
use lang::plan::JointPlan;
use lang::plan::{Plan, Step};
use lang::source::Sources;
use lang::validate::{self, Verdict, joint};
use learner::operators::deed::Deeds;
use learner::operators::line::Line;

/// What each learned action is called in a domain, and which parameter of that each of its own is.
pub type Names = BTreeMap<String, (String, Vec<usize>)>;

/// What was demonstrated, in the words of a domain.
#[derive(Debug)]
pub struct Told {
    /// The joint steps; of one action each, unless actions were tied together.
    pub steps: Vec<Vec<(String, Vec<String>)>>,
}

/// A demonstration as joint steps of named actions.
pub fn told(deeds: &Deeds, line: &Line, learned: &learner::rule::Learned) -> Told {
    let mut steps: Vec<Vec<(String, Vec<String>)>> = Vec::new();
    let mut done: Vec<usize> = Vec::new();
    let tied = |deed: usize, other: usize| {
        let demands = |one: usize, two: usize| {
            let find = |deed: usize| line.instances.iter().find(|instance| instance.deed == deed);
            let (Some(one), Some(two)) = (find(one), find(two)) else { return false };
            learned.actions.iter().any(|action| {
                action.action == one.action
                    && action.partners.iter().any(|partner| partner.action == two.action)
            })
        };
        demands(deed, other) || demands(other, deed)
    };
    for instance in &line.instances {
        if done.contains(&instance.deed) {
            continue;
        }
        let mut group = vec![instance];
        for &other in &deeds.deeds[instance.deed].with {
            let other = line.instances.iter().find(|one| one.deed == other);
            group.extend(other.filter(|other| tied(instance.deed, other.deed)));
        }
        let mut step = Vec::new();
        for one in group {
            done.push(one.deed);
            let name = learned.domain.actions[one.action.index()].name.text.clone();
            let arguments = one.arguments.iter();
            let names = arguments.map(|id| line.trace.objects[id.index()].name.text.clone());
            step.push((name, names.collect()));
        }
        steps.push(step);
    }
    Told { steps }
}

impl Told {
    /// The same in the words of a domain that has other names for some of the actions.
    pub fn rename(&mut self, names: &Names) {
        for (name, arguments) in self.steps.iter_mut().flatten() {
            if let Some((other, places)) = names.get(name.as_str()) {
                let old = arguments.clone();
                for (word, &place) in old.into_iter().zip(places) {
                    arguments[place] = word;
                }
                name.clone_from(other);
            }
        }
    }

    /// As a plan file: one action in a line; of several agents, with the number of the joint step before it.
    pub fn text(&self, agents: bool) -> String {
        let mut text = String::new();
        for (number, step) in self.steps.iter().enumerate() {
            for (name, arguments) in step {
                let words: Vec<&str> =
                    std::iter::once(name).chain(arguments).map(String::as_str).collect();
                if agents {
                    let _ = write!(text, "{number}: ");
                }
                let _ = writeln!(text, "({})", words.join(" "));
            }
        }
        text
    }
}

/// What is wrong with a demonstration as a plan; nothing if it is one.
///
/// With moves that keep shared places free, a plain move may not be allowed where a constrained one is; what was seen counts as the move that it refines,
/// so such domains are not judged.
pub fn judge(domain: &str, problem: &str, told: &Told) -> Result<(), String> {
    let mut sources = Sources::default();
    let id = sources.add("domain.pddl", domain);
    let (domain, found) = lang::read_domain(&sources, id);
    if found.has_errors() {
        return Err(lang::render::concise(&found, &sources));
    }
    let id = sources.add("problem.pddl", problem);
    let (problem, found) = lang::read_problem(&sources, id, &domain);
    if found.has_errors() {
        return Err(lang::render::concise(&found, &sources));
    }
    let steps: Result<Vec<Vec<Step>>, String> = told
        .steps
        .iter()
        .map(|step| step.iter().map(|one| find(&domain, &problem, one)).collect())
        .collect();
    let steps = steps?;
    let executor = Executor::new(&domain, &problem)
        .map_err(|_| "its axioms go round in circles".to_owned())?;
    if domain.is_multi_agent() {
        let plan = JointPlan { steps };
        let verdict = joint::judge(&executor, &plan, Concurrency::Liberal);
        return match verdict {
            joint::Verdict::Valid(_) => Ok(()),
            joint::Verdict::Invalid(_) => Err(joint::story(&verdict, &domain, &problem, &plan)),
        };
    }
    let plan = Plan { steps: steps.into_iter().flatten().collect() };
    let verdict = validate::judge(&executor, &plan);
    match verdict {
        Verdict::Valid(_) => Ok(()),
        Verdict::Invalid(_) => Err(validate::story(&verdict, &domain, &problem, &plan)),
    }
}

/// A step with its ids.
fn find(
    domain: &Domain,
    problem: &Problem,
    (name, arguments): &(String, Vec<String>),
) -> Result<Step, String> {
    let action = domain.actions.iter().position(|one| one.name.text.eq_ignore_ascii_case(name));
    let action = action.ok_or_else(|| format!("there is no action `{name}`"))?;
    let arguments: Result<Vec<_>, String> = arguments
        .iter()
        .map(|name| {
            let object =
                problem.objects.iter().position(|one| one.name.text.eq_ignore_ascii_case(name));
            let object = object.ok_or_else(|| format!("there is no object `{name}`"))?;
            Ok(lang::model::ObjectId(object as u32))
        })
        .collect();
    Ok(Step { action: lang::model::ActionId(action as u32), arguments: arguments?.into() })
}
