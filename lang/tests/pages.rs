//! The example of each page gives the message that the page explains, and the message reads well.

use lang::diagnostic::RULES;
use lang::lint;
use lang::render;
use lang::source::Sources;

/// The first examples of a page that are whole files: a domain, a problem of the kitchen, or a domain and a problem of it.
fn example(page: &str) -> Vec<&str> {
    let blocks = page.split("```lisp\n").skip(1).filter_map(|block| block.split("```").next());
    let files: Vec<&str> = blocks.take_while(|text| text.starts_with("(def")).collect();
    match files.as_slice() {
        [domain, problem, ..] if !is_problem(domain) && is_problem(problem) => {
            vec![*domain, *problem]
        }
        [first, ..] => vec![*first],
        [] => Vec::new(),
    }
}

fn is_problem(text: &str) -> bool {
    text.starts_with("(define (problem")
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
        let texts = example(rule.page);
        let Some(&last) = texts.last() else { continue };
        examples += 1;
        let mut sources = Sources::default();
        let kitchen = ("domain.pddl".to_owned(), include_str!("fixtures/kitchen.pddl"));
        let (domain, problem) = match texts.as_slice() {
            [domain, problem] => (("domain.pddl".to_owned(), *domain), Some(*problem)),
            [problem] if is_problem(problem) => (kitchen, Some(*problem)),
            _ => ((format!("{}.pddl", rule.name), last), None),
        };
        let id = sources.add(domain.0, domain.1);
        let (domain, mut diagnostics) = lang::read_domain(&sources, id);
        let (uses, lints) = if let Some(problem) = problem {
            let id = sources.add(format!("{}.pddl", rule.name), problem);
            let (problem, more) = lang::read_problem(&sources, id, &domain);
            diagnostics.append(more);
            let mut lints = lint::problem(&domain, &problem);
            lints.append(lint::text(&sources, id, &domain));
            (problem.uses, lints)
        } else {
            let mut lints = lint::domain(&domain);
            lints.append(lint::text(&sources, id, &domain));
            (domain.uses, lints)
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
        insta::assert_snapshot!(rule.code, format!("{}\n{rendered}", texts.join("\n")));
    }
    assert!(examples > 30, "only {examples} pages have examples");
}
