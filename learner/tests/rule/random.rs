//! A seed goes in; a small random domain, problems in it and traces of random actions come out.

use std::fmt::Write;

use lang::execute::joint::Concurrency;
use lang::execute::{Executor, State};
use lang::model::{ActionId, Domain, Fact, ObjectId, PredicateId, Problem};
use lang::plan::Step;
use lang::source::Sources;
use learner::trace::{FactId, Joint, Trace};

use super::words::domain;

/// Why writing to a string does not fail.
const TAKES_ALL: &str = "a string takes all";

/// Numbers that look random, the same for the same seed.
pub struct Dice(u64);

impl Dice {
    pub fn new(seed: u64) -> Self {
        Self(seed)
    }

    /// A number below `end`.
    pub fn below(&mut self, end: usize) -> usize {
        // SplitMix64.
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut word = self.0;
        word = (word ^ (word >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        word = (word ^ (word >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((word ^ (word >> 31)) % end as u64) as usize
    }

    pub fn chance(&mut self, percent: usize) -> bool {
        self.below(100) < percent
    }

    fn pick<T: Clone>(&mut self, list: &[T]) -> T {
        list[self.below(list.len())].clone()
    }
}

/// What random domains have in them.
#[derive(Clone, Copy)]
pub struct Kind {
    /// Preconditions may be negative, and anything may be deleted.
    pub negative: bool,
    /// Actions have agents, and steps are joint.
    pub agents: bool,
}

/// The names of types, and those that are also of each.
const TYPES: [(&str, &[&str]); 3] = [("a", &["a", "c"]), ("b", &["b"]), ("c", &["c"])];

fn may_stand(kind: &str, position: &str) -> bool {
    TYPES.iter().any(|(name, below)| *name == position && below.contains(&kind)) || kind == position
}

/// The text of a domain.
pub fn text(dice: &mut Dice, kind: Kind) -> String {
    let names: Vec<&str> = TYPES.iter().map(|(name, _)| *name).collect();
    let positions: Vec<&str> =
        if kind.agents { names.iter().copied().chain(["g"]).collect() } else { names.clone() };
    let mut predicates: Vec<(String, Vec<&str>)> = Vec::new();
    for at in 0..2 + dice.below(3) {
        let arity = dice.below(3);
        predicates.push((format!("p{at}"), (0..arity).map(|_| dice.pick(&positions)).collect()));
    }
    let constant = dice.chance(30).then_some(("k", "a"));
    let mut text = String::from(
        "(define (domain random) (:requirements :typing :negative-preconditions :multi-agent)\n(:types a b g - object c - a)\n",
    );
    if constant.is_some() {
        text.push_str("(:constants k - a)\n");
    }
    text.push_str("(:predicates");
    for (name, types) in &predicates {
        let types = types.iter().enumerate().map(|(at, kind)| format!(" ?x{at} - {kind}"));
        let types: Vec<String> = types.collect();
        text.push_str(&[" (", name, &types.concat(), ")"].concat());
    }
    text.push_str(")\n");
    for at in 0..=dice.below(3) {
        let arity = 1 + dice.below(3);
        let mut terms: Vec<(String, &str)> =
            (0..arity).map(|at| (format!("?x{at}"), dice.pick(&names))).collect();
        let list = terms.iter().map(|(name, kind)| format!("{name} - {kind}"));
        let list = list.collect::<Vec<String>>().join(" ");
        if kind.agents {
            write!(text, "(:action act{at} :agent ?g - g :parameters ({list})").expect(TAKES_ALL);
            terms.push(("?g".to_owned(), "g"));
        } else {
            write!(text, "(:action act{at} :parameters ({list})").expect(TAKES_ALL);
        }
        terms.extend(constant.map(|(name, kind)| (name.to_owned(), kind)));
        let atom = |dice: &mut Dice| {
            let (name, types) = dice.pick(&predicates);
            let mut text = name;
            for position in types {
                let fit: Vec<&str> = terms
                    .iter()
                    .filter(|(_, kind)| may_stand(kind, position))
                    .map(|(name, _)| name.as_str())
                    .collect();
                if fit.is_empty() {
                    return None;
                }
                text.push(' ');
                text.push_str(dice.pick(&fit));
            }
            Some(format!("({text})"))
        };
        let some = |dice: &mut Dice, most: usize| -> Vec<String> {
            let count = dice.below(most + 1);
            (0..count).filter_map(|_| atom(dice)).collect()
        };
        let required = some(dice, 3);
        let mut absent = if kind.negative { some(dice, 1) } else { Vec::new() };
        absent.retain(|atom| !required.contains(atom));
        let mut adds = some(dice, 2);
        // What two agents do at once must not depend on something being added that was there.
        adds.retain(|atom| !kind.agents || !required.contains(atom));
        let mut deletes = if kind.negative { some(dice, 2) } else { Vec::new() };
        deletes.extend(required.iter().filter(|_| dice.chance(50)).cloned());
        let no = |list: &[String]| {
            list.iter().map(|atom| format!("(not {atom})")).collect::<Vec<String>>().concat()
        };
        write!(
            text,
            "\n  :precondition (and {}{})\n  :effect (and {}{}))\n",
            required.concat(),
            no(&absent),
            adds.concat(),
            no(&deletes)
        )
        .expect(TAKES_ALL);
    }
    text.push(')');
    text
}

/// A problem with two or three objects of each type, and facts that are true by chance.
pub fn problem(dice: &mut Dice, domain: &Domain) -> Problem {
    let mut sources = Sources::default();
    let id = sources.add(
        "problem.pddl",
        "(define (problem random) (:domain random) (:objects a1 a2 - a b1 b2 - b c1 - c g1 g2 - g) (:init) (:goal (and)))",
    );
    let (mut problem, _) = lang::read_problem(&sources, id, domain);
    problem.init = facts(dice, domain, &problem);
    problem
}

/// Each possible fact is true with some chance.
pub fn facts(dice: &mut Dice, domain: &Domain, problem: &Problem) -> Vec<Fact> {
    let percent = 20 + dice.below(60);
    let mut facts = Vec::new();
    for (at, predicate) in domain.predicates.iter().enumerate() {
        let types: Vec<_> = predicate.parameters.iter().map(|one| one.types.as_slice()).collect();
        for arguments in tuples(domain, problem, &types) {
            if dice.chance(percent) {
                facts.push(Fact { predicate: PredicateId(at as u32), arguments: arguments.into() });
            }
        }
    }
    facts
}

fn tuples(
    domain: &Domain,
    problem: &Problem,
    types: &[&[lang::model::TypeId]],
) -> Vec<Vec<ObjectId>> {
    let mut tuples: Vec<Vec<ObjectId>> = vec![Vec::new()];
    for types in types {
        let of = (0..problem.objects.len() as u32).map(ObjectId);
        let of: Vec<ObjectId> =
            of.filter(|id| domain.has_type(&problem.objects[id.index()], types)).collect();
        tuples = tuples
            .iter()
            .flat_map(|begun| of.iter().map(|id| begun.iter().copied().chain([*id]).collect()))
            .collect();
    }
    tuples
}

/// All instances of an action.
pub fn steps(domain: &Domain, problem: &Problem, action: ActionId) -> Vec<Step> {
    let scope = &domain.actions[action.index()].scope;
    let types: Vec<_> = scope.variables[..scope.parameters as usize]
        .iter()
        .map(|one| one.types.as_slice())
        .collect();
    let tuples = tuples(domain, problem, &types);
    tuples.into_iter().map(|arguments| Step { action, arguments: arguments.into() }).collect()
}

/// A domain and a number of traces in it.
pub struct Sample {
    pub text: String,
    pub domain: Domain,
    pub problem: Problem,
    pub traces: Vec<Trace>,
}

/// A random domain with traces of random actions, each from a random state.
pub fn sample(seed: u64, kind: Kind) -> Sample {
    let mut dice = Dice::new(seed);
    let text = text(&mut dice, kind);
    let domain = domain(&text);
    let problem = problem(&mut dice, &domain);
    let mut traces = Vec::new();
    for at in 0..=dice.below(8) {
        let begin = facts(&mut dice, &domain, &problem);
        traces.push(walk(
            &mut dice,
            &domain,
            &Problem { init: begin, ..problem.clone() },
            &format!("t{at}"),
        ));
    }
    Sample { text, domain, problem, traces }
}

fn walk(dice: &mut Dice, domain: &Domain, problem: &Problem, name: &str) -> Trace {
    let executor = Executor::new(domain, problem).expect("there are no axioms");
    let mut trace = Trace::new(name, domain);
    trace.objects.clone_from(&problem.objects);
    let agents: Vec<ObjectId> = (0..problem.objects.len() as u32)
        .map(ObjectId)
        .filter(|id| problem.objects[id.index()].name.text.starts_with('g'))
        .collect();
    let joint = domain.is_multi_agent();
    if joint {
        trace.agents.clone_from(&agents);
    }
    let mut state = executor.initial();
    push(&mut trace, &state);
    let all: Vec<Step> = (0..domain.actions.len() as u32)
        .flat_map(|action| steps(domain, problem, ActionId(action)))
        .collect();
    for _ in 0..dice.below(5) {
        let slots = if joint { agents.len() } else { 1 };
        let mut parts: Vec<Option<Step>> = vec![None; slots];
        for (slot, part) in parts.iter_mut().enumerate() {
            let can: Vec<&Step> = all
                .iter()
                .filter(|step| !joint || step.arguments[0] == agents[slot])
                .filter(|step| executor.applicable(&state, step))
                .collect();
            if !can.is_empty() && (!joint || dice.chance(75)) {
                *part = Some(can[dice.below(can.len())].clone());
            }
        }
        let done: Vec<Step> = parts.iter().flatten().cloned().collect();
        if done.is_empty() {
            continue;
        }
        if joint {
            if executor.join(&state, &done, Concurrency::Liberal).is_err() {
                continue;
            }
            executor.apply_joint(&mut state, &done);
        } else {
            executor.apply(&mut state, &done[0]);
        }
        trace.step(Joint { parts, whole: true });
        push(&mut trace, &state);
    }
    trace
}

fn push(trace: &mut Trace, state: &State) {
    let facts: Vec<FactId> =
        state.facts().iter().map(|fact| trace.fact(fact.predicate, &fact.arguments)).collect();
    trace.state(facts);
}
