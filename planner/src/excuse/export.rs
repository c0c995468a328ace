//! A problem and what may be changed go in; a classical task comes out in which changes are actions with costs, so that any planner that minimises cost
//! finds a smallest excuse.
//!
//! After Göbelbecker, Keller, Eyerich, Brenner and Nebel ("Coming up with good excuses", ICAPS 2010), lifted, and with a variable, not a fact, as what a
//! change is about. A plan has two parts, with `begin` between them: changes, then the domain's own actions, which cost nothing.
//!
//! Why its cheapest plans are the smallest excuses:
//!
//! - Each variable is an object, which a change needs untouched. Tables say what it has initially and what it may have ([`change`]),
//!   so that the steps `change-…` are the edits, one a variable at most.
//! - Groups that lie within one variable hold by themselves once the edits that break them always are left out ([`choices`]). Of each other group there is a
//!   token: a change frees those of the fact that it makes false, and the fact that it makes true has to claim its own ([`claim`]), some time before `begin`.
//!   No fact claims what another has, and nothing is left unclaimed, so no group has two facts in the end, in whatever order the changes come; where
//!   exactly one is to hold, the token must not be free.
//! - `begin` asks that the goal does not hold ([`begin`]), so that what comes after it is a plan, with a step, for the changed state.

mod task;
mod choices;
mod change;
mod claim;
mod begin;

use std::collections::BTreeMap;

use lang::model::{Action, ActionId, Domain, Fact, ObjectId, PredicateId, Problem, Term};
use lang::plan::{Plan, Step};
use lang::write::{self, Style};

use super::{Catalogue, CatalogueError, Policy};
use crate::limits::Limits;
use choices::Choices;
use task::Task;

/// What holds no longer, and what holds instead.
pub type Exchange = (Option<Fact>, Option<Fact>);

/// A task whose cheapest plans begin with smallest excuses.
#[derive(Debug, Clone)]
pub struct Export {
    /// The domain. Its first predicates are those of the original, its last actions, too.
    pub domain: Domain,
    /// The problem. Its first objects are those of the original.
    pub problem: Problem,
    /// What actions are for.
    notes: BTreeMap<ActionId, String>,
    /// What predicates say.
    words: BTreeMap<PredicateId, String>,
    /// How many actions stand before those of the original.
    added: u32,
    /// How many predicates the original has.
    predicates: u32,
}

/// Makes the task in which everything may be changed that costs `most` a change at most. New objects and a bound on the number of changes are not part of it.
///
/// # Errors
/// What the planner does not plan, or why it ended.
pub fn export(
    domain: &Domain,
    problem: &Problem,
    policy: &Policy,
    most: u32,
    limits: &Limits,
) -> Result<Export, CatalogueError> {
    let catalogue = super::catalogue(domain, problem, policy, most, limits)?;
    // Where the goal is out of reach whatever is changed, nothing has to be.
    let catalogue = catalogue.unwrap_or(Catalogue { variables: Vec::new(), groups: Vec::new() });
    let choices = Choices::new(catalogue, &problem.init);
    let mut task = Task::new(domain, problem);
    let phases = begin::phases(&mut task);
    change::add(&mut task, &phases, &choices);
    begin::add(&mut task, &phases, &choices, domain, problem)
        .map_err(CatalogueError::Unsupported)?;
    let added = task.domain.actions.len() as u32;
    begin::own(&mut task, &phases, domain);
    let Task { domain: exported, problem, notes, words, .. } = task;
    let predicates = domain.predicates.len() as u32;
    Ok(Export { domain: exported, problem, notes, words, added, predicates })
}

impl Export {
    /// The changes that a plan makes, and what it does then, in terms of the original.
    pub fn read(&self, plan: &Plan) -> (Vec<Exchange>, Plan) {
        let mut changes = Vec::new();
        let mut steps = Vec::new();
        for step in &plan.steps {
            if let Some(own) = step.action.0.checked_sub(self.added) {
                steps.push(Step { action: ActionId(own), arguments: step.arguments.clone() });
            } else {
                changes.extend(self.change(step));
            }
        }
        (changes, Plan { steps })
    }

    /// What a step makes false and true of what the original knows.
    fn change(&self, step: &Step) -> Option<Exchange> {
        let action = &self.domain.actions[step.action.index()];
        let literals = action.effects.iter().flat_map(|effect| &effect.literals);
        let (mut from, mut to) = (None, None);
        for literal in literals.filter(|literal| literal.atom.predicate.0 < self.predicates) {
            let object = |term: &Term| -> ObjectId {
                match term {
                    Term::Variable(variable) => step.arguments[variable.index()],
                    Term::Object(object) => *object,
                }
            };
            let arguments = literal.atom.arguments.iter().map(object).collect();
            let fact = Fact { predicate: literal.atom.predicate, arguments };
            if literal.positive { to = Some(fact) } else { from = Some(fact) }
        }
        (from.is_some() || to.is_some()).then_some((from, to))
    }

    /// The text of the domain; `made` says from what it was made.
    pub fn domain_text(&self, made: &str) -> String {
        let begins = |action: &&Action| action.name.text.starts_with("begin");
        let several = self.domain.actions[..self.added as usize].iter().filter(begins).count() > 1;
        let begin = if several { "a step begin..." } else { "`begin`" };
        let mut head = format!(
            "{made}
The cheapest plans begin with the smallest excuses: the cheapest changes of the initial state with which the problem has a plan.

A plan changes the initial state, takes {begin}, and goes on with the domain's own actions, which cost nothing.
Every step change-... is a change of what its first argument stands for, and the cost of the plan is that of all changes.
If it is 0, the problem has a plan as it is. If there is no plan, there is no excuse."
        );
        let claims = |action: &Action| action.name.text.starts_with("claim-");
        if self.domain.actions[..self.added as usize].iter().any(claims) {
            head.push_str(
                "\nA step claim-... makes sure that what a change makes true does not meet what excludes it.",
            );
        }
        let style = Style {
            head,
            actions: self.notes.clone(),
            predicates: self.words.clone(),
            ..Style::default()
        };
        write::domain(&self.domain, &style)
    }

    /// The text of the problem; `made` says from what it was made.
    pub fn problem_text(&self, made: &str) -> String {
        let head = format!("{made}\nThe head of its domain says how a plan is read.");
        write::problem(&self.domain, &self.problem, &Style { head, ..Style::default() })
    }
}
