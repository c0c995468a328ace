//! A folder of tables with known graphs goes in; how near each learner comes, and the processor seconds that it takes, come out.
//!
//! `cargo run --release -p caveat-causal --example discover -- ../shared/corpus/causal [NET …]`, or with `--method NAME` first for one
//! learner. Each row: the network, the file, the learner, the distance to the true pattern, the score less that of the true graph, how
//! much was counted, the processor seconds.

use std::fs::{self, File};
use std::io::Read;
use std::path::{Path, PathBuf};

use causal::discover::{Config, Method, discover};
use causal::discretize::{declare, discretize};
use causal::graph::Dag;
use causal::knowledge::Knowledge;
use causal::pattern::Pattern;
use causal::place::Policy;
use causal::score::Scorer;
use causal::source::csv::{Csv, Open};
use causal::stream;
use causal::survey::survey;
use causal::table::Table;

const METHODS: [(&str, Method); 9] = [
    ("exact", Method::Exact),
    ("greedy", Method::Greedy),
    ("order", Method::Order),
    ("hill", Method::Hill),
    ("tabu", Method::Tabu),
    ("pc", Method::Pc),
    ("grow-shrink", Method::GrowShrink),
    ("iamb", Method::Iamb),
    ("mmhc", Method::Mmhc),
];

fn load(path: &Path) -> Table {
    let name = path.display().to_string();
    let path: PathBuf = path.to_owned();
    let open: Open = Box::new(move || Ok(Box::new(File::open(&path)?) as Box<dyn Read + Send>));
    let source = Csv::new(vec![(name, open)]).expect("the file is CSV");
    let declared = declare(&source);
    let survey = survey(&source, &declared).expect("it has trials");
    let found = discretize(&source, &declared, &survey, None).expect("they have states");
    stream::table(&source, &found.variables, Policy::default()).expect("they are states").0
}

fn truth(folder: &Path, net: &str, table: &Table) -> Dag {
    let text = fs::read_to_string(folder.join(format!("truth/{net}.json")))
        .expect("there is a true graph");
    let json: serde_json::Value = serde_json::from_str(&text).expect("it is JSON");
    let id = |name: &serde_json::Value| {
        table.named(name.as_str().expect("a name")).expect("a column of the table")
    };
    let arcs = json["edges"].as_array().expect("arcs").iter().map(|arc| (id(&arc[0]), id(&arc[1])));
    Dag::of_arcs(table.variables().len(), arcs).expect("no cycle")
}

fn processor_seconds() -> f64 {
    let stat = fs::read_to_string("/proc/self/schedstat").unwrap_or_default();
    let threads: f64 = fs::read_dir("/proc/self/task").map_or(0.0, |tasks| {
        tasks
            .flatten()
            .filter_map(|task| fs::read_to_string(task.path().join("schedstat")).ok())
            .filter_map(|text| text.split_whitespace().next()?.parse::<f64>().ok())
            .sum()
    });
    threads.max(stat.split_whitespace().next().and_then(|text| text.parse().ok()).unwrap_or(0.0))
        / 1e9
}

fn main() {
    let mut arguments: Vec<String> = std::env::args().skip(1).collect();
    let only = (arguments.first().map(String::as_str) == Some("--method")).then(|| {
        arguments.remove(0);
        arguments.remove(0)
    });
    let folder = PathBuf::from(arguments.first().expect("the folder of the tables"));
    let nets: Vec<&str> = match &arguments[1..] {
        [] => vec!["asia", "sachs", "child", "insurance", "alarm"],
        nets => nets.iter().map(String::as_str).collect(),
    };
    for net in nets {
        for file in ["p1", "p2"] {
            let table = load(&folder.join(format!("data/{net}_{file}_10000.csv")));
            let truth = truth(&folder, net, &table);
            for (name, method) in METHODS {
                let exact_is_too_much = method == Method::Exact && table.variables().len() > 20;
                if only.as_ref().is_some_and(|only| only != name) || exact_is_too_much {
                    continue;
                }
                let config = Config { method, ..Config::default() };
                let start = processor_seconds();
                let found =
                    discover(&table, &Knowledge::default(), &config).expect("it is learned");
                let seconds = processor_seconds() - start;
                let scorer = Scorer::new(&table, config.score);
                let distance = found.pattern.distance(&Pattern::of(&truth));
                println!(
                    "{net}\t{file}\t{name}\tdistance {distance}\tscore {:.6} ({:+.1})\tasked {}\t{seconds:.3} s",
                    found.score,
                    found.score - scorer.total(&truth),
                    found.asked
                );
            }
        }
    }
}
