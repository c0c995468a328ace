//! A parenthesis that is missing or too many is said once, near its place, and the rest is read as it was meant.

use std::fmt::Write;

use lang::diagnostic::{Diagnostic, Diagnostics};
use lang::source::{SourceId, Sources};
use lang::tree::{self, NodeKind};
use proptest::prelude::*;

const DOMAIN: &str = include_str!("fixtures/domain.pddl");
const PROBLEM: &str = include_str!("fixtures/problem.pddl");

/// What is said of a problem, or of a domain.
fn said(text: &str, is_problem: bool) -> Vec<Diagnostic> {
    let mut sources = Sources::default();
    let (domain, text) = (sources.add("domain", DOMAIN), sources.add("text", text));
    if is_problem {
        let domain = lang::read_domain(&sources, domain).0;
        lang::read_problem(&sources, text, &domain).1.list
    } else {
        lang::read_domain(&sources, text).1.list
    }
}

/// The parentheses of the text as the tree has them, written anew: those that are left out are gone, and those that were missing are there.
fn structure(text: &str) -> String {
    let tree = tree::parse(SourceId(0), text, &mut Diagnostics::default());
    let mut out = String::new();
    let mut open: Vec<u32> = Vec::new();
    for (at, node) in tree.nodes().iter().enumerate() {
        while open.pop_if(|end| *end <= at as u32).is_some() {
            out.push(')');
        }
        match node.kind {
            NodeKind::List | NodeKind::OpenList => {
                open.push(node.next);
                out.push('(');
            }
            NodeKind::Atom => {
                write!(out, " {}", &text[node.start as usize..node.end as usize])
                    .expect("a string takes all");
            }
            NodeKind::Comment | NodeKind::Space | NodeKind::Stray => {}
        }
    }
    out.push_str(&")".repeat(open.len()));
    out
}

/// The text after the first fix of each message.
fn mended(text: &str, said: &[Diagnostic]) -> String {
    let mut edits: Vec<_> =
        said.iter().filter_map(|one| one.fixes.first()).flat_map(|fix| &fix.edits).collect();
    edits.sort_by_key(|(span, _)| *span);
    let mut mended = text.to_owned();
    for (span, replacement) in edits.into_iter().rev() {
        mended.replace_range(span.start as usize..span.end as usize, replacement);
    }
    mended
}

/// The text as it is, with tabs and the line ends of another system, without indentation, and in one line.
///
/// Comments are gone in all of them.
fn layouts(text: &str) -> [String; 4] {
    let lines: Vec<&str> =
        text.lines().map(|line| line.split(';').next().unwrap_or("").trim_end()).collect();
    let bare: Vec<&str> = lines.iter().map(|line| line.trim_start()).collect();
    let tabs: Vec<String> = lines.iter().map(|line| line.replace("  ", "\t")).collect();
    let tabs = format!("\u{feff}{}", tabs.join("\r\n"));
    [lines.join("\n"), tabs, bare.join("\n"), bare.join(" ")]
}

/// Every text with one parenthesis dropped or doubled.
fn broken(text: &str) -> Vec<(usize, String)> {
    let places = text.bytes().enumerate().filter(|(_, byte)| matches!(byte, b'(' | b')'));
    let both = places.map(|(at, _)| {
        let dropped = format!("{}{}", &text[..at], &text[at + 1..]);
        let doubled = format!("{}{}", &text[..=at], &text[at..]);
        [(at, dropped), (at, doubled)]
    });
    both.flatten().collect()
}

#[test]
fn every_single_mistake_is_said_once() {
    let mut cases = 0;
    for (whole, is_problem) in [(DOMAIN, false), (PROBLEM, true)] {
        for text in layouts(whole) {
            assert_eq!(said(&text, is_problem), []);
            for (at, broken) in broken(&text) {
                cases += 1;
                let said = said(&broken, is_problem);
                assert_eq!(said.len(), 1, "{said:#?} of the parenthesis at {at} in\n{broken}");
                assert!(matches!(said[0].code, "E0001" | "E0002"), "{:?}", said[0]);
                let mended = mended(&broken, &said);
                assert_eq!(structure(&mended), structure(&broken), "{broken}");
                let mut left = Diagnostics::default();
                tree::parse(SourceId(0), &mended, &mut left);
                assert_eq!(left.list, [], "{mended}");
            }
        }
    }
    assert!(cases > 1000, "only {cases} cases were tried");
}

/// With lines and indentation the text is taken as it was before it was broken.
#[test]
fn indentation_shows_what_was_meant() {
    for whole in [DOMAIN, PROBLEM] {
        let text = &layouts(whole)[0];
        let meant = structure(text);
        for (at, broken) in broken(text) {
            assert_eq!(structure(&broken), meant, "the parenthesis at {at} in\n{broken}");
        }
    }
}

/// Sections of other dialects: fields whose values are lists of any kind, and sections that no other has.
const DIALECTS: &str = "(define (domain dialects)
  (:requirements :durative-actions :hierarchy :multi-agent)
  (:predicates (at ?a ?p) (free ?a)
    (:private ?a - agent (knows ?a ?p)))
  (:durative-action move
    :agent ?a - agent
    :parameters (?from ?to - place)
    :duration (and (>= ?duration 2) (<= ?duration (* 2 (distance ?from ?to))))
    :condition (and (at start (at ?a ?from)) (over all (free ?a)) (at end (not (move ?a))))
    :effect (and (at start (not (at ?a ?from))) (at end (at ?a ?to))
      (at end (decrease (fuel ?a) (* 2 (distance ?from ?to))))))
  (:process fall
    :parameters (?b)
    :precondition (free ?b)
    :effect (increase (height ?b) (* #t (speed ?b))))
  (:task deliver :parameters (?p - parcel ?to - place))
  (:method by-truck
    :parameters (?p - parcel ?to - place)
    :task (deliver ?p ?to)
    :precondition (free ?p)
    :ordered-subtasks (and
      (first (load ?p))
      (second (move ?to)))
    :constraints (not (= ?p ?to)))
  (:concurrency-constraint both
    :parameters (?l - place)
    :bounds (1 2)
    :actions ((move 1) (lift 0)))
  (:constraints (forall (?p) (sometime-before (free ?p) (at ?p depot))))
  (:derived (safe ?x) (forall (?y - (either a b)) (imply (at ?y) (preference gentle (free ?x)))))
)
";

#[test]
fn all_dialects_are_repaired_once() {
    let mut different = 0;
    for (index, text) in layouts(DIALECTS).into_iter().enumerate() {
        for (at, broken) in broken(&text) {
            let mut said = Diagnostics::default();
            let tree = tree::parse(SourceId(0), &broken, &mut said);
            assert_eq!(tree.text(), broken);
            assert_eq!(
                said.list.len(),
                1,
                "{:#?} of the parenthesis at {at} in\n{broken}",
                said.list
            );
            different += usize::from(index == 0 && structure(&broken) != structure(&text));
        }
    }
    // Of `(first (load ?p))` and `((move 1) (lift 0))` the words alone do not tell which are heads.
    assert!(different <= 9, "{different} texts are taken as others than they were");
}

#[test]
fn several_mistakes_are_told_apart() {
    let text = "(define (domain d)
  (:requirements :adl)
  (:predicates (p ?x) (q) (r)
  (:action a
    :parameters (?x)
    :precondition (and (p ?x) (q)
    :effect (r))
  (:action b
    :precondition (and (q)) (r))
    :effect (q))
  (:action c
    :parameters ?x)
    :effect (and ((p ?x) (q))))
";
    let codes: Vec<(&str, usize)> = said(text, false)
        .iter()
        .map(|one| (one.code, text[..one.primary.span.start as usize].lines().count()))
        .collect();
    assert_eq!(codes, [("E0001", 3), ("E0001", 6), ("E0002", 9), ("E0002", 12), ("E0001", 13)]);
}

proptest! {
    #[test]
    fn several_repairs_keep_every_byte(places in prop::collection::vec((0..DOMAIN.len(), any::<bool>()), 1..6)) {
        let mut text = DOMAIN.to_owned();
        for (at, doubled) in places {
            let paren = text[at.min(text.len())..].find(['(', ')']).map(|found| found + at);
            match paren {
                Some(at) if doubled => text.insert(at, char::from(text.as_bytes()[at])),
                Some(at) => drop(text.remove(at)),
                None => {}
            }
        }
        let tree = tree::parse(SourceId(0), &text, &mut Diagnostics::default());
        prop_assert_eq!(tree.text(), text.as_str());
    }
}

#[test]
fn a_text_that_ends_too_early_is_said_once() {
    for whole in [DOMAIN, PROBLEM, DIALECTS] {
        for text in layouts(whole) {
            let first = text.find('(').expect("there is a list");
            let ends = first + 1..text.trim_end().len();
            let twice = ends.filter(|&end| {
                let mut said = Diagnostics::default();
                tree::parse(SourceId(0), &text[..end], &mut said);
                said.list.len() != 1
            });
            // A list that has only begun may look like one that belongs elsewhere.
            assert!(twice.count() * 50 <= text.len(), "often more is said than once of {text}");
        }
    }
}
