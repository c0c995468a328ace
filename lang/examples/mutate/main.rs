//! Valid files go in, each is broken in one place many times; out comes a table of how well the reader says what was done.
//!
//! `cargo run -p caveat-lang --example mutate`, or with paths of files or folders to break those instead.
//! `--seed N` draws other places, `--trials N` breaks each file so many times in each way,
//! and `--show KIND` prints the first cases of that kind that fall short.
//! `--layout line` puts each file on one line before it is broken, `--layout flat` takes the indentation away,
//! and `--layout ours` lays it out as `caveat fmt` does.
//!
//! One file of each folder is taken that defines a domain, and one that defines a problem of it.
//! What counts as a mistake, and on which lines it may be reported, is told in `mutation.rs`, kind by kind.
//! What was said of the unbroken file, with the same code and the same words, is not counted.
//!
//! - *detected*: something new is said, be it an error or a warning.
//! - *right line*: the first new message, in the order of the text, has its primary mark on such a line.
//! - *one message*: exactly one new message.
//! - *suggestion*: of misspelt words, some new message has a fix that puts the original word back, and nothing else.

mod mutation;
mod requirement;
mod text;

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use lang::diagnostic::{Diagnostic, Diagnostics};
use lang::source::{SourceId, Sources};
use lang::{Kind as Defined, lint, render};

use mutation::{KINDS, Kind, Mutation};
use text::{Random, Text};

/// Files that are longer would take most of the time and tell nothing new.
const LONGEST: usize = 60_000;

/// How many cases `--show` prints.
const SHOWN: usize = 12;

/// What the command line says.
struct Options {
    paths: Vec<PathBuf>,
    seed: u64,
    trials: usize,
    show: Option<String>,
    layout: Option<String>,
}

/// How often what was the case.
#[derive(Default, Clone, Copy)]
struct Score {
    count: usize,
    detected: usize,
    right_line: usize,
    one_message: usize,
    misspelt: usize,
    suggested: usize,
}

fn main() -> ExitCode {
    let options = options();
    let mut files = Vec::new();
    options.paths.iter().for_each(|path| files_below(path, &mut files));
    let mut scores: BTreeMap<Kind, Score> = BTreeMap::new();
    let mut shown = 0;
    let mut tasks = 0;
    for (domain, problem) in tasks_of(&files) {
        tasks += 1;
        for (role, path) in [(Role::Domain, Some(&domain)), (Role::Problem, problem.as_ref())] {
            let Some(path) = path else { continue };
            let text = text::layout(read(path), options.layout.as_deref());
            if text.len() > LONGEST {
                continue;
            }
            let reader = Reader::new(role, read(&domain));
            let before = reader.messages(&text);
            if before.0.has_errors() {
                eprintln!("{} has errors and is left out", path.display());
                continue;
            }
            for kind in KINDS {
                let mut random = Random::new(options.seed, &format!("{}{kind:?}", path.display()));
                let whole = Text::new(&text, role == Role::Domain, &reader.domain);
                for _ in 0..options.trials {
                    let Some(mutation) = mutation::mutate(kind, &whole, &mut random) else {
                        continue;
                    };
                    let (said, sources) = reader.messages(&mutation.text);
                    let new = subtract(said, &before.0);
                    let verdict = judge(&mutation, &new, &sources);
                    let score = scores.entry(kind).or_default();
                    score.add(verdict);
                    let wanted = options.show.as_deref().is_some_and(|name| kind.name() == name);
                    if wanted && !verdict.is_perfect() && shown < SHOWN {
                        shown += 1;
                        show(path, &mutation, &new, &sources);
                    }
                }
            }
        }
    }
    println!("{tasks} domains, seed {}, {} trials", options.seed, options.trials);
    table(&scores);
    ExitCode::SUCCESS
}

fn options() -> Options {
    let repository = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let shared = std::env::var_os("CAVEAT_SHARED")
        .map_or_else(|| repository.join("../shared"), PathBuf::from);
    let mut options = Options { paths: Vec::new(), seed: 1, trials: 4, show: None, layout: None };
    let mut arguments = std::env::args().skip(1);
    while let Some(argument) = arguments.next() {
        let mut value = || arguments.next().expect("the option has a value");
        match argument.as_str() {
            "--seed" => options.seed = value().parse().expect("a seed is a number"),
            "--trials" => options.trials = value().parse().expect("trials are a number"),
            "--show" => options.show = Some(value()),
            "--layout" => options.layout = Some(value()),
            _ => options.paths.push(argument.into()),
        }
    }
    if options.paths.is_empty() {
        options.paths.push(repository.join("domains"));
        let ipc = shared.join("benchmarks/ipc");
        if ipc.is_dir() {
            options.paths.push(ipc);
        } else {
            eprintln!("no {}; set CAVEAT_SHARED", ipc.display());
        }
    }
    options
}

fn read(path: &Path) -> String {
    fs::read_to_string(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

/// All files of PDDL and HDDL at the path and below it.
fn files_below(path: &Path, found: &mut Vec<PathBuf>) {
    if path.is_dir() {
        let entries = fs::read_dir(path).expect("the folder can be read");
        let mut entries: Vec<PathBuf> =
            entries.map(|entry| entry.expect("an entry can be read").path()).collect();
        entries.sort();
        for path in entries {
            files_below(&path, found);
        }
    } else if path.extension().is_some_and(|end| end == "pddl" || end == "hddl") {
        found.push(path.to_owned());
    }
}

/// For each folder the first domain, and the first problem that names it.
fn tasks_of(files: &[PathBuf]) -> Vec<(PathBuf, Option<PathBuf>)> {
    let mut folders: BTreeMap<&Path, Vec<&PathBuf>> = BTreeMap::new();
    for file in files {
        folders.entry(file.parent().expect("a file is in a folder")).or_default().push(file);
    }
    let mut tasks = Vec::new();
    for files in folders.values() {
        let mut domain: Option<(&PathBuf, String)> = None;
        let mut problem = None;
        // Domains first, wherever their names stand in the order.
        for wanted in [true, false] {
            for &file in files {
                let mut sources = Sources::default();
                let id = sources.add("", read(file));
                match (lang::detect(&sources, id), &domain) {
                    (Some(Defined::Domain { name }), None) if wanted => {
                        domain = Some((file, name));
                    }
                    (Some(Defined::Problem { domain: Some(of), .. }), Some((_, name)))
                        if !wanted && problem.is_none() && of.eq_ignore_ascii_case(name) =>
                    {
                        problem = Some(file.clone());
                    }
                    _ => {}
                }
            }
        }
        if let Some((file, _)) = domain {
            tasks.push((file.clone(), problem));
        }
    }
    tasks
}

/// Which of the two files is broken.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Role {
    Domain,
    Problem,
}

/// Reads a text as a domain, or as a problem of one.
struct Reader {
    role: Role,
    domain: lang::model::Domain,
}

impl Reader {
    fn new(role: Role, domain: String) -> Self {
        let mut sources = Sources::default();
        let id = sources.add("domain", domain);
        Self { role, domain: lang::read_domain(&sources, id).0 }
    }

    /// What is said of the text, with the lints where there are no errors.
    fn messages(&self, text: &str) -> (Diagnostics, Sources) {
        let mut sources = Sources::default();
        let id = sources.add("text", text);
        let mut said;
        match self.role {
            Role::Domain => {
                let (domain, first) = lang::read_domain(&sources, id);
                said = first;
                if !said.has_errors() {
                    said.append(lint::domain(&domain));
                }
            }
            Role::Problem => {
                let (problem, first) = lang::read_problem(&sources, id, &self.domain);
                said = first;
                if !said.has_errors() {
                    said.append(lint::problem(&self.domain, &problem));
                }
            }
        }
        (said, sources)
    }
}

/// What is said now and was not said before.
fn subtract(said: Diagnostics, before: &Diagnostics) -> Diagnostics {
    let mut old: Vec<(&str, &str)> =
        before.list.iter().map(|one| (one.code, one.message.as_str())).collect();
    let is_new = |one: &Diagnostic| {
        let at = old.iter().position(|&(code, message)| code == one.code && message == one.message);
        at.map(|at| old.swap_remove(at)).is_none()
    };
    Diagnostics { list: said.list.into_iter().filter(is_new).collect() }
}

/// How well one mistake was reported.
#[derive(Clone, Copy)]
struct Verdict {
    detected: bool,
    right_line: bool,
    one_message: bool,
    /// Of misspelt words only.
    suggested: Option<bool>,
}

impl Verdict {
    fn is_perfect(self) -> bool {
        self.detected && self.right_line && self.one_message && self.suggested != Some(false)
    }
}

fn judge(mutation: &Mutation, new: &Diagnostics, sources: &Sources) -> Verdict {
    let source = SourceId(0);
    let first = new.list.iter().find(|one| one.primary.span.source == source);
    let line = first.map(|one| text::line_of(&mutation.text, one.primary.span.start as usize));
    let restores = |one: &Diagnostic, original: &str, range: &std::ops::Range<usize>| {
        one.fixes.iter().any(|fix| match fix.edits.as_slice() {
            [(span, replacement)] => {
                let (start, end) = (span.start as usize, span.end as usize);
                let mut mended = sources.get(source).text.clone();
                mended.replace_range(start..end, replacement);
                let end = range.start + original.len();
                mended.get(range.start..end).is_some_and(|now| now.eq_ignore_ascii_case(original))
                    && mended.len() + range.len() == mutation.text.len() + original.len()
            }
            _ => false,
        })
    };
    Verdict {
        detected: !new.list.is_empty(),
        right_line: line
            .is_some_and(|line| mutation.lines.iter().any(|lines| lines.contains(&line))),
        one_message: new.list.len() == 1,
        suggested: mutation
            .original
            .as_ref()
            .map(|(original, range)| new.list.iter().any(|one| restores(one, original, range))),
    }
}

impl Score {
    fn add(&mut self, verdict: Verdict) {
        self.count += 1;
        self.detected += usize::from(verdict.detected);
        self.right_line += usize::from(verdict.right_line);
        self.one_message += usize::from(verdict.one_message);
        self.misspelt += usize::from(verdict.suggested.is_some());
        self.suggested += usize::from(verdict.suggested == Some(true));
    }

    fn merge(&mut self, other: Self) {
        self.count += other.count;
        self.detected += other.detected;
        self.right_line += other.right_line;
        self.one_message += other.one_message;
        self.misspelt += other.misspelt;
        self.suggested += other.suggested;
    }
}

fn table(scores: &BTreeMap<Kind, Score>) {
    println!(
        "{:<22} {:>6} {:>9} {:>10} {:>11} {:>10}",
        "kind", "count", "detected", "right line", "one message", "suggestion"
    );
    let share = |part: usize, whole: usize| match whole {
        0 => "-".to_owned(),
        _ => format!("{:.1} %", 100.0 * part as f64 / whole as f64),
    };
    let row = |name: &str, score: Score| {
        println!(
            "{name:<22} {:>6} {:>9} {:>10} {:>11} {:>10}",
            score.count,
            share(score.detected, score.count),
            share(score.right_line, score.count),
            share(score.one_message, score.count),
            share(score.suggested, score.misspelt),
        );
    };
    let mut all = Score::default();
    for (kind, &score) in scores {
        row(kind.name(), score);
        all.merge(score);
    }
    row("all", all);
}

/// Prints a case: the lines around the place that was broken, and what is said.
fn show(path: &Path, mutation: &Mutation, new: &Diagnostics, sources: &Sources) {
    println!("--- {}: {}", path.display(), mutation.what);
    let line = text::line_of(&mutation.text, mutation.at);
    for (number, text) in mutation.text.lines().enumerate().skip(line.saturating_sub(4)).take(7) {
        let mark = if number + 1 == line { '>' } else { ' ' };
        println!("{mark}{:4} {}", number + 1, text.chars().take(160).collect::<String>());
    }
    print!("{}", render::concise(new, sources));
}
