//! The joint semantics of `lang::execute` against a second one, which reads the texts itself, grounds everything, and is too simple to be wrong in the same way.

mod brute;
mod corpus;
mod ground;
mod meaning;
mod naive;
mod random;
mod tape;
mod text;

use std::collections::BTreeSet;

use brute::{Least, Measure};
use lang::execute::Executor;
use lang::execute::joint::Concurrency;
use lang::model::{ActionId, Domain, Fact, ObjectId, Problem};
use lang::plan::{self, JointPlan, Step};
use lang::source::Sources;
use lang::validate::joint::{Verdict, judge};
use naive::{Facts, Joint, Tally, World};
use proptest::prelude::*;
use random::Texts;
use rust_decimal::Decimal;
use tape::Tape;

fn tape() -> impl Strategy<Value = Tape> {
    proptest::collection::vec(any::<u8>(), 100..500).prop_map(Tape::new)
}

/// One world as both know it.
struct Both {
    texts: Texts,
    domain: Domain,
    problem: Problem,
    world: World,
}

impl Both {
    /// The texts must be free of errors.
    fn read(texts: Texts) -> Self {
        let mut sources = Sources::default();
        let domain = sources.add("domain.pddl", texts.domain.as_str());
        let problem = sources.add("problem.pddl", texts.problem.as_str());
        let (domain, mut diagnostics) = lang::read_domain(&sources, domain);
        let (problem, more) = lang::read_problem(&sources, problem, &domain);
        diagnostics.append(more);
        let said = lang::render::full(&diagnostics, &sources, false);
        assert!(!diagnostics.has_errors(), "{}\n{}\n{said}", texts.domain, texts.problem);
        let world = ground::world(&texts.domain, &texts.problem);
        Self { texts, domain, problem, world }
    }

    fn executor(&self) -> Executor<'_> {
        Executor::new(&self.domain, &self.problem).expect("rules are stratified")
    }

    fn concurrency(&self) -> Concurrency {
        if self.world.safe { Concurrency::Safe } else { Concurrency::Liberal }
    }

    /// Facts as the second one writes them.
    fn lines(&self, facts: &[Fact]) -> Facts {
        let line = |fact: &Fact| {
            let name = self.domain.predicates[fact.predicate.index()].name.text.as_str();
            let objects = fact.arguments.iter();
            let objects = objects.map(|at| self.problem.objects[at.index()].name.text.as_str());
            format!("({})", [name].into_iter().chain(objects).collect::<Vec<_>>().join(" "))
        };
        facts.iter().map(line).collect()
    }

    fn line(&self, step: &Step) -> String {
        plan::line(step, &self.domain, &self.problem)
    }

    /// A step of any action that mostly fits.
    fn step(&self, tape: &mut Tape) -> Step {
        let action = tape.below(self.domain.actions.len());
        let scope = &self.domain.actions[action].scope;
        let all = &self.problem.objects;
        let mut object = |types: &[_]| {
            let fits = |at: &usize| self.domain.has_type(&all[*at], types);
            let fitting: Vec<usize> = (0..all.len()).filter(fits).collect();
            let anything = fitting.is_empty() || tape.below(20) == 19;
            let at =
                if anything { tape.below(all.len()) } else { fitting[tape.below(fitting.len())] };
            ObjectId(at as u32)
        };
        let parameters = &scope.variables[..scope.parameters as usize];
        let arguments = parameters.iter().map(|variable| object(&variable.types)).collect();
        Step { action: ActionId(action as u32), arguments }
    }

    /// Steps of mostly different agents.
    fn some_parts(&self, tape: &mut Tape) -> Vec<Step> {
        let executor = self.executor();
        let mut parts: Vec<Step> = Vec::new();
        let strict = tape.below(8) != 7;
        for _ in 0..=tape.below(5) {
            let part = self.step(tape);
            let busy = parts.iter().any(|other| executor.agent(other) == executor.agent(&part));
            if !(strict && busy) {
                parts.push(part);
            }
        }
        parts
    }

    /// One of the joint actions that can be taken, sometimes with a part more or less; or any steps.
    fn parts(&self, facts: &Facts, tape: &mut Tape) -> Vec<Step> {
        let joint_actions = brute::joint_actions(&self.world, facts, &mut 300).unwrap_or_default();
        if joint_actions.is_empty() || tape.below(4) == 3 {
            return self.some_parts(tape);
        }
        let mut joint_actions: Vec<&Joint> = joint_actions.iter().collect();
        joint_actions.sort_by_key(|joint| std::cmp::Reverse(joint.len()));
        let mut parts: Vec<Step> = joint_actions[tape.below(joint_actions.len())]
            .iter()
            .map(|line| self.parse(line))
            .collect();
        match tape.below(6) {
            4 if parts.len() > 1 => drop(parts.remove(tape.below(parts.len()))),
            5 => parts.push(self.step(tape)),
            _ => {}
        }
        parts
    }

    /// A step from its line.
    fn parse(&self, line: &str) -> Step {
        let mut words = line.trim_matches(['(', ')']).split(' ');
        let name = words.next().expect("a line is not empty");
        let action = self.domain.actions.iter().position(|action| action.name.text == name);
        let object =
            |word: &str| self.problem.objects.iter().position(|object| object.name.text == word);
        let arguments = words.map(|word| ObjectId(object(word).expect("it is declared") as u32));
        Step {
            action: ActionId(action.expect("it is declared") as u32),
            arguments: arguments.collect(),
        }
    }

    /// The texts and what else there is to say.
    fn told(&self, more: &dyn std::fmt::Debug) -> String {
        format!("{}\n{}\n{more:?}", self.texts.domain, self.texts.problem)
    }
}

fn joint(lines: &[String]) -> Joint {
    lines.iter().cloned().collect::<BTreeSet<_>>()
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 1000, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn both_agree_on_what_can_be_joined_and_on_what_comes_of_it(mut tape in tape()) {
        let both = Both::read(Texts::new(&mut tape));
        let (executor, world) = (both.executor(), &both.world);
        prop_assert_eq!(Concurrency::of(&both.domain), both.concurrency(), "{}", both.texts.domain);
        let (mut state, mut facts) = (executor.initial(), world.initial.clone());
        prop_assert_eq!(&both.lines(&state.facts()), &facts);
        for _ in 0..8 {
            prop_assert_eq!(executor.goal(&state), world.goal(&facts), "{}", both.told(&facts));
            let parts = both.parts(&facts, &mut tape);
            let lines: Vec<String> = parts.iter().map(|part| both.line(part)).collect();
            let joint = joint(&lines);
            for (concurrency, safe) in [(Concurrency::Liberal, false), (Concurrency::Safe, true)] {
                let clash = executor.join(&state, &parts, concurrency);
                // What stands there twice is no set.
                let joins = joint.len() == lines.len() && world.joins(&facts, &joint, safe);
                prop_assert_eq!(clash.is_ok(), joins, "{}", both.told(&(&facts, &lines, clash)));
            }
            if joint.len() < lines.len() || joint.iter().any(|line| !world.actions.contains_key(line)) {
                continue;
            }
            if both.problem.metric.is_some() {
                let cost = executor.joint_cost(&state, &parts).expect("all prices are known");
                prop_assert_eq!(cost, world.cost(&facts, &joint).into(), "{}", both.told(&(&facts, &lines)));
            }
            let after = world.after(&facts, &joint);
            executor.apply_joint(&mut state, &parts);
            prop_assert_eq!(&both.lines(&state.facts()), &after, "{}", both.told(&(&facts, &lines)));
            facts = after;
        }
    }

    #[test]
    fn both_judge_a_joint_plan_alike_and_none_is_less_than_the_least(mut tape in tape()) {
        let both = Both::read(brute::texts(&mut tape));
        let (executor, world) = (both.executor(), &both.world);
        let mut plan = JointPlan::default();
        let mut facts = world.initial.clone();
        for _ in 0..10 {
            if world.goal(&facts) {
                break;
            }
            let parts = both.parts(&facts, &mut tape);
            let lines: Vec<String> = parts.iter().map(|part| both.line(part)).collect();
            if world.joins(&facts, &joint(&lines), world.safe) {
                facts = world.after(&facts, &joint(&lines));
            } else if tape.below(8) < 7 {
                continue;
            }
            plan.steps.push(parts);
        }
        let text = plan::write_joint(&plan, &both.domain, &both.problem, Decimal::ZERO);
        let Some(read) = naive::plan(&text) else { return Ok(()) };
        let tally = match judge(&executor, &plan, both.concurrency()) {
            Verdict::Valid(success) => Some(Tally {
                steps: success.steps as i64,
                actions: success.actions as i64,
                cost: i64::try_from(success.cost).expect("costs are integers"),
            }),
            Verdict::Invalid(_) => None,
        };
        prop_assert_eq!(tally, world.judge(&read, world.safe).ok(), "{}", both.told(&text));
        let Some(tally) = tally else { return Ok(()) };
        for (measure, amount) in
            [(Measure::Steps, tally.steps), (Measure::Actions, tally.actions), (Measure::Cost, tally.cost)]
        {
            match brute::least(world, measure, 2_000) {
                Least::Is(least) => prop_assert!(least <= amount, "{}", both.told(&(measure, least, text))),
                Least::Unsolvable => prop_assert!(false, "{}", both.told(&text)),
                Least::Unknown => {}
            }
        }
    }
}
