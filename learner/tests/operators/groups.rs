//! Traces go in; the groups of facts that exclude each other come out, and nothing that is so by chance.

use learner::invariant::{annotation, invariants};
use learner::trace::Trace;

use super::words::{options, taught};

const KITCHEN: &str = "things blue green - drawer red yellow - plate table shelf - table
    holds (closed blue) (open green) (on-top red table) (on-top yellow shelf) (clear red) (clear yellow)
    holds (hand-empty left) (hand-empty right)
    1.0 right takes blue
    1.4 - (closed blue) right holding
    1.4 + (open blue) right holding
    1.9 right lets go
    3.0 left takes red
    3.2 - (on-top red table) left holding
    5.0 + (inside red blue) left holding
    5.2 left lets go";

/// The groups of what scripts teach, as annotations.
fn groups(scripts: &[&str]) -> Vec<String> {
    let taught = taught(scripts, &options());
    let traces: Vec<Trace> = taught.lines.iter().map(|(_, line)| line.trace.clone()).collect();
    let domain = &taught.learned.domain;
    invariants(domain, &traces).iter().map(|one| annotation(domain, one)).collect()
}

#[test]
fn a_kitchen_is_open_or_closed_and_a_plate_is_in_one_place() {
    assert_eq!(
        groups(&[KITCHEN]),
        [
            "(:exactly-one (in-hand ?plate ?hand) (on-top ?plate ?table) (inside ?plate ?drawer))",
            "(:exactly-one (in-hand ?plate ?hand) (hand-empty ?hand))",
            "(:exactly-one (open ?drawer) (closed ?drawer))",
        ]
    );
}

#[test]
fn what_only_never_was_together_is_no_group() {
    // Nothing ever changes between open and closed here, so that one drawer is open and one is closed says nothing.
    let script = KITCHEN
        .lines()
        .filter(|line| !line.trim_start().starts_with('1'))
        .map(|line| line.replace("(inside red blue)", "(on-top red shelf)"))
        .collect::<Vec<_>>()
        .join("\n");
    assert!(groups(&[&script]).iter().all(|group| !group.contains("open")));
}

#[test]
fn one_demonstration_is_enough_to_refute_a_group() {
    assert!(
        groups(&[KITCHEN]).iter().any(|group| group.contains("(open ?drawer) (closed ?drawer)"))
    );
    // A drawer that is neither.
    let ajar = KITCHEN.replace(" (open green)", "");
    let ajar = groups(&[KITCHEN, &ajar]);
    assert!(
        ajar.iter().all(|group| !group.contains("(open ?drawer) (closed ?drawer)")),
        "{ajar:?}"
    );
}

#[test]
fn things_that_hold_twice_exclude_nothing() {
    // A plate on two tables at once.
    let wide = KITCHEN.replace("(open green) ", "(open green) (on-top red shelf) ");
    let groups = groups(&[&wide]);
    assert!(groups.iter().all(|group| !group.contains("on-top")), "{groups:?}");
}

#[test]
fn what_is_learned_about_groups_can_be_read_again() {
    let taught = taught(&[KITCHEN], &options());
    let (domain, mut style) = learner::write::domain(&taught.learned, taught.learned.rule);
    style.groups = groups(&[KITCHEN]).join("\n");
    let text = lang::write::domain(&domain, &style);
    assert_eq!(super::words::warnings(&text), [""; 0], "{text}");
    assert_eq!(text.matches(":exactly-one").count(), 3, "{text}");
}
