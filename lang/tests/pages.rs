//! The example of each page gives the message that the page explains, and the message reads well.

use lang::diagnostic::RULES;
use lang::lint;
use lang::render;
use lang::source::Sources;

/// The first example of a page that is a whole file.
fn example(page: &str) -> Option<&str> {
    let block = page.split("```lisp\n").nth(1)?;
    let text = block.split("```").next()?;
    text.starts_with("(def").then_some(text)
}

#[test]
fn every_page_starts_with_its_code_and_name() {
    for rule in RULES {
        let title = format!("# {} {}\n", rule.code, rule.name);
        assert!(rule.page.starts_with(&title), "the page of {} has another title", rule.name);
        assert_eq!(lang::explain(rule.code), Some(rule.page));
        assert_eq!(lang::explain(rule.name), Some(rule.page));
    }
}

#[test]
fn codes_and_names_are_unique() {
    for (index, rule) in RULES.iter().enumerate() {
        let same =
            RULES[..index].iter().find(|other| other.code == rule.code || other.name == rule.name);
        assert!(same.is_none(), "{} is taken twice", rule.code);
    }
}

#[test]
fn every_example_gives_its_message() {
    let mut examples = 0;
    for rule in RULES {
        let Some(text) = example(rule.page) else { continue };
        examples += 1;
        let mut sources = Sources::default();
        let kitchen = sources.add("domain.pddl", include_str!("fixtures/domain.pddl"));
        let file = sources.add(format!("{}.pddl", rule.name), text);
        let (uses, lints, mut diagnostics) = if text.starts_with("(define (problem") {
            let (domain, _) = lang::read_domain(&sources, kitchen);
            let (problem, diagnostics) = lang::read_problem(&sources, file, &domain);
            (problem.uses.clone(), lint::problem(&domain, &problem), diagnostics)
        } else {
            let (domain, diagnostics) = lang::read_domain(&sources, file);
            (domain.uses.clone(), lint::domain(&domain), diagnostics)
        };
        // What reading does not say, the lints say, or else whoever is to run the file.
        for more in [lints, lang::refusals(&uses)] {
            if diagnostics.list.is_empty() {
                diagnostics.append(more);
            }
        }
        let rendered = render::full(&diagnostics, &sources, false);
        assert!(
            diagnostics.list.iter().all(|diagnostic| diagnostic.code == rule.code),
            "{rendered}"
        );
        assert!(!diagnostics.list.is_empty(), "the example of {} gives no message", rule.code);
        insta::assert_snapshot!(rule.code, format!("{text}\n{rendered}"));
    }
    assert!(examples > 30, "only {examples} pages have examples");
}
