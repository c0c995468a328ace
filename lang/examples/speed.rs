//! How long a 10 MB domain and a 10 MB problem take to read and check.
//!
//! `cargo run -p caveat-lang --example speed`, or with two paths to time those files instead.

use std::fmt::Write;
use std::time::Instant;

use lang::source::Sources;

const SIZE: usize = 10_000_000;

/// Many ground actions, as the compiled competition domains have them.
fn domain() -> String {
    let mut text =
        "(define (domain big)\n  (:requirements :strips :typing)\n  (:types place)\n".to_owned();
    text.push_str("  (:constants");
    (0..1000).for_each(|n| write!(text, " place-{n}").expect("a string takes all"));
    text.push_str(" - place)\n  (:predicates (at ?p - place) (done ?p - place)");
    (0..5000).for_each(|n| write!(text, " (flag-{n})").expect("a string takes all"));
    text.push_str(")\n");
    let mut n = 0;
    while text.len() < SIZE {
        let (a, b, flag) = (n % 1000, (n * 7 + 1) % 1000, n % 5000);
        writeln!(
            text,
            "  (:action move-{n}\n    :parameters (?p - place)\n    :precondition (and (at place-{a}) (flag-{flag}) (done ?p))\n    \
             :effect (and (at place-{b}) (not (at place-{a})) (not (flag-{flag})) (done place-{b})))"
        )
        .expect("a string takes all");
        n += 1;
    }
    text.push_str(")\n");
    text
}

/// Many objects and facts, several to a line.
fn problem() -> String {
    let mut text = "(define (problem big-1) (:domain big)\n  (:objects".to_owned();
    (0..100_000).for_each(|n| write!(text, " object-{n}").expect("a string takes all"));
    text.push_str(" - place)\n  (:init");
    let mut n: usize = 0;
    while text.len() < SIZE {
        let place = n.wrapping_mul(48_271) % 100_000;
        write!(text, " (at object-{place}) (done object-{})", n % 100_000)
            .expect("a string takes all");
        n += 1;
    }
    text.push_str(")\n  (:goal (and (at object-1))))\n");
    text
}

fn main() {
    let paths: Vec<String> = std::env::args().skip(1).collect();
    let mut sources = Sources::default();
    let read = |path: &String| std::fs::read_to_string(path).expect("the file can be read");
    let domain = sources.add("domain", paths.first().map_or_else(domain, read));
    let problem = sources.add("problem", paths.get(1).map_or_else(problem, read));
    for _ in 0..3 {
        let start = Instant::now();
        let (model, wrong) = lang::read_domain(&sources, domain);
        let middle = Instant::now();
        let (_, more) = lang::read_problem(&sources, problem, &model);
        println!(
            "domain {:.1} MB {:?} ({} messages), problem {:.1} MB {:?} ({} messages)",
            sources.get(domain).text.len() as f64 / 1e6,
            middle - start,
            wrong.list.len(),
            sources.get(problem).text.len() as f64 / 1e6,
            middle.elapsed(),
            more.list.len(),
        );
    }
}
