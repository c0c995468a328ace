//! Domains, problems and plans as text, and what comes of them.

use lang::diagnostic::Diagnostics;
use lang::execute::Executor;
use lang::model::{Domain, Problem};
use lang::plan::{self, Listing};
use lang::source::{SourceId, Sources, Span};
use lang::validate::{Verdict, judge, lines, story};

pub struct Fixture {
    pub sources: Sources,
    pub domain: Domain,
    pub problem: Problem,
}

impl Fixture {
    /// Reads a domain, of which only the sections are given, and a problem likewise; both must be free of errors.
    pub fn new(domain: &str, problem: &str) -> Self {
        let mut sources = Sources::default();
        let domain = sources.add("domain.pddl", format!("(define (domain d)\n{domain})"));
        let problem =
            sources.add("problem.pddl", format!("(define (problem p) (:domain d)\n{problem})"));
        Self::read(sources, domain, problem)
    }

    pub fn read(sources: Sources, domain: SourceId, problem: SourceId) -> Self {
        let (domain, mut diagnostics) = lang::read_domain(&sources, domain);
        let (problem, more) = lang::read_problem(&sources, problem, &domain);
        diagnostics.append(more);
        assert!(!diagnostics.has_errors(), "{diagnostics:?}");
        Self { sources, domain, problem }
    }

    pub fn executor(&self) -> Executor<'_> {
        Executor::new(&self.domain, &self.problem).expect("the axioms are stratified")
    }

    /// The steps of a plan file, and its diagnostics as a person reads them.
    pub fn plan(&mut self, text: &str) -> (Listing, String) {
        let id = self.sources.add("plan", text);
        let (listing, diagnostics) = plan::read(&self.sources, id, &self.domain, &self.problem);
        let notes = lang::render::full(&diagnostics, &self.sources, false);
        (listing, notes)
    }

    /// `domain.pddl:3:7`.
    pub fn place(&self, span: Span) -> String {
        let source = self.sources.get(span.source);
        let before = &source.text[..span.start as usize];
        let line = before.matches('\n').count() + 1;
        let column = before.len() - before.rfind('\n').map_or(0, |at| at + 1) + 1;
        format!("{}:{line}:{column}", source.name)
    }

    /// What `validate` says of a plan.
    pub fn verdict(&mut self, text: &str) -> String {
        let (Listing { plan, .. }, notes) = self.plan(text);
        assert_eq!(notes, "", "the plan can be read");
        let executor = self.executor();
        let verdict = judge(&executor, &plan);
        lines(&verdict) + "\n" + &story(&verdict, &self.domain, &self.problem, &plan)
    }

    /// The failure of a plan as a diagnostic.
    pub fn diagnostic(&mut self, text: &str) -> String {
        let (Listing { plan, spans, .. }, notes) = self.plan(text);
        assert_eq!(notes, "", "the plan can be read");
        let Verdict::Invalid(failure) = judge(&self.executor(), &plan) else {
            panic!("the plan is valid")
        };
        let mut diagnostics = Diagnostics::default();
        diagnostics.push(failure.diagnostic(&self.domain, &self.problem, &plan, &spans));
        lang::render::full(&diagnostics, &self.sources, false)
    }
}
