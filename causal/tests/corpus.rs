//! The shared corpus of networks, tables and exact answers goes in, and is met: data of others, read where it lies and skipped loudly
//! where it is absent.

use std::fs::{self, File};
use std::io::Read;
use std::path::PathBuf;

use causal::discover::{Config, Discovery, discover};
use causal::discretize::{declare, discretize};
use causal::file::bif;
use causal::graph::Dag;
use causal::infer::elimination::posterior;
use causal::infer::junction::JunctionTree;
use causal::knowledge::Knowledge;
use causal::pattern::Pattern;
use causal::place::Policy;
use causal::source::csv::{Csv, Open};
use causal::stream;
use causal::survey::survey;
use causal::table::Table;
use causal::variable::{State, VariableId};

/// The folder of the corpus, if it is there.
fn corpus() -> Option<PathBuf> {
    let root = std::env::var_os("CAVEAT_SHARED")
        .map_or_else(|| PathBuf::from("../../shared"), PathBuf::from);
    let folder = root.join("corpus");
    if folder.join("bif").is_dir() {
        return Some(folder);
    }
    eprintln!("SKIPPED: no networks at {}; set CAVEAT_SHARED", folder.display());
    None
}

fn json(path: &PathBuf) -> serde_json::Value {
    let text =
        fs::read_to_string(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    serde_json::from_str(&text).expect("the corpus is JSON")
}

fn load(path: PathBuf) -> Table {
    let open: Open = Box::new(move || Ok(Box::new(File::open(&path)?) as Box<dyn Read + Send>));
    let source = Csv::new(vec![("table".to_owned(), open)]).expect("the corpus is CSV");
    let declared = declare(&source);
    let survey = survey(&source, &declared).expect("there are trials");
    let found = discretize(&source, &declared, &survey, None).expect("they have states");
    stream::table(&source, &found.variables, Policy::default()).expect("they are states").0
}

/// What the default learner makes of a table, and how far it is from the truth.
fn learned(folder: &std::path::Path, net: &str, file: &str) -> (Discovery, usize) {
    let table = load(folder.join(format!("causal/data/{net}_{file}_10000.csv")));
    let truth = json(&folder.join(format!("causal/truth/{net}.json")));
    let id =
        |name: &serde_json::Value| table.named(name.as_str().expect("a name")).expect("a column");
    let arcs =
        truth["edges"].as_array().expect("arcs").iter().map(|arc| (id(&arc[0]), id(&arc[1])));
    let graph = Dag::of_arcs(table.variables().len(), arcs).expect("no cycle");
    let found = discover(&table, &Knowledge::default(), &Config::default()).expect("it is learned");
    let distance = found.pattern.distance(&Pattern::of(&graph));
    (found, distance)
}

#[test]
fn the_best_graphs_have_the_proven_scores() {
    let Some(folder) = corpus() else { return };
    let known = json(&folder.join("causal/exact.json"));
    for (net, file) in [("asia", "p1"), ("asia", "p2"), ("sachs", "p1")] {
        let (found, distance) = learned(&folder, net, file);
        let best = known[net][file]["bic"].as_f64().expect("a score");
        assert!((found.score - best).abs() < 1e-6, "{net} {file}: {} is not {best}", found.score);
        assert!(distance <= 1, "{net} {file}: {distance}");
    }
}

#[test]
fn large_networks_are_found_again_nearly() {
    let Some(folder) = corpus() else { return };
    for (net, most) in [("insurance", 30), ("alarm", 5)] {
        let (_, distance) = learned(&folder, net, "p1");
        assert!(distance <= most, "{net}: {distance}");
    }
}

#[test]
fn queries_have_the_known_answers() {
    let Some(folder) = corpus() else { return };
    for net in ["asia", "child", "insurance", "alarm"] {
        let text = fs::read_to_string(folder.join(format!("bif/{net}.bif")))
            .expect("the network is there");
        let network = bif::read(&text).expect("it is BIF");
        let tree = JunctionTree::new(&network).expect("its cliques are small");
        let read = |name: &str| json(&folder.join(format!("causal/data/{net}_{name}.json")));
        let (queries, answers) = (read("queries"), read("posteriors"));
        let queries =
            queries.as_array().expect("queries").iter().zip(answers.as_array().expect("answers"));
        for (query, answer) in queries.step_by(7) {
            let id = |name: &str| network.named(name).expect("a variable");
            let evidence: Vec<(VariableId, State)> = query["evidence"]
                .as_object()
                .expect("evidence")
                .iter()
                .map(|(name, state)| {
                    let variable = network.variable(id(name));
                    (
                        id(name),
                        variable
                            .state_of_word(state.as_str().expect("a state"))
                            .expect("its state"),
                    )
                })
                .collect();
            let target = id(query["target"].as_str().expect("a name"));
            let eliminated = posterior(&network, target, &evidence).expect("an answer");
            let spread = tree
                .calibrate(&evidence)
                .expect("an answer")
                .posterior(target)
                .expect("it is not seen");
            let expected = answer.as_array().expect("a probability for each state");
            for ((one, other), expected) in eliminated.iter().zip(&spread).zip(expected) {
                let expected = expected.as_f64().expect("a number");
                assert!(
                    (one - expected).abs() < 1e-12 && (other - expected).abs() < 1e-6,
                    "{net}: {query}"
                );
            }
        }
    }
}

#[test]
fn the_networks_of_the_literature_come_back_to_the_last_bit() {
    let Some(folder) = corpus() else { return };
    let mut read = 0;
    for entry in fs::read_dir(folder.join("bif")).expect("a folder").flatten() {
        if entry.path().extension().is_none_or(|ending| ending != "bif") {
            continue;
        }
        let text = fs::read_to_string(entry.path()).expect("text");
        let network =
            bif::read(&text).unwrap_or_else(|fault| panic!("{}: {fault}", entry.path().display()));
        assert_eq!(bif::read(&bif::write(&network).expect("all is known")).expect("ours"), network);
        read += 1;
    }
    assert!(read >= 10, "there are ten, and {read} were read");
}
