//! The program as its users meet it: exit codes, streams, files, signals.

use std::fmt::Write as _;
use std::fs;
use std::io::{BufRead, BufReader, Read, Write};
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};
use std::thread;
use std::time::{Duration, Instant};

use tempfile::TempDir;

/// A folder of its own, with some of the reference problems in it.
struct Desk {
    folder: TempDir,
}

impl Desk {
    fn new() -> Self {
        Self { folder: tempfile::tempdir().expect("a temporary folder can be made") }
    }

    /// With a reference domain and one of its problems, as `domain.pddl` and `problem.pddl`.
    fn with(domain: &str, problem: &str) -> Self {
        let desk = Self::new();
        let domains = Path::new(env!("CARGO_MANIFEST_DIR")).join("../domains").join(domain);
        for (from, to) in [("domain.pddl", "domain.pddl"), (problem, "problem.pddl")] {
            fs::copy(domains.join(from), desk.path(to)).expect("the reference domains are there");
        }
        desk
    }

    fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    fn write(&self, name: &str, text: impl AsRef<[u8]>) -> &Self {
        fs::write(self.path(name), text).expect("the folder can be written to");
        self
    }

    fn names(&self) -> Vec<String> {
        let entries = fs::read_dir(self.folder.path()).expect("it is a folder").flatten();
        let mut names: Vec<String> =
            entries.filter_map(|entry| entry.file_name().into_string().ok()).collect();
        names.sort();
        names
    }

    fn command(&self, arguments: &str) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_caveat"));
        command.args(arguments.split_whitespace()).current_dir(self.folder.path());
        command.env_remove("COLUMNS").env("NO_COLOR", "1").stdin(Stdio::null());
        command
    }

    fn run(&self, arguments: &str) -> Run {
        Run::of(&self.command(arguments).output().expect("the program can be run"))
    }

    fn run_with_stdin(&self, arguments: &str, stdin: &[u8]) -> Run {
        let mut command = self.command(arguments);
        command.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped());
        let mut child = command.spawn().expect("the program can be run");
        child
            .stdin
            .take()
            .expect("it is piped")
            .write_all(stdin)
            .expect("the program reads its input");
        Run::of(&child.wait_with_output().expect("the program ends"))
    }
}

/// What a run left.
struct Run {
    code: Option<i32>,
    stdout: String,
    stderr: String,
}

impl Run {
    fn of(output: &Output) -> Self {
        let text =
            |bytes: &[u8]| String::from_utf8(bytes.to_vec()).expect("the program writes UTF-8");
        Self {
            code: output.status.code(),
            stdout: text(&output.stdout),
            stderr: text(&output.stderr),
        }
    }

    #[track_caller]
    fn ends_with(self, code: i32) -> Self {
        assert_eq!(self.code, Some(code), "stdout:\n{}\nstderr:\n{}", self.stdout, self.stderr);
        self
    }

    /// Code and both streams, for a snapshot.
    fn shown(&self) -> String {
        format!(
            "exit {}\n--- stdout\n{}--- stderr\n{}",
            self.code.unwrap_or(-1),
            self.stdout,
            self.stderr
        )
    }
}

/// A problem of the stacking domain that blind search does not finish in minutes.
fn tower(blocks: usize) -> String {
    let names: Vec<String> = (1..=blocks).map(|number| format!("b{number}")).collect();
    let mut text = format!(
        "(define (problem tower)\n  (:domain blocks)\n  (:objects {})\n  (:init (handempty)",
        names.join(" ")
    );
    for name in &names {
        let _ = write!(text, " (ontable {name}) (clear {name})");
    }
    text += ")\n  (:goal (and";
    for pair in names.windows(2) {
        let _ = write!(text, " (on {} {})", pair[0], pair[1]);
    }
    text + ")))\n"
}

/// The four-operator blocks world, in which [`tower`] is set.
const BLOCKS: &str = "(define (domain blocks)
  (:requirements :strips)
  (:predicates (on ?x ?y) (ontable ?x) (clear ?x) (handempty) (holding ?x))
  (:action pick-up :parameters (?x)
    :precondition (and (clear ?x) (ontable ?x) (handempty))
    :effect (and (not (ontable ?x)) (not (clear ?x)) (not (handempty)) (holding ?x)))
  (:action put-down :parameters (?x)
    :precondition (holding ?x)
    :effect (and (not (holding ?x)) (clear ?x) (handempty) (ontable ?x)))
  (:action stack :parameters (?x ?y)
    :precondition (and (holding ?x) (clear ?y))
    :effect (and (not (holding ?x)) (not (clear ?y)) (clear ?x) (handempty) (on ?x ?y)))
  (:action unstack :parameters (?x ?y)
    :precondition (and (on ?x ?y) (clear ?x) (handempty))
    :effect (and (holding ?x) (clear ?y) (not (clear ?x)) (not (handempty)) (not (on ?x ?y)))))
";

fn towers(blocks: usize) -> Desk {
    let desk = Desk::new();
    desk.write("domain.pddl", BLOCKS).write("problem.pddl", tower(blocks));
    desk
}

#[test]
fn a_plan_is_printed_written_and_valid() {
    let desk = Desk::with("stacking", "p01.pddl");
    let run = desk.run("plan domain.pddl problem.pddl").ends_with(0);
    for line in [
        "Solution found!",
        "Plan length: ",
        "Plan cost: ",
        "Expanded ",
        "Search time: ",
        "Total time: ",
        "Peak memory: ",
    ] {
        assert!(run.stdout.contains(line), "no `{line}` in:\n{}", run.stdout);
    }
    assert_eq!(desk.names(), ["domain.pddl", "problem.pddl", "sas_plan"]);
    let valid = desk.run("validate domain.pddl problem.pddl sas_plan").ends_with(0);
    assert!(valid.stdout.contains("Plan valid\nFinal value: "), "{}", valid.stdout);
}

#[test]
fn the_domain_is_found_beside_the_problem() {
    let desk = Desk::with("stacking", "p01.pddl");
    desk.run("plan problem.pddl").ends_with(0);
    desk.run("validate problem.pddl sas_plan").ends_with(0);
    fs::rename(desk.path("domain.pddl"), desk.path("world.pddl")).expect("a file can be renamed");
    desk.run("plan problem.pddl").ends_with(0);
    fs::copy(desk.path("world.pddl"), desk.path("world2.pddl")).expect("a file can be copied");
    let run = desk.run("plan problem.pddl").ends_with(31);
    insta::assert_snapshot!("several domains", run.shown());
}

#[test]
fn plans_of_an_earlier_run_do_not_stay() {
    let desk = Desk::with("stacking", "p01.pddl");
    desk.write("sas_plan.3", "(old)").write("sas_plan", "(old)").write("sas_plan.txt", "mine");
    desk.run("plan problem.pddl --anytime --time-limit 1s");
    let names = desk.names();
    assert!(
        names.contains(&"sas_plan.1".to_string()) && names.contains(&"sas_plan.txt".to_string()),
        "{names:?}"
    );
    assert!(
        !names.contains(&"sas_plan".to_string()) && !names.contains(&"sas_plan.3".to_string()),
        "{names:?}"
    );
}

#[test]
fn wrong_command_lines_are_36_for_plan_and_2_for_others() {
    let desk = Desk::new();
    insta::assert_snapshot!("plan alone", desk.run("plan").ends_with(36).shown());
    desk.run("plan --optimally problem.pddl").ends_with(36);
    desk.run("plan --time-limit soon problem.pddl").ends_with(36);
    desk.run("plan --search magic problem.pddl").ends_with(36);
    desk.run("check").ends_with(2);
    desk.run("validate --loudly").ends_with(2);
    desk.run("dance").ends_with(2);
    desk.run("").ends_with(2);
}

#[test]
fn files_that_cannot_be_read_are_31_for_plan_and_2_for_others() {
    let desk = Desk::with("stacking", "p01.pddl");
    desk.write("latin.pddl", b"(define (problem caf\xe9))");
    fs::create_dir(desk.path("folder")).expect("a folder can be made");
    desk.run("check latin.pddl --output-format concise").ends_with(1);
    let mut shown = String::new();
    for name in ["probelm.pddl", "folder"] {
        desk.run(&format!("check {name}")).ends_with(2);
        desk.run(&format!("validate domain.pddl {name} plan")).ends_with(2);
        desk.run(&format!("ground domain.pddl {name}")).ends_with(2);
        let _ = writeln!(shown, "$ caveat plan domain.pddl {name}");
        shown += &desk.run(&format!("plan domain.pddl {name}")).ends_with(31).shown();
    }
    let _ = writeln!(shown, "$ caveat plan domain.pddl latin.pddl");
    let _ = write!(shown, "{}", desk.run("plan domain.pddl latin.pddl").ends_with(31).shown());
    insta::assert_snapshot!("unreadable files", shown);
}

#[test]
fn files_in_the_wrong_place_are_named() {
    let desk = Desk::with("stacking", "p01.pddl");
    desk.write("plan.txt", "(move a b)\n");
    let mut shown = String::new();
    for files in [
        "problem.pddl domain.pddl",
        "domain.pddl",
        "domain.pddl domain.pddl",
        "problem.pddl problem.pddl",
        "domain.pddl plan.txt",
    ] {
        let _ = write!(
            shown,
            "$ caveat plan {files}\n{}\n",
            desk.run(&format!("plan {files}")).ends_with(31).shown()
        );
    }
    let _ = write!(
        shown,
        "$ caveat validate domain.pddl problem.pddl\n{}\n",
        desk.run("validate domain.pddl problem.pddl").ends_with(2).shown()
    );
    insta::assert_snapshot!("files in the wrong place", shown);
    assert!(!desk.path("sas_plan").exists());
}

#[test]
fn a_mistake_in_the_problem_is_shown_and_ends_in_31() {
    let desk = Desk::new();
    desk.write("domain.pddl", BLOCKS);
    desk.write("problem.pddl", tower(3).replace("(on b1 b2)", "(upon b1 b2)"));
    insta::assert_snapshot!("a mistake", desk.run("plan problem.pddl").ends_with(31).shown());
    insta::assert_snapshot!(
        "a mistake, checked",
        desk.run("check problem.pddl --output-format concise").ends_with(1).shown()
    );
    desk.run("check domain.pddl").ends_with(0);
}

#[test]
fn what_cannot_be_planned_is_34() {
    let desk = Desk::new();
    let domain = "(define (domain d) (:requirements :strips :durative-actions)
      (:predicates (done))
      (:durative-action act :parameters () :duration (= ?duration 1)
        :condition (and) :effect (at end (done))))";
    desk.write("domain.pddl", domain);
    desk.write("problem.pddl", "(define (problem p) (:domain d) (:init) (:goal (done)))");
    insta::assert_snapshot!("not planned", desk.run("plan problem.pddl").ends_with(34).shown());
}

#[test]
fn unsolvable_tasks_are_told_apart() {
    let desk = Desk::new();
    desk.write("domain.pddl", BLOCKS);
    desk.write("problem.pddl", tower(2).replace("(handempty)", ""));
    desk.run("plan problem.pddl").ends_with(10);
    assert!(!desk.path("sas_plan").exists());
    // Each half of the goal can be reached, but not both at once.
    desk.write("problem.pddl", tower(2).replace("(on b1 b2)", "(on b1 b2) (on b2 b1)"));
    let run = desk.run("plan problem.pddl");
    assert!(matches!(run.code, Some(10 | 11)), "{}", run.shown());
    let run = desk.run("plan problem.pddl --search astar --heuristic blind");
    assert!(matches!(run.code, Some(10 | 11)), "{}", run.shown());
}

#[test]
fn the_time_limit_ends_a_search_with_23() {
    let desk = towers(40);
    let start = Instant::now();
    let run = desk
        .run("plan problem.pddl --search astar --heuristic blind --time-limit 400ms")
        .ends_with(23);
    assert!(run.stderr.contains("The time limit is reached while searching."), "{}", run.stderr);
    assert!(start.elapsed() < Duration::from_secs(30));
    assert!(!desk.path("sas_plan").exists());
}

#[test]
fn the_memory_limit_ends_a_search_with_22() {
    let desk = towers(40);
    let run = desk.run("plan problem.pddl --search astar --heuristic blind --memory-limit 100M --time-limit 60s").ends_with(22);
    assert!(run.stderr.contains("The memory limit is reached while searching."), "{}", run.stderr);
}

#[test]
fn a_signal_leaves_the_best_plan_whole() {
    let desk = towers(40);
    let mut child = desk
        .command("plan problem.pddl --anytime --time-limit 120s")
        .stdout(Stdio::piped())
        .spawn()
        .expect("the program can be run");
    let lines = BufReader::new(child.stdout.take().expect("it is piped")).lines();
    let reader = thread::spawn(move || {
        let mut lines = lines.map_while(Result::ok);
        let found = lines.any(|line| line.starts_with("Plan cost: "));
        (found, lines)
    });
    let (found, rest) = reader.join().expect("the reader does not panic");
    assert!(found, "no plan was printed");
    let kill = Command::new("kill")
        .args(["-TERM", &child.id().to_string()])
        .status()
        .expect("kill can be run");
    assert!(kill.success());
    rest.for_each(drop);
    assert_eq!(child.wait().expect("the program ends").code(), Some(2));
    let plans: Vec<String> =
        desk.names().into_iter().filter(|name| name.starts_with("sas_plan")).collect();
    assert!(!plans.is_empty() && plans.len() == desk.names().len() - 2, "{:?}", desk.names());
    desk.run(&format!("validate problem.pddl {}", plans.join(" "))).ends_with(0);
}

#[test]
fn a_signal_before_a_plan_leaves_no_plan() {
    let desk = towers(40);
    let mut child = desk
        .command("plan problem.pddl --search astar --heuristic blind --time-limit 120s")
        .stdout(Stdio::null())
        .spawn()
        .expect("the program can be run");
    thread::sleep(Duration::from_millis(1500));
    Command::new("kill").args(["-INT", &child.id().to_string()]).status().expect("kill can be run");
    assert_eq!(child.wait().expect("the program ends").code(), Some(23));
    assert_eq!(desk.names(), ["domain.pddl", "problem.pddl"]);
}

#[test]
fn a_reader_that_leaves_early_disturbs_nothing() {
    let desk = Desk::with("stacking", "p01.pddl");
    for (arguments, code) in
        [("plan problem.pddl", 0), ("completions bash", 0), ("ground --format sas problem.pddl", 0)]
    {
        let mut command = desk.command(arguments);
        let mut child = command
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .expect("the program can be run");
        drop(child.stdout.take());
        let mut stderr = String::new();
        child.stderr.take().expect("it is piped").read_to_string(&mut stderr).expect("it is text");
        assert_eq!(
            child.wait().expect("the program ends").code(),
            Some(code),
            "{arguments}: {stderr}"
        );
        assert!(!stderr.contains("error"), "{arguments}: {stderr}");
    }
    desk.run("validate problem.pddl sas_plan").ends_with(0);
}

#[test]
fn a_dash_is_the_standard_input() {
    let desk = Desk::with("stacking", "p01.pddl");
    let problem = fs::read(desk.path("problem.pddl")).expect("it is there");
    desk.run_with_stdin("plan domain.pddl -", &problem).ends_with(0);
    let plan = fs::read(desk.path("sas_plan")).expect("a plan was written");
    desk.run_with_stdin("validate domain.pddl problem.pddl -", &plan).ends_with(0);
    let run = desk.run_with_stdin("plan -", &problem).ends_with(31);
    insta::assert_snapshot!("a problem alone from the standard input", run.shown());
}

#[test]
fn a_plan_that_fails_is_1_and_says_why() {
    let desk = towers(3);
    desk.write("good", "(pick-up b2)\n(stack b2 b3)\n(pick-up b1)\n(stack b1 b2)\n");
    desk.write("short", "(pick-up b2)\n(stack b2 b3)\n");
    desk.write("wrong", "(pick-up b2)\n(pick-up b1)\n");
    desk.write("strange", "(jump b1)\n");
    desk.run("validate problem.pddl good").ends_with(0);
    let mut shown = String::new();
    for plan in ["short", "wrong", "strange", "good short"] {
        let _ = write!(
            shown,
            "$ caveat validate problem.pddl {plan}\n{}\n",
            desk.run(&format!("validate problem.pddl {plan}")).ends_with(1).shown()
        );
    }
    insta::assert_snapshot!("plans that fail", shown);
}

#[test]
fn plan_files_that_cannot_be_written_are_31() {
    let desk = Desk::with("stacking", "p01.pddl");
    let run = desk.run("plan problem.pddl --plan-file none/sas_plan").ends_with(31);
    assert!(run.stderr.contains("there is no folder `none`"), "{}", run.stderr);
}

#[test]
fn a_ground_task_is_written_as_a_whole() {
    let desk = Desk::with("stacking", "p01.pddl");
    let summary = desk.run("ground problem.pddl").ends_with(0);
    assert!(summary.stdout.contains("Translator operators: "), "{}", summary.stdout);
    desk.run("ground --format sas -o output.sas problem.pddl").ends_with(0);
    let file = fs::read_to_string(desk.path("output.sas")).expect("it was written");
    let printed = desk.run("ground --format sas problem.pddl").ends_with(0);
    assert_eq!(file, printed.stdout);
    assert!(file.starts_with("begin_version\n3\nend_version\n"));
}

#[test]
fn codes_are_explained() {
    let desk = Desk::new();
    assert!(desk.run("explain E0101").ends_with(0).stdout.contains("unknown-predicate"));
    let run = desk.run("explain unknown-predicat").ends_with(2);
    assert!(run.stderr.contains("did you mean `unknown-predicate`?"), "{}", run.stderr);
}

#[test]
fn help_is_data_and_has_examples() {
    let desk = Desk::new();
    let mut shown = String::new();
    let verbs = [
        "check",
        "plan",
        "validate",
        "compile",
        "ground",
        "excuse",
        "bench",
        "explain",
        "completions",
    ];
    for verb in [""].into_iter().chain(verbs) {
        let run = desk.run(&format!("{verb} --help")).ends_with(0);
        assert!(run.stderr.is_empty());
        assert_eq!(
            run.stdout.matches("\n  caveat ").count(),
            3,
            "three examples in:\n{}",
            run.stdout
        );
        let _ = write!(shown, "$ caveat {verb} --help\n{}\n", run.stdout);
    }
    insta::assert_snapshot!("help", shown);
}

/// A domain with two mistakes that a program may mend, and one that it may not.
const MENDABLE: &str = "(define (domain d)
 (:requirements :typng)
 (:predicate (lit))
 (:action a :effect (lti)))
";

#[test]
fn safe_fixes_are_applied_and_the_rest_is_said() {
    let desk = Desk::new();
    desk.write("domain.pddl", MENDABLE);
    let run = desk.run("check --fix --output-format concise domain.pddl").ends_with(1);
    insta::assert_snapshot!(run.shown());
    let mended = fs::read_to_string(desk.path("domain.pddl")).expect("the file is there");
    assert_eq!(
        mended,
        MENDABLE.replace(":typng", ":typing").replace(":predicate ", ":predicates ")
    );
    desk.run("check --fix domain.pddl").ends_with(1);
    let again = fs::read_to_string(desk.path("domain.pddl")).expect("the file is there");
    assert_eq!(again, mended, "nothing is left to mend");
}

#[test]
fn diagnostics_for_programs_are_the_whole_output() {
    let desk = Desk::new();
    desk.write("domain.pddl", MENDABLE);
    for (format, key) in [("json", "diagnostics"), ("sarif", "runs")] {
        let output = desk.command(&format!("check --output-format {format} domain.pddl")).output();
        let output = output.expect("the program can be run");
        assert_eq!(output.status.code(), Some(1));
        let value: serde_json::Value = serde_json::from_slice(&output.stdout).expect("JSON");
        assert!(value[key].is_array(), "{value}");
    }
}

#[test]
fn what_cannot_be_planned_checks_clean() {
    let desk = Desk::new();
    let text = "(define (domain d)
 (:requirements :durative-actions)
 (:predicates (lit))
 (:durative-action glow :parameters () :duration (= ?duration 5) :effect (at end (lit))))
";
    desk.write("domain.pddl", text).write(
        "problem.pddl",
        "(define (problem p) (:domain d) (:init) (:goal (lit)))
",
    );
    desk.run("check domain.pddl problem.pddl").ends_with(0);
    desk.run("plan domain.pddl problem.pddl").ends_with(34);
    // It is right, and not for every program.
    let run = desk.run("check --for lama,val --output-format concise domain.pddl").ends_with(1);
    let lines: Vec<&str> = run.stdout.lines().collect();
    assert_eq!(
        lines,
        [
            "domain.pddl:2:17: warning[W0305] not-portable: Fast Downward refuses the requirement `:durative-actions`",
            "domain.pddl:4:2: warning[W0305] not-portable: Fast Downward refuses `:durative-action`",
        ]
    );
    desk.run("check --for popf --for optic domain.pddl").ends_with(0);
    let wrong = desk.run("check --for nothing domain.pddl").ends_with(2).stderr;
    assert!(wrong.contains("[possible values: fast-downward, val, popf"), "{wrong}");
}

#[test]
fn files_are_laid_out_and_told_apart() {
    let desk = Desk::new();
    desk.write("domain.pddl", "(define (domain d) ; lights\n(:predicates (lit)))");
    desk.write("broken.pddl", "(define (domain d)\n      (:predicates (lit)");
    let even = "(define (domain d) ; lights\n  (:predicates (lit)))\n";
    insta::assert_snapshot!(desk.run("fmt --check .").ends_with(1).shown());
    assert!(
        fs::read_to_string(desk.path("domain.pddl")).expect("it is there").ends_with("(lit)))")
    );
    desk.run("fmt domain.pddl broken.pddl").ends_with(0);
    assert_eq!(fs::read_to_string(desk.path("domain.pddl")).expect("it is there"), even);
    assert!(fs::read_to_string(desk.path("broken.pddl")).expect("it is there").ends_with("(lit)"));
    desk.run("fmt --check domain.pddl").ends_with(0);
    let printed =
        desk.run_with_stdin("fmt --stdin", b"(define (domain d) ; lights\n(:predicates (lit)))");
    assert_eq!(printed.ends_with(0).stdout, even);
    desk.run("fmt absent.pddl").ends_with(2);
    desk.run("fmt").ends_with(2);
}

#[test]
fn a_file_that_cannot_be_laid_out_is_named() {
    let desk = Desk::new();
    desk.write("broken.pddl", "(define (domain d)\n      (:predicates (lit)");
    insta::assert_snapshot!(desk.run("fmt broken.pddl").ends_with(0).shown());
    let printed = desk.run_with_stdin("fmt --stdin", b"(define (domain d)").ends_with(0);
    assert_eq!(printed.stdout, "(define (domain d)", "an editor must get its text back");
}

#[test]
fn a_wrong_problem_does_not_hide_what_is_said_of_another() {
    let desk = Desk::new();
    desk.write("domain.pddl", "(define (domain d) (:predicates (lit)) (:action a :effect (lit)))");
    desk.write("wrong.pddl", "(define (problem p) (:domain d) (:init) (:goal (lti)))");
    desk.write("done.pddl", "(define (problem q) (:domain d) (:init (lit)) (:goal (lit)))");
    let run = desk.run("check --output-format concise domain.pddl wrong.pddl done.pddl");
    let said = run.ends_with(1).stdout;
    assert!(said.contains("wrong.pddl:1:49: error[E0101]"), "{said}");
    assert!(said.contains("done.pddl:1:54: warning[W0702]"), "{said}");
}

#[test]
fn the_domain_that_is_given_is_meant_when_no_file_has_the_name() {
    let desk = Desk::with("hanoi", "p01.pddl");
    let text = fs::read_to_string(desk.path("problem.pddl")).expect("it is there");
    desk.write("problem.pddl", text.replace("(:domain hanoi)", "(:domain hanoy)"));
    let run = desk.run("check --output-format concise domain.pddl problem.pddl").ends_with(1);
    assert_eq!(run.stdout.lines().count(), 1, "{}", run.stdout);
    assert!(run.stdout.contains("error[E0106] domain-name-mismatch"), "{}", run.stdout);
}

#[test]
fn a_domain_that_has_the_name_comes_before_one_with_the_usual_file_name() {
    let desk = Desk::with("hanoi", "p01.pddl");
    let other = "(define (domain lights) (:predicates (lit)) (:action a :effect (lit)))";
    desk.write("lights.hddl", other);
    desk.write("p.pddl", "(define (problem p) (:domain lights) (:init) (:goal (lit)))");
    desk.run("check p.pddl").ends_with(0);
}
