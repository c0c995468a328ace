//! The files of each agent and the task of all agents are made from one another, and nothing is lost on the way.

use lang::diagnostic::Diagnostics;
use lang::factored::{self, Part};
use lang::model::{Domain, Problem};
use lang::render;
use lang::source::{Sources, Span};
use lang::write::{self, Style};

use crate::{files, pairs, read, round, same, shared, text};

/// Reads the files of one agent, which are without errors.
#[track_caller]
fn part(sources: &mut Sources, agent: &str, domain: &str, problem: &str) -> Part {
    let ids = [
        sources.add(format!("domain-{agent}.pddl"), domain),
        sources.add(format!("problem-{agent}.pddl"), problem),
    ];
    let (domain, mut diagnostics) = lang::read_domain(sources, ids[0]);
    let (problem, more) = lang::read_problem(sources, ids[1], &domain);
    diagnostics.append(more);
    assert!(!diagnostics.has_errors(), "{}", render::concise(&diagnostics, sources));
    Part { agent: agent.to_owned(), domain, problem }
}

/// What the parts say together, with all that is said about them.
fn merged(parts: &[Part], sources: &Sources) -> (Domain, Problem, String) {
    let (domain, problem, diagnostics) = factored::merge(parts);
    (domain, problem, render::concise(&diagnostics, sources))
}

/// The task is other people's and stands outside of the project.
#[test]
fn the_files_of_five_agents_are_the_task_of_all() {
    let Some(root) = shared().map(|root| root.join("corpus/mapddl/codmap-factored/depot-pfile1"))
    else {
        return;
    };
    let mut sources = Sources::default();
    let agents = ["driver0", "driver1", "depot0", "distributor0", "distributor1"];
    let read_part = |agent: &&str| {
        let path = |what: &str| text(&root.join(format!("{what}-{agent}.pddl")));
        part(&mut sources, agent, &path("domain"), &path("problem"))
    };
    let parts: Vec<Part> = agents.iter().map(read_part).collect();
    let (domain, problem, said) = merged(&parts, &sources);
    assert_eq!(said, "");
    let given = read(
        &text(&root.join("depot-domain.unfactor.pddl")),
        &text(&root.join("depot-pfile1.unfactor.pddl")),
    );
    assert_eq!(
        same::statements(&domain, &problem),
        same::statements(&given.domain, &given.problem)
    );
}

/// Takes a task apart, writes and reads the parts, and puts them together again.
fn apart_and_together(domain: &Domain, problem: &Problem) -> (Domain, Problem, String) {
    let mut sources = Sources::default();
    let parts = factored::split(domain, problem).expect("the task can be taken apart");
    let again: Vec<Part> = parts
        .iter()
        .map(|one| {
            let style = Style::default();
            let texts = [
                write::domain(&one.domain, &style),
                write::problem(&one.domain, &one.problem, &style),
            ];
            assert_eq!(round(&texts[0], &texts[1]), Some(Ok(())));
            part(&mut sources, &one.agent, &texts[0], &texts[1])
        })
        .collect();
    merged(&again, &sources)
}

/// The tasks are other people's and stand outside of the project.
#[test]
fn tasks_come_back_as_they_were() {
    let Some(root) = shared().map(|root| root.join("corpus/mapddl/codmap-unfactored")) else {
        return;
    };
    let mut done = 0;
    for (domain, problem) in files(&root).iter().flat_map(|folder| pairs(folder)) {
        let task = read(&text(&domain), &text(&problem));
        let shown = format!("{} {}", domain.display(), problem.display());
        if domain.ends_with("domain_constrained.pddl") {
            let refused = factored::split(&task.domain, &task.problem);
            let refused = refused.expect_err("it asks what others do");
            let asks = "asks what other agents do at the same time";
            assert!(refused.list.iter().all(|one| one.message.ends_with(asks)), "{shown}");
            continue;
        }
        let (merged_domain, merged_problem, said) = apart_and_together(&task.domain, &task.problem);
        assert_eq!(said, "", "{shown}");
        let before = same::statements(&task.domain, &task.problem);
        let after = same::statements(&merged_domain, &merged_problem);
        let lost: Vec<_> = before.symmetric_difference(&after).collect();
        assert!(lost.is_empty(), "{shown}: {lost:#?}");
        done += 1;
    }
    assert!(done >= 16, "only {done} tasks");
}

const DOMAIN: &str = "(define (domain carry) (:requirements :typing :factored-privacy)
    (:types truck place crate)
    (:predicates (at ?t - truck ?p - place) (in ?c - crate ?p - place)
      (:private (holds ?agent - truck ?c - crate)))
    (:action take :parameters (?t - truck ?c - crate ?p - place)
      :precondition (and (at ?t ?p) (in ?c ?p))
      :effect (and (holds ?t ?c) (not (in ?c ?p)))))";

fn problem_of(agent: &str, more: &str) -> String {
    format!(
        "(define (problem two) (:domain carry) (:objects a b - place c - crate
        (:private {agent} - truck)) (:init (at {agent} a) (in c a){more})
        (:goal (holds {agent} c)))"
    )
}

/// Two agents of which the second has these files.
fn said_of(domain: &str, problem: &str) -> String {
    let mut sources = Sources::default();
    let parts = [
        part(&mut sources, "one", DOMAIN, &problem_of("one", "")),
        part(&mut sources, "two", domain, problem),
    ];
    merged(&parts, &sources).2
}

/// Each wants something that only it knows of, which is no disagreement.
#[test]
fn what_is_private_may_differ() {
    let mut sources = Sources::default();
    let parts = [
        part(&mut sources, "one", DOMAIN, &problem_of("one", "")),
        part(&mut sources, "two", DOMAIN, &problem_of("two", "")),
    ];
    let (domain, problem, said) = merged(&parts, &sources);
    assert_eq!(said, "");
    insta::assert_snapshot!(format!(
        "{}\n{}",
        write::domain(&domain, &Style::default()),
        write::problem(&domain, &problem, &Style::default())
    ));
    insta::assert_snapshot!(factored::write_list(&parts));
}

#[test]
fn disagreements_are_said() {
    let problem = problem_of("two", "");
    let mut said = String::new();
    for (of, domain, problem) in [
        (
            "types",
            DOMAIN.replace("truck place crate", "truck - place place crate"),
            problem.clone(),
        ),
        (
            "arity",
            DOMAIN
                .replace("(in ?c - crate ?p - place)", "(in ?c - crate)")
                .replace("(in ?c ?p)", "(in ?c)"),
            problem.replace("(in c a)", "(in c)"),
        ),
        (
            "privacy",
            DOMAIN.replace("(:private ", "").replace("?c - crate)))", "?c - crate))"),
            problem.clone(),
        ),
        ("body", DOMAIN.replace("(and (at ?t ?p) (in ?c ?p))", "(at ?t ?p)"), problem.clone()),
        ("object", DOMAIN.to_owned(), problem.replace("a b - place", "a - place b - crate")),
        (
            "holder",
            DOMAIN.to_owned(),
            problem.replace("c - crate", "").replace("two - truck", "two - truck c - crate"),
        ),
        ("fact", DOMAIN.to_owned(), problem_of("two", " (in c b)")),
        ("goal", DOMAIN.to_owned(), problem.replace("(holds two c)", "(in c b)")),
        ("name", DOMAIN.replace("domain carry", "domain other"), problem.replace("carry", "other")),
        ("agent", DOMAIN.to_owned(), problem.replace("two", "three")),
        ("stranger", DOMAIN.to_owned(), problem.replace("two - truck", "two three - truck")),
    ] {
        said.extend([of, "\n", &said_of(&domain, &problem)]);
    }
    insta::assert_snapshot!(said);
}

/// An agent of which no action says so acts as the first parameter.
#[test]
fn an_action_without_its_agent_gets_it() {
    let mut sources = Sources::default();
    let domain = DOMAIN.replace(":parameters (?t - truck ", ":parameters (").replace("?t ", "one ");
    let domain = domain.replace("(at one - truck", "(at ?t - truck");
    let domain = domain.replace("(:predicates", "(:constants one - truck) (:predicates");
    let problem = problem_of("one", "").replace("(:private one - truck)", "");
    let parts = [part(&mut sources, "one", &domain, &problem)];
    let (domain, _, said) = merged(&parts, &sources);
    assert_eq!(said, "");
    let written = write::domain(&domain, &Style::default());
    insta::assert_snapshot!(&written[written.find("(:action").expect("it has one")..]);
}

#[test]
fn what_no_file_can_say_is_refused() {
    let domain = "(define (domain d) (:requirements :adl :multi-agent :unfactored-privacy)
        (:types robot crane) (:predicates (near ?x ?y - robot) (:private ?c - crane (busy ?c - crane)))
        (:action go :agent ?a - robot :parameters (?b - robot)
          :precondition (exists (?c - crane) (busy ?c)) :effect (near ?a ?b))
        (:action wait :parameters () :effect (and)))";
    let problem = "(define (problem p) (:domain d)
        (:objects (:private r r - robot) (:private s s - robot))
        (:init (near r s)) (:goal (near s r)))";
    let task = read(domain, problem);
    let refused = factored::split(&task.domain, &task.problem).expect_err("nobody knows both");
    let mut sources = Sources::default();
    sources.add("domain.pddl", domain);
    sources.add("problem.pddl", problem);
    insta::assert_snapshot!(render::concise(&refused, &sources));
}

#[test]
fn lists_of_agents_are_read_in_both_forms() {
    let list = |text: &str| {
        let mut sources = Sources::default();
        let id = sources.add("problem.addl", text);
        let (list, said): (_, Diagnostics) = factored::read_list(&sources, id);
        let names: Vec<String> = list.agents.into_iter().map(|agent| agent.text).collect();
        let of = [list.problem, list.domain].map(|name| name.map(|name| name.text));
        (names, of, render::concise(&said, &sources))
    };
    let of = [Some("p".to_owned()), Some("d".to_owned())];
    let agents = vec!["a1".to_owned(), "a2".to_owned()];
    let define = "(define (problem p)\n  (:domain d)\n  (:agents a1 a2))\n";
    assert_eq!(list(define), (agents.clone(), of, String::new()));
    assert_eq!(list("a1\na2\n"), (agents, [None, None], String::new()));
    let (_, _, said) = list("(define (problem p) (:agent a1))");
    assert_eq!(
        said,
        "problem.addl:1:21: error[E0013] unexpected-item: expected `(problem NAME)`, `(:domain NAME)` or `(:agents NAME …)`\n"
    );
}

#[test]
fn a_list_of_other_agents_is_wrong() {
    let mut sources = Sources::default();
    let parts = [
        part(&mut sources, "one", DOMAIN, &problem_of("one", "")),
        part(&mut sources, "two", DOMAIN, &problem_of("two", "")),
    ];
    let mut said = String::new();
    for text in [
        "ONE\ntwo\n",
        "(define (problem too) (:domain carry) (:agents one tow one))",
        "(define (problem two) (:domain carrying) (:agents one))",
    ] {
        let id = sources.add("two.addl", text);
        let (list, _) = factored::read_list(&sources, id);
        let found = factored::check_list(&list, &parts, Span::new(id, 0, text.len() as u32));
        said += &render::concise(&found, &sources);
    }
    insta::assert_snapshot!(said);
}

#[test]
fn the_agent_is_found_without_its_name() {
    let mut sources = Sources::default();
    let one = part(&mut sources, "one", DOMAIN, &problem_of("one", ""));
    assert_eq!(factored::agent(&one.domain, &one.problem, &["pfile", "one"]), Some("one"));
    assert_eq!(factored::agent(&one.domain, &one.problem, &["pfile"]), Some("one"));
    let public = problem_of("one", "").replace("(:private one - truck)", "one - truck");
    let public = part(&mut sources, "one", DOMAIN, &public);
    assert_eq!(factored::agent(&public.domain, &public.problem, &[]), None);
}
