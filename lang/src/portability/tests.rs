//! What is said for each program, and that nothing is said of what all of them read.

use super::{Tool, check};
use crate::diagnostic::fixture::port;
use crate::source::Sources;

/// A task that every one of the programs reads and plans.
const PLAIN: [&str; 2] = [
    "(define (domain d)
  (:requirements :strips :typing)
  (:types cube)
  (:predicates (clear ?c - cube) (held ?c - cube))
  (:action lift
    :parameters (?c - cube)
    :precondition (clear ?c)
    :effect (and (held ?c) (not (clear ?c)))))
",
    "(define (problem p)
  (:domain d)
  (:objects a b - cube)
  (:init (clear a) (clear b))
  (:goal (held a)))
",
];

#[test]
fn nothing_is_said_of_what_all_read() {
    port(&Tool::ALL, &PLAIN);
}

#[test]
fn names_of_tools_are_read_back() {
    for tool in Tool::ALL {
        assert_eq!(Tool::named(tool.name()), Some(tool));
    }
    assert_eq!(Tool::named("nothing"), None);
}

#[test]
fn fast_downward_and_numbers() {
    port(
        &[Tool::FastDownward],
        &[
            "(define (domain d)
  (:requirements :strips :typing :numeric-fluents)
;                                ^^^^^^^^^^^^^^^^ W0305: Fast Downward refuses the requirement `:numeric-fluents`
  (:types cube)
  (:predicates (held ?c - cube))
  (:functions (weight ?c - cube) (load) - number (total-cost))
  (:action lift
    :parameters (?c - cube)
    :precondition (< (+ (load) (weight ?c)) 10)
;                 ^^ W0305: Fast Downward refuses conditions on numbers
    :effect (and (held ?c) (increase (load) (weight ?c)) (increase (total-cost) 1.5))))
;                          ^^^^^^^^^ W0305: Fast Downward refuses numeric effects other than `(increase (total-cost) …)`
;                                                                               ^^^ W0305: Fast Downward refuses numbers with a fraction
",
            "(define (problem p)
  (:domain d)
  (:objects a - cube)
  (:init (= (weight a) -2) (= (load) 0) (= (total-cost) 0))
;                      ^^ W0305: Fast Downward refuses negative numbers
  (:goal (held a))
  (:metric minimize (load)))
; ^^^^^^^^ W0305: Fast Downward refuses metrics other than `minimize (total-cost)`
",
        ],
    );
}

#[test]
fn fast_downward_and_its_costs() {
    port(
        &[Tool::FastDownward],
        &["(define (domain d)
  (:requirements :adl :action-costs)
  (:types cube number - object)
;              ^^^^^^ W0305: Fast Downward refuses a type `number`
  (:predicates (held ?c - cube) (free))
  (:functions (total-cost) - number)
  (:action lift
    :parameters (?c -cube)
;                   ^^^^^ W0007: `-cube` is read as `- cube`; some planners read it as one word
;                   ^^^^^ W0305: Fast Downward misreads a `-` without blanks around it as part of a name
    :effect (and (held ?c) (when (free) (increase (total-cost) 2)) (increase (total-cost) (+ 1 2)))))
;                                                                   ^^^^^^^^ W0302: a numeric effect needs the requirement `:numeric-fluents`, which is not declared
;                                       ^^^^^^^^^ W0305: Fast Downward fails at costs under `when` or `forall`
;                                                                  ^^^^^^^^^ W0305: Fast Downward fails at costs that are computed
"],
    );
}

#[test]
fn fast_downward_and_other_dialects() {
    port(
        &[Tool::FastDownward],
        &[
            "(define (domain d)
  (:requirements :strips :typing :durative-actions :constraints)
;                                ^^^^^^^^^^^^^^^^^ W0305: Fast Downward refuses the requirement `:durative-actions`
;                                                  ^^^^^^^^^^^^ W0305: Fast Downward refuses the requirement `:constraints`
  (:types cube block)
  (:predicates (held ?c - (either cube block)))
  (:durative-action lift
; ^^^^^^^^^^^^^^^^^ W0305: Fast Downward refuses `:durative-action`
    :parameters (?c - (either cube block))
;                     ^^^^^^^ W0305: Fast Downward refuses `either`
    :duration (= ?duration 2)
    :condition (at start (held ?c))
    :effect (at end (held ?c))))
",
            "(define (problem p)
  (:domain d)
  (:objects a - cube)
  (:init (held a) (at 5 (held a)))
;                     ^ W0302: a fact at a point in time needs the requirement `:timed-initial-literals`, which is not declared
;                 ^^^ W0305: Fast Downward refuses timed initial literals
  (:goal (held a))
  (:constraints (always (held a))))
; ^^^^^^^^^^^^^ W0305: Fast Downward refuses `:constraints`
",
        ],
    );
}

#[test]
fn the_order_of_sections_and_fields() {
    port(
        &[Tool::FastDownward, Tool::Enhsp, Tool::UnifiedPlanning],
        &[
            "(define (domain d)
  (:predicates (p) (q))
  (:requirements :strips)
; ^^^^^^^^^^^^^^ W0305: ENHSP refuses declarations in another order than its own
; ^^^^^^^^^^^^^^ W0305: unified-planning refuses declarations in another order than its own
  (:action a :precondition (p) :parameters () :effect (q))
;                              ^^^^^^^^^^^ W0305: Fast Downward refuses the fields of an action in another order than its own
;                              ^^^^^^^^^^^ W0305: ENHSP refuses the fields of an action in another order than its own
;                              ^^^^^^^^^^^ W0305: unified-planning refuses the fields of an action in another order than its own
  (:constants c))
; ^^^^^^^^^^^ W0305: Fast Downward refuses declarations behind actions
",
            "(define (problem e)
  (:domain d)
  (:init (p))
  (:objects o)
; ^^^^^^^^^ W0305: Fast Downward refuses the parts of a problem in another order than its own
; ^^^^^^^^^ W0305: ENHSP misreads the parts of a problem in another order than its own
; ^^^^^^^^^ W0305: unified-planning refuses the parts of a problem in another order than its own
  (:goal (q)))
",
        ],
    );
}

#[test]
fn the_validator_and_its_keywords() {
    port(
        &[Tool::Val],
        &["(define (domain d)
  (:requirements :strips :typing :durative-actions)
  (:types place 2nd-place)
;               ^^^^^^^^^ W0305: VAL refuses names that begin with a digit
  (:predicates (after ?name - place) (at ?p - place))
;               ^^^^^ W0305: VAL refuses `after` as a name
;                     ^^^^^ W0305: VAL refuses `?name` as a variable
  (:action a :parameters (?name - place) :effect (after ?name))
; ^^^^^^^^ W0305: VAL refuses an action without `:precondition`
  (:durative-action b
    :parameters (?p - place)
    :duration (= ?duration 1)
    :condition (at  start (at ?p))
;               ^^^^^^^^^ W0305: VAL refuses time specifiers with other than one blank
    :effect (at end (after ?p))))
"],
    );
}

#[test]
fn temporal_planners_and_conditions() {
    port(
        &[Tool::Popf, Tool::Optic, Tool::Tamer],
        &["(define (domain d)
  (:requirements :adl :derived-predicates)
;                     ^^^^^^^^^^^^^^^^^^^ W0305: Tamer refuses the requirement `:derived-predicates`
  (:predicates (fixed) (p) (q) (r))
  (:derived (r) (and (p) (q)))
; ^^^^^^^^^ W0305: POPF does not plan with `:derived`
; ^^^^^^^^^ W0305: OPTIC does not plan with `:derived`
; ^^^^^^^^^ W0305: Tamer refuses `:derived`
  (:action a
    :parameters ()
    :precondition (and (not (fixed)) (not (p)) (or (q) (r)))
;                                    ^^^^ W0305: POPF does not plan with conditions that an atom be false
;                                    ^^^^ W0305: OPTIC does not plan with conditions that an atom be false
;                                              ^^^ W0305: POPF does not plan with disjunctive conditions
;                                              ^^^ W0305: OPTIC does not plan with disjunctive conditions
    :effect (and (p) (when (q) (not (p))))))
;                    ^^^^^ W0305: POPF does not plan with conditional effects
;                    ^^^^^ W0305: OPTIC does not plan with conditional effects
;                    ^^^^^ W0305: Tamer does not plan with conditional effects
"],
    );
}

#[test]
fn readers_and_names() {
    port(
        &[Tool::UnifiedPlanning, Tool::Aries, Tool::Pddl],
        &["(define (domain d)
  (:requirements :strips :typing)
  (:types area - place area - room place room - object)
;                      ^^^^ W0305: unified-planning refuses a type with several supertypes
;                      ^^^^ W0305: the Python package `pddl` refuses a type with several supertypes
  (:predicates (in ?a - area) (place ?a - area) (always ?a - area) (x.y))
;                              ^^^^^ W0305: unified-planning refuses one name for type and predicate
;                                                ^^^^^^ W0305: unified-planning refuses `always` as a predicate
;                                                                   ^^^ W0305: unified-planning refuses names with other characters than letters, digits, `-` and `_`
;                                                                   ^^^ W0305: the Python package `pddl` refuses names with other characters than letters, digits, `-` and `_`
  (:action a
    :parameters (?a - area)
    :precondition (and (in?a) (place ?a) (x.y))
;                       ^^^^ W0305: unified-planning refuses a variable without a blank before it
;                       ^^^^ W0305: aries refuses a variable without a blank before it
    :effect (always ?a)))
"],
    );
}

#[test]
fn agents_are_read_by_none() {
    port(
        &[Tool::FastDownward, Tool::Aries],
        &["(define (domain d)
  (:requirements :typing :multi-agent :unfactored-privacy)
;                        ^^^^^^^^^^^^ W0305: Fast Downward refuses the requirement `:multi-agent`
;                                     ^^^^^^^^^^^^^^^^^^^ W0305: Fast Downward refuses the requirement `:unfactored-privacy`
  (:types robot)
  (:predicates (:private ?r - robot (held ?r - robot)))
;              ^^^^^^^^^ W0305: Fast Downward refuses `:private`
;              ^^^^^^^^^ W0305: aries refuses `:private`
  (:action lift
    :agent ?r - robot
;   ^^^^^^ W0305: Fast Downward refuses `:agent` in an action
;   ^^^^^^ W0305: aries refuses `:agent` in an action
    :parameters ()
    :effect (held ?r)))
"],
    );
}

#[test]
fn a_mark_before_the_text() {
    let mut sources = Sources::default();
    let id = sources.add("domain.pddl", format!("\u{feff}{}", PLAIN[0]));
    let found = check(&sources, id, &[Tool::FastDownward, Tool::Val]);
    let messages: Vec<&str> = found.list.iter().map(|one| one.message.as_str()).collect();
    assert_eq!(messages, ["Fast Downward refuses a byte order mark"]);
    assert_eq!(check(&sources, id, &[]).list, []);
}

#[test]
fn deep_and_broken_texts_take_no_time() {
    const DEPTH: usize = 20_000;
    for text in
        ["(increase (total-cost) ", "(when (p) ", "(- ", "(define ", "(:action ", "(either "]
    {
        let start = "(define (domain d) (:action a :effect ";
        let mut sources = Sources::default();
        let id = sources.add("deep", format!("{start}{}{}", text.repeat(DEPTH), ")".repeat(DEPTH)));
        check(&sources, id, &Tool::ALL);
        let id = sources.add("open", text.repeat(DEPTH));
        check(&sources, id, &Tool::ALL);
    }
}
