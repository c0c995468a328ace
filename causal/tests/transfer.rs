//! Hand-made networks go in; what is carried over from one to another must be what one calculates by hand, and no row may lose anything.

use causal::graph::Dag;
use causal::network::{Conditional, Network};
use causal::table::Table;
use causal::transfer::curve::{Study, columns, curve};
use causal::transfer::relation::{Pair, Relation};
use causal::transfer::{Ends, Prior, Strategy, TransferError, estimated, prior, related};
use causal::variable::{Variable, VariableId};
use proptest::prelude::{prop, prop_assert, proptest};
use proptest::strategy::Strategy as Generated;

/// A network in which all variables but the last one cause the last one, whose table this is; the others are as these tables say, or even.
fn network(variables: Vec<Variable>, goal: Vec<f64>, roots: &[Vec<f64>]) -> Network {
    let last = variables.len() - 1;
    let mut tables: Vec<Conditional> = variables[..last]
        .iter()
        .map(|one| vec![1.0 / one.arity() as f64; one.arity()])
        .map(|probabilities| Conditional { probabilities, ..Conditional::default() })
        .collect();
    for (table, root) in tables.iter_mut().zip(roots) {
        table.probabilities.clone_from(root);
    }
    tables.push(Conditional { probabilities: goal, ..Conditional::default() });
    let arcs = (0..last as u16).map(|id| (VariableId(id), VariableId(last as u16)));
    let graph = Dag::of_arcs(last + 1, arcs).expect("nothing comes round");
    Network::new(variables, graph, tables).expect("the tables fit")
}

fn ends<'a>(source: &'a Network, target: &'a Network) -> Ends<'a> {
    let goal = |network: &Network| (VariableId(network.variables().len() as u16 - 1), 1);
    Ends { source, source_goal: goal(source), target, target_goal: goal(target) }
}

fn cut(name: &str, edges: &[f64]) -> Variable {
    Variable::of_intervals(name, edges.to_vec())
}

fn stays(name: &str) -> Variable {
    Variable::of_words(name, ["0", "1"])
}

/// One cube: it stays in 8 of 10 trials to the left, and in 4 of 10 to the right.
fn one_cube() -> Network {
    let variables = vec![cut("xOff", &[-1.0, 0.0, 1.0]), stays("onTop")];
    network(variables, vec![0.2, 0.8, 0.6, 0.4], &[])
}

/// Two cubes, of which nothing is known.
fn two_cubes(edges: &[f64]) -> Network {
    let variables = vec![cut("xOff_1", edges), cut("xOff_2", edges), stays("onTop_2")];
    let rows = (edges.len() - 1) * (edges.len() - 1);
    network(variables, vec![0.5; 2 * rows], &[])
}

/// The probabilities of success.
fn successes(prior: &Prior) -> Vec<Option<f64>> {
    prior.rows.iter().map(|row| row.as_ref().map(|row| row[1])).collect()
}

#[track_caller]
fn are(found: &[Option<f64>], wanted: &[Option<f64>]) {
    assert_eq!(found.len(), wanted.len());
    for (one, other) in found.iter().zip(wanted) {
        let close = match (one, other) {
            (Some(one), Some(other)) => (one - other).abs() < 1e-12,
            (one, other) => one == other,
        };
        assert!(close, "{found:?} should be {wanted:?}");
    }
}

#[test]
fn the_three_replacements_by_hand() {
    let (source, target) = (one_cube(), two_cubes(&[-1.0, 0.0, 1.0]));
    let ends = ends(&source, &target);
    let relation = related::relation(&ends);
    // The rows are (left, left), (left, right), (right, left), (right, right), the first cube first.
    for (strategy, wanted) in [
        (Strategy::Direct, [0.8, 0.8, 0.4, 0.4]),
        (Strategy::Cross, [0.8, 0.4, 0.8, 0.4]),
        (Strategy::Minimal, [0.8, 0.4, 0.4, 0.4]),
    ] {
        let found = prior(&ends, &relation, strategy).unwrap();
        are(&successes(&found), &wanted.map(Some));
        assert!(found.summed_out.is_empty());
    }
}

#[test]
fn other_cells_are_mixed_and_what_lies_outside_has_no_prior() {
    let (source, target) = (one_cube(), two_cubes(&[-1.0, -0.5, 0.5, 4.0]));
    let ends = ends(&source, &target);
    let found = prior(&ends, &related::relation(&ends), Strategy::Direct).unwrap();
    // The middle cell lies half over each of the source's; of the last one a seventh lies in its range.
    let (left, middle) = (Some(0.8), Some(0.6));
    are(&successes(&found), &[left, left, left, middle, middle, middle, None, None, None]);
    // Minimal replacement takes what there is: where the one cube lies outside, the other.
    let found = prior(&ends, &related::relation(&ends), Strategy::Minimal).unwrap();
    are(&successes(&found), &[left, middle, left, middle, middle, middle, left, middle, None]);
    let table = estimated(&found, 4.0, None, 2).unwrap();
    assert_eq!(table.unknown, [8], "neither the source nor a trial knows that row");
}

#[test]
fn causes_that_nothing_stands_for_are_summed_out() {
    let variables =
        vec![cut("xOff", &[-1.0, 0.0, 1.0]), cut("dropOff", &[0.0, 5.0, 10.0]), stays("onTop")];
    let goal = vec![0.1, 0.9, 0.5, 0.5, 0.4, 0.6, 0.8, 0.2];
    let source = network(variables, goal, &[vec![0.5, 0.5], vec![0.25, 0.75]]);
    let target = network(vec![cut("xOff", &[-1.0, 0.0, 1.0]), stays("inCont")], vec![0.5; 4], &[]);
    let ends = ends(&source, &target);
    let found = prior(&ends, &related::relation(&ends), Strategy::Direct).unwrap();
    assert_eq!(found.summed_out, ["dropOff"]);
    are(&successes(&found), &[Some(0.25 * 0.9 + 0.75 * 0.5), Some(0.25 * 0.6 + 0.75 * 0.2)]);
}

#[test]
fn equation_2_12_lies_between_the_trials_and_the_prior() {
    let (source, target) = (one_cube(), two_cubes(&[-1.0, 0.0, 1.0]));
    let ends = ends(&source, &target);
    let prior = prior(&ends, &related::relation(&ends), Strategy::Direct).unwrap();
    let counts = [1, 3, 0, 0, 5, 5, 2, 0];
    let none = estimated(&prior, 0.0, Some(&counts), 2).unwrap();
    assert_eq!(none.probabilities, [0.25, 0.75, 0.0, 0.0, 0.5, 0.5, 1.0, 0.0]);
    assert_eq!(none.unknown, [1], "without a weight a row without trials is unknown");
    let some = estimated(&prior, 6.0, Some(&counts), 2).unwrap();
    assert!((some.probabilities[1] - (6.0 * 0.8 + 3.0) / 10.0).abs() < 1e-12);
    assert!(
        (some.probabilities[3] - 0.8).abs() < 1e-12,
        "where there are no trials it is the prior"
    );
    let all = estimated(&prior, 1e12, Some(&counts), 2).unwrap();
    for (one, other) in all.probabilities.iter().zip(prior.rows.iter().flatten().flatten()) {
        assert!((one - other).abs() < 1e-9);
    }
    assert_eq!(
        estimated(&prior, f64::NAN, None, 2).unwrap_err().to_string(),
        "a prior is worth NaN trials; it can be any finite number from 0"
    );
}

#[test]
fn relations_by_hand_are_checked() {
    let (source, target) = (one_cube(), two_cubes(&[-1.0, 0.0, 1.0]));
    let ends = ends(&source, &target);
    let pair = |source: &str, target: &str| Pair {
        source: source.to_owned(),
        target: target.to_owned(),
        score: None,
        why: None,
    };
    let ask = |direct: Vec<Pair>| {
        let relation = Relation { version: 1, direct, cross: Vec::new() };
        prior(&ends, &relation, Strategy::Direct).unwrap_err().to_string()
    };
    assert_eq!(
        ask(vec![pair("xOf", "xOff_1")]),
        "the relation is wrong: in the source there is no variable `xOf`; did you mean `xOff`?"
    );
    assert_eq!(
        ask(vec![pair("xOff", "onTop_2")]),
        "the relation is wrong: `onTop_2` does not cause `onTop_2` in the target; its causes are xOff_1, xOff_2"
    );
    assert!(ask(vec![pair("xOff", "xOff_1"), pair("xOff", "xOff_2")]).contains("stands for two"));
    assert!(matches!(
        prior(&ends, &Relation { version: 1, direct: vec![], cross: vec![] }, Strategy::Cross),
        Err(TransferError::Unrelated { .. })
    ));
    let way = vec![vec![pair("xOff", "xOff_2")]];
    let crossed = Relation { version: 1, direct: vec![], cross: way };
    assert_eq!(prior(&ends, &crossed, Strategy::Direct), Err(TransferError::NothingSame));
    are(
        &successes(&prior(&ends, &crossed, Strategy::Minimal).unwrap()),
        &[Some(0.8), Some(0.4), Some(0.8), Some(0.4)],
    );
    let written = Relation::read(&crossed.write()).unwrap();
    assert_eq!(written, crossed);
}

#[test]
fn a_good_prior_is_better_than_none_and_trials_catch_up() {
    let (source, target) = (one_cube(), two_cubes(&[-1.0, 0.0, 1.0]));
    let ends = ends(&source, &target);
    let names = columns(&ends);
    assert_eq!(names, [VariableId(0), VariableId(1), VariableId(2)]);
    // Both cubes must stay: a product, which minimal replacement is nearest to.
    let drawn = |seed: u64, rows: usize| {
        let mut random = fastrand::Rng::with_seed(seed);
        let mut columns = vec![Vec::new(); 3];
        for _ in 0..rows {
            let (one, other) = (random.u8(..2), random.u8(..2));
            let chance = [0.95, 0.4];
            let stays = random.f64() < chance[usize::from(one)] * chance[usize::from(other)];
            for (column, state) in columns.iter_mut().zip([one, other, u8::from(stays)]) {
                column.push(state);
            }
        }
        Table::new(target.variables().to_vec(), columns).unwrap()
    };
    let (trials, test) = (drawn(1, 4000), drawn(2, 4000));
    let relation = related::relation(&ends);
    let study = Study {
        ends,
        relation: &relation,
        strategies: &Strategy::ALL,
        weights: &[0.0, 10.0],
        sizes: &[0, 8, 4000],
        trials: Some(&trials),
        repeats: 10,
        seed: 3,
        test: &test,
    };
    let points = curve(&study).unwrap();
    assert_eq!(points.len(), 12, "alone and three strategies, at three sizes");
    let none = points[0].measures;
    assert!((none.unknown - 1.0).abs() < 1e-12 && (none.brier - 0.25).abs() < 1e-12);
    assert_eq!(none.avoided, Some(0.0), "who knows nothing goes ahead");
    let minimal = points[3].measures;
    assert!(minimal.accuracy > none.accuracy && minimal.brier < none.brier);
    assert!(minimal.difference < points[1].measures.difference, "direct forgets the second cube");
    assert!(minimal.avoided > Some(0.8));
    assert!(points[7].measures.brier < points[4].measures.brier, "few trials are worth less");
    let (alone, with) = (points[8].measures, points[11].measures);
    assert!((alone.brier - with.brier).abs() < 0.001, "many trials need no prior");
    assert_eq!(curve(&study).unwrap(), points);
    let short = Study { sizes: &[5000], ..study };
    assert_eq!(
        curve(&short).unwrap_err().to_string(),
        "a curve up to 5000 trials needs as many, and there are 4000"
    );
}

/// Rows of three probabilities each.
fn table(rows: usize) -> impl Generated<Value = Vec<f64>> {
    prop::collection::vec((0.01_f64..1.0, 0.01_f64..1.0, 0.01_f64..1.0), rows).prop_map(|rows| {
        rows.into_iter()
            .flat_map(|(a, b, c)| {
                let whole = a + b + c;
                [a / whole, b / whole, c / whole]
            })
            .collect::<Vec<f64>>()
    })
}

fn edges() -> impl Generated<Value = Vec<f64>> {
    prop::collection::btree_set(-40_i32..40, 4)
        .prop_map(|edges| edges.into_iter().map(|edge| f64::from(edge) / 10.0).collect())
}

proptest! {
    #[test]
    fn rows_sum_to_one(
        from in table(9),
        own in (edges(), edges()),
        other in (edges(), edges(), edges()),
        weight in 0.0_f64..100.0,
        counts in prop::collection::vec(0_u64..5, 81),
    ) {
        let ends_in = |name: &str| Variable::of_words(name, ["falls", "stays", "tilts"]);
        let source = vec![cut("x_1", &own.0), cut("y_1", &own.1), ends_in("end_1")];
        let source = network(source, from, &[]);
        let target =
            vec![cut("x_1", &other.0), cut("x_2", &other.1), cut("y_2", &other.2), ends_in("end_2")];
        let target = network(target, vec![1.0 / 3.0; 81], &[]);
        let ends = ends(&source, &target);
        let relation = related::relation(&ends);
        for strategy in Strategy::ALL {
            let Ok(prior) = prior(&ends, &relation, strategy) else { continue };
            let table = estimated(&prior, weight, Some(&counts), 3).unwrap();
            for (row, chances) in table.probabilities.chunks_exact(3).enumerate() {
                if table.unknown.contains(&(row as u32)) {
                    continue;
                }
                let sum: f64 = chances.iter().sum();
                prop_assert!((sum - 1.0).abs() < 1e-9 && chances.iter().all(|one| *one >= 0.0));
            }
        }
    }

    #[test]
    fn a_network_carried_over_to_itself_stays_as_it_is(from in table(27), own in (edges(), edges(), edges())) {
        let ends_in = Variable::of_words("end", ["falls", "stays", "tilts"]);
        let variables = vec![cut("x_1", &own.0), cut("x_2", &own.1), cut("drop", &own.2), ends_in];
        let source = network(variables, from.clone(), &[]);
        let ends = ends(&source, &source);
        let relation = related::relation(&ends);
        for strategy in Strategy::ALL {
            let found = prior(&ends, &relation, strategy).unwrap();
            for (one, other) in found.rows.iter().flat_map(|row| row.as_ref().unwrap()).zip(&from) {
                prop_assert!((one - other).abs() < 1e-9);
            }
        }
    }
}
