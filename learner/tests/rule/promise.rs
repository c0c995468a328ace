//! What the safe model promises, tried on random domains: whatever it allows is allowed in the true domain, with the same result.

use std::collections::BTreeSet;

use lang::execute::Executor;
use lang::execute::joint::Concurrency;
use lang::model::{ActionId, Atom, Domain, ObjectId, Problem, Term, VariableId};
use lang::plan::Step;
use learner::rule::{self, Company, Learned, Options, Rule};
use learner::trace::Trace;
use learner::write;
use proptest::prelude::*;

use super::random::{self, Dice, Kind, Sample};

const PLAIN: Kind = Kind { negative: false, agents: false };
const NEGATIVE: Kind = Kind { negative: true, agents: false };
const AGENTS: Kind = Kind { negative: false, agents: true };

/// How many random domains the promises are tried on, those about agents and all others.
const CASES: [u32; 2] = [40, 400];

/// How often something was allowed.
#[derive(Default)]
struct Allowed {
    single: usize,
    joint: usize,
}

/// Compares the learned domain with the true one in random states.
#[track_caller]
fn keeps_its_promise(seed: u64, kind: Kind, options: &Options) -> Allowed {
    let sample = random::sample(seed, kind);
    let learned = rule::learn(&sample.domain, &sample.traces, options);
    assert_eq!(learned.strays, 0);
    let (found, _) = write::domain(&learned, Rule::Safe);
    let mut dice = Dice::new(seed ^ 0x5eed);
    let mut allowed = Allowed::default();
    for _ in 0..if kind.agents { 4 } else { 12 } {
        let init = random::facts(&mut dice, &sample.domain, &sample.problem);
        let problem = Problem { init, ..sample.problem.clone() };
        if kind.agents {
            allowed.joint += joint(seed, &sample, &learned, &found, &problem);
        } else {
            allowed.single += single(seed, &sample, &learned, &found, &problem);
        }
    }
    allowed
}

/// The step in the true domain.
fn original(learned: &Learned, step: &Step) -> Step {
    Step { action: learned.actions[step.action.index()].action, arguments: step.arguments.clone() }
}

fn all(found: &Domain, problem: &Problem) -> Vec<Step> {
    (0..found.actions.len() as u32)
        .flat_map(|action| random::steps(found, problem, ActionId(action)))
        .collect()
}

fn single(
    seed: u64,
    sample: &Sample,
    learned: &Learned,
    found: &Domain,
    problem: &Problem,
) -> usize {
    let truth = Executor::new(&sample.domain, problem).expect("there are no axioms");
    let model = Executor::new(found, problem).expect("there are no axioms");
    let mut allowed = 0;
    for step in all(found, problem) {
        let real = original(learned, &step);
        if !model.applicable(&model.initial(), &step) {
            continue;
        }
        allowed += 1;
        let told = || format!("seed {seed}: {step:?}\n{}\n{}", sample.text, write::text(learned));
        assert!(truth.applicable(&truth.initial(), &real), "not applicable: {}", told());
        let (mut wanted, mut got) = (truth.initial(), model.initial());
        truth.apply(&mut wanted, &real);
        model.apply(&mut got, &step);
        assert_eq!(got.facts(), wanted.facts(), "another result: {}", told());
    }
    allowed
}

/// Steps of one agent and of both.
fn joint(
    seed: u64,
    sample: &Sample,
    learned: &Learned,
    found: &Domain,
    problem: &Problem,
) -> usize {
    let truth = Executor::new(&sample.domain, problem).expect("there are no axioms");
    let model = Executor::new(found, problem).expect("there are no axioms");
    let steps = all(found, problem);
    let none: Vec<Option<&Step>> = vec![None];
    let mut allowed = 0;
    for one in &steps {
        for other in steps.iter().map(Some).chain(none.clone()) {
            let parts: Vec<Step> = [Some(one), other].into_iter().flatten().cloned().collect();
            if model.join(&model.initial(), &parts, Concurrency::Safe).is_err() {
                continue;
            }
            let real: Vec<Step> = parts.iter().map(|step| original(learned, step)).collect();
            if real.iter().any(|step| undoes_itself(&sample.domain, step)) {
                continue;
            }
            allowed += 1;
            let told =
                || format!("seed {seed}: {parts:?}\n{}\n{}", sample.text, write::text(learned));
            let verdict = truth.join(&truth.initial(), &real, Concurrency::Liberal);
            assert_eq!(verdict, Ok(()), "not applicable: {}", told());
            let (mut wanted, mut got) = (truth.initial(), model.initial());
            truth.apply_joint(&mut wanted, &real);
            model.apply_joint(&mut got, &parts);
            assert_eq!(got.facts(), wanted.facts(), "another result: {}", told());
        }
    }
    allowed
}

/// Whether a step adds and deletes the same fact, which is not the same in company: then nothing may delete what another part adds.
fn undoes_itself(domain: &Domain, step: &Step) -> bool {
    let value = |term: &Term| match term {
        Term::Variable(id) => step.arguments[id.index()],
        Term::Object(id) => *id,
    };
    let facts = |positive: bool| -> BTreeSet<_> {
        let effects = domain.actions[step.action.index()].effects.iter();
        let literals = effects.flat_map(|effect| &effect.literals);
        let literals = literals.filter(|literal| literal.positive == positive);
        literals
            .map(|literal| {
                let arguments: Vec<ObjectId> = literal.atom.arguments.iter().map(value).collect();
                (literal.atom.predicate, arguments)
            })
            .collect()
    };
    !facts(true).is_disjoint(&facts(false))
}

/// What an intersection over all liftings finds: for each example all atoms that some fact of the state may be an instance of.
fn naive(domain: &Domain, traces: &[Trace], action: ActionId) -> Option<BTreeSet<String>> {
    let scope = &domain.actions[action.index()].scope;
    let mut common: Option<BTreeSet<String>> = None;
    for trace in traces {
        for (state, joint, _) in trace.transitions() {
            for step in joint.parts.iter().flatten().filter(|step| step.action == action) {
                let mut lifted = BTreeSet::new();
                for fact in state.facts() {
                    let fact = &trace.facts[fact.index()];
                    let mut begun: Vec<Vec<Term>> = vec![Vec::new()];
                    for object in &fact.arguments {
                        let terms = terms(domain, step, *object);
                        begun = begun
                            .iter()
                            .flat_map(|one| {
                                terms
                                    .iter()
                                    .map(|term| one.iter().copied().chain([*term]).collect())
                            })
                            .collect();
                    }
                    let positions = &domain.predicates[fact.predicate.index()].parameters;
                    for arguments in begun {
                        let fits =
                            arguments.iter().zip(positions).all(|(term, position)| match term {
                                Term::Object(_) => true,
                                Term::Variable(id) => {
                                    scope.variables[id.index()].types.iter().all(|below| {
                                        position
                                            .types
                                            .iter()
                                            .any(|above| domain.is_subtype(*below, *above))
                                    })
                                }
                            });
                        let atom = Atom { predicate: fact.predicate, arguments };
                        if fits {
                            lifted.insert(format!("{atom:?}"));
                        }
                    }
                }
                common = Some(match common {
                    Some(before) => before.intersection(&lifted).cloned().collect(),
                    None => lifted,
                });
            }
        }
    }
    common
}

fn terms(domain: &Domain, step: &Step, object: ObjectId) -> Vec<Term> {
    let places = step.arguments.iter().enumerate().filter(|(_, argument)| **argument == object);
    let variables = places.map(|(at, _)| Term::Variable(VariableId(at as u32)));
    let constant = (object.index() < domain.constants.len()).then_some(Term::Object(object));
    variables.chain(constant).collect()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(CASES[1]))]

    #[test]
    fn no_step_of_the_safe_model_fails(seed in any::<u64>()) {
        keeps_its_promise(seed, PLAIN, &Options { rule: Rule::Safe, ..Options::default() });
    }

    #[test]
    fn with_negative_preconditions_not_even_where_anything_is_deleted(seed in any::<u64>()) {
        let options = Options { rule: Rule::Safe, negative: true, ..Options::default() };
        keeps_its_promise(seed, NEGATIVE, &options);
    }

    #[test]
    fn the_upper_bound_is_the_intersection_over_all_liftings(seed in any::<u64>()) {
        for kind in [PLAIN, AGENTS] {
            let sample = random::sample(seed, kind);
            let learned = rule::learn(&sample.domain, &sample.traces, &Options::default());
            for action in &learned.actions {
                let found: BTreeSet<String> =
                    action.required.iter().map(|atom| format!("{atom:?}")).collect();
                prop_assert_eq!(Some(found), naive(&sample.domain, &sample.traces, action.action), "{}", sample.text);
            }
        }
    }

    #[test]
    fn what_was_seen_can_be_done_again(seed in any::<u64>()) {
        let sample = random::sample(seed, PLAIN);
        let learned = rule::learn(&sample.domain, &sample.traces, &Options::default());
        for trace in &sample.traces {
            for (before, joint, after) in trace.transitions() {
                let step = joint.parts[0].as_ref().expect("each step is one");
                let Some(at) = learned.actions.iter().position(|one| one.action == step.action) else {
                    continue;
                };
                let action = &learned.actions[at];
                let value = |term: &Term| match term {
                    Term::Variable(id) => step.arguments[id.index()],
                    Term::Object(id) => *id,
                };
                // A guard may keep out what was seen, where something else of the kind would be unclear.
                let guarded = action.same.iter().any(|(one, other)| value(one) != value(other))
                    || action.distinct.iter().any(|(one, other)| value(one) == value(other));
                if guarded {
                    continue;
                }
                let ground = |atom: &Atom| lang::model::Fact {
                    predicate: atom.predicate,
                    arguments: atom.arguments.iter().map(value).collect(),
                };
                let facts = |list: &[Atom]| list.iter().map(ground).collect::<BTreeSet<_>>();
                let held: BTreeSet<_> =
                    before.facts().iter().map(|id| trace.facts[id.index()].clone()).collect();
                let wanted: BTreeSet<_> =
                    after.facts().iter().map(|id| trace.facts[id.index()].clone()).collect();
                prop_assert!(facts(&action.required).is_subset(&held));
                let mut got: BTreeSet<_> = &held - &facts(&action.deletes);
                got.extend(facts(&action.adds));
                prop_assert_eq!(got, wanted, "{}", sample.text);
            }
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(CASES[0]))]

    #[test]
    fn nor_of_several_agents(seed in any::<u64>()) {
        keeps_its_promise(seed, AGENTS, &Options::default());
    }

    #[test]
    fn nor_of_agents_that_demand_each_other(seed in any::<u64>()) {
        for joint in [Company::Unclear, Company::Together] {
            keeps_its_promise(seed, AGENTS, &Options { joint, ..Options::default() });
        }
    }
}

#[test]
fn the_promise_is_about_something() {
    let options = Options { joint: Company::Together, ..Options::default() };
    let (mut single, mut joint, mut partners, mut guards, mut refused) = (0, 0, 0, 0, 0);
    for seed in 0..100 {
        single += keeps_its_promise(seed, PLAIN, &options).single;
        joint += keeps_its_promise(seed, AGENTS, &options).joint;
        let sample = random::sample(seed, AGENTS);
        let learned = rule::learn(&sample.domain, &sample.traces, &options);
        partners += learned.actions.iter().filter(|one| !one.partners.is_empty()).count();
        let guarded = |one: &&rule::Action| !one.same.is_empty() || !one.distinct.is_empty();
        guards += learned.actions.iter().filter(guarded).count();
        let alone = rule::learn(&sample.domain, &sample.traces, &Options::default());
        refused += alone.refused.len() - learned.refused.len();
    }
    assert!(single > 1000 && joint > 1000, "{single} and {joint}");
    assert!(partners > 10 && guards > 10 && refused > 5, "{partners}, {guards} and {refused}");
}
