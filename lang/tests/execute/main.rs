//! `lang::execute` and `lang::validate` against a second interpreter, which grounds everything and is too simple to be wrong in the same way.

mod depth;
mod meaning;
mod naive;
mod plans;
mod random;
mod stories;
mod text;

use lang::execute::Executor;
use lang::model::Fact;
use lang::plan::Plan;
use lang::validate::{Verdict, is_valid, judge};
use naive::Naive;
use proptest::prelude::*;
use random::{Tape, World};

fn tape() -> impl Strategy<Value = Tape> {
    proptest::collection::vec(any::<u8>(), 0..600).prop_map(Tape::new)
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 1500, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn both_interpreters_agree_on_states_steps_and_goals(mut tape in tape()) {
        let world = World::new(&mut tape);
        let naive = Naive::new(&world.domain, &world.problem);
        let executor = Executor::new(&world.domain, &world.problem);
        prop_assert_eq!(naive.is_none(), executor.is_err(), "stratification");
        let (Some(naive), Ok(executor)) = (naive, executor) else { return Ok(()) };
        let (mut facts, mut state) = (naive.initial(), executor.initial());
        for _ in 0..5 {
            prop_assert_eq!(state.facts(), facts.iter().cloned().collect::<Vec<_>>());
            for fact in naive.all_facts() {
                let derived = naive.derived(&facts);
                prop_assert_eq!(executor.contains(&state, &fact), derived.contains(&fact), "{:?}", fact);
            }
            prop_assert_eq!(executor.goal(&state), naive.goal(&facts));
            let step = world.step(&mut tape);
            prop_assert_eq!(executor.applicable(&state, &step), naive.applicable(&facts, &step), "{:?}", step);
            if executor.fits(&step).is_err() {
                continue;
            }
            prop_assert_eq!(executor.cost(&state, &step).ok(), naive.cost(&facts, &step));
            let before = state.clone();
            let change = executor.apply(&mut state, &step);
            facts = naive.apply(&facts, &step);
            let lost = |from: Vec<Fact>, to: Vec<Fact>| from.into_iter().filter(|fact| !to.contains(fact)).collect::<Vec<_>>();
            let sorted = |mut facts: Vec<Fact>| {
                facts.sort();
                facts
            };
            prop_assert_eq!(sorted(change.added.clone()), lost(state.facts(), before.facts()));
            prop_assert_eq!(sorted(change.deleted.clone()), lost(before.facts(), state.facts()));
            let mut back = state.clone();
            executor.revert(&mut back, &change);
            prop_assert_eq!(back.facts(), before.facts());
        }
    }

    #[test]
    fn mutated_plans_are_judged_alike(mut tape in tape()) {
        let world = World::new(&mut tape);
        let (Some(naive), Ok(executor)) =
            (Naive::new(&world.domain, &world.problem), Executor::new(&world.domain, &world.problem))
        else {
            return Ok(());
        };
        let plan = naive.plan(3).unwrap_or_else(|| Plan { steps: (0..3).map(|_| world.step(&mut tape)).collect() });
        for _ in 0..6 {
            let mutant = world.mutate(&plan, &mut tape);
            let expected = naive.validate(&mutant);
            let verdict = judge(&executor, &mutant);
            prop_assert_eq!(is_valid(&executor, &mutant), expected.is_some());
            match verdict {
                Verdict::Valid(success) => prop_assert_eq!(Some(success.cost), expected),
                Verdict::Invalid(failure) => {
                    prop_assert_eq!(None, expected);
                    let story = lang::validate::story(&Verdict::Invalid(failure.clone()), &world.domain, &world.problem, &mutant);
                    prop_assert!(story.starts_with("The plan fails"));
                    if let Some(mended) = random::mended(&mutant, &failure.repair) {
                        prop_assert!(naive.is_executable(&mended), "{}", story);
                    }
                }
            }
        }
    }
}
