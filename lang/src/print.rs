//! An [`Domain`] or an [`Problem`] goes in; PDDL text comes out that reads as the same again.
//!
//! Comments are not part of the AST and so are not printed; spelling is kept.

use std::fmt::Write;

use crate::ast::{
    Action, Amount, Application, Domain, DomainSection, EntryKind, Formula, FunctionGroup, Head,
    Init, Name, Node, NodeKind, Problem, ProblemSection, TypeReference, TypedList,
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
        for group in &list.groups {
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
            DomainSection::Predicates(heads) => {
                self.text.push_str("(:predicates");
                for head in heads {
                    self.text.push_str("\n    ");
                    self.head(head);
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
            DomainSection::Unread(unread) => self.text.push_str(unread.node.text),
        }
    }

    fn action(&mut self, action: &Action<'_>) {
        write!(self.text, "(:action {}\n    :parameters (", action.name)
            .expect("a string takes all");
        self.typed_list(&action.parameters);
        self.text.push(')');
        for (field, formulas) in
            [(":precondition", &action.preconditions), (":effect", &action.effects)]
        {
            for formula in formulas {
                write!(self.text, "\n    {field} ").expect("a string takes all");
                self.formula(formula);
            }
        }
        for unread in &action.unread {
            write!(self.text, "\n    {} {}", unread.keyword, unread.node)
                .expect("a string takes all");
        }
        self.text.push(')');
    }

    fn problem_section(&mut self, section: &ProblemSection<'_>) {
        match section {
            ProblemSection::Domain(name) => self.words(":domain", &[*name]),
            ProblemSection::Requirements(names) => self.words(":requirements", names),
            ProblemSection::Objects(list) => self.typed_section(":objects", list),
            ProblemSection::Init(init) => self.init(init),
            ProblemSection::Goal(formulas) => {
                self.text.push_str("(:goal");
                for formula in formulas {
                    self.text.push(' ');
                    self.formula(formula);
                }
                self.text.push(')');
            }
            ProblemSection::Metric(function, _) => {
                write!(self.text, "(:metric minimize ({function}))").expect("a string takes all");
            }
            ProblemSection::Unread(unread) => self.text.push_str(unread.node.text),
        }
    }

    fn init(&mut self, init: &Init<'_>) {
        self.text.push_str("(:init");
        let write = |out: &mut Self, application: &Application<'_>| {
            out.words(application.name.text, init.arguments(application));
        };
        for entry in &init.entries {
            self.text.push_str("\n    ");
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
            NodeKind::Atom(atom) | NodeKind::Equal(atom) => {
                self.words(atom.name.text, formula.arguments(atom));
            }
            NodeKind::Connective(connective) => {
                write!(self.text, "({}", connective.word()).expect("a string takes all");
                return true;
            }
            NodeKind::Quantifier(quantifier, variables) => {
                write!(self.text, "({} (", quantifier.word()).expect("a string takes all");
                self.typed_list(variables);
                self.text.push(')');
                return true;
            }
            NodeKind::Increase(function, amount) => {
                self.text.push_str("(increase ");
                self.words(function.name.text, formula.arguments(function));
                match amount {
                    Amount::Number(number) => self.word(number.text),
                    Amount::Function(function, _) => {
                        self.text.push(' ');
                        self.words(function.name.text, formula.arguments(function));
                    }
                }
                self.text.push(')');
            }
            NodeKind::Unread(unread) => self.text.push_str(unread.node.text),
        }
        false
    }
}
