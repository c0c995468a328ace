//! Tasks, methods and task networks of HDDL.

use super::Reader;
use crate::ast::{InitialNetwork, Method, Name, Network, Subtask, Task, TypedList};
use crate::diagnostic::unexpected_item;
use crate::tree::NodeId;

/// The fields of a task; what it needs and does is allowed and says nothing.
const TASK: [&str; 3] = [":parameters", ":precondition", ":effect"];

/// The fields of a task network.
const NETWORK: [&str; 7] = [
    ":parameters",
    ":ordered-subtasks",
    ":subtasks",
    ":ordered-tasks",
    ":tasks",
    ":ordering",
    ":constraints",
];

/// The fields of a method.
const METHOD: [&str; 9] = [
    ":parameters",
    ":task",
    ":precondition",
    ":ordered-subtasks",
    ":subtasks",
    ":ordered-tasks",
    ":tasks",
    ":ordering",
    ":constraints",
];

impl<'a> Reader<'a, '_> {
    /// `(:task NAME :parameters (…))`
    pub(super) fn task(&mut self, item: NodeId) -> Task<'a> {
        let (name, skip) = self.title_of(item, "task");
        let mut fields = self.fields(item, skip, format!("task `{name}`"), &TASK);
        let mut parameters = TypedList::default();
        while let Some((field, _, values)) = self.next_field(&mut fields) {
            if field == ":parameters" {
                self.parameters(&values, &mut parameters);
            }
        }
        Task { name, parameters, place: self.place(item) }
    }

    /// `(:method NAME …)`
    pub(super) fn method(&mut self, item: NodeId) -> Method<'a> {
        let (name, skip) = self.title_of(item, "method");
        let mut fields = self.fields(item, skip, format!("method `{name}`"), &METHOD);
        let mut method = Method {
            name,
            parameters: TypedList::default(),
            task: None,
            preconditions: Vec::new(),
            network: Network::default(),
            place: self.place(item),
        };
        while let Some((field, keyword, values)) = self.next_field(&mut fields) {
            match field {
                ":parameters" => self.parameters(&values, &mut method.parameters),
                ":precondition" => self.formulas(field, &values, &mut method.preconditions),
                ":task" => match values.as_slice() {
                    &[task] if self.tree.is_list(task) => method.task = Some(self.formula(task)),
                    _ => self.diagnostics.push(unexpected_item::missing_item(
                        "`(TASK ?x …)` after `:task`",
                        keyword.span,
                    )),
                },
                _ => self.network(field, keyword, &values, &mut method.network),
            }
        }
        if method.task.is_none() && !name.text.is_empty() && !fields.has(":task") {
            let expected = "a `:task` that the method achieves";
            self.diagnostics.push(unexpected_item::missing_item(expected, name.span));
        }
        method
    }

    /// `(:htn …)` of a problem
    pub(super) fn initial_network(
        &mut self,
        keyword: Name<'a>,
        item: NodeId,
    ) -> InitialNetwork<'a> {
        let mut fields = self.fields(item, 1, format!("`{keyword}`"), &NETWORK);
        let mut parameters = TypedList::default();
        let mut network = Network::default();
        while let Some((field, keyword, values)) = self.next_field(&mut fields) {
            match field {
                ":parameters" => self.parameters(&values, &mut parameters),
                _ => self.network(field, keyword, &values, &mut network),
            }
        }
        InitialNetwork { keyword, parameters, network }
    }

    /// One field of a task network.
    fn network(
        &mut self,
        field: &str,
        keyword: Name<'a>,
        values: &[NodeId],
        network: &mut Network<'a>,
    ) {
        if field == ":constraints" {
            return self.formulas(field, values, &mut network.constraints);
        }
        let &[value] = values else {
            let expected = format!("one list after `{field}`");
            self.diagnostics.push(unexpected_item::missing_item(&expected, keyword.span));
            return;
        };
        let parts = self.conjuncts(value);
        if field == ":ordering" {
            for part in parts {
                network.ordering.extend(self.before(part));
            }
            return;
        }
        network.ordered |= field.starts_with(":ordered");
        for part in parts {
            let subtask = self.subtask(part, &mut network.terms);
            network.subtasks.extend(subtask);
        }
    }

    /// The parts of `(and …)`, or the one thing that stands there; none of `()`.
    fn conjuncts(&mut self, value: NodeId) -> Vec<NodeId> {
        let tree = self.tree;
        if !tree.is_list(value) {
            self.unexpected("a list in parentheses", value);
            return Vec::new();
        }
        if tree.children(value).next().is_none() {
            return Vec::new();
        }
        if self.head(value).is_some_and(|head| head.is("and")) {
            return tree.children(value).skip(1).collect();
        }
        vec![value]
    }

    /// `(TASK TERM …)` or `(ID (TASK TERM …))`
    fn subtask(&mut self, part: NodeId, terms: &mut Vec<Name<'a>>) -> Option<Subtask<'a>> {
        let tree = self.tree;
        let mut label = None;
        let mut task = part;
        let mut parts = tree.children(part);
        if let (Some(first), Some(second), None) = (parts.next(), parts.next(), parts.next())
            && !tree.is_list(first)
            && tree.is_list(second)
        {
            label = Some(self.name(first));
            task = second;
        }
        let read = if tree.is_list(task) { self.application(task, terms) } else { None };
        let Some(read) = read else {
            self.unexpected("a subtask such as `(TASK ?x)` or `(ID (TASK ?x))`", part);
            return None;
        };
        Some(Subtask { label, task: read, place: self.place(task) })
    }

    /// `(< FIRST SECOND)`
    fn before(&mut self, part: NodeId) -> Option<(Name<'a>, Name<'a>)> {
        let words: Vec<Name<'a>> = match self.head(part) {
            Some(head) if head.is("<") => self.words(part),
            _ => Vec::new(),
        };
        if let &[first, second] = words.as_slice() {
            return Some((first, second));
        }
        self.unexpected("an order such as `(< first second)`", part);
        None
    }
}
