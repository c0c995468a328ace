//! A problem in normal form goes in; all its reachable facts, operators and axioms come out.
//!
//! First a fixpoint of joins finds what is reachable when deletes are ignored ([`reach`]), over interned relations ([`relation`]) and
//! without storing intermediate results ([`join`]); then every instance is written out once ([`emit`]);
//! last, what always or never holds is taken out ([`mod@simplify`]).

mod relation;
mod world;
mod join;
mod reach;
mod emit;
mod simplify;

use lang::model::{Domain, Fact, Problem};

use crate::grounded::Grounded;
use crate::limits::{Limits, Stop};
use crate::normal::{Condition, Kind, Normal};
use relation::Relation;

/// What grounding found.
#[derive(Debug)]
pub enum Outcome {
    /// The ground problem.
    Grounded(Box<Grounded>),
    /// The goal cannot be reached even when deletes are ignored.
    Unsolvable,
}

/// Where grounding was when it was told to stop.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Interrupted {
    /// Why.
    pub stop: Stop,
    /// What it was doing.
    pub phase: &'static str,
}

/// Grounds `normal`, the normal form of `problem`.
///
/// # Errors
/// Where it was, if the limits ended it.
pub fn ground(
    domain: &Domain,
    problem: &Problem,
    normal: &Normal,
    limits: &Limits,
) -> Result<Outcome, Interrupted> {
    let shut = Open { facts: &[], prices: &[], objects: (u32::MAX, 0), purse: 0 };
    let Some((mut grounded, exact, _)) = instantiate(domain, problem, normal, &shut, limits)?
    else {
        return Ok(Outcome::Unsolvable);
    };
    if !simplify::simplify(&mut grounded, exact) {
        return Ok(Outcome::Unsolvable);
    }
    Ok(Outcome::Grounded(Box::new(grounded)))
}

/// Facts that may hold initially or not.
#[derive(Debug, Clone, Copy)]
pub struct Open<'a> {
    /// The facts.
    pub facts: &'a [Fact],
    /// What a fact of each predicate costs that does not hold initially, for predicates that no action changes; nothing for those behind the last.
    pub prices: &'a [u32],
    /// Objects from this one on may exist or not, and cost so much each.
    pub objects: (u32, u32),
    /// Instances of actions and axioms whose conditions and objects cost more are left out.
    pub purse: u32,
}

/// Grounds `normal` as if each fact of `open` might hold initially or not: nothing that depends on them is left out. They stand among the facts of the
/// result, which says of each fact whether it does hold initially. Facts that always or never hold are not taken out.
///
/// `None` where the goal is out of reach even so. The second part of the result says whether an instance was left out because its facts were too dear.
///
/// # Errors
/// Where it was, if the limits ended it.
pub fn ground_open(
    domain: &Domain,
    problem: &Problem,
    normal: &Normal,
    open: &Open<'_>,
    limits: &Limits,
) -> Result<(Option<Grounded>, bool), Interrupted> {
    Ok(match instantiate(domain, problem, normal, open, limits)? {
        Some((grounded, _, was_short)) => (Some(grounded), was_short),
        None => (None, !open.prices.is_empty()),
    })
}

/// The ground problem before anything is taken out; whether everything in it is known to be reachable when deletes are ignored; and whether an instance was
/// too dear.
fn instantiate(
    domain: &Domain,
    problem: &Problem,
    normal: &Normal,
    open: &Open<'_>,
    limits: &Limits,
) -> Result<Option<(Grounded, bool, bool)>, Interrupted> {
    let interrupted = |phase| move |stop| Interrupted { stop, phase };
    let world = world::World::new(domain, problem);
    let mut relations: Vec<Relation> =
        normal.predicates.iter().map(|predicate| Relation::new(predicate.arity)).collect();
    let mut row = Vec::new();
    let mut insert = |facts: &[Fact], relations: &mut Vec<Relation>| {
        for fact in facts {
            // What is said initially of a derived predicate is for its axioms to decide.
            if normal.predicates[fact.predicate.index()].kind != Kind::Derived {
                row.clear();
                row.extend(fact.arguments.iter().map(|object| object.0));
                relations[fact.predicate.index()].insert(&row);
            }
        }
    };
    insert(&problem.init, &mut relations);
    let initial: Vec<u32> = relations.iter().map(Relation::len).collect();
    for (relation, &price) in relations.iter_mut().zip(open.prices) {
        relation.charge(price);
    }
    insert(open.facts, &mut relations);
    let purse = join::Purse::new(open.purse, open.objects);
    let mut reach = reach::reach(normal, &world, relations, purse, limits)
        .map_err(interrupted("finding reachable facts"))?;
    let relations = std::mem::take(&mut reach.relations);
    let opened = !open.prices.is_empty();
    let mut emission =
        emit::Emission::new(normal, problem, &world, limits, relations, &initial, opened);
    let reachable = emission.run(&reach).map_err(interrupted("writing operators"))?;
    let grounded = emission.grounded;
    // The fixpoint took universal conditions as true, so less may be reachable than it found.
    let universals = |condition: &Condition| !condition.universals.is_empty();
    let approximate = normal.schemas.iter().any(|schema| {
        universals(&schema.condition)
            || schema.effects.iter().any(|effect| universals(&effect.condition))
    }) || normal.rules.iter().any(|rule| universals(&rule.condition));
    let exact = !emission.dropped && !approximate;
    Ok(reachable.then_some((grounded, exact, reach.was_short)))
}

/// Takes out of a ground problem what always or never holds and what never applies, as [`ground`] does; false if the goal cannot be reached.
pub fn simplify(grounded: &mut Grounded) -> bool {
    simplify::simplify(grounded, false)
}
