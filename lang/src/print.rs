//! An [`Domain`] or an [`Problem`] goes in; PDDL text comes out that reads as the same again.
//!
//! Comments are not part of the AST and so are not printed; spelling is kept.

use std::fmt::Write;

use crate::ast::{
    Action, Agent, Application, Concurrency, Domain, DomainSection, EntryKind, Formula,
    FunctionGroup, Goal, Group, Head, Init, Metric, Name, Network, Node, NodeKind, Predicates,
    Problem, ProblemSection, TypeReference, TypedList,
};

/// Prints a domain.
pub fn domain(domain: &Domain<'_>) -> String {
    let mut out = Printer { text: format!("(define (domain {})", domain.name) };
    for section in &domain.sections {
        out.text.push_str("\n  ");
        out.domain_section(section);
    }
    out.text.push_str(")\n");
    out.text
}

/// Prints a problem.
pub fn problem(problem: &Problem<'_>) -> String {
    let mut out = Printer { text: format!("(define (problem {})", problem.name) };
    for section in &problem.sections {
        out.text.push_str("\n  ");
        out.problem_section(section);
    }
    out.text.push_str(")\n");
    out.text
}

/// Prints a condition or an effect on one line.
pub fn formula(formula: &Formula<'_>) -> String {
    let mut out = Printer { text: String::new() };
    out.formula(formula);
    out.text
}

/// The text so far.
struct Printer {
    text: String,
}

impl Printer {
    fn word(&mut self, word: &str) {
        if !self.text.ends_with(['(', ' ', '\n']) {
            self.text.push(' ');
        }
        self.text.push_str(word);
    }

    /// `(KEYWORD WORD …)`
    fn words(&mut self, keyword: &str, words: &[Name<'_>]) {
        write!(self.text, "({keyword}").expect("a string takes all");
        for word in words {
            self.word(word.text);
        }
        self.text.push(')');
    }

    fn type_reference(&mut self, types: &TypeReference<'_>) {
        self.word("-");
        match types.names.as_slice() {
            [one] => self.word(one.text),
            several => {
                self.text.push(' ');
                self.words("either", several);
            }
        }
    }

    fn typed_list(&mut self, list: &TypedList<'_>) {
        self.groups(&list.groups);
        for private in &list.private {
            write!(self.text, "\n    ({}", private.keyword).expect("a string takes all");
            self.groups(&private.groups);
            self.text.push(')');
        }
    }

    fn groups(&mut self, groups: &[Group<'_>]) {
        for group in groups {
            group.names.iter().for_each(|name| self.word(name.text));
            if let Some(types) = &group.types {
                self.type_reference(types);
            }
        }
    }

    /// `(KEYWORD a b - t …)`
    fn typed_section(&mut self, keyword: &str, list: &TypedList<'_>) {
        write!(self.text, "({keyword}").expect("a string takes all");
        self.typed_list(list);
        self.text.push(')');
    }

    /// `(NAME ?x - t …)`
    fn head(&mut self, head: &Head<'_>) {
        self.typed_section(head.name.text, &head.parameters);
    }

    fn functions(&mut self, groups: &[FunctionGroup<'_>]) {
        self.text.push_str("(:functions");
        for group in groups {
            for head in &group.heads {
                self.text.push_str("\n    ");
                self.head(head);
            }
            if let Some(types) = &group.types {
                self.type_reference(types);
            }
        }
        self.text.push(')');
    }

    fn domain_section(&mut self, section: &DomainSection<'_>) {
        match section {
            DomainSection::Requirements(names) => self.words(":requirements", names),
            DomainSection::Types(list) => self.typed_section(":types", list),
            DomainSection::Constants(list) => self.typed_section(":constants", list),
            DomainSection::Predicates(parts) => {
                self.text.push_str("(:predicates");
                for part in parts {
                    self.predicates(part);
                }
                self.text.push(')');
            }
            DomainSection::Functions(groups) => self.functions(groups),
            DomainSection::Action(action) => self.action(action),
            DomainSection::Derived(derived) => {
                self.text.push_str("(:derived ");
                self.head(&derived.head);
                if let Some(body) = &derived.body {
                    self.text.push_str("\n    ");
                    self.formula(body);
                }
                self.text.push(')');
            }
            DomainSection::Axiom(axiom) => {
                write!(self.text, "({} :vars (", axiom.keyword).expect("a string takes all");
                self.typed_list(&axiom.variables);
                self.text.push(')');
                self.field(":context", axiom.context.as_slice());
                self.field(":implies", axiom.implies.as_slice());
                self.text.push(')');
            }
            DomainSection::Constraints(keyword, formulas) => self.formulas(keyword.text, formulas),
            DomainSection::Task(task) => {
                write!(self.text, "(:task {}", task.name).expect("a string takes all");
                self.parameters(&task.parameters);
                self.text.push(')');
            }
            DomainSection::Method(method) => {
                write!(self.text, "(:method {}", method.name).expect("a string takes all");
                self.parameters(&method.parameters);
                self.field(":task", method.task.as_slice());
                self.field(":precondition", &method.preconditions);
                self.network(&method.network);
                self.text.push(')');
            }
            DomainSection::Concurrency(constraint) => self.concurrency(constraint),
            DomainSection::Dependence(keyword, names) => self.words(keyword.text, names),
            DomainSection::Unread(unread) => self.text.push_str(unread.node.text),
        }
    }

    /// Public predicates, or the `(:private …)` ones of somebody.
    fn predicates(&mut self, part: &Predicates<'_>) {
        if let Some(keyword) = part.private {
            write!(self.text, "\n    ({keyword}").expect("a string takes all");
            self.typed_list(&part.owner);
        }
        for head in &part.heads {
            self.text.push_str("\n    ");
            self.head(head);
        }
        if part.private.is_some() {
            self.text.push(')');
        }
    }

    /// `:parameters (…)` on a line of its own
    fn parameters(&mut self, list: &TypedList<'_>) {
        self.text.push_str("\n    :parameters (");
        self.typed_list(list);
        self.text.push(')');
    }

    /// A field with its formulas, if it has any.
    fn field(&mut self, field: &str, formulas: &[Formula<'_>]) {
        for formula in formulas {
            write!(self.text, "\n    {field} ").expect("a string takes all");
            self.formula(formula);
        }
    }

    /// A section of formulas.
    fn formulas(&mut self, keyword: &str, formulas: &[Formula<'_>]) {
        write!(self.text, "({keyword}").expect("a string takes all");
        for formula in formulas {
            self.text.push(' ');
            self.formula(formula);
        }
        self.text.push(')');
    }

    fn action(&mut self, action: &Action<'_>) {
        write!(self.text, "({} {}", action.kind.keyword(), action.name)
            .expect("a string takes all");
        if let Some(agent) = &action.agent {
            self.text.push_str("\n    ");
            self.agent(agent);
        }
        self.parameters(&action.parameters);
        self.field(":duration", &action.durations);
        self.field(action.kind.condition(), &action.preconditions);
        self.field(":effect", &action.effects);
        for unread in &action.unread {
            write!(self.text, "\n    {} {}", unread.keyword, unread.node)
                .expect("a string takes all");
        }
        self.text.push(')');
    }

    /// `:agent ?a - t`
    fn agent(&mut self, agent: &Agent<'_>) {
        self.word(":agent");
        self.word(agent.name.text);
        if let Some(types) = &agent.types {
            self.type_reference(types);
        }
    }

    fn concurrency(&mut self, constraint: &Concurrency<'_>) {
        write!(self.text, "(:concurrency-constraint {}", constraint.name)
            .expect("a string takes all");
        self.parameters(&constraint.parameters);
        self.text.push_str("\n    :bounds (");
        constraint.bounds.iter().for_each(|bound| self.word(bound.text));
        self.text.push_str(")\n    :actions (");
        for participant in &constraint.actions {
            self.words(participant.action.text, &participant.positions);
        }
        self.text.push_str("))");
    }

    fn network(&mut self, network: &Network<'_>) {
        let field = if network.ordered { ":ordered-subtasks" } else { ":subtasks" };
        write!(self.text, "\n    {field} (and").expect("a string takes all");
        for subtask in &network.subtasks {
            let range = subtask.task.arguments.start as usize..subtask.task.arguments.end as usize;
            let arguments = &network.terms[range];
            self.text.push(' ');
            if let Some(label) = subtask.label {
                write!(self.text, "({label} ").expect("a string takes all");
                self.words(subtask.task.name.text, arguments);
                self.text.push(')');
            } else {
                self.words(subtask.task.name.text, arguments);
            }
        }
        self.text.push(')');
        if !network.ordering.is_empty() {
            self.text.push_str("\n    :ordering (and");
            for (first, second) in &network.ordering {
                write!(self.text, " (< {first} {second})").expect("a string takes all");
            }
            self.text.push(')');
        }
        self.field(":constraints", &network.constraints);
    }

    fn problem_section(&mut self, section: &ProblemSection<'_>) {
        match section {
            ProblemSection::Domain(name) => self.words(":domain", &[*name]),
            ProblemSection::Requirements(names) => self.words(":requirements", names),
            ProblemSection::Objects(list) => self.typed_section(":objects", list),
            ProblemSection::Init(init) => self.init(init),
            ProblemSection::Goal(goal) => self.goal(goal),
            ProblemSection::Metric(metric) => self.metric(metric),
            ProblemSection::Constraints(keyword, formulas) => self.formulas(keyword.text, formulas),
            ProblemSection::Network(asked) => {
                write!(self.text, "({}", asked.keyword).expect("a string takes all");
                self.parameters(&asked.parameters);
                self.network(&asked.network);
                self.text.push(')');
            }
            ProblemSection::Unread(unread) => self.text.push_str(unread.node.text),
        }
    }

    fn goal(&mut self, goal: &Goal<'_>) {
        let Some(agent) = &goal.agent else {
            return self.formulas(":goal", &goal.formulas);
        };
        self.text.push_str("(:goal");
        self.agent(agent);
        self.field(":condition", &goal.formulas);
        self.text.push(')');
    }

    fn metric(&mut self, metric: &Metric<'_>) {
        write!(self.text, "({}", metric.keyword).expect("a string takes all");
        if let Some(agent) = &metric.agent {
            self.agent(agent);
            self.word(":utility");
        }
        self.word(metric.direction.text);
        if let Some(value) = &metric.value {
            self.text.push(' ');
            self.formula(value);
        }
        self.text.push(')');
    }

    fn init(&mut self, init: &Init<'_>) {
        self.text.push_str("(:init");
        let write = |out: &mut Self, application: &Application<'_>| {
            out.words(application.name.text, init.arguments(application));
        };
        for entry in &init.entries {
            self.text.push_str("\n    ");
            if let Some(time) = entry.time {
                write!(self.text, "(at {time} ").expect("a string takes all");
            }
            match &entry.kind {
                EntryKind::Fact(fact) => write(self, fact),
                EntryKind::Absent(fact) => {
                    self.text.push_str("(not ");
                    write(self, fact);
                    self.text.push(')');
                }
                EntryKind::Value(function, number) => {
                    self.text.push_str("(= ");
                    write(self, function);
                    self.word(number.text);
                    self.text.push(')');
                }
                EntryKind::Unread(unread) => self.text.push_str(unread.node.text),
            }
            if entry.time.is_some() {
                self.text.push(')');
            }
        }
        self.text.push(')');
    }

    fn formula(&mut self, formula: &Formula<'_>) {
        // The ends of the nodes whose operands are being printed.
        let mut open: Vec<u32> = Vec::new();
        for (index, node) in formula.nodes.iter().enumerate() {
            self.close(&mut open, index as u32);
            if index > 0 {
                self.text.push(' ');
            }
            if self.node(node, formula) {
                open.push(node.next);
            }
        }
        self.close(&mut open, formula.nodes.len() as u32);
    }

    fn close(&mut self, open: &mut Vec<u32>, at: u32) {
        while open.pop_if(|&mut end| end <= at).is_some() {
            self.text.push(')');
        }
    }

    /// Prints a node; returns whether it waits for operands and a `)`.
    fn node(&mut self, node: &Node<'_>, formula: &Formula<'_>) -> bool {
        match &node.kind {
            NodeKind::Apply(application) => {
                self.words(application.name.text, formula.arguments(application));
                return false;
            }
            NodeKind::Word(word) => {
                self.text.push_str(word.text);
                return false;
            }
            NodeKind::Unread(unread) => {
                self.text.push_str(unread.node.text);
                return false;
            }
            NodeKind::Nested(name) => write!(self.text, "({name}"),
            NodeKind::Connective(connective) => write!(self.text, "({}", connective.word()),
            NodeKind::Operator(operator) => write!(self.text, "({}", operator.word()),
            NodeKind::Timed(time) => write!(self.text, "({}", time.words()),
            NodeKind::Preference(None) => write!(self.text, "(preference"),
            NodeKind::Preference(Some(name)) => write!(self.text, "(preference {name}"),
            NodeKind::Quantifier(quantifier, variables) => {
                write!(self.text, "({} (", quantifier.word()).expect("a string takes all");
                self.typed_list(variables);
                self.text.push(')');
                Ok(())
            }
            NodeKind::Trajectory(modality, times) => {
                write!(self.text, "({}", modality.word()).expect("a string takes all");
                for time in times {
                    self.word(time.text);
                }
                Ok(())
            }
        }
        .expect("a string takes all");
        true
    }
}
