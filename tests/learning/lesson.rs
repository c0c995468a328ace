//! The loop: a problem without a plan goes in; an excuse says what to show, a person shows it, what is learned from that extends the domain, and there is a plan.

use cli::exit::Exit;

use super::{demo, keep};
use crate::desk::{Desk, shipped};

/// The loop for one kitchen; gives back what was printed on the way.
#[track_caller]
fn taught(domain: &str, world: &str) -> String {
    let desk = Desk::new();
    let known = format!("domains/{domain}");
    let steps = [
        (Exit::Done, format!("caveat excuse {known}/plate.pddl")),
        (Exit::Done, format!("caveat simulate demo {world} --task guided -o demo.jsonl")),
        (
            Exit::Done,
            format!(
                "caveat learn --extend {known}/domain.pddl --config {known}/words.json --plan-file demo.plan -o taught.pddl demo.jsonl"
            ),
        ),
        (
            Exit::Done,
            format!(
                "caveat excuse --check-demo taught.pddl --demonstration demo.plan {known}/plate.pddl"
            ),
        ),
    ];
    let before = desk.run(&format!("caveat plan --plan-file x.plan {known}/plate.pddl"));
    assert_ne!(before.exit, Exit::Done, "there is nothing to be learned");
    let shown: String = steps.iter().map(|(exit, step)| desk.shown(*exit, step) + "\n").collect();
    desk.ends(
        Exit::Done,
        &format!("caveat plan --plan-file x.plan taught.pddl {known}/plate.pddl"),
    );
    desk.ends(Exit::Done, &format!("caveat validate taught.pddl {known}/plate.pddl x.plan"));
    desk.clean("taught.pddl");
    // Nothing that was there is gone.
    let known = shipped(&format!("{domain}/domain.pddl"));
    let kept = known.trim_end().strip_suffix(')').expect("a domain ends with a parenthesis");
    let text = desk.file("taught.pddl");
    let new = text.strip_prefix(kept).unwrap_or_else(|| panic!("{text}"));
    format!("{shown}$ cat demo.plan\n{}\nWhat is new in taught.pddl:{new}", desk.file("demo.plan"))
}

#[test]
fn who_is_shown_how_a_drawer_is_opened_can_put_a_plate_into_it() {
    let shown = taught("closed-drawer", "kitchen");
    assert!(shown.contains("The demonstration reaches excuse 1."), "{shown}");
    keep("the loop of the closed drawer", "kitchen I", &shown);
}

#[test]
fn who_is_shown_how_a_chair_is_moved_can_open_the_drawer_behind_it() {
    let shown = taught("blocked-drawer", "kitchen-blocked");
    assert!(shown.contains("The demonstration reaches excuse 1."), "{shown}");
    keep("the loop of the blocked drawer", "kitchen II", &shown);
}

#[test]
fn what_was_learned_once_is_known_the_second_time() {
    let desk = demo("kitchen --task guided");
    let known = "domains/closed-drawer";
    let learn = |domain: &str, output: &str| {
        format!("caveat learn --extend {domain} --config {known}/words.json -o {output} demo.jsonl")
    };
    desk.ends(Exit::Done, &learn(&format!("{known}/domain.pddl"), "once.pddl"));
    let said = desk.ends(Exit::Done, &learn("once.pddl", "twice.pddl"));
    assert_eq!(desk.file("once.pddl"), desk.file("twice.pddl"));
    assert!(
        said.contains("`open-drawer` was known, and seen once.\nNothing new was added."),
        "{said}"
    );
}

#[test]
fn without_words_the_domain_has_none_for_what_was_seen() {
    let desk = demo("kitchen --task guided");
    let command =
        "caveat learn --extend domains/closed-drawer/domain.pddl -o taught.pddl demo.jsonl";
    keep("a domain without words", command, &desk.shown(Exit::Findings, command));
    assert_eq!(desk.file("taught.pddl"), shipped("closed-drawer/domain.pddl"));
}
