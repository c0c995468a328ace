//! A network of a world of cubes and a threshold go in; how many failures it prevents in trials that it has not seen comes out, with whatever it corrects needlessly.
//!
//! `cargo run --release -p caveat-domains --example prevention -- MODEL CUBES TRIALS SEED ENOUGH TARGET [WORLD.json]`
//!
//! A trial is predicted before the first cube is let go and again before each further one, when what has been done cannot be changed any
//! more; success is that the last cube stays. The same trial is run without a correction, with those of the network, and with every
//! cube let go in the middle from the least height; all that is not corrected, down to how the gripper errs, is the same. What a
//! correction of the first prediction alone does, which is what an explanation says, is told apart.

use std::fs;

use causal::contrast::{Question, contrast, corrected};
use causal::derive::Derivation;
use causal::file::json;
use causal::network::Network;
use causal::prevent::{Prevention, prevent};
use causal::situation::{Known, Situation};
use causal::variable::{Role, VariableId};
use domains::trial::stack::{Parameters, Place, Stack};
use domains::trial::{Chance, Values, World, noise};
use rayon::prelude::*;

/// What came of a trial.
#[derive(Default)]
#[expect(clippy::struct_excessive_bools, reason = "each is a line of the table")]
struct Outcome {
    plain: bool,
    predicted: bool,
    touched: bool,
    prevented: bool,
    centred: bool,
    /// Whether it was explained, and whether it succeeds with that change alone.
    explained: Option<bool>,
}

struct Test<'a> {
    stack: &'a Stack,
    network: &'a Network,
    enough: f64,
    target: f64,
}

impl Test<'_> {
    fn run(&self, seed: u64, trial: u64) -> Outcome {
        let set = self.stack.draw(seed, trial);
        let chance = || noise(seed, trial);
        let last = |set: &[f64], chance: Chance| self.stack.run(set, chance).last() == Some(&1.0);
        let mut outcome = Outcome { plain: last(&set, chance()), ..Outcome::default() };
        let situation = self.situation(&set);
        let first = self.question(&situation, 0);
        let found = causal::contrast::probability(&first).expect("the trial is one of the model");
        outcome.predicted = found.is_some_and(|found| found >= self.enough);
        (outcome.prevented, outcome.touched) = self.corrected(&set, chance());
        let mut centred = set.clone();
        for (value, column) in centred.iter_mut().zip(self.stack.columns()) {
            if let Values::Between(low, _) = column.values {
                *value = if column.name.starts_with("drop") { low } else { 0.0 };
            }
        }
        outcome.centred = last(&centred, chance());
        if !outcome.plain {
            let found = contrast(&first).expect("the trial is one of the model");
            outcome.explained = found.answers.first().map(|answer| {
                last(&self.set(&corrected(self.network, &situation, &answer.changes)), chance())
            });
        }
        outcome
    }

    /// Whether the tower stands when each cube is looked at before it is let go, and whether anything was changed.
    fn corrected(&self, set: &[f64], chance: Chance) -> (bool, bool) {
        let mut tower = self.stack.begin(chance);
        let (mut set, mut touched) = (set.to_vec(), false);
        for cube in 0..self.stack.cubes() {
            let situation = self.situation(&set);
            let question = self.question(&situation, cube);
            if let Ok(Prevention::Correct { situation, .. }) = prevent(&question, self.enough) {
                set = self.set(&situation);
                touched = true;
            }
            let place: Place = self.stack.places(&set)[cube];
            if !tower.put(place) {
                return (false, touched);
            }
        }
        (true, touched)
    }

    /// What is asked before a cube is let go.
    fn question<'q>(&'q self, situation: &'q Situation, cube: usize) -> Question<'q> {
        let goal = self.network.goal.as_ref().expect("the model has a goal");
        let goal = self.network.named(&goal.variable).expect("its variable is there");
        let success = self.network.variable(goal).state_of_word("1").expect("and its state");
        let may = |id: &VariableId| {
            let variable = self.network.variable(*id);
            let own = !matches!(&variable.from, Some(Derivation::Of(_)));
            let later = match variable.name.rsplit_once('_') {
                Some((_, number)) => number.parse().is_ok_and(|number: usize| number > cube),
                None => true,
            };
            variable.role == Some(Role::Treatment) && own && later
        };
        Question {
            network: self.network,
            goal: (goal, success),
            situation,
            free: self.network.ids().filter(may).map(|id| (id, 1.0)).collect(),
            threshold: self.target,
            least_trials: 5,
            most: 200_000,
        }
    }

    fn situation(&self, set: &[f64]) -> Situation {
        let columns = self.stack.columns().into_iter().zip(set);
        let known = |(column, &value): (domains::trial::Column, &f64)| match column.values {
            Values::Between(..) => (column.name, Known::Number(value)),
            Values::Words(words) => (column.name, Known::Word(words[value as usize].to_owned())),
        };
        columns.map(known).collect()
    }

    fn set(&self, situation: &Situation) -> Vec<f64> {
        let set = self.stack.columns().into_iter().filter(|column| column.role == Role::Treatment);
        set.map(|column| match (&situation[&column.name], column.values) {
            (Known::Number(value), _) => *value,
            (Known::Word(word), Values::Words(words)) => {
                words.iter().position(|one| one == word).expect("it is one of the words") as f64
            }
            other => panic!("{} cannot be {other:?}", column.name),
        })
        .collect()
    }
}

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let number = |at: usize| arguments[at].parse::<f64>().expect("a number");
    let network =
        json::read(&fs::read_to_string(&arguments[0]).expect("a model")).expect("a model in JSON");
    let parameters = match arguments.get(6) {
        None => Parameters::default(),
        Some(path) => {
            serde_json::from_str(&fs::read_to_string(path).expect("the measures of a world"))
                .expect("measures")
        }
    };
    let stack = Stack::new(number(1) as usize, parameters).expect("a world");
    let test = Test { stack: &stack, network: &network, enough: number(4), target: number(5) };
    let seed = number(3) as u64;
    let outcomes: Vec<Outcome> =
        (0..number(2) as u64).into_par_iter().map(|trial| test.run(seed, trial)).collect();
    let count = |what: &dyn Fn(&Outcome) -> bool| outcomes.iter().filter(|one| what(one)).count();
    let all = outcomes.len();
    let failures = count(&|one| !one.plain);
    let share = |part: usize, of: usize| {
        format!("{part} of {of} ({:.1} %)", part as f64 / of.max(1) as f64 * 100.0)
    };
    println!("failures without: {}", share(failures, all));
    println!(
        "predicted rightly before the first cube: {}",
        share(count(&|one| one.plain == one.predicted), all)
    );
    println!("the majority: {}", share(failures.max(all - failures), all));
    println!("failures prevented: {}", share(count(&|one| !one.plain && one.prevented), failures));
    println!(
        "good trials corrected: {}",
        share(count(&|one| one.plain && one.touched), all - failures)
    );
    println!(
        "good trials broken: {}",
        share(count(&|one| one.plain && !one.prevented), all - failures)
    );
    println!(
        "failures prevented by always centring: {}",
        share(count(&|one| !one.plain && one.centred), failures)
    );
    println!("failures although all are centred: {}", share(count(&|one| !one.centred), all));
    let explained = count(&|one| one.explained.is_some());
    println!("failures explained: {}", share(explained, failures));
    println!(
        "explanations true in the world: {}",
        share(count(&|one| one.explained == Some(true)), explained)
    );
}
