//! The contrastive search against the thesis's table 2.2 and figure 2.9, and against trying everything.

use std::fmt::Write as _;

use causal::contrast::{Contrast, Question, contrast};
use causal::graph::Dag;
use causal::network::{Conditional, Network};
use causal::prevent::{Prevention, prevent};
use causal::situation::{Known, Situation};
use causal::variable::{State, Variable, VariableId};
use causal::words::{Audience, Time, Vocabulary, explain};
use proptest::prelude::*;

/// Adds a line.
macro_rules! put {
    ($text:ident, $($piece:tt)*) => {
        writeln!($text, $($piece)*).expect("a string takes any text")
    };
}

/// A network of settings that all cause one outcome, with the probability of success of each combination.
fn network(settings: Vec<Variable>, success: impl Fn(&[State]) -> f64) -> Network {
    let arities: Vec<usize> = settings.iter().map(Variable::arity).collect();
    let mut variables = settings;
    variables.push(Variable::of_words("success", ["0", "1"]));
    let goal = VariableId(variables.len() as u16 - 1);
    let arcs = (0..goal.0).map(|id| (VariableId(id), goal));
    let graph = Dag::of_arcs(variables.len(), arcs).unwrap();
    let uniform = |arity: usize| Conditional {
        probabilities: vec![1.0 / arity as f64; arity],
        ..Conditional::default()
    };
    let mut tables: Vec<Conditional> = arities.iter().map(|&arity| uniform(arity)).collect();
    let rows: usize = arities.iter().product();
    let mut probabilities = Vec::new();
    for row in 0..rows {
        let mut rest = row;
        let mut states = vec![0; arities.len()];
        for (state, &arity) in states.iter_mut().zip(&arities).rev() {
            *state = (rest % arity) as State;
            rest /= arity;
        }
        let one = success(&states);
        probabilities.extend([1.0 - one, one]);
    }
    tables.push(Conditional { probabilities, ..Conditional::default() });
    Network::new(variables, graph, tables).unwrap()
}

fn intervals(name: &str, edges: &[f64]) -> Variable {
    let mut variable = Variable::of_intervals(name, edges.to_vec());
    variable.unit = Some("cm".to_owned());
    variable
}

fn situation(values: &[(&str, f64)]) -> Situation {
    values.iter().map(|&(name, value)| (name.to_owned(), Known::Number(value))).collect()
}

fn ask<'a>(network: &'a Network, situation: &'a Situation, threshold: f64) -> Question<'a> {
    let goal = network.named("success").unwrap();
    Question {
        network,
        goal: (goal, 1),
        situation,
        free: network.ids().filter(|&id| id != goal).map(|id| (id, 1.0)).collect(),
        threshold,
        least_trials: 1,
        most: 100_000,
    }
}

/// What was found, as a person reads it.
fn told(network: &Network, found: &Contrast, words: &str) -> String {
    let vocabulary: Vocabulary = serde_json::from_str(words).unwrap();
    let known = |probability: Option<f64>| {
        probability.map_or("unknown".to_owned(), |one| format!("{one:.3}"))
    };
    let mut text = format!("before: {}\n", known(found.before));
    for answer in &found.answers {
        let labels: Vec<String> = answer
            .changes
            .iter()
            .map(|change| {
                let variable = network.variable(change.variable);
                format!(
                    "{} {} -> {}",
                    variable.name,
                    variable.label(change.from),
                    variable.label(change.to)
                )
            })
            .collect();
        put!(text, "{}: {:.3}, cost {}", labels.join(", "), answer.probability, answer.cost);
        for audience in [Audience::User, Audience::Engineer] {
            put!(
                text,
                "  {}",
                explain(network, &answer.changes, &vocabulary, audience, Time::Past)
            );
        }
    }
    text
}

const CUBES: &str = r#"{"variables": {
    "xOff": {"subject": "the upper cube", "verb": "was stacked", "more": "too far to the right of the lower cube", "less": "too far to the left of the lower cube"},
    "yOff": {"subject": "the upper cube", "verb": "was stacked", "more": "too far to the front of the lower cube", "less": "too far to the back of the lower cube"},
    "dropOff": {"subject": "the upper cube", "verb": "was stacked", "more": "too high", "less": "too low"}}}"#;

const SPHERES: &str = r#"{"variables": {
    "xOff": {"subject": "the sphere", "verb": "was dropped", "more": "too far to the right", "less": "too far to the left"},
    "yOff": {"subject": "the sphere", "verb": "was dropped", "more": "too far to the front", "less": "too far to the back"},
    "contSize": {"subject": "the container (plate)", "verb": "was", "more": "too large", "less": "too small"},
    "contHeight": {"subject": "the container (plate)", "verb": "was", "more": "too high", "less": "too low"}}}"#;

/// The four examples of table 2.2: its intervals, and its probabilities where it prints them. What it does not print fails.
#[test]
fn table_2_2_is_explained_as_printed() {
    let off = [-1.8, -1.2, -0.6, 0.6, 1.2, 1.8];
    let drop = [0.5, 1.8, 2.2, 3.2, 4.5, 5.5];
    let cubes = |printed: &'static [([State; 3], f64)]| {
        let settings =
            vec![intervals("xOff", &off), intervals("yOff", &off), intervals("dropOff", &drop)];
        network(settings, move |states| {
            printed.iter().find(|(one, _)| one == states).map_or(0.3, |&(_, p)| p)
        })
    };
    let wide = [-6.4, -3.6, -1.2, 1.2, 4.5, 5.4, 6.4];
    let spheres = |printed: &'static [([State; 4], f64)]| {
        let settings = vec![
            intervals("xOff", &wide),
            intervals("yOff", &wide),
            intervals("contSize", &[10.0, 14.0, 17.0, 22.0]),
            intervals("contHeight", &[1.5, 2.9, 6.3, 9.5]),
        ];
        network(settings, move |states| {
            printed.iter().find(|(one, _)| one == states).map_or(0.3, |&(_, p)| p)
        })
    };
    let mut all = String::new();
    let first = cubes(&[([4, 2, 4], 0.58), ([4, 2, 3], 0.91)]);
    let at = situation(&[("xOff", 1.5), ("yOff", 0.0), ("dropOff", 5.0)]);
    all += &told(&first, &contrast(&ask(&first, &at, 0.8)).unwrap(), CUBES);
    let second = cubes(&[([0, 0, 1], 0.017), ([1, 1, 1], 1.0)]);
    let at = situation(&[("xOff", -1.5), ("yOff", -1.5), ("dropOff", 2.0)]);
    all += &told(&second, &contrast(&ask(&second, &at, 0.8)).unwrap(), CUBES);
    let third = spheres(&[([5, 5, 2, 2], 0.727), ([4, 5, 2, 2], 0.98)]);
    let at = situation(&[("xOff", 5.9), ("yOff", 5.9), ("contSize", 21.0), ("contHeight", 9.0)]);
    all += &told(&third, &contrast(&ask(&third, &at, 0.8)).unwrap(), SPHERES);
    let fourth = spheres(&[([1, 1, 1, 0], 0.58), ([1, 1, 2, 0], 0.933)]);
    let at = situation(&[("xOff", -3.0), ("yOff", -3.0), ("contSize", 15.0), ("contHeight", 1.7)]);
    all += &told(&fourth, &contrast(&ask(&fourth, &at, 0.8)).unwrap(), SPHERES);
    insta::assert_snapshot!(all);
}

/// Figure 2.9: two variables of five intervals, from x1, y4; one step does not help, two do.
#[test]
fn the_search_of_figure_2_9() {
    let edges = [0.0, 1.0, 2.0, 3.0, 4.0, 5.0];
    let figure = network(vec![intervals("x", &edges), intervals("y", &edges)], |states| {
        if states == [1, 2] { 0.9 } else { 0.2 }
    });
    let at = situation(&[("x", 0.5), ("y", 3.5)]);
    let found = contrast(&ask(&figure, &at, 0.8)).unwrap();
    let mut text = String::new();
    for visit in &found.trace {
        let mut states = [0, 3];
        for change in &visit.changes {
            states[change.variable.index()] = change.to;
        }
        let probability = visit.probability.expect("all rows are known");
        let taken = if probability > 0.8 { "  <- likely" } else { "" };
        put!(
            text,
            "{} step(s): x{} y{}  {probability:.1}{taken}",
            visit.cost,
            states[0] + 1,
            states[1] + 1
        );
    }
    text += &told(&figure, &found, "{\"variables\": {}}");
    insta::assert_snapshot!(text);
}

#[test]
fn costs_choose_and_what_may_not_be_changed_stays() {
    let edges = [0.0, 1.0, 2.0, 3.0];
    let both = network(vec![intervals("x", &edges), intervals("y", &edges)], |states| {
        if states[0] == 1 || states[1] == 1 { 0.9 } else { 0.1 }
    });
    let at = situation(&[("x", 0.5), ("y", 0.5)]);
    let mut question = ask(&both, &at, 0.5);
    assert_eq!(contrast(&question).unwrap().answers.len(), 2, "both are as near");
    question.free[0].1 = 3.0;
    let dear = contrast(&question).unwrap();
    assert_eq!(dear.answers.len(), 1);
    assert_eq!(dear.answers[0].changes[0].variable, VariableId(1));
    question.free.remove(1);
    let only = contrast(&question).unwrap();
    assert_eq!((only.answers[0].changes[0].variable, only.answers[0].cost), (VariableId(0), 3.0));
    question.threshold = 0.95;
    let none = contrast(&question).unwrap();
    assert_eq!((none.answers.len(), none.looked, none.complete), (0, 3, true));
    // The middle of the interval for what changes; what does not keeps its value.
    question.threshold = 0.5;
    let Prevention::Correct { situation, .. } = prevent(&question, 0.5).unwrap() else {
        panic!("it helps")
    };
    assert_eq!(situation, self::situation(&[("x", 1.5), ("y", 0.5)]));
}

#[test]
fn what_cannot_be_asked_is_said() {
    let edges = [0.0, 1.0, 2.0];
    let never = network(vec![intervals("x", &edges)], |_| 0.0);
    let at = situation(&[("x", 0.5)]);
    let said = |network: &Network, at: &Situation| {
        contrast(&ask(network, at, 0.5)).unwrap_err().to_string()
    };
    let sometimes = network(vec![intervals("x", &edges)], |states| f64::from(states[0]));
    let all = [
        said(&never, &at),
        said(&sometimes, &situation(&[("x", 7.0)])),
        said(&sometimes, &situation(&[])),
        contrast(&Question { free: Vec::new(), ..ask(&sometimes, &at, 0.5) })
            .unwrap_err()
            .to_string(),
    ];
    insta::assert_snapshot!(all.join("\n"));
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(200) })]

    /// All nearest situations, and no others, are what trying every situation finds.
    #[test]
    fn the_search_finds_what_trying_everything_finds(
        successes in prop::collection::vec(0.0..1.0_f64, 36),
        start in (0.0..4.0_f64, 0.0..3.0_f64, 0..3_u8),
        costs in prop::collection::vec(1..4_u8, 3),
        threshold in 0.5..0.99_f64,
    ) {
        let settings = vec![
            intervals("a", &[0.0, 1.0, 2.0, 3.0, 4.0]),
            intervals("b", &[0.0, 1.0, 2.0, 3.0]),
            Variable::of_words("c", ["red", "green", "blue"]),
        ];
        let at = |states: &[State]| usize::from(states[0]) * 9 + usize::from(states[1]) * 3 + usize::from(states[2]);
        let model = network(settings, |states| successes[at(states)]);
        let mut here = situation(&[("a", start.0), ("b", start.1)]);
        here.insert("c".to_owned(), Known::Word(["red", "green", "blue"][usize::from(start.2)].to_owned()));
        let mut question = ask(&model, &here, threshold);
        for (free, &cost) in question.free.iter_mut().zip(&costs) {
            free.1 = f64::from(cost);
        }
        let found = contrast(&question).unwrap();
        let begin = [start.0 as State, start.1 as State, start.2];
        let mut likely: Vec<(f64, Vec<State>)> = Vec::new();
        for a in 0..4_u8 {
            for b in 0..3_u8 {
                for c in 0..3_u8 {
                    let cost = f64::from(a.abs_diff(begin[0]) * costs[0] + b.abs_diff(begin[1]) * costs[1])
                        + f64::from(u8::from(c != begin[2]) * costs[2]);
                    if cost > 0.0 && successes[at(&[a, b, c])] > threshold {
                        likely.push((cost, vec![a, b, c]));
                    }
                }
            }
        }
        let least = likely.iter().map(|one| one.0).fold(f64::INFINITY, f64::min);
        let mut expected: Vec<Vec<State>> =
            likely.into_iter().filter(|one| one.0 <= least).map(|one| one.1).collect();
        let mut answers: Vec<Vec<State>> = found
            .answers
            .iter()
            .map(|answer| {
                let mut states = begin.to_vec();
                for change in &answer.changes {
                    states[change.variable.index()] = change.to;
                }
                states
            })
            .collect();
        expected.sort();
        answers.sort();
        prop_assert_eq!(answers, expected);
    }
}
