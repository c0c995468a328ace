//! `caveat excuse` from the command line to what a person or a program reads: the answers are kept in snapshots, each with its command line.

mod meaning;
mod worlds;

use std::fmt::Write as _;
use std::fs;
use std::path::Path;

use cli::exit::Exit;
use serde_json::Value;

use crate::desk::Desk;
use crate::domains::caveat;
use crate::unsolvable::{edit, excuses, folder, problems, read};

/// Keeps what a command prints, with the command line as description.
fn keep(name: &str, command: &str, printed: &str) {
    insta::with_settings!({ description => command, omit_expression => true }, {
        insta::assert_snapshot!(name, printed);
    });
}

/// The changes of an excuse as `excuses.tsv` has them.
fn changes(excuse: &Value) -> Vec<String> {
    let atom = |edit: &Value, key: &str| edit[key].as_str().unwrap_or("none").to_owned();
    let change = |edit: &Value| match edit.get("object") {
        Some(object) => format!("{} - {}", text(object), text(&edit["type"])),
        None => format!("{} -> {}", atom(edit, "from"), atom(edit, "to")),
    };
    excuse["edits"].as_array().expect("there are edits").iter().map(change).collect()
}

fn text(value: &Value) -> &str {
    value.as_str().expect("it is a text")
}

#[test]
fn the_cheapest_excuses_of_the_shipped_problems_are_exactly_those_that_are_stated() {
    let desk = Desk::with(&[]);
    let (changed, plan) = (desk.path("changed.pddl"), desk.path("sas.plan"));
    for name in domains::UNSOLVABLE {
        for problem in problems(name) {
            let file = format!("domains/{name}/{problem}.pddl");
            let answer = desk.json(&format!("caveat excuse --all --output-format json {file}"));
            let about = format!("{file}: {answer:#}");
            assert_eq!(answer["status"], "excuse", "{about}");
            assert_eq!((&answer["proven"], &answer["complete"]), (&true.into(), &true.into()));
            let known: Vec<_> =
                excuses(name).into_iter().filter(|one| one.problem == problem).collect();
            let list = answer["excuses"].as_array().expect("there are excuses");
            assert_eq!(list.len(), known.len(), "{about}");
            for (number, (excuse, known)) in list.iter().zip(&known).enumerate() {
                assert_eq!(excuse["rank"], number + 1, "{about}");
                assert_eq!(excuse["cost"], known.cost, "{about}");
                assert_eq!(answer["cost"], known.cost, "{about}");
                let mut stated: Vec<&str> = known.changes.split(", ").collect();
                let mut found = changes(excuse);
                stated.sort_unstable();
                found.sort();
                assert_eq!(found, stated, "{about}");
                let mut text = read(&folder(name).join(&problem).with_extension("pddl"));
                for change in &found {
                    edit(&mut text, change);
                }
                fs::write(&changed, text).expect("there is room for a problem");
                let steps = excuse["plan"].as_array().expect("there is a plan");
                let steps: String =
                    steps.iter().fold(String::new(), |text, step| text + self::text(step) + "\n");
                fs::write(&plan, steps).expect("there is room for a plan");
                let domain = folder(name).join("domain.pddl");
                let (exit, said) = caveat("validate", &[], &[&domain, &changed, &plan]);
                assert_eq!(exit, Exit::Done, "{about}\n{said}");
            }
        }
    }
}

#[test]
fn the_changed_problem_is_written_and_has_a_plan() {
    let desk = Desk::with(&[]);
    for (number, name) in ["blocked-drawer/plate", "vials/p01", "cranes/p01"].iter().enumerate() {
        let folder = name.split('/').next().expect("it is a path");
        let mended = format!("mended{number}.pddl");
        desk.ends(Exit::Done, &format!("caveat excuse --apply {mended} domains/{name}.pddl"));
        let domain = domains::folder().join(folder).join("domain.pddl");
        let plan = desk.path("sas.plan");
        let options = ["--plan-file", plan.to_str().expect("the name is ours")];
        let (exit, said) = caveat("plan", &options, &[&domain, &desk.path(&mended)]);
        assert_eq!(exit, Exit::Done, "{name}: {said}");
    }
    keep("the problem of --apply", "cat mended0.pddl", &desk.file("mended0.pddl"));
}

#[test]
fn what_a_person_reads() {
    let desk = Desk::with(&[]);
    let drawer = "domains/blocked-drawer/plate.pddl";
    let answers = [
        ("closed drawer", Exit::Done, "domains/closed-drawer/plate.pddl"),
        ("blocked drawer", Exit::Done, drawer),
        ("vials", Exit::Done, "domains/vials/p01.pddl"),
        ("vials, five", Exit::Done, "domains/vials/p03.pddl"),
        ("cranes", Exit::Done, "domains/cranes/p01.pddl"),
        ("cranes, moved", Exit::Done, "domains/cranes/p03.pddl"),
        ("rovers", Exit::Done, "domains/rovers/p01.pddl"),
        ("solvable", Exit::Unneeded, "domains/stacking/p01.pddl"),
        ("nothing helps", Exit::Exhausted, "--new-objects 0 domains/cranes/p01.pddl"),
        ("beyond, vials", Exit::Done, "--goals --operators domains/vials/p01.pddl"),
        ("beyond, drawer", Exit::Done, "--goals --operators domains/blocked-drawer/plate.pddl"),
        ("beyond, rovers", Exit::Done, "--goals domains/rovers/p02.pddl"),
    ];
    for (name, exit, arguments) in answers {
        let command = format!("caveat excuse {arguments}");
        keep(name, &command, &desk.ends(exit, &command));
    }
}

#[test]
fn what_a_program_reads() {
    let desk = Desk::with(&[]);
    let answers = [
        ("json", Exit::Done, "domains/blocked-drawer/plate.pddl"),
        ("json, object", Exit::Done, "domains/cranes/p01.pddl"),
        ("json, beyond", Exit::Exhausted, "--new-objects 0 domains/cranes/p01.pddl"),
        ("json, solvable", Exit::Unneeded, "domains/stacking/p01.pddl"),
    ];
    for (name, exit, arguments) in answers {
        let command = format!("caveat excuse --output-format json {arguments}");
        let run = desk.run(&command);
        assert_eq!((run.exit, run.talk.as_str()), (exit, ""), "{command}");
        keep(name, &command, &run.data);
    }
}

#[test]
fn what_a_human_shall_demonstrate() {
    let desk = Desk::with(&[]);
    let command = "caveat excuse --demonstrate lesson domains/blocked-drawer/plate.pddl";
    desk.ends(Exit::Done, command);
    let lesson = desk.file("lesson/lesson.txt");
    keep("lesson", command, &lesson);
    let problem = desk.file("lesson/lesson.pddl");
    keep("lesson as a problem", command, &problem);
    // Who has seen how a chair is moved can do what the lesson asks for.
    let taught = folder("blocked-drawer").join("taught.pddl");
    let plan = desk.path("sas.plan");
    let options = ["--plan-file", plan.to_str().expect("the name is ours")];
    let (exit, said) = caveat("plan", &options, &[&taught, &desk.path("lesson/lesson.pddl")]);
    assert_eq!(exit, Exit::Done, "{said}");
}

#[test]
fn demonstrations_are_judged() {
    let desk = Desk::with(&[
        ("fails.plan", "(move-chair chair1 blue-drawer)\n"),
        ("beside.plan", "(open-drawer blue-drawer)\n"),
        ("unknown.plan", "(fly chair1)\n"),
    ]);
    let check = |extended: &str, plan: &str, rest: &str| {
        format!("caveat excuse --check-demo {extended} --demonstration {plan} {rest}")
    };
    let drawer = "domains/blocked-drawer/plate.pddl";
    let taught = "domains/blocked-drawer/taught.pddl";
    let good = "domains/blocked-drawer/demonstration.plan";
    let solvable = "domains/stacking/p01.pddl";
    let runs = [
        (Exit::Done, check(taught, good, drawer)),
        (Exit::Done, check(taught, good, &format!("--output-format json {drawer}"))),
        (Exit::Findings, check(taught, "fails.plan", drawer)),
        (Exit::Findings, check(taught, "beside.plan", drawer)),
        (Exit::Findings, check("domains/blocked-drawer/domain.pddl", "beside.plan", drawer)),
        (Exit::Findings, check("domains/stacking/domain.pddl", "beside.plan", solvable)),
        (Exit::Failed, check(taught, "unknown.plan", drawer)),
        (Exit::Failed, check(taught, "nowhere.plan", drawer)),
        (Exit::Failed, check("domains/closed-drawer/taught.pddl", good, drawer)),
        (Exit::Failed, format!("caveat excuse --check-demo {taught} {drawer}")),
    ];
    let mut shown = String::new();
    for (exit, command) in runs {
        let _ = writeln!(shown, "{}", desk.shown(exit, &command));
    }
    keep("demonstrations", "caveat excuse --check-demo", &shown);
}

#[test]
fn every_demonstration_that_is_shipped_reaches_the_first_excuse() {
    let desk = Desk::with(&[]);
    for name in ["closed-drawer", "blocked-drawer"] {
        let at = format!("domains/{name}");
        let said = desk.ends(
            Exit::Done,
            &format!(
                "caveat excuse --check-demo {at}/taught.pddl --demonstration {at}/demonstration.plan {at}/plate.pddl"
            ),
        );
        assert!(said.starts_with("The demonstration reaches excuse 1.\n"), "{said}");
    }
}

#[test]
fn what_cannot_be_asked_is_refused() {
    let desk = Desk::with(&[
        ("lamps.pddl", worlds::LAMPS),
        ("dark.pddl", worlds::DARK),
        ("grid.pddl", worlds::GRID),
        ("mast.pddl", worlds::MAST),
        ("none.txt", "\n"),
        ("typo.txt", "(:exactly-one (wired ?lamp) (unwired ?lamp))\n"),
        ("broken.pddl", "(define (problem broken) (:domain lamps) (:goal (lit desk)))\n"),
    ]);
    let wrong = [
        "--only wierd lamps.pddl dark.pddl",
        "--protect wired,weird lamps.pddl dark.pddl",
        "--cost zzz=3 lamps.pddl dark.pddl",
        "--only live grid.pddl mast.pddl",
        "--cost wired lamps.pddl dark.pddl",
        "--cost wired=0 lamps.pddl dark.pddl",
        "--cost wired=1.5 lamps.pddl dark.pddl",
        "--cost wired=-1 lamps.pddl dark.pddl",
        "--groups nowhere.txt lamps.pddl dark.pddl",
        "--groups none.txt lamps.pddl dark.pddl",
        "--groups typo.txt lamps.pddl dark.pddl",
        "--object-cost 0 lamps.pddl dark.pddl",
        "--all --limit 3 lamps.pddl dark.pddl",
        "--time-limit soon lamps.pddl dark.pddl",
        "--output-format xml lamps.pddl dark.pddl",
        "--demonstrate dark.pddl lamps.pddl dark.pddl",
        "--demonstrate lesson domains/cranes/p01.pddl",
        "--apply none/mended.pddl lamps.pddl dark.pddl",
        "domains/warehouse/two-carts.pddl",
        "lamps.pddl nowhere.pddl",
        "lamps.pddl broken.pddl",
        "lamps.pddl",
        "",
    ];
    let mut shown = String::new();
    for arguments in wrong {
        let command = format!("caveat excuse {arguments}");
        let run = desk.run(command.trim());
        assert_eq!((run.exit, run.data.as_str()), (Exit::Failed, ""), "{command}: {}", run.talk);
        let _ = writeln!(shown, "$ {}\n{}", command.trim(), run.talk);
    }
    keep("refused", "caveat excuse", &shown);
}

#[test]
fn odd_questions_get_an_answer() {
    let desk = Desk::with(&[
        ("lamps.pddl", worlds::LAMPS),
        ("dark.pddl", worlds::DARK),
        ("contrary.pddl", &worlds::DARK.replace("(lit hall)", "(not (lit desk))")),
        ("empty.pddl", &worlds::DARK.replace("(and (lit desk) (lit hall))", "(and)")),
    ]);
    let odd = [
        (Exit::Exhausted, "lamps.pddl contrary.pddl"),
        (Exit::Unneeded, "lamps.pddl empty.pddl"),
        (Exit::Exhausted, "--only dusty lamps.pddl dark.pddl"),
        (Exit::Exhausted, "--protect wired,lit,dusty lamps.pddl dark.pddl"),
        (Exit::Exhausted, "--max-edits 0 lamps.pddl dark.pddl"),
        (Exit::Unneeded, "--demonstrate lesson domains/stacking/p01.pddl"),
    ];
    let mut shown = String::new();
    for (exit, arguments) in odd {
        let _ = writeln!(shown, "{}", desk.shown(exit, &format!("caveat excuse {arguments}")));
    }
    keep("odd questions", "caveat excuse", &shown);
    assert!(!Path::new(&desk.path("lesson")).exists());
}

#[test]
fn a_limit_that_is_reached_is_said() {
    let desk = Desk::with(&[]);
    let command = "caveat excuse --time-limit 10ms domains/rovers/p03.pddl";
    let said = desk.ends(Exit::Incomplete, command);
    // How far it comes in that time depends on the machine.
    assert!(said.to_lowercase().contains("a limit was reached"), "{said}");
    let answer = desk.json(&command.replace("excuse", "excuse --output-format json"));
    assert_eq!((&answer["status"], &answer["reason"]), (&"unknown".into(), &"limit".into()));
}
