//! Tasks of which each agent has files of its own, as users meet them.

use std::fs;
use std::path::Path;

use cli::exit::Exit;
use cli::terminal::Terminal;
use tempfile::TempDir;

/// A truck that takes things from place to place, and knows alone what it carries.
const DOMAIN: &str = "(define (domain deliver)
  (:requirements :typing :factored-privacy)
  (:types truck place thing)
  (:predicates
    (at ?t - truck ?p - place)
    (road ?t - truck ?p ?q - place)
    (lies ?x - thing ?p - place)
    (:private (carries ?agent - truck ?x - thing)))
  (:action drive
    :parameters (?t - truck ?p ?q - place)
    :precondition (and (at ?t ?p) (road ?t ?p ?q))
    :effect (and (at ?t ?q) (not (at ?t ?p))))
  (:action take
    :parameters (?t - truck ?x - thing ?p - place)
    :precondition (and (at ?t ?p) (lies ?x ?p))
    :effect (and (carries ?t ?x) (not (lies ?x ?p))))
  (:action leave
    :parameters (?t - truck ?x - thing ?p - place)
    :precondition (and (at ?t ?p) (carries ?t ?x))
    :effect (and (lies ?x ?p) (not (carries ?t ?x)))))
";

/// The north truck drives from `a` to `b`, and the south truck from `b` to `c`.
fn problem_of(truck: &str) -> String {
    let road = if truck == "north" { "a b" } else { "b c" };
    let start = &road[..1];
    format!(
        "(define (problem parcel)
  (:domain deliver)
  (:objects a b c - place parcel - thing
    (:private {truck} - truck))
  (:init (at {truck} {start}) (road {truck} {road}) (lies parcel a))
  (:goal (lies parcel c)))
"
    )
}

struct Desk {
    folder: TempDir,
}

impl Desk {
    /// With the files of both trucks.
    fn new() -> Self {
        let desk = Self { folder: tempfile::tempdir().expect("a temporary folder can be made") };
        for truck in ["north", "south"] {
            desk.write(&format!("domain-{truck}.pddl"), DOMAIN);
            desk.write(&format!("problem-{truck}.pddl"), &problem_of(truck));
        }
        desk
    }

    fn write(&self, name: &str, text: &str) -> &Self {
        fs::write(self.folder.path().join(name), text).expect("the folder can be written to");
        self
    }

    /// Runs a command line in which `@` is the folder; what it printed has `@` for it, too.
    fn run(&self, line: &str) -> (Exit, String, String) {
        let folder = self.folder.path().display().to_string();
        let words = line.split_whitespace().map(|word| word.replace('@', &folder).into());
        let (mut out, mut err) = (Vec::new(), Vec::new());
        let exit = cli::call(words, &mut Terminal::new(&mut out, &mut err));
        let text = |bytes: Vec<u8>| String::from_utf8_lossy(&bytes).replace(&folder, "@");
        (exit, text(out), text(err))
    }

    /// How a command line ends and what it says.
    fn shown(&self, line: &str) -> String {
        let (exit, out, err) = self.run(line);
        format!("$ {line}\n{out}{err}exit {}\n\n", exit.code())
    }
}

/// Each way to name the files of both trucks gives the task of both.
#[test]
fn the_files_of_all_agents_are_one_task() {
    let desk = Desk::new();
    desk.write("both.addl", "north\nsouth\n");
    fs::create_dir(desk.folder.path().join("lists")).expect("a folder can be made");
    let ways = [
        "@",
        "@/both.addl",
        "@/problem-south.pddl @/domain-north.pddl @/domain-south.pddl @/problem-north.pddl",
        "@/domain-south.pddl @/problem-south.pddl @/both.addl @/domain-north.pddl @/problem-north.pddl",
    ];
    for way in ways {
        let (exit, out, err) = desk.run(&format!("caveat check {way}"));
        assert_eq!((exit, out.as_str()), (Exit::Done, ""), "{way}: {err}");
        let (exit, out, err) = desk.run(&format!("caveat plan --plan-file @/plan {way}"));
        assert_eq!(exit, Exit::Done, "{way}: {err}");
        for step in ["take north parcel a", "leave north parcel b", "take south parcel b"] {
            assert!(out.contains(step), "{way}: {out}");
        }
        let (exit, out, err) = desk.run(&format!("caveat validate {way} @/plan"));
        assert_eq!(exit, Exit::Done, "{way}: {out}{err}");
    }
}

#[test]
fn the_files_of_one_agent_are_its_view() {
    let desk = Desk::new();
    let pair = "@/domain-north.pddl @/problem-north.pddl";
    insta::assert_snapshot!(desk.shown(&format!("caveat plan --plan-file @/plan {pair}")));
}

/// What each mistake in the files of several agents says.
#[test]
fn files_that_do_not_go_together_are_named() {
    let plan = "caveat plan --plan-file @/plan --output-format concise @";
    let mut shown = String::new();
    let mut say = |change: &dyn Fn(&Desk), line: &str| {
        let desk = Desk::new();
        change(&desk);
        shown += &desk.shown(line);
    };
    let remove = |desk: &Desk, name: &str| {
        fs::remove_file(desk.folder.path().join(name)).expect("it was there");
    };
    say(&|desk| remove(desk, "problem-south.pddl"), plan);
    say(
        &|desk| remove(desk, "domain-south.pddl"),
        &format!("{plan}/problem-south.pddl @/domain-north.pddl @/problem-north.pddl"),
    );
    say(&|_| {}, &format!("{plan}/domain-north.pddl @/problem-north.pddl @/domain-south.pddl"));
    say(
        &|desk| {
            desk.write("problem-south.pddl", &problem_of("south").replace("deliver", "take"));
        },
        plan,
    );
    say(
        &|desk| {
            desk.write("domain-south.pddl", &DOMAIN.replace("deliver", "take"))
                .write("problem-south.pddl", &problem_of("south").replace("deliver", "take"));
        },
        plan,
    );
    say(
        &|desk| {
            desk.write(
                "domain-south.pddl",
                &DOMAIN.replace("(and (at ?t ?p) (lies ?x ?p))", "(lies ?x ?p)"),
            );
        },
        plan,
    );
    say(
        &|desk| {
            desk.write(
                "all.addl",
                "(define (problem parcel) (:domain deliver) (:agents north soth))",
            );
        },
        plan,
    );
    say(
        &|desk| {
            desk.write("all.addl", "west\neast\n");
        },
        &format!("{plan}/all.addl"),
    );
    say(
        &|desk| {
            desk.write(
                "problem-south.pddl",
                &problem_of("south")
                    .replace("south", "east")
                    .replace("(:private east - truck)", "(:private east west - truck)"),
            );
        },
        plan,
    );
    insta::assert_snapshot!(shown);
}

/// The warnings of `check`, which are about all files together.
#[test]
fn what_the_agents_do_not_agree_about_is_checked() {
    let desk = Desk::new();
    desk.write("problem-south.pddl", &problem_of("south").replace("(lies parcel a)", ""));
    insta::assert_snapshot!(desk.shown("caveat check --output-format concise @"));
}

#[test]
fn a_folder_may_hold_a_domain_and_its_problem() {
    let domains = Path::new(env!("CARGO_MANIFEST_DIR")).join("../domains/delivery");
    let desk = Desk { folder: tempfile::tempdir().expect("a temporary folder can be made") };
    for name in ["domain.pddl", "p01.pddl"] {
        fs::copy(domains.join(name), desk.folder.path().join(name)).expect("it is there");
    }
    assert_eq!(desk.run("caveat plan --plan-file @/plan @").0, Exit::Done);
    assert_eq!(desk.run("caveat check @").0, Exit::Done);
    desk.write("p02.pddl", &fs::read_to_string(domains.join("p02.pddl")).expect("it is there"));
    let (exit, _, err) = desk.run("caveat plan --plan-file @/plan @");
    assert_eq!(exit, Exit::Input);
    assert!(err.contains("these are 3 files"), "{err}");
}

/// The text of a file that was written.
fn written(desk: &Desk, name: &str) -> String {
    fs::read_to_string(desk.folder.path().join(name)).expect("it was written")
}

#[test]
fn the_files_of_all_agents_become_one_domain_and_one_problem_and_back() {
    let desk = Desk::new();
    let (exit, out, err) = desk.run("caveat compile --to unfactored -o @/whole @");
    assert_eq!((exit, err.as_str()), (Exit::Done, ""));
    assert_eq!(out, "@/whole/domain.pddl\n@/whole/problem.pddl\n");
    let folder = desk.folder.path().file_name().expect("it has a name").to_string_lossy();
    let whole = written(&desk, "whole/domain.pddl") + &written(&desk, "whole/problem.pddl");
    insta::assert_snapshot!(whole.replace(&*folder, "FOLDER"));
    assert_eq!(desk.run("caveat check @/whole").0, Exit::Done);
    let (exit, out, err) = desk.run("caveat compile --to factored -o @/parts @/whole/problem.pddl");
    assert_eq!((exit, err.as_str()), (Exit::Done, ""));
    assert_eq!(out.lines().count(), 5, "{out}");
    insta::assert_snapshot!(
        written(&desk, "parts/problem-north.pddl") + &written(&desk, "parts/agents.addl")
    );
    assert_eq!(desk.run("caveat check @/parts").0, Exit::Done);
    // Once more, and nothing is different.
    assert_eq!(desk.run("caveat compile --to unfactored -o @/again @/parts").0, Exit::Done);
    let bare =
        |name: &str| written(&desk, name).split_once('\n').expect("it has a head").1.to_owned();
    for name in ["domain.pddl", "problem.pddl"] {
        assert_eq!(bare(&format!("whole/{name}")), bare(&format!("again/{name}")));
    }
}

#[test]
fn what_cannot_be_compiled_is_said() {
    let desk = Desk::new();
    fs::create_dir(desk.folder.path().join("joint")).expect("a folder can be made");
    desk.write(
        "joint/domain.pddl",
        "(define (domain lift) (:requirements :adl :multi-agent)
  (:types arm) (:predicates (up))
  (:action lift :agent ?a - arm :parameters ()
    :precondition (exists (?b - arm) (and (not (= ?a ?b)) (lift ?b)))
    :effect (up)))
",
    );
    desk.write(
        "joint/problem.pddl",
        "(define (problem p) (:domain lift) (:objects a b - arm) (:goal (up)))\n",
    );
    let mut shown = String::new();
    for line in [
        "caveat compile --to factored --output-format concise -o @/parts @/joint",
        "caveat compile --to unfactored -o @/joint @/joint",
        "caveat compile --to unfactored -o @/whole @/domain-north.pddl @/problem-north.pddl",
        "caveat compile --to unfactored -o @/joint/domain.pddl/whole @/joint",
    ] {
        shown += &desk.shown(line);
    }
    insta::assert_snapshot!(shown);
    assert!(!desk.folder.path().join("parts").exists());
}
