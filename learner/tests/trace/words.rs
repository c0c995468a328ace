//! A small domain for the texts of the tests.

use lang::model::Domain;
use lang::source::Sources;

pub const BLOCKS: &str = "(define (domain blocks) (:requirements :strips :typing)
  (:types cube table - thing hand)
  (:constants bench - table)
  (:predicates (on ?a - cube ?b - thing) (clear ?c - cube) (held ?c - cube ?h - hand) (free ?h - hand))
  (:action take :parameters (?h - hand ?c - cube ?from - thing) :precondition (free ?h) :effect (held ?c ?h))
  (:action put :parameters (?h - hand ?c - cube ?to - thing) :precondition (held ?c ?h) :effect (on ?c ?to)))";

pub fn domain(text: &str) -> Domain {
    let mut sources = Sources::default();
    let id = sources.add("domain.pddl", text);
    let (domain, diagnostics) = lang::read_domain(&sources, id);
    assert!(!diagnostics.has_errors(), "{}", lang::render::concise(&diagnostics, &sources));
    domain
}
