//! A multi-agent domain and problem go in; a classical domain and problem, and the way back from its plans to joint plans, come out.
//!
//! Two means, both exact:
//! - *Shortcuts*: each team of parts that are all that their action atoms ask for becomes one ordinary action.
//!   By construction its parts are simultaneous, since PDDL reads all conditions of an action before any effect.
//! - *Blocks*: any joint action of a group of actions is put together step by step and taken as one.
//!   Only groups that can act together in ways that no sequence of shortcuts has need one.
//!
//! Every plan of the compiled problem is a joint plan of the original ([`Compiled::decode`]), and with blocks for all groups the original has
//! a joint plan only if the compiled problem has a plan. The semantics is that of [`crate::execute::joint`].

mod world;
mod schema;
mod protect;
mod team;
mod interact;
mod assembly;
mod shortcut;
mod block;
mod merge;

use std::collections::{BTreeMap, BTreeSet};

pub use merge::merge;

use crate::execute::joint::Concurrency;
use crate::model::{
    ActionId, Atom, Domain, Object, ObjectId, PredicateId, Problem, Term, Type, TypeId, VariableId,
};
use crate::plan::{JointPlan, Plan, Step};
use assembly::Assembly;
use block::{Block, Counter, Tokens};
use interact::Feeds;
use schema::Schema;
use team::{Finder, Team};
use world::World;

/// What a good joint plan has little of.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Objective {
    /// Joint steps.
    Steps,
    /// Ground actions.
    Actions,
    /// What the metric counts.
    Cost,
}

/// By which means joint actions are compiled.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Means {
    /// Shortcuts alone: small and quick to search, but some joint actions may have no counterpart.
    Shortcuts,
    /// Shortcuts, and blocks for the groups that need them.
    Complete,
    /// One block for all actions, and no shortcuts: each joint action is one block, which makes joint steps countable.
    Block,
}

/// What to compile, and how.
#[derive(Debug, Clone, Copy)]
pub struct Options {
    /// How much the parts of a joint action may have to do with one another.
    pub concurrency: Concurrency,
    /// How many parts a joint action has at most.
    pub size: Option<usize>,
    /// The means.
    pub means: Means,
    /// What the costs of the compiled problem count; the domain's own costs, or none, without it.
    pub objective: Option<Objective>,
}

/// What an action of the compiled domain stands for.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Role {
    /// A joint action: its parts, in the parameters of the compiled action.
    Joint(Vec<(ActionId, Vec<Term>)>),
    /// A part of the joint action that is being put together.
    Select(ActionId, Vec<Term>),
    /// A step on the way.
    Frame,
    /// The joint action that was put together is taken.
    End,
}

/// A compiled domain and problem.
#[derive(Debug)]
pub struct Compiled {
    /// The classical domain.
    pub domain: Domain,
    /// The classical problem, with the objects of the original in their places.
    pub problem: Problem,
    /// What each action stands for.
    pub roles: Vec<Role>,
    /// The same in words, for the reader of the compiled domain.
    pub notes: BTreeMap<ActionId, String>,
    /// Whether there is a plan whenever the original has a joint plan.
    pub complete: bool,
}

/// Why a domain is not compiled.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Refusal {
    /// As a sentence without a full stop.
    pub message: String,
    /// Where.
    pub span: crate::source::Span,
}

/// Compiles a multi-agent problem.
///
/// # Errors
/// Conditions that are nested deeper than [`crate::condition::DEEPEST`].
pub fn compile(domain: &Domain, problem: &Problem, options: &Options) -> Result<Compiled, Refusal> {
    let world = World::new(domain, problem);
    let feeds = Feeds::new(&world);
    let Some((schemas, exact)) = schema::schemas(&world, &feeds, options.concurrency) else {
        let message = format!("conditions nested deeper than {}", crate::condition::DEEPEST);
        return Err(Refusal { message, span: domain.name.span });
    };
    let agents = agents(&world, &schemas);
    let size = options.size.unwrap_or(usize::MAX);
    let finder = Finder { world: &world, schemas: &schemas, size, agents: agents.len() };
    let groups = match options.means {
        Means::Block => vec![(0..schemas.len()).collect()],
        _ => interact::groups(&finder, &feeds),
    };
    let mut assembly = Assembly::new(domain, problem);
    let blocks = options.means != Means::Shortcuts && !groups.is_empty();
    let tokens = blocks.then(|| tokens(&world, &schemas, &agents, options, &mut assembly));
    let counted = match &tokens {
        Some(tokens) => tokens.counted,
        None => counted(options, &mut assembly),
    };
    let before = tokens.as_ref().map(|tokens| tokens.before);
    if options.means != Means::Block {
        let idle = tokens.as_ref().map(|tokens| tokens.idle);
        shortcuts(&finder, options, (before, idle, counted), &agents, &mut assembly);
    }
    if let Some(tokens) = &tokens {
        for group in &groups {
            let block = Block {
                world: &world,
                feeds: &feeds,
                schemas: &schemas,
                group: group.clone(),
                tokens,
                objective: options.objective.unwrap_or(Objective::Cost),
                ordered: options.means == Means::Block,
            };
            block.write(&mut assembly);
        }
    }
    Ok(assembly.finish(exact && (blocks || groups.is_empty())))
}

/// The objects that can act, in order.
fn agents(world: &World<'_>, schemas: &[Schema]) -> Vec<ObjectId> {
    let types: Vec<TypeId> = agent_types(schemas);
    let objects = world.problem.objects.iter().enumerate();
    objects
        .filter(|(_, object)| world.domain.has_type(object, &types))
        .map(|(at, _)| ObjectId(at as u32))
        .collect()
}

fn agent_types(schemas: &[Schema]) -> Vec<TypeId> {
    let acting = schemas.iter().filter(|schema| schema.agent);
    let types: BTreeSet<TypeId> =
        acting.flat_map(|schema| schema.scope.variables[0].types.iter().copied()).collect();
    types.into_iter().collect()
}

/// Puts the agents into the order in which their objects stand.
fn order(agents: &[ObjectId], types: &[TypeId], assembly: &mut Assembly) -> PredicateId {
    let parameters = vec![assembly.variable("?a", types), assembly.variable("?b", types)];
    let before = assembly.predicate("before", parameters);
    for (at, &one) in agents.iter().enumerate() {
        for &other in &agents[at + 1..] {
            assembly.init(before, &[one, other]);
        }
    }
    before
}

/// The function that costs are counted in, if they are not the domain's own.
fn counted(options: &Options, assembly: &mut Assembly) -> Option<crate::model::FunctionId> {
    matches!(options.objective, Some(Objective::Steps | Objective::Actions))
        .then(|| assembly.count())
}

/// What all blocks share: predicates, and what holds of them initially and in the end.
fn tokens(
    world: &World<'_>,
    schemas: &[Schema],
    agents: &[ObjectId],
    options: &Options,
    assembly: &mut Assembly,
) -> Tokens {
    let types = agent_types(schemas);
    let idle = assembly.predicate("idle", Vec::new());
    let agent = assembly.variable("?a", &types);
    let free = assembly.predicate("free", vec![agent.clone()]);
    let pending = assembly.predicate("pending", vec![agent]);
    let nobody = schemas.iter().any(|schema| !schema.agent).then(|| {
        let pair = ["free-nobody", "pending-nobody"];
        pair.map(|name| assembly.predicate(name, Vec::new()))
    });
    let before = order(agents, &types, assembly);
    assembly.init(idle, &[]);
    for &agent in agents {
        assembly.init(free, &[agent]);
    }
    if let Some([free, _]) = nobody {
        assembly.init(free, &[]);
    }
    assembly.goal(Atom { predicate: idle, arguments: Vec::new() });
    let counter = options.size.map(|size| counter(world, size, assembly));
    let counted = counted(options, assembly);
    Tokens { idle, free, pending, nobody, before, agents: types, counted, counter }
}

/// Numbers from 0 to `size`.
fn counter(world: &World<'_>, size: usize, assembly: &mut Assembly) -> Counter {
    let span = world.domain.name.span;
    let name = |text: String| crate::model::Name { text, span };
    let taken =
        |text: &str| world.domain.types.iter().any(|one| one.name.text.eq_ignore_ascii_case(text));
    let mut text = "part-count".to_owned();
    while taken(&text) {
        text.push('-');
    }
    let number = TypeId(assembly.domain.types.len() as u32);
    let root = crate::check::OBJECT;
    assembly.domain.types.push(Type {
        name: name(text),
        parents: vec![root],
        ancestors: vec![root, number],
    });
    let one = |name: &str, assembly: &Assembly| assembly.variable(name, &[number]);
    let count = assembly.predicate("part-count-is", vec![one("?n", assembly)]);
    let next = assembly.predicate("part-next", vec![one("?n", assembly), one("?m", assembly)]);
    let zero = assembly.predicate("part-zero", vec![one("?n", assembly)]);
    let first = assembly.problem.objects.len() as u32;
    assembly.init(zero, &[ObjectId(first)]);
    for at in 0..=size {
        let types = vec![number];
        assembly.problem.objects.push(Object {
            name: name(format!("part-{at}")),
            types,
            holder: None,
        });
        if at > 0 {
            let this = first + at as u32;
            assembly.init(next, &[ObjectId(this - 1), ObjectId(this)]);
        }
    }
    Counter { count, next, number, zero }
}

/// Adds an action for each team.
fn shortcuts(
    finder: &Finder<'_>,
    options: &Options,
    (before, idle, counted): (
        Option<PredicateId>,
        Option<PredicateId>,
        Option<crate::model::FunctionId>,
    ),
    agents: &[ObjectId],
    assembly: &mut Assembly,
) {
    let teams = finder.teams();
    let symmetric = teams.iter().any(|team| !team.interchangeable().is_empty());
    let types = agent_types(finder.schemas);
    let before = match before {
        Some(before) => before,
        None if symmetric => order(agents, &types, assembly),
        // No team needs it.
        None => PredicateId(u32::MAX),
    };
    for team in teams {
        let Some(mut draft) = shortcut::shortcut(finder, &team, before) else { continue };
        if let Some(idle) = idle {
            draft.needs(Atom { predicate: idle, arguments: Vec::new() }, true);
        }
        if let Some(function) = counted {
            let value = match options.objective {
                Some(Objective::Actions) => team.members.len(),
                _ => 1,
            };
            draft.increases = vec![unconditional(function, value, assembly)];
        }
        assembly.action(draft, role(&team, finder.schemas));
    }
}

fn unconditional(
    function: crate::model::FunctionId,
    value: usize,
    assembly: &Assembly,
) -> crate::model::Increase {
    crate::model::Increase {
        variables: Vec::new(),
        condition: crate::model::Formula::truth(assembly.span),
        function,
        arguments: Vec::new(),
        value: crate::model::Expression::Number(value.into()),
        span: assembly.span,
    }
}

fn role(team: &Team, schemas: &[Schema]) -> Role {
    let part = |member: &team::Member| (schemas[member.schema].id, member.arguments.clone());
    Role::Joint(team.members.iter().map(part).collect())
}

impl Compiled {
    /// The joint plan that a plan of the compiled problem stands for.
    pub fn decode(&self, plan: &Plan) -> JointPlan {
        let mut joint = JointPlan::default();
        let mut chosen = Vec::new();
        for step in &plan.steps {
            match &self.roles[step.action.index()] {
                Role::Joint(parts) => {
                    joint.steps.push(parts.iter().map(|part| ground(part, step)).collect());
                }
                Role::Select(action, terms) => {
                    chosen.push(ground(&(*action, terms.clone()), step));
                }
                Role::Frame => {}
                Role::End => {
                    // A block in which nobody was chosen changes nothing.
                    if !chosen.is_empty() {
                        joint.steps.push(std::mem::take(&mut chosen));
                    }
                }
            }
        }
        joint
    }
}

/// A part of a step, in the objects of the step.
fn ground((action, terms): &(ActionId, Vec<Term>), step: &Step) -> Step {
    let object = |term: &Term| match *term {
        Term::Variable(VariableId(at)) => step.arguments[at as usize],
        Term::Object(object) => object,
    };
    Step { action: *action, arguments: terms.iter().map(object).collect() }
}
