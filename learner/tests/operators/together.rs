//! Deeds of two hands at the same time go in; which of them are tied together comes out, by the guideline of the thesis, by teach mode and by need.

use learner::operators::Options;
use learner::operators::synergy::{self, Synergy};

use super::script;
use super::words::{deeds, names, options, taught, text};

/// Each hand stacks a cube of its own, at the same time.
const BUSY: &str = "things red blue green - cube table - table
    holds (on-top red table) (on-top blue table) (on-top green table) (clear red) (clear blue) (clear green)
    holds (hand-empty left) (hand-empty right)
    1.0 left takes red
    1.0 right takes blue
    1.2 - (on-top red table) left holding
    1.2 - (on-top blue table) right holding
    3.0 + (on-top red green) left holding
    3.0 - (clear green) left holding
    3.0 + (on-top blue table) right holding
    3.2 left lets go
    3.2 right lets go";

/// One hand holds a bottle, and the other takes its lid off.
const BOTTLE: &str = "things bottle - bottle lid - lid table - table
    holds (on-top lid bottle) (on-top bottle table) (closed lid) (hand-empty left) (hand-empty right)
    1.0 left takes bottle
    1.2 - (on-top bottle table) left holding
    2.0 right takes lid
    3.0 - (closed lid) right holding left holding
    3.0 + (open lid) right holding left holding
    3.2 - (on-top lid bottle) right holding left holding
    5.0 + (on-top lid table) right holding
    5.2 right lets go
    6.0 + (on-top bottle table) left holding
    6.2 left lets go";

/// The pairs of hands and deeds that are tied, as lines.
fn ties(script: &str, synergy: Synergy) -> Vec<String> {
    let (record, mut found) = deeds(script);
    synergy::tie(&record, &mut found, synergy);
    let short = |line: String| {
        let words: Vec<&str> = line.split(' ').take(3).collect();
        (words.join(" "), line.contains(" with "))
    };
    let lines = script::lines(&record, &found).into_iter().map(short);
    lines.filter(|(_, tied)| *tied).map(|(line, _)| line).collect()
}

#[test]
fn hands_that_only_happen_to_be_busy_are_tied_by_the_thesis_alone() {
    assert_eq!(ties(BUSY, Synergy::Needed), [""; 0]);
    assert_eq!(ties(BUSY, Synergy::Flag), [""; 0]);
    assert_eq!(
        ties(BUSY, Synergy::Thesis),
        ["left take red", "right take blue", "left put red", "right put blue"]
    );
}

#[test]
fn hands_in_teach_mode_are_tied_by_the_flag() {
    let both = format!("0.1 left is taught\n0.1 right is taught\n{BUSY}");
    let script = both.lines().collect::<Vec<_>>();
    // The names of things come first.
    let (flags, rest) = script.split_at(2);
    let mut lines = rest[..3].to_vec();
    lines.extend(flags);
    lines.extend(&rest[3..]);
    assert_eq!(
        ties(&lines.join("\n"), Synergy::Flag),
        ["left take red", "right take blue", "left put red", "right put blue"]
    );
    // One hand alone is not taught together with another.
    let lines: Vec<&str> =
        lines.into_iter().filter(|line| !line.starts_with("0.1 right")).collect();
    assert_eq!(ties(&lines.join("\n"), Synergy::Flag), [""; 0]);
}

#[test]
fn what_one_hand_could_not_have_done_alone_is_tied_by_need() {
    assert_eq!(ties(BOTTLE, Synergy::Needed), ["left hold bottle", "right take lid"]);
}

#[test]
fn what_is_tied_becomes_a_joint_action() {
    let agents = Options { agents: true, ..options() };
    let taught = taught(&[BOTTLE], &agents);
    let text = text(&taught);
    insta::with_settings!({ description => BOTTLE, omit_expression => true }, {
        insta::assert_snapshot!("the lid of a bottle", text);
    });
    assert!(text.contains(":multi-agent"), "{text}");
}

#[test]
fn without_agents_a_deed_that_needs_two_hands_names_only_one() {
    let names = names(&taught(&[BUSY], &options()));
    assert_eq!(
        names,
        ["take-cube-from-table 2", "put-cube-on-cube 1", "put-cube-on-table 1"],
        "each was done by one hand"
    );
}

#[test]
fn by_the_thesis_busy_hands_only_act_together() {
    let agents = Options { agents: true, synergy: Synergy::Thesis, ..options() };
    let tied = text(&taught(&[BUSY], &agents));
    let free = text(&taught(&[BUSY], &Options { agents: true, ..options() }));
    let joint = |text: &str| {
        text.matches("(exists (?other").count() + text.matches("(put-cube-on-table ?").count()
    };
    assert!(joint(&tied) > joint(&free), "{tied}\n{free}");
    insta::with_settings!({ description => BUSY, omit_expression => true }, {
        insta::assert_snapshot!("two busy hands by the thesis", tied);
    });
}
