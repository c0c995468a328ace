//! Encoded tasks against the propositional meaning of the ground problems that they stem from.

pub(crate) mod random;
pub(crate) mod semantics;

use proptest::prelude::*;

use self::random::Draft;
use self::semantics::{Propositional, explore, project};
use super::*;
use crate::grounded::Literal;

fn encoded(draft: &Draft, groups: &[Vec<FactId>]) -> (Grounded, Encoded) {
    let grounded = draft.grounded();
    let encoded = encode(&grounded, groups, &Limits::default()).expect("nobody asked to stop");
    (grounded, encoded)
}

/// Domain sizes of the variables, and for each operator its precondition and effects, as text.
fn show(encoded: &Encoded) -> String {
    use std::fmt::Write;
    let task = &encoded.task;
    let name = |fact: &Fact| match encoded.value(*fact) {
        Value::Atom(atom) => format!("f{}", atom.0),
        Value::Negated(atom) => format!("-f{}", atom.0),
        Value::Other => format!("none{}", fact.variable.0),
    };
    let names = |facts: &[Fact]| facts.iter().map(&name).collect::<Vec<_>>().join(" ");
    let mut out = String::new();
    for (variable, &initial) in task.initial_state.iter().enumerate() {
        let variable = VariableId(variable as u32);
        let values: Vec<Fact> = (0..task.variables[variable.index()].domain_size)
            .map(|value| Fact { variable, value })
            .collect();
        let layer = task.variables[variable.index()]
            .axiom_layer
            .map_or(String::new(), |layer| format!(" layer {layer}"));
        writeln!(
            out,
            "{{{}}} = {}{layer}",
            names(&values),
            name(&Fact { variable, value: initial })
        )
        .expect("a string takes all");
    }
    for operator in task.operator_ids() {
        let effect = |effect: &crate::task::Effect| {
            let conditions = task.conditions(&effect.conditions);
            if conditions.is_empty() {
                name(&effect.fact)
            } else {
                format!("({} > {})", names(conditions), name(&effect.fact))
            }
        };
        let effects: Vec<String> = task.effects(operator).iter().map(effect).collect();
        let origin = encoded.origins[operator.index()];
        writeln!(out, "{origin}: {} -> {}", names(task.precondition(operator)), effects.join(" "))
            .expect("a string takes all");
    }
    for axiom in &task.axioms {
        writeln!(out, "{} => {}", names(task.conditions(&axiom.conditions)), name(&axiom.head))
            .expect("a string takes all");
    }
    writeln!(out, "goal {}", names(&task.goal)).expect("a string takes all");
    out
}

fn groups(lists: &[&[u32]]) -> Vec<Vec<FactId>> {
    lists.iter().map(|list| list.iter().copied().map(FactId).collect()).collect()
}

#[track_caller]
fn check(problem: &str, lists: &[&[u32]], expected: &str) {
    let (_, encoded) = encoded(&Draft::parse(problem), &groups(lists));
    assert_eq!(show(&encoded), expected);
}

#[test]
fn a_group_becomes_a_variable_without_a_value_for_none() {
    check(
        "init f0; f0 -> -f0 f1; f1 -> -f1 f2; f2 -> -f2 f0; goal f2",
        &[&[0, 1, 2]],
        "{f0 f1 f2} = f0\n0: f0 -> f1\n1: f1 -> f2\n2: f2 -> f0\ngoal f2\n",
    );
}

#[test]
fn a_delete_without_an_add_leaves_none() {
    check(
        "init f0; f0 -> -f0 f2; f2 -> -f2 f1; goal f1",
        &[&[0, 1]],
        "{f2 -f2} = -f2\n{f0 f1 none1} = f0\n0: f0 -> f2 none1\n1: f2 -> -f2 f1\ngoal f1\n",
    );
}

#[test]
fn a_delete_of_a_value_that_is_not_asked_for_is_conditional() {
    check(
        "init f0; f0 -> -f0 f1; -> -f1 f2; f1 f2 -> f3; goal f3",
        &[&[0, 1]],
        "{f0 f1 none0} = f0\n{f2 -f2} = -f2\n{f3 -f3} = -f3\n0: f0 -> f1\n1:  -> (f1 > none0) f2\n2: f1 f2 -> f3\ngoal f3\n",
    );
}

#[test]
fn deleting_every_value_needs_no_condition() {
    check(
        "init f0; f0 -> -f0 f1; -> -f1 -f0 f2; f1 f2 -> f3; goal f3",
        &[&[0, 1]],
        "{f0 f1 none0} = f0\n{f2 -f2} = -f2\n{f3 -f3} = -f3\n0: f0 -> f1\n1:  -> none0 f2\n2: f1 f2 -> f3\ngoal f3\n",
    );
}

#[test]
fn a_negative_condition_on_a_large_group_gets_a_dual() {
    check(
        "init f0; f0 -> -f0 f1; f1 -> -f1 f2; -f1 -> f3; goal f3 f2",
        &[&[0, 1, 2]],
        "{f0 f1 f2} = f0\n{f1 -f1} = -f1\n{f3 -f3} = -f3\n0: f0 -> f1 f1\n1: f1 -> f2 -f1\n2: -f1 -> f3\ngoal f2 f3\n",
    );
}

#[test]
fn a_negative_condition_on_a_closed_pair_is_the_other_value() {
    check(
        "init f0; f0 -> -f0 f1; f1 -> -f1 f0; -f0 -> f3; goal f3",
        &[&[0, 1]],
        "{f0 f1} = f0\n{f3 -f3} = -f3\n0: f0 -> f1\n1: f1 -> f0\n2: f1 -> f3\ngoal f3\n",
    );
}

#[test]
fn adds_win_over_deletes_of_the_same_fact() {
    check(
        "f0 -> -f1 f1; -> f0; goal f1",
        &[],
        "{f0 -f0} = -f0\n{f1 -f1} = -f1\n0: f0 -> f1\n1:  -> f0\ngoal f1\n",
    );
}

#[test]
fn a_conditional_add_stands_behind_the_delete_that_it_overrides() {
    check(
        "init f1; f1 -> -f1 [f0 > f1] f2; -> f0; goal f1 f2",
        &[],
        "{f0 -f0} = -f0\n{f1 -f1} = f1\n{f2 -f2} = -f2\n0: f1 -> -f1 (f0 > f1) f2\n1:  -> f0\ngoal f1 f2\n",
    );
}

#[test]
fn operators_that_ask_for_two_facts_of_a_group_vanish_and_with_them_what_only_they_reach() {
    check(
        "init f0; f0 -> -f0 f1; f1 -> -f1 f0; f0 f1 -> f2; f2 -> f3; f1 -> f3; goal f3",
        &[&[0, 1]],
        "{f0 f1} = f0\n{f3 -f3} = -f3\n0: f0 -> f1\n1: f1 -> f0\n4: f1 -> f3\ngoal f3\n",
    );
}

#[test]
fn what_the_goal_does_not_need_is_dropped_and_twins_leave_the_cheaper() {
    check(
        "init f0; f0 -> f1 f2 cost 5; f0 -> f1 cost 3; f2 -> f3; goal f1",
        &[],
        "{f1 -f1} = -f1\n1:  -> f1\ngoal f1\n",
    );
}

#[test]
fn axioms_have_a_layer_above_what_they_negate() {
    check(
        "init f0; f0 -> -f0; -f3 -> f4; derived f2 f3; f2 <= f0; f3 <= -f2; goal f4",
        &[],
        "{f0 -f0} = f0\n{f2 -f2} = -f2 layer 0\n{f3 -f3} = -f3 layer 1\n{f4 -f4} = -f4\n0: f0 -> -f0\n1: -f3 -> f4\nf0 => f2\n-f2 => f3\ngoal f4\n",
    );
}

#[test]
fn a_goal_of_two_facts_of_a_group_has_no_plan() {
    let (_, encoded) =
        encoded(&Draft::parse("init f0; f0 -> -f0 f1; goal f0 f1"), &groups(&[&[0, 1]]));
    assert!(encoded.unsolvable);
    assert_ne!(encoded.task.initial_state[0], encoded.task.goal[0].value);
}

#[test]
fn a_goal_that_always_holds_leaves_a_task_that_is_solved() {
    let (_, encoded) = encoded(&Draft::parse("init f0; -> f1; goal f0"), &[]);
    assert!(!encoded.unsolvable);
    assert_eq!(encoded.task.initial_state[0], encoded.task.goal[0].value);
}

#[test]
fn steps_come_back_from_the_decoder() {
    let (grounded, encoded) = encoded(&Draft::parse("init f0; f0 -> f2; f0 -> f1; goal f1"), &[]);
    let step = encoded.step(&grounded, OperatorId(0));
    assert_eq!(step.action.0, 1, "drafts give each operator an action of its own");
    assert_eq!(encoded.decoder(grounded).plan(&[OperatorId(0)]).steps, [step]);
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 2000, ..ProptestConfig::default() })]

    #[test]
    fn encoded_and_propositional_tasks_reach_the_same_states_and_cost_the_same(draft in random::draft(), seed in any::<u64>()) {
        let grounded = draft.grounded();
        let truth = Propositional::explore(&grounded);
        let groups = truth.groups(seed);
        let (grounded, encoded) = encoded(&draft, &groups);
        let reached = explore(&encoded);
        if encoded.unsolvable {
            prop_assert_eq!(truth.cost, None);
        } else {
            prop_assert_eq!(truth.cost, reached.cost, "{}", show(&encoded));
            let visible = semantics::visible(&encoded);
            let expected: BTreeSet<u32> = truth.states.iter().map(|&state| state & visible).collect();
            prop_assert_eq!(project(&encoded, &reached.states), expected, "{}", show(&encoded));
        }
        if let Some(plan) = reached.plan {
            let steps: Vec<u32> = plan.iter().map(|operator| encoded.origins[operator.index()]).collect();
            prop_assert!(semantics::solves(&grounded, &steps), "{}", show(&encoded));
        }
    }

    #[test]
    fn groups_hold_at_most_once_and_conditions_name_each_variable_once(draft in random::draft(), seed in any::<u64>()) {
        let truth = Propositional::explore(&draft.grounded());
        let (_, encoded) = encoded(&draft, &truth.groups(seed));
        let task = &encoded.task;
        let sorted = |facts: &[Fact]| facts.windows(2).all(|pair| pair[0].variable < pair[1].variable);
        for operator in task.operator_ids() {
            prop_assert!(sorted(task.precondition(operator)));
            for effect in task.effects(operator) {
                prop_assert!(sorted(task.conditions(&effect.conditions)));
            }
        }
        for axiom in &task.axioms {
            prop_assert!(sorted(task.conditions(&axiom.conditions)));
        }
        prop_assert!(sorted(&task.goal));
        for state in explore(&encoded).states {
            for group in &task.mutex_groups {
                prop_assert!(group.iter().filter(|fact| state[fact.variable.index()] == fact.value).count() <= 1);
            }
        }
    }
}

/// Literals of a draft are written the same way everywhere.
#[test]
fn drafts_read_what_they_say() {
    let draft = Draft::parse("init f1; f0 -f1 -> -f0 [f1 > f2] cost 4; goal -f2");
    let grounded = draft.grounded();
    assert_eq!(grounded.initial, [false, true, false]);
    assert_eq!(grounded.literals[0], Literal { fact: FactId(0), positive: true });
    assert_eq!(grounded.operators[0].cost, 4);
    assert_eq!(grounded.effects.len(), 2);
    assert_eq!(grounded.goal, [Literal { fact: FactId(2), positive: false }]);
}
