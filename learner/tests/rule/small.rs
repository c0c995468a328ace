//! Small demonstrations, and the domains that are learned from them as a person reads them.

use lang::model::{PredicateId, Term, VariableId};
use learner::rule::schema::Schema;
use learner::rule::{self, Company, Evidence, Options, Reason, Rule};
use learner::trace::vocabulary;
use learner::write;

use super::words::{action, domain, trace, warnings};

const KITCHEN: &str = "(define (domain kitchen) (:requirements :strips :typing)
  (:types plate cup - thing drawer hand)
  (:predicates (inside ?x - thing ?d - drawer) (on-table ?x - thing) (held ?x - thing ?h - hand) (free ?h - hand)
    (open ?d - drawer) (unblocked ?d - drawer))
  (:action take :parameters (?x - thing ?h - hand) :effect (and))
  (:action put-in :parameters (?x - thing ?d - drawer ?h - hand) :effect (and))
  (:action pull :parameters (?d - drawer ?h - hand) :effect (and)))";

const MORNING: &str = "((:state (on-table p) (on-table c) (free left) (unblocked d) (unblocked e))
  (:action (pull d left)) (:state (on-table p) (on-table c) (free left) (unblocked d) (open d) (unblocked e))
  (:action (take p left)) (:state (on-table c) (held p left) (unblocked d) (open d) (unblocked e))
  (:action (put-in p d left)) (:state (on-table c) (inside p d) (free left) (unblocked d) (open d) (unblocked e)))";

const EVENING: &str = "((:state (on-table c) (free right) (unblocked d) (open d))
  (:action (take c right)) (:state (held c right) (unblocked d) (open d)))";

#[test]
fn a_domain_from_two_demonstrations() {
    let domain = domain(KITCHEN);
    let traces = [trace("morning", &domain, MORNING), trace("evening", &domain, EVENING)];
    let learned = rule::learn(&domain, &traces, &Options::default());
    let text = write::text(&learned);
    insta::assert_snapshot!(text);
    assert_eq!(warnings(&text), [""; 0]);
}

#[test]
fn the_rule_of_the_thesis_demands_what_changes() {
    let domain = domain(KITCHEN);
    let traces = [trace("morning", &domain, MORNING), trace("evening", &domain, EVENING)];
    let options = Options { rule: Rule::Changed, ..Options::default() };
    let text = write::text(&rule::learn(&domain, &traces, &options));
    insta::assert_snapshot!(text);
    assert_eq!(warnings(&text), [""; 0]);
    // What is said of hands counts even where it stays.
    let free = PredicateId(3);
    let options = Options { rule: Rule::Changed, hand: vec![free], ..Options::default() };
    let learned = rule::learn(&domain, &traces, &options);
    let pull = action(&learned, "pull");
    assert_eq!(pull.changed.iter().map(|atom| atom.predicate).collect::<Vec<_>>(), [free]);
    assert_eq!(pull.doubts.len(), 1);
}

#[test]
fn what_never_held_is_forbidden_when_asked() {
    let domain = domain(KITCHEN);
    let traces = [trace("morning", &domain, MORNING)];
    let options = Options { rule: Rule::Safe, negative: true, ..Options::default() };
    let text = write::text(&rule::learn(&domain, &traces, &options));
    insta::assert_snapshot!(text);
    assert_eq!(warnings(&text), [""; 0]);
}

const BOTTLE: &str = "(define (domain bottle) (:requirements :strips :typing)
  (:types hand bottle lid)
  (:predicates (closed ?b - bottle ?l - lid) (held ?b - bottle ?h - hand) (lid-held ?l - lid ?h - hand) (free ?h - hand))
  (:action hold :parameters (?h - hand ?b - bottle) :effect (and))
  (:action unscrew :parameters (?h - hand ?b - bottle ?l - lid) :effect (and))
  (:action grasp :parameters (?h - hand ?b - bottle) :effect (and)))";

const OPENED: &str = "((:init (closed b l) (free left) (free right))
  (operators: (grasp left b) (nop ))
  (:state (closed b l) (held b left) (free right))
  (operators: (hold left b) (nop ))
  (:state (closed b l) (held b left) (free right))
  (operators: (hold left b) (unscrew right b l))
  (:state (held b left) (lid-held l right)))";

#[test]
fn an_effect_that_always_came_in_company_demands_the_company() {
    let mut domain = domain(BOTTLE);
    let traces = [trace("opened", &domain, OPENED)];
    vocabulary::declare_agents(&mut domain, &traces);
    let options = Options { joint: Company::Together, ..Options::default() };
    let learned = rule::learn(&domain, &traces, &options);
    // Holding alone was seen, and it opened nothing.
    assert_eq!(action(&learned, "hold").partners, []);
    let partner = &action(&learned, "unscrew").partners[0];
    assert_eq!(partner.arguments, [None, Some(Term::Variable(VariableId(1)))]);
    let text = write::text(&learned);
    insta::assert_snapshot!(text);
    assert_eq!(warnings(&text), [""; 0]);
}

#[test]
fn an_effect_of_one_of_two_actions_is_credited_to_none() {
    let domain = domain(
        "(define (domain lift) (:requirements :strips :typing) (:types hand box)
        (:predicates (lifted ?b - box) (near ?h - hand ?b - box))
        (:action pull :parameters (?h - hand ?b - box) :effect (and))
        (:action push :parameters (?h - hand ?b - box) :effect (and)))",
    );
    let together = "((:init (near l b) (near r b)) (operators: (pull l b) (push r b)) (:state (near l b) (near r b) (lifted b)))";
    let traces = [trace("together", &domain, together)];
    let learned = rule::learn(&domain, &traces, &Options::default());
    assert!(learned.actions.is_empty());
    let said: Vec<String> =
        learned.refused.iter().map(|refusal| refusal.describe(&domain)).collect();
    insta::assert_snapshot!(said.join("\n"));
    let options = Options { joint: Company::Together, ..Options::default() };
    let mut acting = domain.clone();
    vocabulary::declare_agents(&mut acting, &traces);
    let text = write::text(&rule::learn(&acting, &traces, &options));
    insta::assert_snapshot!(text);
    assert_eq!(warnings(&text), [""; 0]);
    // Pulling alone does nothing, so it was pushing.
    let alone = "((:init (near l b)) (operators: (pull l b) (nop )) (:state (near l b)))";
    let traces = [traces[0].clone(), trace("alone", &domain, alone)];
    let learned = rule::learn(&domain, &traces, &Options::default());
    assert_eq!(action(&learned, "pull").adds, []);
    assert_eq!(action(&learned, "push").adds.len(), 1);
}

const MOVES: &str = "(define (domain moves) (:requirements :strips :typing) (:types spot)
  (:predicates (at ?s - spot) (seen ?s - spot))
  (:action go :parameters (?from ?to - spot) :effect (and)))";

#[test]
fn parameters_that_were_one_object_leave_open_which_is_meant() {
    let domain = domain(MOVES);
    let stays = "((:state (at a)) (:action (go a a)) (:state (at a) (seen a)))";
    let learned = rule::learn(&domain, &[trace("stays", &domain, stays)], &Options::default());
    let go = action(&learned, "go");
    let (from, to) = (Term::Variable(VariableId(0)), Term::Variable(VariableId(1)));
    // It is `seen` of one of them, and it is not clear of which: so they must be one.
    assert_eq!(go.same, [(from, to)]);
    let goes = "((:state (at a)) (:action (go a b)) (:state (at b) (seen b)))";
    let traces = [trace("stays", &domain, stays), trace("goes", &domain, goes)];
    let learned = rule::learn(&domain, &traces, &Options::default());
    let go = action(&learned, "go");
    assert_eq!((go.same.len(), go.distinct.len()), (0, 0));
    insta::assert_snapshot!(write::text(&learned));
}

#[test]
fn what_an_action_leaves_may_not_be_what_it_takes() {
    let domain = domain(
        "(define (domain poke) (:requirements :strips :typing) (:types cell)
        (:predicates (full ?c - cell))
        (:action poke :parameters (?here ?there - cell) :effect (and)))",
    );
    let poke = "((:state (full a) (full b)) (:action (poke a b)) (:state (full a)))";
    let learned = rule::learn(&domain, &[trace("poke", &domain, poke)], &Options::default());
    // That `?here` stays full may be an effect; if both are one cell, it would then be full, and else empty.
    let pair = (Term::Variable(VariableId(0)), Term::Variable(VariableId(1)));
    assert_eq!(action(&learned, "poke").distinct, [pair]);
}

#[test]
fn constants_are_terms_like_parameters() {
    let domain = domain(
        "(define (domain desk) (:requirements :strips :typing) (:types thing place) (:constants table - place)
        (:predicates (on ?t - thing ?p - place) (held ?t - thing))
        (:action take :parameters (?t - thing) :effect (and)))",
    );
    let text = "((:state (on pen table)) (:action (take pen)) (:state (held pen)))";
    let learned = rule::learn(&domain, &[trace("desk", &domain, text)], &Options::default());
    insta::assert_snapshot!(write::text(&learned));
}

#[test]
fn evidence_adds_up_in_any_order() {
    let domain = domain(KITCHEN);
    let traces = [trace("morning", &domain, MORNING), trace("evening", &domain, EVENING)];
    let whole = rule::learn(&domain, &traces, &Options::default());
    let mut parts = traces.each_ref().map(|trace| {
        let mut evidence = Evidence::new(&domain);
        evidence.add(trace);
        evidence
    });
    let (first, second) = parts.split_at_mut(1);
    first[0].merge(&second[0]);
    assert_eq!(first[0].conclude(&Options::default()).actions, whole.actions);
}

#[test]
fn an_action_that_is_known_is_refined_by_what_is_seen() {
    let domain = domain(KITCHEN);
    let first = [trace("evening", &domain, EVENING)];
    let learned = rule::learn(&domain, &first, &Options::default());
    let take = action(&learned, "take");
    let known = Schema::learned(&learned, take, Rule::Safe).expect("it has no partners");
    let mut evidence = Evidence::new(&domain);
    evidence.assume(take.action, &known, take.count, "domain.pddl");
    let same = evidence.conclude(&Options::default());
    let again = Schema::learned(&same, action(&same, "take"), Rule::Safe).expect("no partners");
    assert_eq!(again, known);
    // A plate can be taken where no cup and no open drawer is.
    let other =
        "((:state (on-table p) (free left)) (:action (take p left)) (:state (held p left)))";
    evidence.add(&trace("night", &domain, other));
    let refined = evidence.conclude(&Options::default());
    let take = action(&refined, "take");
    assert_eq!((take.count, take.required.len(), take.adds.len()), (2, 2, 1));
    let sources: Vec<&str> = take.sources.iter().map(|(name, _)| name.as_str()).collect();
    assert_eq!(sources, ["domain.pddl", "night"]);
}

#[test]
fn what_was_never_seen_or_hidden_is_refused() {
    let domain = domain(KITCHEN);
    let mut hidden = trace("evening", &domain, EVENING);
    hidden.steps[0].whole = false;
    let learned = rule::learn(&domain, &[hidden], &Options::default());
    let reasons: Vec<&Reason> = learned.refused.iter().map(|refusal| &refusal.reason).collect();
    assert_eq!(reasons, [&Reason::Obscured, &Reason::Unseen, &Reason::Unseen]);
}
