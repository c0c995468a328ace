//! What is kept of a run: one line of a table with named columns, appended when the task is done and read back by name.

use std::collections::BTreeMap;
use std::fs::{self, File, OpenOptions};
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::time::{SystemTime, UNIX_EPOCH};

use super::meter::{Allowance, Measured, Stopped};
use crate::args::List;

/// The columns in the order in which they are written. A file with fewer columns is still read: what it lacks is unknown.
const COLUMNS: [&str; 24] = [
    "domain",
    "problem",
    "machine",
    "program",
    "seconds",
    "mebibytes",
    "verdict",
    "code",
    "cpu_s",
    "wall_s",
    "rss_kb",
    "cost",
    "length",
    "expanded",
    "evaluated",
    "generated",
    "facts",
    "operators",
    "variables",
    "axioms",
    "own_s",
    "commit",
    "unix_time",
    "load",
];

/// Which run a row is of. Two rows of one key are two measurements of the same thing.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Key {
    /// The domain file, relative to the folder of the benchmark files.
    pub domain: String,
    /// The problem file.
    pub problem: String,
    /// The machine, as [`machine`] names it.
    pub machine: String,
    /// The hash of the program.
    pub program: String,
    /// The limit on CPU time in seconds.
    pub seconds: f64,
    /// The limit on resident memory in MiB.
    pub mebibytes: u64,
}

/// How a run counts.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub(super) enum Verdict {
    /// A plan within the limits, or the whole ground task.
    Solved,
    /// Shown to have no plan.
    Unsolvable,
    /// Gave up without a proof.
    Incomplete,
    /// Out of time.
    Time,
    /// Ended by the guard on wall time: no result at all.
    Wall,
    /// Out of memory.
    Memory,
    /// The program does not take this task.
    Unsupported,
    /// The program says that the input is wrong.
    Input,
    /// Anything else: a fault of the program.
    Fault,
}

impl Verdict {
    const WORDS: [(Self, &'static str); 9] = [
        (Self::Solved, "solved"),
        (Self::Unsolvable, "unsolvable"),
        (Self::Incomplete, "incomplete"),
        (Self::Time, "time"),
        (Self::Wall, "wall"),
        (Self::Memory, "memory"),
        (Self::Unsupported, "unsupported"),
        (Self::Input, "input"),
        (Self::Fault, "fault"),
    ];

    /// The word in the table.
    pub(super) fn word(self) -> &'static str {
        Self::WORDS
            .iter()
            .find(|(verdict, _)| *verdict == self)
            .expect("every verdict has a word")
            .1
    }

    /// The verdict that `word` stands for.
    fn from_word(word: &str) -> Option<Self> {
        Self::WORDS.iter().find(|(_, known)| *known == word).map(|(verdict, _)| *verdict)
    }

    /// Reads Fast Downward's exit codes, which are ours too.
    fn of(measured: &Measured, allowance: &Allowance) -> Self {
        match (measured.stopped, measured.code) {
            (Some(Stopped::Memory), _) | (None, 20 | 22) => Self::Memory,
            (Some(Stopped::Wall | Stopped::Interrupted), _) => Self::Wall,
            (Some(Stopped::Time), _) | (None, 21 | 23 | 24) => Self::Time,
            (None, 0..=3) if measured.cpu > allowance.cpu.as_secs_f64() => Self::Time,
            (None, 0..=3) => Self::Solved,
            (None, 10 | 11) => Self::Unsolvable,
            (None, 12) => Self::Incomplete,
            (None, 34 | 37) => Self::Unsupported,
            (None, 31 | 33 | 36) => Self::Input,
            (None, _) => Self::Fault,
        }
    }
}

/// One measured run.
#[derive(Debug, Clone)]
pub(super) struct Row {
    /// What was run.
    pub key: Key,
    /// How it counts.
    pub verdict: Verdict,
    /// User and system time in seconds.
    pub cpu: f64,
    /// All columns by name, as written.
    pub cells: BTreeMap<String, String>,
}

impl Row {
    /// The row of a run that has just ended.
    pub(super) fn new(key: Key, measured: &Measured, allowance: &Allowance, commit: &str) -> Self {
        let verdict = Verdict::of(measured, allowance);
        let said = |label: &str| figure(&measured.stdout, label).unwrap_or_else(|| "-".to_string());
        // Programs shorter than the meter's interval are only seen by their own account.
        let own = |label: &str| {
            figure(&measured.stdout, label).and_then(|text| text.parse().ok()).unwrap_or(0)
        };
        let rss = measured.rss.max(own("peak memory: ")).max(own("Peak memory: "));
        let time = SystemTime::now().duration_since(UNIX_EPOCH).map_or(0, |time| time.as_secs());
        let values = [
            key.domain.clone(),
            key.problem.clone(),
            key.machine.clone(),
            key.program.clone(),
            key.seconds.to_string(),
            key.mebibytes.to_string(),
            verdict.word().to_string(),
            measured.code.to_string(),
            format!("{:.3}", measured.cpu),
            format!("{:.3}", measured.wall),
            rss.to_string(),
            said("Plan cost: "),
            said("Plan length: "),
            said("Expanded "),
            said("Evaluated "),
            figure(&measured.stdout, "Generated ")
                .filter(|_| verdict == Verdict::Solved)
                .unwrap_or_else(|| "-".to_string()),
            said("Translator facts: "),
            said("Translator operators: "),
            said("Translator variables: "),
            said("Translator axioms: "),
            figure(&measured.stdout, "Total time: ")
                .or(figure(&measured.stdout, "Done! ["))
                .unwrap_or_else(|| "-".to_string()),
            commit.to_string(),
            time.to_string(),
            load(),
        ];
        let cells = COLUMNS.iter().map(ToString::to_string).zip(values).collect();
        Self { key, verdict, cpu: measured.cpu, cells }
    }

    /// The row on a line, if the line is whole.
    fn read(columns: &[&str], line: &str) -> Option<Self> {
        let cells: BTreeMap<String, String> = columns
            .iter()
            .map(ToString::to_string)
            .zip(line.split('\t').map(ToString::to_string))
            .collect();
        let text = |column: &str| cells.get(column).cloned();
        let key = Key {
            domain: text("domain")?,
            problem: text("problem")?,
            machine: text("machine")?,
            program: text("program")?,
            seconds: text("seconds")?.parse().ok()?,
            mebibytes: text("mebibytes")?.parse().ok()?,
        };
        let verdict = Verdict::from_word(&text("verdict")?)?;
        let cpu = text("cpu_s")?.parse().ok()?;
        (cells.len() == columns.len()).then_some(Self { key, verdict, cpu, cells })
    }

    /// Whether the machine had nothing else to do when this was measured.
    pub(super) fn is_quiet(&self) -> bool {
        self.number("load").is_some_and(|load| load <= 1.5)
    }

    /// The number in a column, if there is one.
    pub(super) fn number(&self, column: &str) -> Option<f64> {
        self.cells.get(column)?.parse().ok()
    }
}

/// The rows of one list and side, and the file that they are in.
#[derive(Debug)]
pub(super) struct Rows {
    /// The rows in the order in which they were measured.
    pub rows: Vec<Row>,
    file: File,
}

impl Rows {
    /// Reads the rows of an earlier run, if there was one, and opens the file for more.
    pub(super) fn open(folder: &Path, list: List, side: &str) -> io::Result<Self> {
        let path = folder.join(format!("{}-{side}.tsv", name(list)));
        let rows = read(&path)?;
        let mut file = OpenOptions::new().create(true).append(true).open(&path)?;
        // A line that a kill cut off is ended here, and so dropped when read.
        let text = fs::read_to_string(&path)?;
        if !text.is_empty() && !text.ends_with('\n') {
            writeln!(file)?;
        }
        if text.lines().rev().find(|line| line.starts_with("domain\t"))
            != Some(COLUMNS.join("\t").as_str())
        {
            writeln!(file, "{}", COLUMNS.join("\t"))?;
        }
        Ok(Self { rows, file })
    }

    /// Whether the run that `key` names has been measured; if only `quiet` rows count, while the machine had nothing else to do.
    pub(super) fn contains(&self, key: &Key, quiet: bool) -> bool {
        self.rows.iter().any(|row| {
            row.key == *key && row.verdict != Verdict::Wall && (!quiet || row.is_quiet())
        })
    }

    /// Writes a row at once.
    pub(super) fn append(&mut self, row: Row) -> io::Result<()> {
        let line: Vec<&str> = COLUMNS.iter().map(|column| row.cells[*column].as_str()).collect();
        self.file.write_all(format!("{}\n", line.join("\t")).as_bytes())?;
        self.rows.push(row);
        Ok(())
    }
}

/// The rows in a file; none where there is no file. A header may stand anywhere and holds for what follows.
pub(super) fn read(path: &Path) -> io::Result<Vec<Row>> {
    let text = match fs::read_to_string(path) {
        Ok(text) => text,
        Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(Vec::new()),
        Err(error) => return Err(error),
    };
    let mut columns = Vec::new();
    let mut rows = Vec::new();
    for line in text.lines() {
        if line.starts_with("domain\t") {
            columns = line.split('\t').collect();
        } else {
            rows.extend(Row::read(&columns, line));
        }
    }
    Ok(rows)
}

/// Where the plan of a task is kept.
pub(super) fn plan_file(folder: &Path, list: List, side: &str, problem: &str) -> PathBuf {
    folder.join(format!("plans-{}-{side}", name(list))).join(problem.replace('/', "--"))
}

/// Where the output of a run is kept that ended as it never should.
pub(super) fn log_file(folder: &Path, list: List, side: &str, problem: &str) -> PathBuf {
    folder.join(format!("faults-{}-{side}", name(list))).join(problem.replace('/', "--"))
}

/// The name of a list in file names.
pub(super) fn name(list: List) -> &'static str {
    match list {
        List::Opt => "opt",
        List::Sat => "sat",
        List::Ground => "ground",
    }
}

/// The machine, as far as times depend on it: the model of the processor, how many there are, and the memory in GiB.
pub(super) fn machine() -> String {
    let processors = fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
    let models: Vec<&str> = processors
        .lines()
        .filter_map(|line| line.strip_prefix("model name"))
        .map(|rest| rest.trim_start_matches([' ', '\t', ':']))
        .collect();
    let memory = fs::read_to_string("/proc/meminfo").unwrap_or_default();
    let memory = memory
        .lines()
        .next()
        .and_then(|line| line.split_ascii_whitespace().nth(1)?.parse::<u64>().ok())
        .unwrap_or(0);
    let model = models.first().unwrap_or(&"unknown");
    format!("{model} x{} {}G", models.len(), memory >> 20)
}

/// The number of processes that wanted to run in the last minute.
fn load() -> String {
    let text = fs::read_to_string("/proc/loadavg").unwrap_or_default();
    text.split(' ').next().unwrap_or("-").to_string()
}

/// The number behind the last `label` that a number follows.
fn figure(text: &str, label: &str) -> Option<String> {
    text.rmatch_indices(label).find_map(|(position, _)| {
        let rest = &text[position + label.len()..];
        let end = rest
            .find(|letter: char| !letter.is_ascii_digit() && letter != '.')
            .unwrap_or(rest.len());
        let number = rest[..end].trim_end_matches('.');
        (!number.is_empty()).then(|| number.to_string())
    })
}

#[cfg(test)]
mod tests {
    use super::figure;

    #[test]
    fn the_last_figure_behind_a_label_is_taken() {
        let text = "[t=0.1s, 9 KB] Expanded 12 state(s).\nExpanded until last jump: 3 state(s).\nPlan length: 11 step(s).\nDone! [0.070s CPU]";
        assert_eq!(figure(text, "Expanded ").as_deref(), Some("12"));
        assert_eq!(figure(text, "Plan length: ").as_deref(), Some("11"));
        assert_eq!(figure(text, "Done! [").as_deref(), Some("0.070"));
        assert_eq!(figure(text, "Plan cost: "), None);
    }
}
