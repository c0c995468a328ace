//! What is read, and what is said where something is wrong.

use learner::trace::{self, Fault, Reading, Trace, vocabulary};
use proptest::prelude::*;

use super::words::{BLOCKS, domain};

const GOOD: &str = "; a demonstration
(:trajectory
  (:state (on a b) (on b bench) (clear a) (free left))
  (:action (take left a b))
  (:state (on b bench) (clear b) (held a left))
  (:action (put left a bench))
  (:state (on a bench) (on b bench) (clear a) (clear b) (free left)))";

fn read(text: &str, skip: bool) -> (Trace, Vec<Fault>) {
    trace::read(text, &domain(BLOCKS), &Reading { name: "demo", skip, ..Reading::default() })
}

#[track_caller]
fn said(text: &str) -> Vec<String> {
    read(text, true).1.iter().map(ToString::to_string).collect()
}

#[test]
fn states_and_actions_come_in_their_order() {
    let (trace, faults) = read(GOOD, false);
    assert_eq!(faults, []);
    assert_eq!((trace.states.len(), trace.steps.len()), (3, 2));
    let sizes: Vec<usize> = trace.states.iter().map(|state| state.facts().len()).collect();
    assert_eq!(sizes, [4, 3, 5]);
    assert!(trace.steps.iter().all(|joint| joint.whole && joint.parts.len() == 1));
}

#[test]
fn an_object_has_the_most_specific_type_of_its_positions() {
    let (trace, _) = read(GOOD, false);
    let domain = domain(BLOCKS);
    let types: Vec<(&str, &str)> = trace
        .objects
        .iter()
        .map(|one| {
            assert_eq!(one.types.len(), 1);
            (one.name.text.as_str(), domain.types[one.types[0].index()].name.text.as_str())
        })
        .collect();
    // `b` stands where a thing stands and where a cube does.
    let wanted = [("bench", "table"), ("a", "cube"), ("b", "cube"), ("left", "hand")];
    assert_eq!(types, wanted);
}

#[test]
fn text_is_written_as_it_is_read() {
    let domain = domain(BLOCKS);
    let (trace, _) = read(GOOD, false);
    insta::assert_snapshot!(trace::print(&trace, &domain));
    let (again, faults) = read(&trace::print(&trace, &domain), false);
    assert_eq!(faults, []);
    assert_eq!(trace::print(&again, &domain), trace::print(&trace, &domain));
}

#[test]
fn joint_steps_have_a_slot_for_each_agent() {
    let text = "((:init (on a b) (clear a) (free left) (free right))
      (operators: (take left a b) (nop ))
      (:state (held a left) (clear b) (free right))
      (operators: (nop ) (take right b bench))
      (:state (held a left) (held b right)))";
    let domain = domain(BLOCKS);
    let (trace, faults) = read(text, false);
    assert_eq!(faults, []);
    let agents: Vec<&str> =
        trace.agents.iter().map(|agent| trace.objects[agent.index()].name.text.as_str()).collect();
    assert_eq!(agents, ["left", "right"]);
    insta::assert_snapshot!(trace::print_joint(&trace, &domain));
    let mut acting = domain.clone();
    vocabulary::declare_agents(&mut acting, &[trace]);
    let agents: Vec<bool> = acting.actions.iter().map(|action| action.agent).collect();
    assert_eq!(agents, [true, false], "nobody was seen to put");
}

#[test]
fn given_agents_and_objects_are_held_to() {
    let domain = domain(BLOCKS);
    let (trace, _) = read(GOOD, false);
    let objects = &trace.objects[..3];
    let reading =
        Reading { objects: Some(objects), agents: &["a", "b"], skip: true, ..Reading::default() };
    let text =
        "((:state (free left) (on bench a)) (operators: (take left a b)) (:state (clear a)))";
    let faults = trace::read(text, &domain, &reading).1;
    let said: Vec<String> = faults.iter().map(ToString::to_string).collect();
    assert_eq!(
        said,
        [
            "1:10: unknown object `left`",
            "1:22: `bench` in `on` is not of the type cube",
            "1:36: here are 1 actions of 2 agents",
            "1:48: unknown object `left`",
        ]
    );
}

#[test]
fn mistakes_are_told_with_their_place() {
    let wrong = [
        "",
        "state",
        "(state)",
        "((:state (claer a)) (:action (tkae left a b)) (:state))",
        "((:state (clear a b) (clear) ()) (:action (take left)) (:state))",
        "((:action (put left a b)) (:state (clear a)))",
        "((:state (clear a))\n (:state (clear b)))",
        "((:state clear a (= (cost) 3) (not (clear a)) (and (clear a))) (goal) () ((clear b)) more)",
        "((:state (clear a)) (:action (take left a b",
        "((:state (clear a))) (:state)",
        "((:objects a - cube b - cub (c)) (:state (clear a) (clear b)))",
        "((:state (clear a)) (:objects a - cube))",
    ];
    let all: Vec<String> =
        wrong.iter().map(|text| format!("{text}\n{}\n", said(text).join("\n"))).collect();
    insta::assert_snapshot!(all.join("\n"));
}

#[test]
fn reading_ends_at_the_first_mistake_unless_it_is_to_go_on() {
    let text = GOOD.replace("(clear b) (held", "(claer b) (hled");
    let (short, faults) = read(&text, false);
    assert_eq!(faults.len(), 1);
    assert_eq!((faults[0].line, faults[0].column), (5, 24));
    assert_eq!(short.states.len(), 1);
    let (long, faults) = read(&text, true);
    assert_eq!((long.states.len(), faults.len()), (3, 2));
}

#[test]
fn an_action_that_cannot_be_read_hides_what_was_done() {
    let (trace, faults) = read(&GOOD.replace("take left", "tkae left"), true);
    assert_eq!(faults.len(), 1);
    let whole: Vec<bool> = trace.steps.iter().map(|joint| joint.whole).collect();
    assert_eq!(whole, [false, true]);
}

#[test]
fn types_are_inferred_from_what_stands_where() {
    let texts = [
        "((:state (on cube1 cube2) (free left) (lamp)) (:action (take left cube1)) (:state (held cube1 left)))",
        "((:state (on cube3)) (operators: (nop ) (take right cube1)))",
    ];
    let (domain, faults) = trace::infer("seen", &texts);
    let said: Vec<String> = faults.concat().iter().map(ToString::to_string).collect();
    assert_eq!(said, ["1:10: `on` took 2 arguments before, and here are 1"]);
    insta::assert_snapshot!(lang::write::domain(&domain, &lang::write::Style::default()));
}

#[test]
fn objects_that_are_all_alike_need_no_types() {
    let (domain, _) =
        trace::infer("seen", &["((:state (on b1 b2)) (:action (swap b1 b2)) (:state (on b2 b1)))"]);
    assert_eq!(domain.types.len(), 1);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(400))]

    #[test]
    fn any_text_is_read_without_a_panic(words in prop::collection::vec(prop::sample::select(vec![
        "(", "(", "(", ")", ")", ":state", ":init", ":action", "operators:", ":objects", "nop", "take", "put", "on", "clear", "a", "b",
        "left", "bench", "-", "cube", "not", "=", "; remark\n", ":trajectory", "é", "(:state (clear a))", "(:action (put left a b))",
    ]), 0..60), skip in any::<bool>()) {
        let text = words.join(" ");
        let (trace, faults) = read(&text, skip);
        prop_assert!(!trace.states.is_empty() || !faults.is_empty());
        prop_assert!(trace.steps.len() <= trace.states.len());
        prop_assert!(skip || faults.len() <= 1);
        trace::infer("any", &[&text]);
    }
}
