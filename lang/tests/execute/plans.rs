//! Plan files: what is read, what is said of what cannot be, and what is written.

use insta::assert_snapshot;
use lang::plan;
use rust_decimal::Decimal;

use crate::text::Fixture;

fn fixture() -> Fixture {
    Fixture::new(
        "(:requirements :typing) (:types cube arm)
  (:predicates (on ?a ?b - cube))
  (:action pick :parameters (?c - cube ?a - arm) :effect (and))
  (:action stack :parameters (?up ?down - cube) :effect (on ?up ?down))
  (:action rest :parameters () :effect (and))",
        "(:objects red blue Green-1 - cube left - arm) (:init) (:goal (on red blue))",
    )
}

/// The steps that were understood, then what was said.
fn read(text: &str) -> String {
    let mut fixture = fixture();
    let (listing, notes) = fixture.plan(text);
    let steps = listing.plan.steps.iter().zip(&listing.spans);
    let lines = steps.map(|(step, &span)| {
        let line = plan::line(step, &fixture.domain, &fixture.problem);
        format!("{} {line}\n", fixture.place(span))
    });
    lines.collect::<String>() + &notes
}

#[test]
fn all_usual_forms_are_read() {
    let text = "; found by hand\n\n(PICK Red left)\n  ( stack red\n blue ) (rest);not (this)\n0.000: (rest) [1.000]\n0.001:(pick green-1 LEFT)[2]\r\n1 : (rest)\n; cost = 5 (unit cost)\n";
    assert_snapshot!(read(text), @r#"
    plan:3:1 (pick red left)
    plan:4:3 (stack red blue)
    plan:5:9 (rest)
    plan:6:8 (rest)
    plan:7:7 (pick green-1 left)
    plan:8:5 (rest)
    "#);
}

#[test]
fn what_a_plan_is_written_as_is_what_it_is_read_from() {
    let mut fixture = fixture();
    let (listing, _) = fixture.plan("(PICK GREEN-1 left) (rest)");
    let text =
        plan::write(&listing.plan, &fixture.domain, &fixture.problem, Decimal::new(150, 2), false);
    assert_eq!(text, "(pick green-1 left)\n(rest)\n; cost = 1.5 (general cost)\n");
    let (again, notes) = fixture.plan(&text);
    assert_eq!((again.plan, notes.as_str()), (listing.plan, ""));
    let empty =
        plan::write(&plan::Plan::default(), &fixture.domain, &fixture.problem, Decimal::ZERO, true);
    assert_eq!(empty, "; cost = 0 (unit cost)\n");
}

#[test]
fn unknown_names_get_a_suggestion() {
    assert_snapshot!(read("(pikc red left)\n(pick rad left)\n(juggle red blue)\n(stack red planet)"), @r#"
    error[E0711]: unknown action `pikc`
     --> plan:1:2
      |
    1 | (pikc red left)
      |  ^^^^ not in the domain
      |
      = help: did you mean `pick`?

    error[E0713]: unknown object `rad`
     --> plan:2:7
      |
    2 | (pick rad left)
      |       ^^^ not in the problem or the domain
      |
      = help: did you mean `red`?

    error[E0711]: unknown action `juggle`
     --> plan:3:2
      |
    3 | (juggle red blue)
      |  ^^^^^^ not in the domain

    error[E0713]: unknown object `planet`
     --> plan:4:12
      |
    4 | (stack red planet)
      |            ^^^^^^ not in the problem or the domain
    "#);
}

#[test]
fn wrong_arguments_are_told_with_the_declaration() {
    assert_snapshot!(read("(pick red)\n(rest red)\n(stack left blue)\n(pick left red)"), @r#"
    error[E0712]: `pick` takes 2 arguments, 1 given
     --> plan:1:1
      |
    1 | (pick red)
      | ^^^^^^^^^^ 1 here
      |
     ::: domain.pddl:4:12
      |
    4 |   (:action pick :parameters (?c - cube ?a - arm) :effect (and))
      |            ---- declared here
      |
      = help: its parameters are `?c - cube ?a - arm`

    error[E0712]: `rest` takes 0 arguments, 1 given
     --> plan:2:1
      |
    2 | (rest red)
      | ^^^^^^^^^^ 1 here
      |
     ::: domain.pddl:6:12
      |
    6 |   (:action rest :parameters () :effect (and)))
      |            ---- declared here

    error[E0714]: `left` is of type `arm`, not `cube`
     --> plan:3:8
      |
    3 | (stack left blue)
      |        ^^^^ `stack` takes type `cube` here
      |
     ::: domain.pddl:5:31
      |
    5 |   (:action stack :parameters (?up ?down - cube) :effect (on ?up ?down))
      |                               --- `?up` is declared here

    error[E0714]: `left` is of type `arm`, not `cube`
     --> plan:4:7
      |
    4 | (pick left red)
      |       ^^^^ `pick` takes type `cube` here
      |
     ::: domain.pddl:4:30
      |
    4 |   (:action pick :parameters (?c - cube ?a - arm) :effect (and))
      |                              -- `?c` is declared here

    error[E0714]: `red` is of type `cube`, not `arm`
     --> plan:4:12
      |
    4 | (pick left red)
      |            ^^^ `pick` takes type `arm` here
      |
     ::: domain.pddl:4:40
      |
    4 |   (:action pick :parameters (?c - cube ?a - arm) :effect (and))
      |                                        -- `?a` is declared here
    "#);
}

#[test]
fn parentheses_that_are_missing_lose_no_step_silently() {
    assert_snapshot!(read("pick red left\n(pick red left\n(rest))\nrest)\n()\n[1.0]\n3:\n(stack red blue"), @r#"
    plan:2:1 (pick red left)
    plan:3:1 (rest)
    plan:8:1 (stack red blue)
    error[E0710]: a step stands in parentheses
     --> plan:1:1
      |
    1 | pick red left
      | ^^^^^^^^^^^^^ no `(` before it
      |
      = help: a plan file has one `(action object …)` for each step

    error[E0710]: a step that is not closed
     --> plan:2:1
      |
    2 | (pick red left
      | ^ this `(` has no `)`
      |
      = help: a plan file has one `(action object …)` for each step

    error[E0710]: unexpected `)`
     --> plan:3:7
      |
    3 | (rest))
      |       ^ no step is open here
      |
      = help: a plan file has one `(action object …)` for each step

    error[E0710]: a step stands in parentheses
     --> plan:4:1
      |
    4 | rest)
      | ^^^^^ no `(` before it
      |
      = help: a plan file has one `(action object …)` for each step

    error[E0710]: a step without a name
     --> plan:5:1
      |
    5 | ()
      | ^^ an action's name belongs here
      |
      = help: a plan file has one `(action object …)` for each step

    error[E0710]: a step that is not closed
     --> plan:8:1
      |
    8 | (stack red blue
      | ^ this `(` has no `)`
      |
      = help: a plan file has one `(action object …)` for each step
    "#);
}

#[test]
fn times_that_go_back_are_refused() {
    assert_snapshot!(read("0: (rest)\n2: (rest)\n1.5: (rest)"), @r#"
    plan:1:4 (rest)
    plan:2:4 (rest)
    plan:3:6 (rest)
    error[E0715]: this step comes before the one above it
     --> plan:3:1
      |
    2 | 2: (rest)
      | - at time 2
    3 | 1.5: (rest)
      | ^^^ at time 1.5
      |
      = help: write the steps in the order of their times
    "#);
}
