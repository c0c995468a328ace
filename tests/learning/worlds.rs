//! One demonstration in each world goes in; a plan with what was learned is carried out there and reaches its goal, and a sabotaged one does not.

use cli::exit::Exit;

use super::demo;
use crate::desk::Desk;

/// Learns from a demonstration, plans for a goal, and carries the plan out; gives back what was printed in the end.
#[track_caller]
fn carried_out(world: &str, seed: u32, learn: &str, goal: Option<(&str, &str)>) -> (Desk, String) {
    let desk = demo(&format!("{world} --seed {seed}"));
    let wanted = goal.map_or_else(String::new, |(_, condition)| format!("--goal '{condition}'"));
    desk.ends(
        Exit::Done,
        &format!("caveat learn {learn} {wanted} -o learned.pddl --problem shown.pddl demo.jsonl"),
    );
    desk.clean("learned.pddl shown.pddl");
    desk.ends(Exit::Done, "caveat plan --plan-file x.plan learned.pddl shown.pddl");
    desk.ends(Exit::Done, "caveat validate learned.pddl shown.pddl x.plan");
    let name = goal.map_or_else(String::new, |(name, _)| format!("--goal {name}"));
    let run = desk.run(&format!(
        "caveat simulate run {world} --seed {seed} {name} --routines learned.routines.json x.plan"
    ));
    let plan = desk.file("x.plan");
    assert_eq!(run.exit, Exit::Done, "{plan}{}{}", run.data, run.talk);
    (desk, run.data)
}

#[test]
fn a_plate_gets_into_a_drawer_that_was_closed() {
    let (_, said) = carried_out("kitchen", 0, "", None);
    assert!(said.contains("The goal (inside red-plate pink-drawer) is reached"), "{said}");
}

#[test]
fn a_plate_gets_into_a_drawer_behind_a_chair() {
    let (_, said) = carried_out("kitchen-blocked", 0, "", None);
    assert!(said.contains("is reached"), "{said}");
}

#[test]
fn cubes_are_stacked_as_shown_and_as_never_shown() {
    let shown = "(and (on-top red-cube green-cube) (on-top green-cube blue-cube))";
    carried_out("cubes", 0, "", Some(("tower-of-three", shown)));
    let other = "(and (on-top red-cube green-cube) (on-top blue-cube yellow-cube))";
    carried_out("cubes", 0, "", Some(("two-towers", other)));
}

#[test]
fn a_bottle_is_opened_with_two_hands() {
    let goal = "(and (open lid) (on-top lid table))";
    let (desk, said) = carried_out("bottle", 0, "--agents", Some(("open-bottle", goal)));
    assert!(said.contains("is reached"), "{said}");
    // One hand cannot: a step of the plan has two parts.
    let plan = desk.file("x.plan");
    let together = plan.lines().filter(|line| line.contains("hold-bottle")).count();
    assert!(together > 0, "{plan}");
}

#[test]
fn a_tower_gets_from_one_arm_to_the_other() {
    let goal = "(and (at large-cube right-spot) (on-top small-cube large-cube))";
    let (desk, said) = carried_out("hanoi", 0, "--agents", Some(("tower-on-the-right", goal)));
    assert!(said.contains("is reached"), "{said}");
    let domain = desk.file("learned.pddl");
    assert!(domain.contains("(:action constrained-move-1"), "{domain}");
}

#[test]
fn a_sabotaged_plan_fails() {
    let (desk, _) = carried_out("kitchen", 0, "", None);
    let plan = desk.file("x.plan");
    let run = "caveat simulate run kitchen --routines learned.routines.json broken.plan";
    // Without opening the drawer.
    let lines = plan.split_inclusive('\n');
    let closed: String = lines.filter(|line| !line.contains("open-drawer")).collect();
    assert_ne!(closed, plan);
    desk.write("broken.plan", &closed);
    let said = desk.ends(Exit::Findings, run);
    assert!(said.contains("(inside red-plate pink-drawer) is not reached"), "{said}");
    // With the other plate.
    desk.write("broken.plan", &plan.replace("red-plate", "green-plate"));
    desk.ends(Exit::Findings, run);
    // Nothing at all.
    desk.write("broken.plan", "");
    desk.ends(Exit::Findings, run);
    // With way points that lead nowhere near.
    let far = desk
        .file("learned.routines.json")
        .replace("\"offset\": [", "\"offset\": [\n0.5, 0.5, 0.5, 0, 0, 0, 1], \"was\": [");
    desk.write("learned.routines.json", &far);
    desk.write("broken.plan", &plan);
    desk.ends(Exit::Findings, run);
}
