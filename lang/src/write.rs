//! A checked [`Domain`] or [`Problem`] goes in; PDDL text comes out that reads as the same model again.
//!
//! What the model does not hold, its `uses`, is not written.
//! Concurrency constraints are written as what the checker makes of them: preconditions with action atoms.

mod condition;
mod effect;
mod list;
mod requirement;
mod variable;

use std::collections::{BTreeMap, BTreeSet};

use crate::format::format;
use crate::model::{
    Action, ActionId, Axiom, Domain, Function, Holder, Object, ObjectId, Predicate, PredicateId,
    Problem, Requirement, Term, VariableId,
};

pub use requirement::{of_domain, of_problem};

use list::Entry;
use variable::Variables;

/// What is written besides the model.
#[derive(Debug, Clone, Default)]
pub struct Style {
    /// A comment at the head of the file, of any number of lines.
    pub head: String,
    /// A comment before each of these actions.
    pub actions: BTreeMap<ActionId, String>,
    /// A comment before each of these predicates.
    pub predicates: BTreeMap<PredicateId, String>,
    /// Annotations of the domain, one in a line, without the `;@`.
    pub groups: String,
    /// Annotations of each of these actions, one in a line, without the `;@`.
    pub annotations: BTreeMap<ActionId, String>,
}

/// Writes a domain.
pub fn domain(domain: &Domain, style: &Style) -> String {
    let mut out = Writer::new(domain, &domain.constants);
    out.comment(&style.head);
    out.push(&format!("(define (domain {})\n", domain.name.text));
    out.requirements(&of_domain(domain));
    out.types();
    out.objects(":constants", &domain.constants);
    out.predicates(style);
    out.annotation(&style.groups);
    out.functions();
    for axiom in &domain.axioms {
        out.axiom(axiom);
    }
    for (id, action) in domain.actions.iter().enumerate() {
        out.push("\n");
        if let Some(comment) = style.actions.get(&ActionId(id as u32)) {
            out.comment(comment);
        }
        out.action(action, style.annotations.get(&ActionId(id as u32)));
    }
    out.finish()
}

/// Writes one action of a domain, with its comment and its annotations.
pub fn action(domain: &Domain, id: ActionId, style: &Style) -> String {
    let mut out = Writer::new(domain, &domain.constants);
    if let Some(comment) = style.actions.get(&id) {
        out.comment(comment);
    }
    out.action(&domain.actions[id.index()], style.annotations.get(&id));
    format(&out.text).unwrap_or(out.text)
}

/// Writes a problem of `domain`.
pub fn problem(domain: &Domain, problem: &Problem, style: &Style) -> String {
    let mut out = Writer::new(domain, &problem.objects);
    out.comment(&style.head);
    out.push(&format!("(define (problem {})\n", problem.name.text));
    out.push(&format!("(:domain {})\n", domain.name.text));
    out.requirements(&of_problem(domain, problem));
    out.objects(":objects", &problem.objects[domain.constants.len()..]);
    out.initial(problem);
    out.push("(:goal");
    out.condition(&problem.goal, &mut Variables::new(&problem.goal_scope.variables));
    out.push(")\n");
    out.metric(problem);
    out.finish()
}

/// The text so far, in which line ends stand where the layout shall keep them.
struct Writer<'m> {
    domain: &'m Domain,
    /// What objects in terms are.
    objects: &'m [Object],
    text: String,
}

impl<'m> Writer<'m> {
    fn new(domain: &'m Domain, objects: &'m [Object]) -> Self {
        Self { domain, objects, text: String::new() }
    }

    fn push(&mut self, text: &str) {
        self.text.push_str(text);
    }

    /// Ends the definition and lays it out.
    fn finish(mut self) -> String {
        self.push(")\n");
        format(&self.text).unwrap_or(self.text)
    }

    fn comment(&mut self, text: &str) {
        for line in text.split(['\n', '\r']) {
            if !text.is_empty() {
                self.push(format!("; {}", line.trim_end()).trim_end());
                self.push("\n");
            }
        }
    }

    /// Annotations, each on lines of its own.
    fn annotation(&mut self, text: &str) {
        for line in text.lines() {
            self.push(&format!(";@ {line}\n"));
        }
    }

    fn requirements(&mut self, requirements: &BTreeSet<Requirement>) {
        if !requirements.is_empty() {
            self.push("(:requirements");
            for requirement in requirements {
                self.push(" ");
                self.push(requirement.keyword());
            }
            self.push(")\n");
        }
    }

    fn types(&mut self) {
        let types = self.domain.types.iter().skip(1);
        let entries: Vec<Entry<'_>> =
            types.map(|of| (of.name.text.as_str(), of.parents.as_slice())).collect();
        if !entries.is_empty() {
            let groups = list::groups(&self.domain.types, &entries, false);
            self.push(&format!("(:types\n{})\n", groups.join("\n")));
        }
    }

    /// The public objects, then those of each agent.
    fn objects(&mut self, keyword: &str, objects: &'m [Object]) {
        if objects.is_empty() {
            return;
        }
        let (public, private): (Vec<&'m Object>, Vec<&'m Object>) =
            objects.iter().partition(|object| match object.holder {
                // A constant cannot name an agent that only the problem knows.
                Some(Holder::Agent(agent)) => agent.index() >= self.objects.len(),
                Some(Holder::File) => false,
                None => true,
            });
        let mut all = self.typed_objects(&public);
        for group in private.chunk_by(|one, other| one.holder == other.holder) {
            let agent = match group[0].holder {
                Some(Holder::Agent(agent)) => self.objects[agent.index()].name.text.as_str(),
                _ => "",
            };
            let objects = self.typed_objects(group);
            all.extend(["\n(:private ", agent, "\n", &objects, ")"]);
        }
        self.push(&format!("({keyword}\n{})\n", all.trim_start()));
    }

    fn typed_objects(&self, objects: &[&'m Object]) -> String {
        let entry = |object: &&'m Object| (object.name.text.as_str(), object.types.as_slice());
        let entries: Vec<Entry<'_>> = objects.iter().map(entry).collect();
        list::groups(&self.domain.types, &entries, false).join("\n")
    }

    /// The predicates, those that belong to the same agents together.
    fn predicates(&mut self, style: &Style) {
        let predicates = &self.domain.predicates;
        if predicates.is_empty() {
            return;
        }
        self.push("(:predicates\n");
        let mut id = 0;
        for group in predicates.chunk_by(same_owner) {
            let agent = group.iter().find_map(agent_name).unwrap_or("?agent");
            let owner = group[0].owner.as_ref();
            if let Some(owner) = owner {
                let agent = list::groups(&self.domain.types, &[(agent, &owner.types)], false);
                let named = !owner.types.is_empty();
                self.push("(:private");
                self.push(&if named { format!(" {}\n", agent.join(" ")) } else { "\n".to_owned() });
            }
            for predicate in group {
                if let Some(comment) = style.predicates.get(&PredicateId(id)) {
                    self.comment(comment);
                }
                self.predicate(predicate, agent);
                id += 1;
            }
            if owner.is_some() {
                self.push(")\n");
            }
        }
        self.push(")\n");
    }

    /// The declaration of a predicate, in which the agent that owns it, and nothing else, is called `agent`.
    fn predicate(&mut self, predicate: &Predicate, agent: &str) {
        let mut variables = Variables::new(&predicate.parameters);
        if let Some(owner) = predicate.owner.as_ref().filter(|owner| !owner.types.is_empty()) {
            variables.reserve(agent);
            if let Some(position) = owner.position {
                variables.call(VariableId(position as u32), agent);
            }
        }
        self.push(&format!("({}", predicate.name.text));
        self.declared(&mut variables);
        self.push(")\n");
    }

    fn functions(&mut self) {
        let functions = &self.domain.functions;
        if functions.is_empty() {
            return;
        }
        self.push("(:functions\n");
        for function in functions {
            self.function(function);
        }
        self.push(")\n");
    }

    fn function(&mut self, function: &Function) {
        self.push(&format!("({}", function.name.text));
        self.declared(&mut Variables::new(&function.parameters));
        let values = function.values.as_ref();
        let values = values.map(|types| list::reference(&self.domain.types, types));
        self.push(&format!(") - {}\n", values.as_deref().unwrap_or("number")));
    }

    /// All variables that `variables` is about, each with a blank before it.
    fn declared(&mut self, variables: &mut Variables<'_>) {
        let ids: Vec<VariableId> = variables.ids().collect();
        variables.bind_rest();
        let list = self.typed(&ids, variables, false);
        if !list.is_empty() {
            self.push(" ");
            self.push(&list);
        }
    }

    /// `?a ?b - TYPE …`, with a type even if all are objects where it must be `explicit`.
    fn typed(&self, ids: &[VariableId], variables: &Variables<'_>, explicit: bool) -> String {
        let entries: Vec<Entry<'_>> =
            ids.iter().map(|&id| (variables.name(id), variables.types(id))).collect();
        list::groups(&self.domain.types, &entries, explicit).join(" ")
    }

    fn axiom(&mut self, axiom: &Axiom) {
        let mut variables = Variables::new(&axiom.scope.variables);
        let parameters: Vec<VariableId> = (0..axiom.scope.parameters).map(VariableId).collect();
        variables.bind(&parameters);
        let head = &self.domain.predicates[axiom.head.index()].name.text;
        // A head without types would have those of the predicate.
        let typed = self.typed(&parameters, &variables, self.domain.types.len() > 1);
        let blank = if typed.is_empty() { "" } else { " " };
        self.push(&format!("\n(:derived ({head}{blank}{typed})"));
        self.condition(&axiom.body, &mut variables);
        self.push(")\n");
    }

    fn action(&mut self, action: &Action, annotation: Option<&String>) {
        let mut variables = Variables::new(&action.scope.variables);
        let parameters: Vec<VariableId> = (0..action.scope.parameters).map(VariableId).collect();
        variables.bind(&parameters);
        self.push(&format!("(:action {}\n", action.name.text));
        let (agent, others) = parameters.split_at(usize::from(action.agent).min(parameters.len()));
        if !agent.is_empty() {
            let agent = self.typed(agent, &variables, false);
            self.push(&format!(":agent {agent}\n"));
        }
        let others = self.typed(others, &variables, false);
        self.push(&format!(":parameters ({others})\n"));
        if !action.precondition.is_truth() {
            self.push(":precondition");
            self.condition(&action.precondition, &mut variables);
            self.push("\n");
        }
        self.push(":effect");
        self.effects(action, &mut variables);
        if let Some(annotation) = annotation {
            self.push("\n");
            self.annotation(annotation);
        }
        self.push(")\n");
    }

    fn initial(&mut self, problem: &Problem) {
        self.push("(:init\n");
        for fact in &problem.init {
            let name = &self.domain.predicates[fact.predicate.index()].name.text;
            self.ground(name, &fact.arguments);
            self.push("\n");
        }
        for value in &problem.values {
            self.push("(= ");
            let name = &self.domain.functions[value.function.index()].name.text;
            self.ground(name, &value.arguments);
            self.push(&format!(" {})\n", value.value));
        }
        self.push(")\n");
    }

    fn ground(&mut self, name: &str, arguments: &[ObjectId]) {
        self.push("(");
        self.push(name);
        for argument in arguments {
            self.push(" ");
            self.push(&self.objects[argument.index()].name.text);
        }
        self.push(")");
    }

    /// What is minimised; a function of one agent is that of every agent.
    fn metric(&mut self, problem: &Problem) {
        let Some(metric) = &problem.metric else { return };
        let function = &self.domain.functions[metric.function.index()];
        let name = &function.name.text;
        if function.parameters.is_empty() {
            return self.push(&format!("(:metric minimize ({name}))\n"));
        }
        let mut variables = Variables::new(&function.parameters);
        let ids: Vec<VariableId> = variables.ids().collect();
        variables.bind(&ids);
        let agent = self.typed(&ids, &variables, false);
        let terms: Vec<Term> = ids.into_iter().map(Term::Variable).collect();
        self.push(&format!("(:metric :agent {agent} :utility minimize "));
        self.apply(name, &terms, &variables);
        self.push(")\n");
    }
}

/// Whether two predicates may stand in one `(:private …)`, or both outside.
fn same_owner(one: &Predicate, other: &Predicate) -> bool {
    let types = |of: &Predicate| of.owner.as_ref().map(|owner| owner.types.clone());
    types(one) == types(other)
}

/// What a private predicate calls its owner, if one of its parameters is that.
fn agent_name(predicate: &Predicate) -> Option<&str> {
    let position = predicate.owner.as_ref()?.position?;
    Some(&predicate.parameters.get(position)?.name.text)
}
