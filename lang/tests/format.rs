//! Layout: what a person sees, and what must hold for any text.

use std::fs;
use std::path::{Path, PathBuf};

use lang::annotation;
use lang::lexer::{TokenKind, lex};
use lang::source::Sources;
use proptest::prelude::*;

/// The text laid out, or as it is where that cannot be done.
fn format(text: &str) -> String {
    lang::format::format(text).unwrap_or_else(|| text.to_owned())
}

/// All words, parentheses and comments; of annotations what stands in them, since their lines may be cut differently.
fn tokens(text: &str) -> Vec<&str> {
    let words = lex(text).into_iter().filter(|token| token.kind != TokenKind::Space);
    words
        .map(|token| text[token.start as usize..token.end as usize].trim_end())
        .flat_map(|word| annotation::words(word).unwrap_or_else(|| vec![word]))
        .collect()
}

/// All annotations with their places, and what is wrong with them.
fn annotations(text: &str) -> (Vec<String>, Vec<String>) {
    let mut sources = Sources::default();
    let id = sources.add("fixture", text);
    let (annotations, diagnostics) = lang::annotations(&sources, id);
    (
        annotations.iter().map(|one| format!("{} in {}", one.expression, one.place)).collect(),
        diagnostics.list.into_iter().map(|one| one.message).collect(),
    )
}

#[track_caller]
fn holds(text: &str) {
    let once = format(text);
    assert_eq!(tokens(text), tokens(&once), "tokens changed:\n{text}\n---\n{once}");
    assert_eq!(annotations(text), annotations(&once), "annotations changed:\n{text}\n---\n{once}");
    assert_eq!(once, format(&once), "formatting again changes:\n{text}");
}

#[test]
fn a_domain_with_comments_everywhere() {
    insta::assert_snapshot!(format(
        "; the kitchen
(define
 (domain kitchen) ; a name
(:requirements :strips :typing)
   (:types cup plate - dish ; what is washed
      dish room
      - object)


(:predicates (clean ?d - dish) ; washed
 (in ?d - dish ?r - room) (lit ?r - room))
  ;@ (:measured (temperature ?d - dish))
  (:action wash :parameters (?d - dish
     ?r - room)
   :precondition
     (and (in ?d ?r) (lit ?r)
       ; nothing else
     )
   :effect (and (clean ?d)
        (forall (?other - dish) (when (and (in ?other ?r) (clean ?other)) (not (lit ?r)))) (not (in ?d ?r))))
(:action rest :parameters () :precondition () :effect (and )))
;; the end
"
    ));
}

#[test]
fn a_problem_keeps_the_lines_of_its_facts() {
    insta::assert_snapshot!(format(
        "(define (problem p) (:domain kitchen)
(:objects red blue - cup   hall
 - room)
(:init (in red hall) (in blue hall)
       (lit hall)

       ; costs
       (= (total-cost) 0))
  (:goal (and (clean red) (clean blue))) (:metric minimize (total-cost)))"
    ));
}

#[test]
fn long_lists_are_broken() {
    insta::assert_snapshot!(format(
        "(define (problem p) (:domain kitchen) (:objects aaaaaaaaaa bbbbbbbbbb cccccccccc dddddddddd eeeeeeeeee ffffffffff - cup)
(:goal (and (clean aaaaaaaaaa) (clean bbbbbbbbbb) (or (clean cccccccccc) (not (clean dddddddddd))) (clean eeeeeeeeee))))"
    ));
}

#[test]
fn broken_parentheses_are_left_alone() {
    let text = "(define (domain d)\n   (:predicates (p)\n";
    assert_eq!(format(text), text);
}

#[test]
fn annotations_are_laid_out_like_code() {
    let text = r#"(define (domain d)
;@(:measured (x-offset ?up ?down - cube)  (drop-height ?up - cube)) ; millimetres
  ;@
      ;@ (:exactly-one (clean ?d)
  ;@ (dirty ?d) (broken ?d)) (:at-most-one (in ?d ?p))

  ;@ (:unknown a
  ;@  b)
  (:predicates (clean ?d)   ;@   (:seen
    ;@ "a  (strange;   file?)")
    (dirty ?d)     ;@ (:seen 2)
  )
(:action stack :precondition (and (holding ?up)
;@ (:causal "stack-three.cbn.json" :outcome (= onTop 1) :at-least 0.9 :bind ((xOff (x-offset ?up ?down) :nominal 0 :sd 0.4)
;@ (dropOff (drop-height ?up) :nominal 2.0 :sd 0.3) ; as measured
;@
;@
;@ (xOffBelow (x-offset ?down ?base) :from (stack ?down ?base) :otherwise 0)))
)))
"#;
    holds(text);
    insta::assert_snapshot!(format(text));
}

#[test]
fn annotations_that_are_not_clear_stay_as_they_are() {
    let text = "(define (domain d)
  ;@ (:exactly-one   (a)
  ;@  (b)
  (:predicates (a) (b)) ;@author   Lovelace  of  London
  ;@   (:seen \"a)
)
";
    assert_eq!(format(text), text);
    holds(text);
    assert_eq!(format(";@\n  ;@\n\n ;@   \n"), ";@\n\n;@\n");
}

#[test]
fn remarks_in_lists_are_kept_whichever_way_lines_end() {
    for text in ["(and ; c\r (p))", "(and ; c\r\n (p))", "(a)\r\r;@ (:a)\r;@ (:b)\r(c)"] {
        holds(text);
    }
}

#[test]
fn nothing_stays_nothing() {
    assert_eq!(format(""), "");
    assert_eq!(format("\u{feff} \r\n"), "");
    assert_eq!(format("; only\r\n"), "; only\n");
}

#[test]
fn a_carriage_return_alone_ends_a_line() {
    assert_eq!(format("(a (b ; c\rd))\re"), "(a (b ; c\n  d))\ne\n");
}

#[test]
fn a_line_end_that_is_not_kept_changes_nothing() {
    let start = "(and-then-something-that-is-long (with-more-in-it ?and-more) (and-still-more) ";
    for list in ["(p\n)", "(\np)", "(a -\nb)", "(a\n- b)", "(:action\nb)", "(:task a :x\n(b))"] {
        let flat = list.replace('\n', " ").replace("( ", "(").replace(" )", ")");
        let broken = format(&format!("{start}{list})"));
        assert_eq!(broken, format(&format!("{start}{flat})")), "{list}");
        assert_eq!(broken, format(&broken), "{list}");
    }
}

#[test]
fn deep_nesting_takes_no_stack() {
    let text = format!("{}{}", "(".repeat(50_000), ")".repeat(50_000));
    assert_eq!(tokens(&text).len(), tokens(&format(&text)).len());
}

proptest! {
    #[test]
    fn any_text_keeps_its_tokens(pieces in prop::collection::vec(prop::sample::select(vec![
        "(", ")", " ", "\n", "\n\n", "; c\n", ";@ (x)\n", ";@ (x\n", ";@ y)\n", ";@", "\"", "\r", "\u{feff}", "(:seen", "\"a  b\"", "a", "?x", "-", ":action", ":effect", "and", "define", "(and ", "(:types ", "\r\n", "é",
    ]), 0..60)) {
        holds(&pieces.concat());
    }

    #[test]
    fn annotations_keep_their_words(
        lines in prop::collection::vec((0..6_usize, prop::collection::vec(prop::sample::select(vec![
            "(", "(", ")", ")", "(:causal", "(:measured", ":bind", "\"a  b\"", "\"c;(d\"", "?x", "word", "; note", "  ", "\t", "a-rather-long-word-that-makes-lines-long",
        ]), 0..8)), 0..12),
    ) {
        let mut text = String::from("(define (domain d)\n");
        for (start, words) in lines {
            text.push_str(["  ;@ ", ";@ ", "(p) ;@ ", "; ", "\n;@", "    ;@    "][start]);
            text.push_str(&words.join(" "));
            text.push('\n');
        }
        holds(&format!("{text})"));
    }

    #[test]
    fn balanced_text_keeps_its_tokens(pieces in prop::collection::vec(prop::sample::select(vec![
        "(p ?x)", "(and (p) (q))", " ", "\n", "\n\n", "; c\n", "- t", ":action a", ":effect", "(define (domain d) (:types a b))", "(or\n(p) ; c\n)",
    ]), 0..40)) {
        holds(&format!("(and {}\n)", pieces.concat()));
    }
}

/// All files of PDDL or HDDL in a folder and below it, but only one problem of each folder.
fn files_below(folder: &Path, found: &mut Vec<PathBuf>) {
    let entries = fs::read_dir(folder).expect("the folder can be read");
    let mut entries: Vec<PathBuf> =
        entries.map(|entry| entry.expect("an entry can be read").path()).collect();
    entries.sort();
    let mut problems = 0;
    for path in entries {
        let text =
            |part: Option<&std::ffi::OsStr>| part.map(|part| part.to_string_lossy().into_owned());
        if path.is_dir() {
            files_below(&path, found);
        } else if matches!(text(path.extension()).as_deref(), Some("pddl" | "hddl")) {
            let domain = text(path.file_name()).is_some_and(|name| name.contains("domain"));
            problems += usize::from(!domain);
            if domain || problems <= 2 {
                found.push(path);
            }
        }
    }
}

#[test]
fn real_files_keep_their_tokens() {
    let root = match std::env::var_os("CAVEAT_SHARED") {
        Some(root) => PathBuf::from(root),
        None => Path::new(env!("CARGO_MANIFEST_DIR")).join("../../shared"),
    };
    if !root.join("benchmarks").is_dir() {
        eprintln!("SKIPPED: no shared material at {}; set CAVEAT_SHARED", root.display());
        return;
    }
    let mut files = Vec::new();
    files_below(&root.join("benchmarks"), &mut files);
    files_below(&root.join("corpus"), &mut files);
    assert!(files.len() > 100, "only {} files were found", files.len());
    for file in files {
        if let Ok(text) = fs::read_to_string(&file) {
            holds(&text);
        }
    }
}
