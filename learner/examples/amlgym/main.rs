//! Folders of `AMLGym` or MA-SAM go in (a true `domain.pddl` and traces); how near the learned models come to the true one, and how long learning takes, comes out.
//!
//! `cargo run --release -p caveat-learner --example amlgym -- [--out FOLDER] FOLDER…`
//!
//! Precision and recall are those of `AMLGym` (`metrics/_syntactic.py` of version 1.0.13): of each true action the atoms of the positive and negative
//! preconditions, the adds and the deletes are counted together, and the mean is over the true actions; an action that was not learned
//! has precision 1 and recall 0. Types and signatures are the true domain's. The time is for reading all traces from memory and learning,
//! the least of several runs. With `--out` the learned domains are written to `FOLDER/NAME/RULE.pddl`.

mod score;

use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use lang::model::Domain;
use lang::source::Sources;
use learner::rule::{self, Options, Rule};
use learner::trace::{self, Reading, Trace};
use learner::write;

use score::Score;

/// How often the time is taken.
const RUNS: usize = 30;

/// The ways to learn that are compared.
const WAYS: [(&str, Rule, bool); 3] = [
    ("both", Rule::Both, false),
    ("changed", Rule::Changed, false),
    ("negative", Rule::Safe, true),
];

fn main() {
    let mut folders: Vec<PathBuf> = Vec::new();
    let mut out = None;
    let mut arguments = std::env::args().skip(1);
    while let Some(argument) = arguments.next() {
        if argument == "--out" {
            out = arguments.next().map(PathBuf::from);
        } else {
            folders.push(argument.into());
        }
    }
    let mut sums = vec![(Score::default(), Duration::ZERO); WAYS.len()];
    println!("{:12} {:9} {}  actions    time", "domain", "rule", Score::HEADS);
    for folder in &folders {
        for (way, sum) in WAYS.iter().zip(&mut sums) {
            let (score, time) = measure(folder, *way, out.as_deref());
            sum.0.add(&score);
            sum.1 = sum.1.max(time);
        }
    }
    for ((name, ..), (sum, time)) in WAYS.iter().zip(&sums) {
        println!(
            "{:12} {name:9} {}          {}",
            "mean, worst",
            sum.mean(folders.len()),
            milliseconds(*time)
        );
    }
}

fn milliseconds(time: Duration) -> String {
    format!("{:5.2} ms", time.as_secs_f64() * 1000.0)
}

fn measure(
    folder: &Path,
    (name, rule, negative): (&str, Rule, bool),
    out: Option<&Path>,
) -> (Score, Duration) {
    let title = folder.file_name().unwrap_or_default().to_string_lossy().into_owned();
    let (domain, texts) = load(folder);
    let options = Options { rule, negative, ..Options::default() };
    let mut best = Duration::MAX;
    for _ in 0..RUNS {
        let start = Instant::now();
        let traces = read(&domain, &texts);
        let learned = rule::learn(&domain, &traces, &options);
        best = best.min(start.elapsed());
        std::hint::black_box(learned);
    }
    let learned = rule::learn(&domain, &read(&domain, &texts), &options);
    let score = Score::of(&domain, &learned, rule);
    println!(
        "{title:12} {name:9} {score}  {:2} of {:2}  {}",
        learned.actions.len(),
        domain.actions.len(),
        milliseconds(best)
    );
    for refusal in &learned.refused {
        println!("             {}", refusal.describe(&learned.domain));
    }
    if let Some(out) = out {
        let folder = out.join(&title);
        std::fs::create_dir_all(&folder).expect("the folder can be made");
        let mut text = String::new();
        write!(text, "{}", write::text(&learned)).expect("a string takes all");
        std::fs::write(folder.join(format!("{name}.pddl")), text).expect("the file can be written");
    }
    (score, best)
}

fn load(folder: &Path) -> (Domain, Vec<(String, String)>) {
    let mut sources = Sources::default();
    let path = folder.join("domain.pddl");
    let text = std::fs::read_to_string(&path).expect("there is a domain");
    let id = sources.add(path.display().to_string(), text);
    let (domain, diagnostics) = lang::read_domain(&sources, id);
    assert!(!diagnostics.has_errors(), "{}", lang::render::concise(&diagnostics, &sources));
    let mut files: Vec<PathBuf> = Vec::new();
    for place in [folder.join("trajectories"), folder.to_owned()] {
        let Ok(entries) = place.read_dir() else { continue };
        let paths = entries.filter_map(|entry| Some(entry.ok()?.path()));
        files.extend(paths.filter(|path| {
            let name = path.to_string_lossy();
            name.ends_with("_traj") || name.ends_with(".trajectory")
        }));
    }
    files.sort();
    let name = |path: &PathBuf| path.file_name().unwrap_or_default().to_string_lossy().into_owned();
    let texts = files
        .iter()
        .map(|path| (name(path), std::fs::read_to_string(path).expect("traces are text")))
        .collect();
    (domain, texts)
}

fn read(domain: &Domain, texts: &[(String, String)]) -> Vec<Trace> {
    let traces = texts.iter().map(|(name, text)| {
        let (trace, faults) = trace::read(text, domain, &Reading { name, ..Reading::default() });
        assert!(faults.is_empty(), "{name}:{}", faults[0]);
        trace
    });
    traces.collect()
}
