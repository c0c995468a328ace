//! `docs/multi-agent.md` goes in; every plan on it of which the validator says something else than the page comes out.
//!
//! A block of PDDL is the domain or the problem from there on.
//! A block that is a plan, `plan liberal` or `plan safe` if the concurrency is overridden, is followed by what is said of it.

use std::fs;
use std::path::Path;

use lang::execute::Executor;
use lang::execute::joint::Concurrency;
use lang::source::Sources;
use lang::validate::joint::{Verdict, judge, lines, story};
use lang::{Kind, plan, render};

/// A fenced block: what stands behind the fence, its text, and the line in which it begins.
struct Block<'a> {
    info: &'a str,
    text: String,
    line: usize,
}

/// The fenced blocks of a page.
fn blocks(page: &str) -> Vec<Block<'_>> {
    let mut blocks = Vec::new();
    let mut open: Option<Block<'_>> = None;
    for (at, line) in page.lines().enumerate() {
        match (line.strip_prefix("```"), &mut open) {
            (Some(info), None) => open = Some(Block { info, text: String::new(), line: at + 1 }),
            (Some(_), Some(_)) => blocks.extend(open.take()),
            (None, Some(block)) => {
                block.text.push_str(line);
                block.text.push('\n');
            }
            (None, None) => {}
        }
    }
    assert!(open.is_none(), "a block is not closed");
    blocks
}

/// What the validator says of a plan.
fn said(domain: &str, problem: &str, plan: &str, concurrency: Option<Concurrency>) -> String {
    let mut sources = Sources::default();
    let domain = sources.add("domain", domain);
    let problem = sources.add("problem", problem);
    let plan = sources.add("plan", plan);
    let (domain, mut diagnostics) = lang::read_domain(&sources, domain);
    let (problem, more) = lang::read_problem(&sources, problem, &domain);
    diagnostics.append(more);
    let (listing, more) = plan::read(&sources, plan, &domain, &problem);
    diagnostics.append(more);
    assert_eq!(render::concise(&diagnostics, &sources), "");
    let executor = Executor::new(&domain, &problem).expect("no axiom denies itself");
    let (plan, _) = listing.joint();
    let verdict = judge(&executor, &plan, concurrency.unwrap_or(Concurrency::of(&domain)));
    let mut text = lines(&verdict);
    if let Verdict::Invalid(_) = verdict {
        text.push_str(&story(&verdict, &domain, &problem, &plan));
    }
    text
}

#[test]
fn plans_on_the_page_are_judged_as_it_says() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs/multi-agent.md");
    let page = fs::read_to_string(path).expect("the page is there");
    let blocks = blocks(&page);
    let (mut domain, mut problem) = ("", "");
    let (mut valid, mut invalid) = (0, 0);
    let mut wrong = Vec::new();
    for (at, block) in blocks.iter().enumerate() {
        let concurrency = match block.info {
            "pddl" => {
                let mut sources = Sources::default();
                let id = sources.add("block", block.text.as_str());
                match lang::detect(&sources, id) {
                    Some(Kind::Domain { .. }) => domain = &block.text,
                    Some(Kind::Problem { .. }) => problem = &block.text,
                    None => panic!("line {}: neither a domain nor a problem", block.line),
                }
                continue;
            }
            "plan" => None,
            "plan liberal" => Some(Concurrency::Liberal),
            "plan safe" => Some(Concurrency::Safe),
            "text" | "lisp" => continue,
            other => panic!("line {}: a block of `{other}`", block.line),
        };
        let expected = blocks.get(at + 1).filter(|next| next.info == "text");
        let expected = expected.unwrap_or_else(|| panic!("line {}: nothing is said", block.line));
        let said = said(domain, problem, &block.text, concurrency);
        *if said.contains("Plan valid\n") { &mut valid } else { &mut invalid } += 1;
        if said != expected.text {
            wrong.push(format!("line {}: the validator says\n{said}", expected.line));
        }
    }
    assert_eq!(wrong.join("\n"), "");
    assert!(valid > 10 && invalid > 10, "{valid} valid, {invalid} invalid");
}
