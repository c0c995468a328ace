//! The same trials go to a table, to `DataFusion` and to a Ballista cluster on this machine, and all must count the same.
#![cfg(feature = "datafusion")]

use std::fs;

use causal::cluster::{Cluster, Engine};
use causal::count::Counter;
use causal::discover::{Config, discover};
use causal::estimate::{Estimator, estimate};
use causal::knowledge::Knowledge;
use causal::table::Table;
use causal::variable::{Variable, VariableId};

/// Trials as a table and as a file of CSV.
fn trials() -> (Table, tempfile::TempDir) {
    let mut random = fastrand::Rng::with_seed(9);
    let variables = vec![
        Variable::of_intervals("xOff", vec![-3.0, -1.0, 1.0, 3.0]),
        Variable::of_words("colour", ["it's", "blue"]),
        Variable::of_words("onTop", ["0", "1"]),
    ];
    let mut lines = vec!["xOff,colour,onTop".to_owned()];
    let mut columns = vec![Vec::new(); 3];
    for _ in 0..2000 {
        let x = (random.f64() * 6.0 - 3.0) * 1.001;
        let colour = random.u8(..2);
        let stays = u8::from(x.abs() < 1.0 && random.f64() < 0.9);
        lines.push(format!("{x},{},{stays}", ["it's", "blue"][usize::from(colour)]));
        // A few lie outside every interval, and count nowhere.
        if let Some(state) = variables[0].state_of_number(x) {
            columns[0].push(state);
            columns[1].push(colour);
            columns[2].push(stays);
        }
    }
    let folder = tempfile::tempdir().expect("there is room for a folder");
    fs::write(folder.path().join("trials.csv"), lines.join("\n")).expect("the file can be written");
    (Table::new(variables, columns).expect("states of the variables"), folder)
}

/// Whether an engine counts what the table counts, and learns the same from it.
fn holds(engine: &Engine) {
    let (table, folder) = trials();
    let path = folder.path().join("trials.csv");
    let path = path.to_str().expect("the path is text");
    let cluster = Cluster::new(engine, path, table.variables()).expect("the trials are known");
    assert_eq!(cluster.rows(), table.len() as u64);
    assert_eq!(cluster.dropped(), 2000 - table.len() as u64);
    assert!(cluster.dropped() > 0, "some trials lie outside");
    let sets: Vec<Vec<VariableId>> = [&[0, 1, 2][..], &[2, 0], &[1], &[]]
        .map(|set| set.iter().map(|&id| VariableId(id)).collect())
        .into();
    assert_eq!(cluster.count(&sets).expect("counts"), table.count(&sets).expect("counts"));
    let learn = |counter: &dyn Counter| {
        let found = discover(counter, &Knowledge::default(), &Config::default()).expect("a graph");
        estimate(counter, &found.graph, Estimator::Bdeu(1.0)).expect("probabilities")
    };
    assert_eq!(learn(&cluster), learn(&table));
}

#[test]
fn datafusion_counts_as_a_table_does() {
    holds(&Engine::embedded().expect("an engine of this process"));
}

/// A scheduler and an executor of this process, which talk over the loopback interface.
#[cfg(feature = "ballista")]
#[test]
fn a_cluster_counts_as_a_table_does() {
    holds(&Engine::standalone().expect("a cluster on this machine"));
}
