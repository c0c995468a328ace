//! A domain and a problem go in; every name in them comes out with what it means and does.

use std::fmt::Write;

use lang::source::Sources;
use lang::symbol::{Namespace, Occurrences, Symbol};

const DOMAIN: &str = "(define (domain light)
 (:types lamp - thing)
 (:constants l0 - lamp)
 (:predicates (lit ?l - lamp) (dark))
 (:functions (total-cost) - number)
 (:derived (dark) (not (lit l0)))
 (:action press :parameters (?l - Lamp)
  :precondition (exists (?o - thing) (not (LIT ?l)))
  :effect (and (lit ?l) (not (lit l0)) (lti ?x) (increase (total-cost) 1))))";

const PROBLEM: &str = "(define (problem p) (:domain LIGHT)
 (:objects l1 - lamp)
 (:init (lit l0) (= (total-cost) 0))
 (:goal (lit l1 l2)))";

fn shown(sources: &Sources, occurrences: &Occurrences) -> String {
    let mut out = String::new();
    for occurrence in &occurrences.list {
        let text = &sources.get(occurrence.span.source).text;
        let line = text[..occurrence.span.start as usize].matches('\n').count() + 1;
        let name = sources.text(occurrence.span);
        let meaning = match occurrence.symbol {
            Symbol::Known(namespace, id) => format!("{} {id}", namespace.describe()),
            Symbol::Unknown(namespace) => format!("unknown {}", namespace.describe()),
        };
        let _ = writeln!(out, "{line}: {name} {:?} {meaning}", occurrence.role);
    }
    out
}

#[test]
fn every_name_is_listed_once_with_its_meaning_and_role() {
    let mut sources = Sources::default();
    let domain = sources.add("domain.pddl", DOMAIN);
    let problem = sources.add("problem.pddl", PROBLEM);
    let (model, _, names) = lang::index_domain(&sources, domain);
    let (_, _, more) = lang::index_problem(&sources, problem, &model);
    insta::assert_snapshot!(format!("{}---\n{}", shown(&sources, &names), shown(&sources, &more)));
}

#[test]
fn a_variable_leads_to_its_declaration_from_wherever_it_is_used() {
    let mut sources = Sources::default();
    let id = sources.add("domain.pddl", DOMAIN);
    let (_, _, names) = lang::index_domain(&sources, id);
    let used = DOMAIN.find("(LIT ?l").expect("the fixture has it") as u32 + 5;
    let Some(Symbol::Known(Namespace::Variable, declared)) = names.at(used).map(|name| name.symbol)
    else {
        panic!("`?l` is bound there");
    };
    assert_eq!(declared as usize, DOMAIN.find("?l - Lamp").expect("the fixture has it"));
    assert_eq!(names.variable(declared).map(|variable| variable.types.len()), Some(1));
}

#[test]
fn listing_names_changes_neither_the_model_nor_the_messages() {
    let mut sources = Sources::default();
    let (domain, problem) = (sources.add("d", DOMAIN), sources.add("p", PROBLEM));
    let (model, said) = lang::read_domain(&sources, domain);
    let (indexed, heard, _) = lang::index_domain(&sources, domain);
    assert_eq!((format!("{model:?}"), said), (format!("{indexed:?}"), heard));
    let (model, said) = lang::read_problem(&sources, problem, &indexed);
    let (again, heard, _) = lang::index_problem(&sources, problem, &indexed);
    assert_eq!((format!("{model:?}"), said), (format!("{again:?}"), heard));
}
