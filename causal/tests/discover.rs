//! Small tables drawn from random networks go in, and what learners make of them is held: the best graph is the best, knowledge is
//! obeyed, and neither the order of columns nor threads change anything.

use causal::count::Counter;
use causal::discover::{Config, DiscoverError, Discovery, Method, discover};
use causal::graph::Dag;
use causal::independence::Test;
use causal::knowledge::Knowledge;
use causal::pattern::Pattern;
use causal::score::{Score, Scorer};
use causal::table::Table;
use causal::variable::{Variable, VariableId};
use proptest::prelude::*;

const METHODS: [Method; 10] = [
    Method::Auto,
    Method::Exact,
    Method::Greedy,
    Method::Order,
    Method::Hill,
    Method::Tabu,
    Method::Pc,
    Method::GrowShrink,
    Method::Iamb,
    Method::Mmhc,
];

/// Trials of a random network over `many` variables of two or three states.
fn draw(seed: u64, many: usize, rows: usize) -> Table {
    let mut random = fastrand::Rng::with_seed(seed);
    let arities: Vec<u8> = (0..many).map(|_| random.u8(2..=3)).collect();
    let parents: Vec<Vec<usize>> =
        (0..many).map(|child| (0..child).filter(|_| random.f64() < 0.5).collect()).collect();
    let salt: Vec<u64> = (0..many).map(|_| random.u64(..)).collect();
    let mut columns: Vec<Vec<u8>> = vec![Vec::new(); many];
    for _ in 0..rows {
        for child in 0..many {
            // Each configuration of the parents prefers one state.
            let key = parents[child].iter().fold(salt[child], |key, &parent| {
                key.wrapping_mul(31)
                    .wrapping_add(u64::from(*columns[parent].last().expect("parents come first")))
            });
            let favourite = fastrand::Rng::with_seed(key).u8(..arities[child]);
            let state = if random.f64() < 0.7 { favourite } else { random.u8(..arities[child]) };
            columns[child].push(state);
        }
    }
    let name = |at: usize| format!("v{}", (at * 11 + 3) % many);
    let words = |arity: u8| (0..arity).map(|state| state.to_string());
    let variables = (0..many).map(|at| Variable::of_words(name(at), words(arities[at]))).collect();
    Table::new(variables, columns).unwrap()
}

fn learn(table: &dyn Counter, knowledge: &Knowledge, method: Method) -> Discovery {
    discover(table, knowledge, &Config { method, ..Config::default() }).unwrap()
}

/// The arcs by name, so that tables with other orders of columns can be compared.
fn named(table: &Table, found: &Discovery) -> (Vec<(String, String)>, Vec<String>) {
    let name = |id: VariableId| table.variable(id).name.clone();
    let mut arcs: Vec<(String, String)> =
        found.graph.arcs().map(|(from, to)| (name(from), name(to))).collect();
    arcs.sort();
    let join = |&(one, other): &(VariableId, VariableId)| {
        let mut ends = [name(one), name(other)];
        ends.sort();
        ends.join(" - ")
    };
    let mut undirected: Vec<String> = found.pattern.undirected().iter().map(join).collect();
    undirected.sort();
    (arcs, undirected)
}

/// All graphs over four variables.
fn graphs() -> Vec<Dag> {
    let pairs = [(0, 1), (0, 2), (0, 3), (1, 2), (1, 3), (2, 3)]
        .map(|(a, b)| (VariableId(a), VariableId(b)));
    (0..3_usize.pow(6))
        .filter_map(|code| {
            let arcs = pairs.iter().enumerate().filter_map(|(at, &(a, b))| {
                match code / 3_usize.pow(at as u32) % 3 {
                    0 => None,
                    1 => Some((a, b)),
                    _ => Some((b, a)),
                }
            });
            Dag::of_arcs(4, arcs).ok()
        })
        .collect()
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 12, ..ProptestConfig::default() })]

    #[test]
    fn the_exact_graph_is_the_best_of_all(seed in any::<u64>(), which in 0..3_usize) {
        let table = draw(seed, 4, 300);
        let score = [Score::Bic, Score::Bdeu(1.0), Score::K2][which];
        let scorer = Scorer::new(&table, score);
        let best = graphs().iter().map(|graph| scorer.total(graph)).fold(f64::NEG_INFINITY, f64::max);
        for method in METHODS {
            let config = Config { method, score, ..Config::default() };
            let found = discover(&table, &Knowledge::default(), &config).unwrap();
            prop_assert!((scorer.total(&found.graph) - found.score).abs() < 1e-9);
            prop_assert!(found.score <= best + 1e-9, "{method:?} beats the best");
            if matches!(method, Method::Auto | Method::Exact) {
                prop_assert!((found.score - best).abs() < 1e-9, "{} is not {best}", found.score);
            }
        }
    }

    #[test]
    fn the_order_of_columns_and_threads_change_nothing(seed in any::<u64>(), turn in 1..7_usize) {
        let table = draw(seed, 7, 400);
        let mut order: Vec<VariableId> = table.ids().collect();
        order.rotate_left(turn);
        order.swap(0, 3);
        let turned = table.project(&order);
        let alone = rayon::ThreadPoolBuilder::new().num_threads(1).build().unwrap();
        let two = rayon::ThreadPoolBuilder::new().num_threads(2).build().unwrap();
        for method in METHODS {
            let one = alone.install(|| learn(&table, &Knowledge::default(), method));
            let other = two.install(|| learn(&turned, &Knowledge::default(), method));
            prop_assert_eq!(named(&table, &one), named(&turned, &other), "{:?}", method);
            prop_assert_eq!(one.score.to_bits(), other.score.to_bits());
        }
    }

    #[test]
    fn knowledge_is_obeyed_and_a_graph_comes_out(seed in any::<u64>()) {
        let table = draw(seed, 6, 400);
        let name = |at: u16| table.variable(VariableId(at)).name.clone();
        let knowledge = Knowledge {
            tiers: vec![vec![name(5)], vec![name(0), name(1)]],
            required: vec![(name(3), name(2))],
            forbidden: vec![(name(0), name(1)), (name(4), name(0))],
            set: vec![name(4)],
        };
        for method in METHODS {
            let found = learn(&table, &knowledge, method);
            let parents = |id: u16| -> Vec<u16> {
                found.graph.parents(VariableId(id)).iter().map(|id| id.0).collect()
            };
            prop_assert!(parents(2).contains(&3), "{method:?}: what is required");
            prop_assert!(!parents(1).contains(&0), "{method:?}: what is forbidden");
            prop_assert!(!parents(0).contains(&4), "{method:?}: what is forbidden");
            prop_assert!(parents(4).is_empty(), "{method:?}: what was set");
            prop_assert!(!parents(5).iter().any(|id| [0, 1].contains(id)), "{method:?}: an earlier tier");
            // The pattern has the arcs of the graph, and directs none otherwise.
            for (from, to) in found.pattern.arcs() {
                prop_assert!(found.graph.parents(to).contains(&from), "{method:?}");
            }
            prop_assert_eq!(found.graph.arcs().count(), found.pattern.arcs().len() + found.pattern.undirected().len());
        }
    }
}

#[test]
fn a_score_that_differs_within_a_class_leads_nobody_round() {
    for seed in 0..60 {
        let table = draw(seed, 4, 300);
        let config = Config { method: Method::Greedy, score: Score::K2, ..Config::default() };
        let found = discover(&table, &Knowledge::default(), &config).unwrap();
        let empty = Scorer::new(&table, Score::K2).total(&Dag::empty(4));
        assert!(found.score >= empty - 1e-9);
    }
}

#[test]
fn what_tests_say_is_as_it_is_whichever_test_says_it() {
    let table = draw(5, 5, 2000);
    let patterns: Vec<Pattern> = [Test::G2, Test::X2, Test::MutualInformation]
        .into_iter()
        .map(|test| {
            let config = Config { method: Method::Pc, test, ..Config::default() };
            discover(&table, &Knowledge::default(), &config).unwrap().pattern
        })
        .collect();
    assert_eq!(patterns[0], patterns[2]);
    assert_eq!(patterns[0], patterns[1]);
}

#[test]
fn a_column_that_never_varies_is_said_and_has_no_arcs() {
    let table = draw(1, 3, 200);
    let mut variables = table.variables().to_vec();
    variables.push(Variable::of_words("same", ["only"]));
    let mut columns: Vec<Vec<u8>> = table.ids().map(|id| table.column(id).to_vec()).collect();
    columns.push(vec![0; 200]);
    let table = Table::new(variables, columns).unwrap();
    for method in METHODS {
        let found = learn(&table, &Knowledge::default(), method);
        assert!(found.pattern.adjacent(VariableId(3)).is_empty(), "{method:?}");
        assert_eq!(
            found.notes,
            ["`same` is the same in every trial: no arc of it can be learned"],
            "{method:?}"
        );
    }
}

#[test]
fn what_cannot_be_learned_from_is_said() {
    let table = draw(1, 3, 50);
    let said = |table: &Table, config: &Config| -> DiscoverError {
        discover(table, &Knowledge::default(), config).unwrap_err()
    };
    let one = table.project(&[VariableId(0)]);
    assert_eq!(
        said(&one, &Config::default()).to_string(),
        "a graph needs two variables, and there is one"
    );
    let none = table.select(&[]);
    assert_eq!(said(&none, &Config::default()).to_string(), "there is no trial");
    let many = draw(1, 21, 20);
    let exact = Config { method: Method::Exact, ..Config::default() };
    assert_eq!(
        said(&many, &exact).to_string(),
        "the best graph of 21 variables cannot be proven; up to 20 can, and `greedy` takes more"
    );
    let alpha = Config { alpha: 0.0, ..Config::default() };
    assert_eq!(said(&table, &alpha).to_string(), "alpha is 0; it is a probability between 0 and 1");
}
