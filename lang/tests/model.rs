//! What the checked model says of texts that are not straightforward.

use lang::Kind;
use lang::model::{
    Domain, Expression, Formula, NodeKind, Problem, Requirement, Scope, Term, TypeId,
};
use lang::source::{SourceId, Sources};
use rust_decimal::Decimal;

/// Reads a domain that is without mistakes.
#[track_caller]
fn domain(text: &str) -> Domain {
    let mut sources = Sources::default();
    let id = sources.add("domain.pddl", text);
    let (domain, mut diagnostics) = lang::read_domain(&sources, id);
    // Hiding a variable is no mistake, and a test is about it.
    diagnostics.list.retain(|one| one.name != "shadowed-variable");
    assert_eq!(diagnostics.list, [], "{text}");
    domain
}

/// Reads a problem that is without mistakes.
#[track_caller]
fn problem(domain: &Domain, text: &str) -> Problem {
    let mut sources = Sources::default();
    let id = sources.add("problem.pddl", text);
    let (problem, diagnostics) = lang::read_problem(&sources, id, domain);
    assert_eq!(diagnostics.list, [], "{text}");
    problem
}

/// The condition in PDDL again, written from its nodes.
fn show(formula: &Formula, scope: &Scope, domain: &Domain) -> String {
    let term = |term: &Term| match term {
        Term::Variable(id) => scope.variables[id.index()].name.text.clone(),
        Term::Object(id) => domain.constants[id.index()].name.text.clone(),
    };
    let mut texts: Vec<String> = Vec::new();
    for node in &formula.nodes {
        let join = |word: &str, children: &[lang::model::NodeId]| {
            let parts = children.iter().map(|child| format!(" {}", texts[child.index()]));
            format!("({word}{})", parts.collect::<String>())
        };
        let bound = |ids: &[lang::model::VariableId]| {
            let names: Vec<&str> =
                ids.iter().map(|id| scope.variables[id.index()].name.text.as_str()).collect();
            names.join(" ")
        };
        texts.push(match &node.kind {
            NodeKind::Atom(atom) => {
                let arguments: String = atom
                    .arguments
                    .iter()
                    .flat_map(|argument| [" ".to_owned(), term(argument)])
                    .collect();
                format!("({}{arguments})", domain.predicates[atom.predicate.index()].name.text)
            }
            NodeKind::Action(atom) => {
                let arguments: String =
                    atom.arguments.iter().flat_map(|one| [" ".to_owned(), term(one)]).collect();
                format!("({}{arguments})", domain.actions[atom.action.index()].name.text)
            }
            NodeKind::Equal(left, right) => format!("(= {} {})", term(left), term(right)),
            NodeKind::Not(child) => join("not", &[*child]),
            NodeKind::And(children) => join("and", children),
            NodeKind::Or(children) => join("or", children),
            NodeKind::Imply(left, right) => join("imply", &[*left, *right]),
            NodeKind::Forall(ids, body) => {
                format!("(forall ({}) {})", bound(ids), texts[body.index()])
            }
            NodeKind::Exists(ids, body) => {
                format!("(exists ({}) {})", bound(ids), texts[body.index()])
            }
        });
    }
    texts.pop().expect("a formula has a root")
}

/// The effects of the first action, one line for each group.
fn effects(domain: &Domain) -> Vec<String> {
    let action = &domain.actions[0];
    let line = |effect: &lang::model::Effect| {
        let variables: String = effect
            .variables
            .iter()
            .flat_map(|id| [action.scope.variables[id.index()].name.text.as_str(), " "])
            .collect();
        let literals: String = effect
            .literals
            .iter()
            .flat_map(|literal| {
                let sign = if literal.positive { " +" } else { " -" };
                [sign, domain.predicates[literal.atom.predicate.index()].name.text.as_str()]
            })
            .collect();
        format!("{variables}{} =>{literals}", show(&effect.condition, &action.scope, domain))
    };
    action.effects.iter().map(line).collect()
}

#[test]
fn types_may_come_in_any_order_and_have_several_parents() {
    let domain = domain(
        "(define (domain d) (:requirements :typing)
           (:types car boat - vehicle amphibian - car amphibian - boat vehicle - object duck - (either boat bird))
           (:types stone))",
    );
    let id = |name: &str| {
        let found = domain.types.iter().position(|known| known.name.text == name);
        TypeId(found.unwrap_or_else(|| panic!("{name} is a type")) as u32)
    };
    for (sub, above) in [
        ("amphibian", "car"),
        ("amphibian", "boat"),
        ("amphibian", "vehicle"),
        ("duck", "bird"),
        ("duck", "vehicle"),
        ("stone", "object"),
    ] {
        assert!(domain.is_subtype(id(sub), id(above)), "{sub} is below {above}");
    }
    assert!(!domain.is_subtype(id("car"), id("boat")));
    assert!(!domain.is_subtype(id("vehicle"), id("car")));
    assert_eq!(id("object"), TypeId(0));
    assert_eq!(domain.types[id("amphibian").index()].parents, [id("car"), id("boat")]);
}

#[test]
fn requirements_are_taken_apart() {
    let adl = domain("(define (domain d) (:requirements :ADL))");
    assert!(adl.requirements.contains(&Requirement::ConditionalEffects));
    assert!(adl.requirements.contains(&Requirement::UniversalPreconditions));
    assert!(!adl.requirements.contains(&Requirement::DerivedPredicates));
    let none = domain("(define (domain d))");
    assert_eq!(none.requirements.into_iter().collect::<Vec<_>>(), [Requirement::Strips]);
}

#[test]
fn case_and_missing_blanks_do_not_matter() {
    let domain = domain(
        "\u{feff}(DEFINE(DOMAIN D)(:PREDICATES(On?x?y)(HAND-empty))\r\n(:Action A :Parameters(?X?y):Precondition(AND(oN?x?Y)(hand-EMPTY)):EFFECT(NOT(ON ?x ?y))))",
    );
    let action = &domain.actions[0];
    assert_eq!(show(&action.precondition, &action.scope, &domain), "(and (On ?X ?y) (HAND-empty))");
    assert_eq!(effects(&domain), ["(and) => -On"]);
}

#[test]
fn what_is_left_out_is_true_or_nothing() {
    let domain = domain(
        "(define (domain d) (:predicates (p))
           (:action a) (:action b :parameters () :precondition () :effect ()) (:action c :precondition :effect (and)))",
    );
    for action in &domain.actions {
        assert!(
            action.precondition.is_truth()
                && action.effects.is_empty()
                && action.scope.variables.is_empty()
        );
    }
}

#[test]
fn effects_are_taken_apart() {
    let domain = domain(
        "(define (domain d) (:requirements :adl) (:predicates (p) (q ?x) (r ?x ?y) (s))
           (:action a :parameters (?x)
             :effect (and (p) (forall (?y) (and (q ?y) (when (r ?x ?y) (and (not (r ?x ?y)) (forall (?z) (when (q ?z) (r ?y ?z)))))))
                          (and (not (s)) (when (and) (s))))))",
    );
    assert_eq!(
        effects(&domain),
        [
            "(and) => +p -s",
            "?y (and) => +q",
            "?y (r ?x ?y) => -r",
            "?y ?z (and (r ?x ?y) (q ?z)) => +r",
            "(and) => +s"
        ]
    );
}

#[test]
fn each_binder_has_variables_of_its_own() {
    let domain = domain(
        "(define (domain d) (:requirements :adl) (:predicates (p ?x) (q ?x))
           (:action a :parameters (?x) :precondition (and (p ?x) (exists (?x) (q ?x)) (forall (?x) (q ?x)) (q ?x)) :effect (p ?x)))",
    );
    let action = &domain.actions[0];
    assert_eq!((action.scope.parameters, action.scope.variables.len()), (1, 3));
    let used: Vec<u32> = action
        .precondition
        .nodes
        .iter()
        .filter_map(|node| match &node.kind {
            NodeKind::Atom(atom) => match atom.arguments[0] {
                Term::Variable(id) => Some(id.0),
                Term::Object(_) => None,
            },
            _ => None,
        })
        .collect();
    assert_eq!(used, [0, 1, 2, 0]);
}

#[test]
fn conjunctions_of_one_are_that_one() {
    let domain = domain(
        "(define (domain d) (:requirements :adl) (:predicates (p) (q))
           (:action a :precondition (and (and (or (p)) (and)) (not (not (q))) (or)) :effect (p)))",
    );
    let action = &domain.actions[0];
    assert_eq!(
        show(&action.precondition, &action.scope, &domain),
        "(and (and (p) (and)) (not (not (q))) (or))"
    );
}

#[test]
fn costs_and_numbers_are_exact() {
    let domain = domain(
        "(define (domain d) (:requirements :action-costs) (:predicates (p)) (:constants here)
           (:functions (total-cost) (fee ?x) - number)
           (:action a :effect (and (p) (increase (total-cost) .5)))
           (:action b :parameters (?x) :effect (and (p) (increase total-cost (fee ?x)))))",
    );
    assert_eq!(domain.actions[0].increases[0].value, Expression::Number(Decimal::new(5, 1)));
    assert!(
        matches!(&domain.actions[1].increases[0].value, Expression::Function(_, arguments) if arguments.len() == 1)
    );
    let problem = problem(
        &domain,
        "(define (problem p) (:domain d) (:objects there) (:init (= (fee here) 1e3) (= (fee there) 5.) (= (total-cost) -0.1) (= (fee there) 5))
           (:goal (p)) (:metric minimize (total-cost)))",
    );
    let values: Vec<String> =
        problem.values.iter().map(|value| value.value.normalize().to_string()).collect();
    assert_eq!(values, ["1000", "5", "-0.1"]);
    assert_eq!(
        problem.metric.map(|metric| metric.function),
        Some(domain.actions[0].increases[0].function)
    );
}

#[test]
fn constants_come_first_and_facts_are_not_repeated() {
    let domain = domain("(define (domain d) (:constants here) (:predicates (p ?x) (q)))");
    let problem = problem(
        &domain,
        "(define (problem p) (:domain d) (:objects there Everywhere)
           (:init (p here) (p there) (P HERE) (q) (not (p everywhere)) (q)) (:goal (and)))",
    );
    let names: Vec<&str> = problem.objects.iter().map(|object| object.name.text.as_str()).collect();
    assert_eq!(names, ["here", "there", "Everywhere"]);
    assert_eq!(problem.init.len(), 3);
    assert!(problem.goal.is_truth());
}

#[test]
fn derived_predicates_are_marked_and_lend_their_types() {
    let domain = domain(
        "(define (domain d) (:requirements :typing :derived-predicates) (:types block) (:predicates (on ?x ?y - block) (above ?x ?y - block))
           (:derived (above ?a ?b) (on ?a ?b)))",
    );
    assert!(domain.predicates[1].derived && !domain.predicates[0].derived);
    assert_eq!(domain.axioms[0].scope.variables[0].types, domain.predicates[1].parameters[0].types);
    assert_eq!(domain.axioms[0].scope.parameters, 2);
}

#[test]
fn keywords_are_names_elsewhere() {
    domain(
        "(define (domain define) (:requirements :typing) (:types domain problem - object) (:constants either - domain)
           (:predicates (at ?at - domain) (domain ?x - domain) (start) (over ?all - domain) (minimize))
           (:action action :parameters (?and - domain) :precondition (and (at ?and) (over either) (start)) :effect (and (domain ?and) (minimize))))",
    );
}

#[test]
fn kinds_are_told_apart() {
    let mut sources = Sources::default();
    let mut detect = |text: &str| {
        let id: SourceId = sources.add("file", text);
        lang::detect(&sources, id)
    };
    assert_eq!(
        detect("; a comment\n(DEFINE (Domain Kitchen) (:predicates))"),
        Some(Kind::Domain { name: "Kitchen".into() })
    );
    let problem = |domain: Option<&str>| {
        Some(Kind::Problem { name: "p".into(), domain: domain.map(Into::into) })
    };
    assert_eq!(
        detect("(define (problem p) (:objects a) (:DOMAIN kitchen))"),
        problem(Some("kitchen"))
    );
    assert_eq!(detect("(define (problem p) (:objects a))"), problem(None));
    assert_eq!(detect("(pick left cup)\n"), None);
    assert_eq!(detect(""), None);
}
