//! A folder of networks, tables and queries goes in; what reading, estimating and asking costs, and how exact the answers are, come out.
//!
//! `cargo run --release -p caveat-causal --example inference -- ../shared/corpus [FOLDER OF MORE BIF]`

use std::fs::{self, File};
use std::io::Read;
use std::path::PathBuf;

use causal::discretize::{declare, discretize};
use causal::estimate::{Estimator, estimate};
use causal::file::bif;
use causal::graph::Dag;
use causal::infer::elimination::posterior;
use causal::place::Policy;
use causal::source::csv::{Csv, Open};
use causal::stream;
use causal::survey::survey;
use causal::variable::{State, VariableId};

/// Seconds since the program began; one thread works, so that on a quiet machine they are its own.
fn seconds() -> f64 {
    static BEGAN: std::sync::LazyLock<std::time::Instant> =
        std::sync::LazyLock::new(std::time::Instant::now);
    BEGAN.elapsed().as_secs_f64()
}

fn main() {
    rayon::ThreadPoolBuilder::new()
        .num_threads(1)
        .use_current_thread()
        .build_global()
        .expect("one thread");
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let corpus = PathBuf::from(&arguments[0]);
    let mut folders = vec![corpus.join("bif")];
    folders.extend(arguments.get(1).map(PathBuf::from));
    for folder in folders {
        let mut files: Vec<PathBuf> =
            fs::read_dir(&folder).expect("a folder").flatten().map(|entry| entry.path()).collect();
        files.sort();
        for path in
            files.iter().filter(|path| path.extension().is_some_and(|ending| ending == "bif"))
        {
            let text = fs::read_to_string(path).expect("text");
            let start = seconds();
            let network =
                bif::read(&text).unwrap_or_else(|fault| panic!("{}: {fault}", path.display()));
            let read = seconds() - start;
            let again =
                bif::read(&bif::write(&network).expect("all is known")).expect("what was written");
            println!("{}\tread in {read:.4} s\tround trip {}", path.display(), again == network);
        }
    }
    for net in ["asia", "child", "insurance", "alarm"] {
        let text = fs::read_to_string(corpus.join(format!("bif/{net}.bif"))).expect("a network");
        let network = bif::read(&text).expect("a network");
        let path = corpus.join(format!("causal/data/{net}_p1_10000.csv"));
        let open: Open = Box::new(move || Ok(Box::new(File::open(&path)?) as Box<dyn Read + Send>));
        let source = Csv::new(vec![(net.to_owned(), open)]).expect("CSV");
        let declared = declare(&source);
        let survey = survey(&source, &declared).expect("trials");
        let variables = discretize(&source, &declared, &survey, None).expect("states").variables;
        let table = stream::table(&source, &variables, Policy::default()).expect("states").0;
        let arcs = network.graph().arcs().map(|(from, to)| {
            let id = |id: VariableId| {
                table.named(&network.variable(id).name).expect("the same variables")
            };
            (id(from), id(to))
        });
        let graph = Dag::of_arcs(table.variables().len(), arcs).expect("no cycle");
        let start = seconds();
        for _ in 0..10 {
            std::hint::black_box(
                estimate(&table, &graph, Estimator::Bdeu(1.0)).expect("estimates"),
            );
        }
        let fit = (seconds() - start) / 10.0;
        let read = |name: &str| -> serde_json::Value {
            let text = fs::read_to_string(corpus.join(format!("causal/data/{net}_{name}.json")))
                .expect("a file");
            serde_json::from_str(&text).expect("JSON")
        };
        let (queries, answers) = (read("queries"), read("posteriors"));
        let id = |name: &str| network.named(name).expect("a variable of the network");
        let questions: Vec<(VariableId, Vec<(VariableId, State)>)> = queries
            .as_array()
            .expect("queries")
            .iter()
            .map(|query| {
                let evidence =
                    query["evidence"].as_object().expect("evidence").iter().map(|(name, state)| {
                        let id = id(name);
                        let state = state.as_str().expect("a state");
                        (
                            id,
                            network
                                .variable(id)
                                .state_of_word(state)
                                .expect("a state of the variable"),
                        )
                    });
                (id(query["target"].as_str().expect("a name")), evidence.collect())
            })
            .collect();
        let start = seconds();
        let found: Vec<Vec<f64>> = questions
            .iter()
            .map(|(target, evidence)| posterior(&network, *target, evidence).expect("an answer"))
            .collect();
        let asked = seconds() - start;
        let mut worst: f64 = 0.0;
        for (found, answer) in found.iter().zip(answers.as_array().expect("answers")) {
            let answer = answer.as_array().expect("a probability for each state");
            for (expected, probability) in answer.iter().zip(found) {
                worst = worst.max((probability - expected.as_f64().expect("a number")).abs());
            }
        }
        println!(
            "{net}\tfit {fit:.5} s\t{} queries {asked:.4} s\tfarthest from the known answers {worst:.1e}",
            found.len()
        );
    }
}
