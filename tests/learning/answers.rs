//! Logs go in; domains by each rule, time lines, decision trees and traces come out, whatever form the log has.

use cli::exit::Exit;

use super::{demo, keep};

#[test]
fn a_domain_as_a_person_reads_it() {
    let desk = demo("kitchen");
    let command = "caveat learn --problem shown.pddl --plan-file demo.plan demo.jsonl";
    let printed = desk.shown(Exit::Done, command);
    let files = format!(
        "{printed}\n$ cat shown.pddl\n{}\n$ cat demo.plan\n{}",
        desk.file("shown.pddl"),
        desk.file("demo.plan")
    );
    keep("a kitchen", command, &files);
    // The demonstration is a plan of what was learned from it.
    desk.ends(Exit::Done, "caveat learn -o learned.pddl --problem shown.pddl demo.jsonl");
    desk.ends(Exit::Done, "caveat validate learned.pddl shown.pddl demo.plan");
}

#[test]
fn each_rule_writes_a_domain_of_which_nothing_is_to_be_said() {
    let desk = demo("kitchen");
    let text = |rule: &str| {
        desk.ends(Exit::Done, &format!("caveat learn --rule {rule} -o {rule}.pddl demo.jsonl"));
        desk.clean(&format!("{rule}.pddl"));
        let text = desk.file(&format!("{rule}.pddl"));
        assert_eq!(lang::format::format(&text).as_deref(), Some(text.as_str()), "{rule}");
        text
    };
    let (changed, safe, both) = (text("changed"), text("safe"), text("both"));
    assert!(changed.contains("(:action reach-plate"), "algorithm 4 has activities: {changed}");
    assert!(!safe.contains("Perhaps"), "{safe}");
    assert!(both.contains("Perhaps not needed:"), "{both}");
    let code = |text: &str| {
        let lines = text.lines().filter(|line| !line.trim_start().starts_with("; "));
        lines.collect::<Vec<_>>().join("\n")
    };
    assert_eq!(code(&safe), code(&both), "plans are made with the safe bound");
}

#[test]
fn csv_says_the_same_as_json_lines() {
    let desk = demo("cubes");
    desk.ends(Exit::Done, "caveat simulate demo cubes --csv -o demo.csv");
    let learn =
        |log: &str| desk.run(&format!("caveat learn {log}")).data.replace("demo.csv", "demo.jsonl");
    let text = learn("demo.jsonl");
    assert!(text.contains("(:action"), "{text}");
    assert_eq!(learn("demo.csv"), text);
}

#[test]
fn several_demonstrations_are_counted_together() {
    let desk = demo("cubes");
    desk.ends(Exit::Done, "caveat simulate demo cubes --person 2 --seed 2 -o other.jsonl");
    let said = desk.ends(Exit::Done, "caveat learn demo.jsonl other.jsonl");
    assert!(
        said.contains(";@ (:seen 2 \"demo.jsonl\")\n    ;@ (:seen 2 \"other.jsonl\")"),
        "{said}"
    );
    assert!(said.contains("Seen 4 times in demo.jsonl and another."), "{said}");
}

#[test]
fn what_each_hand_does_and_when() {
    let desk = demo("kitchen --task guided");
    let command = "caveat learn --segments --segments-svg time.svg demo.jsonl";
    keep("a time line", command, &desk.shown(Exit::Done, command));
    assert!(desk.file("time.svg").starts_with("<svg"));
}

#[test]
fn a_decision_tree_is_learned_from_annotated_frames() {
    let desk = demo("kitchen --task guided");
    let command = "caveat learn --truth demo.truth.jsonl demo.jsonl";
    keep("a decision tree", command, &desk.shown(Exit::Done, command));
}

#[test]
fn hands_get_other_names_or_are_left_out() {
    let desk = demo("kitchen --task guided");
    let mapped = desk
        .ends(Exit::Done, "caveat learn --map right-hand=robot --problem shown.pddl demo.jsonl");
    assert!(mapped.contains("(:action open-drawer"), "{mapped}");
    let problem = desk.file("shown.pddl");
    assert!(problem.contains("robot - hand") && !problem.contains("right-hand"), "{problem}");
    assert!(!problem.contains("left-hand"), "{problem}");
    // The hand that is left did nothing.
    let said = desk.ends(Exit::Findings, "caveat learn --map left-hand=robot demo.jsonl");
    assert!(said.contains("nothing was done"), "{said}");
}

#[test]
fn traces_are_written_and_learned_from() {
    let desk = demo("kitchen");
    desk.ends(Exit::Done, "caveat learn --trace demo.trace -o learned.pddl demo.jsonl");
    let names = |text: &str| -> Vec<String> {
        let actions = text.split("(:action ").skip(1);
        actions.map(|rest| rest.lines().next().unwrap_or_default().to_owned()).collect()
    };
    let learned = names(&desk.file("learned.pddl"));
    // With the words of a domain the trace teaches the same.
    let with = desk.ends(Exit::Done, "caveat learn --domain learned.pddl demo.trace");
    assert_eq!(names(&with), learned, "{with}");
    let effects = |text: &str| -> Vec<String> {
        let parts = text.split(":effect").skip(1);
        let parts = parts.map(|rest| rest.split(";@").next().unwrap_or_default());
        parts.map(|rest| rest.split_whitespace().collect::<Vec<_>>().join(" ")).collect()
    };
    assert_eq!(effects(&with), effects(&desk.file("learned.pddl")));
    // Without it, the words are inferred.
    let without = desk.ends(Exit::Done, "caveat learn -o inferred.pddl demo.trace");
    assert_eq!(names(&desk.file("inferred.pddl")).len(), learned.len(), "{without}");
    desk.clean("inferred.pddl");
}

#[test]
fn the_thresholds_of_observation_can_be_printed_and_given_back() {
    let desk = demo("cubes --task stack-one");
    let config = desk.ends(Exit::Done, "caveat learn --print-config");
    desk.write("config.json", &config);
    let usual = desk.run("caveat learn demo.jsonl").data;
    assert_eq!(desk.run("caveat learn --config config.json demo.jsonl").data, usual);
    let words =
        r#"{"vocabulary": {"on-top": "(on ?above ?below)", "in-hand": "(holding ?object)"}}"#;
    desk.write("words.json", words);
    let other = desk.run("caveat learn --config words.json demo.jsonl").data;
    assert!(other.contains("(on ?") && other.contains("(holding ?cube"), "{other}");
    assert!(!other.contains("on-top"), "{other}");
}
