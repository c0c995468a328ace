//! `caveat bench` on a collection of two tasks, against a peer that knows one plan by heart.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use tempfile::TempDir;

/// Says what Fast Downward says, whatever the task: the plan of the first problem.
const PEER: &str = "\
case \"$*\" in *p02*) echo 'Translator facts: 9'; exit 12;; esac
case \"$*\" in
  *--translate*) echo 'Translator facts: 3'; echo 'Translator operators: 4'; echo 'Done! [0.010s CPU, 0.010s wall-clock]';;
  *) echo '[t=0.1s, 900 KB] Plan length: 1 step(s).'; echo '[t=0.1s, 900 KB] Plan cost: 1'; echo '(work)' > sas_plan;;
esac
";

const DOMAIN: &str = "(define (domain d) (:requirements :strips) (:predicates (done) (more))
  (:action work :parameters () :precondition (and) :effect (done))
  (:action again :parameters () :precondition (done) :effect (more)))";

/// A folder with a collection of benchmarks, a peer, and the rows.
struct Bench {
    folder: TempDir,
}

impl Bench {
    fn new() -> Self {
        let bench = Self { folder: tempfile::tempdir().expect("a temporary folder can be made") };
        let problem =
            |goal: &str| format!("(define (problem p) (:domain d) (:init) (:goal {goal}))");
        let list = "d/domain.pddl\td/p01.pddl\nd/domain.pddl\td/p02.pddl\n";
        bench.write("shared/benchmarks/ipc/d/domain.pddl", DOMAIN);
        bench.write("shared/benchmarks/ipc/d/p01.pddl", &problem("(done)"));
        bench.write("shared/benchmarks/ipc/d/p02.pddl", &problem("(more)"));
        for name in ["opt", "sat", "ground"] {
            bench.write(&format!("shared/benchmarks/{name}.txt"), list);
        }
        // The optimal cost of the second problem is wrong here, so that there is a conflict to report.
        let reference = "domain\tproblem\topt_cost\tbest_known_cost\nd/domain.pddl\td/p01.pddl\t1\t1\nd/domain.pddl\td/p02.pddl\t3\t3\n";
        bench.write("shared/benchmarks/reference.tsv", reference);
        bench.write("peer/fast-downward.sh", PEER);
        bench
    }

    fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    fn write(&self, name: &str, text: &str) {
        let path = self.path(name);
        fs::create_dir_all(path.parent().expect("it lies in a folder"))
            .expect("folders can be made");
        fs::write(path, text).expect("files can be written");
    }

    fn run(&self, arguments: &str) -> String {
        let output = Command::new(env!("CARGO_BIN_EXE_caveat"))
            .arg("bench")
            .args(arguments.split_whitespace())
            .args(["--python", "sh", "--wall-factor", "20", "--out"])
            .arg(self.path("rows"))
            .env("CAVEAT_SHARED", self.path("shared"))
            .env_remove("CAVEAT_PEER")
            .current_dir(self.folder.path())
            .output()
            .expect("the program can be run");
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        String::from_utf8(output.stdout).expect("reports are UTF-8")
    }

    /// Problem, verdict and some columns of every row.
    fn rows(&self, file: &str, columns: &[&str]) -> Vec<String> {
        let text = fs::read_to_string(self.path(&format!("rows/{file}"))).expect("there are rows");
        let mut lines = text.lines().map(|line| line.split('\t').collect::<Vec<_>>());
        let header = lines.next().expect("there is a header");
        let position = |column: &&str| {
            header.iter().position(|name| name == column).expect("the column is there")
        };
        let positions: Vec<usize> = columns.iter().map(position).collect();
        lines
            .map(|row| {
                positions.iter().map(|&position| row[position]).collect::<Vec<_>>().join(" ")
            })
            .collect()
    }
}

fn has(report: &str, line: &str) {
    assert!(report.lines().any(|one| one == line), "no `{line}` in\n{report}");
}

#[test]
fn both_planners_are_measured_once_and_compared() {
    let bench = Bench::new();
    let both = "opt --peer peer/fast-downward.sh";
    bench.run(both);
    let columns = ["problem", "verdict", "code", "cost", "length"];
    assert_eq!(
        bench.rows("opt-ours.tsv", &columns),
        ["d/p01.pddl solved 0 1 1", "d/p02.pddl solved 0 2 2"]
    );
    assert_eq!(
        bench.rows("opt-peer.tsv", &columns),
        ["d/p01.pddl solved 0 1 1", "d/p02.pddl incomplete 12 - -"]
    );
    bench.run(both);
    assert_eq!(bench.rows("opt-peer.tsv", &["problem"]).len(), 2, "nothing is measured twice");
    let report = bench.run("opt --report");
    has(
        &report,
        "Of the 2 tasks that both were run on and accept, ours solves 2, the peer 1, both 1.",
    );
    has(
        &report,
        "Solved by ours alone: 1, by the peer alone: 0 (sign test, two-sided: p = 1.000).",
    );
    has(&report, "Plans that are not valid or cost something else than was said: 0 of 3.");
    has(&report, "Costs different from the optimal cost of the reference: 1 of 3 compared.");
    has(&report, "- d/p02.pddl: ours has 2, the reference has 3");
}

#[test]
fn a_new_peer_is_measured_anew() {
    let bench = Bench::new();
    bench.run("sat --only peer --peer peer/fast-downward.sh");
    bench.write("peer/fast-downward.sh", &PEER.replace("(work)", "(again)"));
    bench.run("sat --only peer --peer peer/fast-downward.sh");
    assert_eq!(bench.rows("sat-peer.tsv", &["problem"]).len(), 4);
    let report = bench.run("sat --report");
    has(&report, "Plans that are not valid or cost something else than was said: 1 of 1.");
}

#[test]
fn a_row_that_was_cut_off_is_measured_again() {
    let bench = Bench::new();
    let peer = "opt --only peer --peer peer/fast-downward.sh";
    bench.run(peer);
    let file = bench.path("rows/opt-peer.tsv");
    let text = fs::read_to_string(&file).expect("there are rows");
    fs::write(&file, &text[..text.len() - 40]).expect("files can be written");
    bench.run(peer);
    let whole = fs::read_to_string(&file).expect("there are rows");
    assert_eq!(
        whole
            .lines()
            .filter(|line| line.contains("incomplete") && line.split('\t').count() == 24)
            .count(),
        1
    );
}

#[test]
fn ground_tasks_are_counted_side_by_side() {
    let bench = Bench::new();
    bench.run("ground --peer peer/fast-downward.sh");
    let report = bench.run("ground --report");
    let row = report
        .lines()
        .find(|line| line.starts_with("| d/p01.pddl"))
        .expect("the task is in the table");
    let cells: Vec<&str> = row.split(" | ").collect();
    assert_eq!((cells[2], cells[4]), ("3", "4"), "the peer's facts and operators in\n{row}");
    assert!(row.ends_with("| no |"), "{row}");
    assert!(Path::new(&bench.path("rows/ground-ours.tsv")).exists());
}
