//! Types, predicates, objects and actions go in one by one; the exported domain and problem come out.

use std::collections::{BTreeMap, HashSet};

use lang::ast::ActionKind;
use lang::condition::Condition;
use lang::model::{
    Action, ActionId, Atom, Doing, Domain, Effect, Expression, Fact, Formula, Function, FunctionId,
    FunctionValue, Increase, Literal, Metric, Name, Node, NodeId, NodeKind, Object, ObjectId,
    Predicate, PredicateId, Problem, Scope, Signature, Term, Type, TypeId, Variable, VariableId,
};
use lang::source::Span;

/// The root of all types.
const OBJECT: TypeId = TypeId(0);

/// What costs are counted in.
const COST: FunctionId = FunctionId(0);

/// The exported domain and problem while they are put together.
pub(super) struct Task {
    pub(super) domain: Domain,
    pub(super) problem: Problem,
    pub(super) notes: BTreeMap<ActionId, String>,
    pub(super) words: BTreeMap<PredicateId, String>,
    /// Where all that is new is said to stand.
    pub(super) span: Span,
    /// All names, in lower case: what is new is called like nothing else, of whatever kind.
    taken: HashSet<String>,
    /// The type of all objects of the original.
    root: TypeId,
}

/// An action that is put together.
pub(super) struct Draft {
    pub(super) name: String,
    pub(super) note: String,
    pub(super) scope: Scope,
    pub(super) precondition: Vec<Condition>,
    pub(super) effects: Vec<(Atom, bool)>,
    pub(super) cost: u32,
}

impl Draft {
    pub(super) fn new(name: String, note: String) -> Self {
        let (precondition, effects) = (Vec::new(), Vec::new());
        Self { name, note, scope: Scope::default(), precondition, effects, cost: 0 }
    }

    /// A further parameter.
    pub(super) fn parameter(&mut self, variable: Variable) -> Term {
        self.scope.variables.push(variable);
        self.scope.parameters += 1;
        Term::Variable(VariableId(self.scope.parameters - 1))
    }

    pub(super) fn needs(&mut self, predicate: PredicateId, arguments: Vec<Term>) {
        self.precondition.push(Condition::Atom(Atom { predicate, arguments }, true));
    }

    pub(super) fn makes(&mut self, predicate: PredicateId, arguments: Vec<Term>, holds: bool) {
        self.effects.push((Atom { predicate, arguments }, holds));
    }
}

impl Task {
    /// The same world without actions, and with costs that nothing has yet.
    pub(super) fn new(domain: &Domain, problem: &Problem) -> Self {
        let span = domain.name.span;
        let mut task = Self {
            domain: domain.clone(),
            problem: problem.clone(),
            notes: BTreeMap::new(),
            words: BTreeMap::new(),
            span,
            taken: names(domain, problem),
            root: OBJECT,
        };
        task.domain.name = task.name(format!("{}-excuses", domain.name.text));
        task.problem.name = task.name(format!("{}-excuses", problem.name.text));
        task.domain.actions.clear();
        task.domain.signatures.clear();
        task.cost();
        // What ranges over all objects must not range over those that are new.
        let actions = domain.actions.iter().map(|action| &action.scope);
        let axioms = domain.axioms.iter().map(|axiom| &axiom.scope);
        let mut scopes = actions.chain(axioms).chain([&problem.goal_scope]);
        if scopes.any(|scope| scope.variables.iter().any(|one| is_root(&one.types))) {
            task.split();
        }
        task
    }

    /// Puts all objects under a type of their own.
    fn split(&mut self) {
        let name = self.unused("thing");
        let thing = TypeId(self.domain.types.len() as u32);
        for of in self.domain.types.iter_mut().skip(1) {
            of.parents.iter_mut().filter(|parent| **parent == OBJECT).for_each(|parent| {
                *parent = thing;
            });
            if of.ancestors.contains(&OBJECT) {
                of.ancestors.push(thing);
            }
        }
        let name = self.name(name);
        let ancestors = vec![OBJECT, thing];
        self.domain.types.push(Type { name, parents: vec![OBJECT], ancestors });
        self.root = thing;
        let mut all: Vec<&mut Vec<TypeId>> = Vec::new();
        let (domain, problem) = (&mut self.domain, &mut self.problem);
        let objects = domain.constants.iter_mut().chain(&mut problem.objects);
        all.extend(objects.map(|object| &mut object.types));
        let parameters = domain.predicates.iter_mut().flat_map(|one| &mut one.parameters);
        let scopes = domain.axioms.iter_mut().flat_map(|axiom| &mut axiom.scope.variables);
        let variables = parameters.chain(scopes).chain(&mut problem.goal_scope.variables);
        all.extend(variables.map(|variable| &mut variable.types));
        for types in all {
            under(types, thing);
        }
    }

    /// The variables of a scope of the original.
    pub(super) fn variables(&self, variables: &[Variable]) -> Vec<Variable> {
        let mut variables = variables.to_vec();
        for variable in &mut variables {
            under(&mut variable.types, self.root);
        }
        variables
    }

    /// Drops all functions, and counts costs that are minimised.
    fn cost(&mut self) {
        let (span, problem) = (self.span, &mut self.problem);
        let name = Name { text: "total-cost".to_owned(), span };
        let parameters = Vec::new();
        self.domain.functions =
            vec![Function { name, parameters, values: None, read: None, assigned: false }];
        let arguments = Box::default();
        problem.values = vec![FunctionValue { function: COST, arguments, value: 0.into(), span }];
        problem.metric = Some(Metric { function: COST, span });
    }

    fn name(&self, text: String) -> Name {
        Name { text, span: self.span }
    }

    /// `name`, or with a number behind it if that is taken; it is from now on.
    fn unused(&mut self, name: &str) -> String {
        let numbered = (2..).map(|number| format!("{name}-{number}"));
        let found = std::iter::once(name.to_owned())
            .chain(numbered)
            .find(|name| !self.taken.contains(&name.to_lowercase()))
            .expect("there are more numbers than names");
        self.taken.insert(found.to_lowercase());
        found
    }

    /// A variable of a new action or predicate.
    pub(super) fn variable(&self, name: &str, types: &[TypeId]) -> Variable {
        Variable { name: self.name(name.to_owned()), types: types.to_vec() }
    }

    /// A type of what is new.
    pub(super) fn new_type(&mut self, name: &str) -> TypeId {
        let id = TypeId(self.domain.types.len() as u32);
        let name = self.unused(name);
        let name = self.name(name);
        self.domain.types.push(Type { name, parents: vec![OBJECT], ancestors: vec![OBJECT, id] });
        id
    }

    /// A predicate, called `name` or nearly so, and what it says, if that is to be said.
    pub(super) fn predicate(
        &mut self,
        name: &str,
        parameters: Vec<Variable>,
        words: &str,
    ) -> PredicateId {
        let id = PredicateId(self.domain.predicates.len() as u32);
        let name = self.unused(name);
        let name = self.name(name);
        self.domain.predicates.push(Predicate { name, parameters, derived: false, owner: None });
        if !words.is_empty() {
            self.words.insert(id, words.to_owned());
        }
        id
    }

    /// An object, called `name` or nearly so.
    pub(super) fn object(&mut self, name: &str, of: TypeId) -> ObjectId {
        let name = self.unused(name);
        let name = self.name(name);
        self.problem.objects.push(Object { name, types: vec![of], holder: None });
        ObjectId(self.problem.objects.len() as u32 - 1)
    }

    /// A fact that holds initially.
    pub(super) fn init(&mut self, predicate: PredicateId, arguments: Vec<ObjectId>) {
        self.problem.init.push(Fact { predicate, arguments: arguments.into() });
    }

    /// Adds to the goal.
    pub(super) fn goal(&mut self, literals: Vec<(Atom, bool)>) {
        let goal = std::mem::replace(&mut self.problem.goal, Formula::truth(self.span));
        self.problem.goal = also(goal, literals, self.span);
    }

    /// Adds an action.
    pub(super) fn action(&mut self, draft: Draft) {
        let Draft { name, note, scope, precondition, effects, cost } = draft;
        let span = self.span;
        let literals =
            effects.into_iter().map(|(atom, positive)| Literal { positive, atom, span }).collect();
        let condition = Formula::truth(span);
        let effects = vec![Effect { variables: Vec::new(), condition, literals, span }];
        let increase = |value: u32| Increase {
            variables: Vec::new(),
            condition: Formula::truth(span),
            function: COST,
            arguments: Vec::new(),
            value: Expression::Number(value.into()),
            span,
        };
        let name = self.unused(&name);
        self.push(Action {
            name: self.name(name),
            scope,
            agent: false,
            precondition: Condition::all(precondition).formula(span),
            effects,
            increases: (cost > 0).then(|| increase(cost)).into_iter().collect(),
            span,
        });
        self.notes.insert(ActionId(self.domain.actions.len() as u32 - 1), note);
    }

    /// Adds an action as it is.
    pub(super) fn push(&mut self, action: Action) {
        self.domain.signatures.push(Signature {
            name: action.name.clone(),
            doing: Doing::Action(ActionKind::Instant),
            parameters: action.scope.variables[..action.scope.parameters as usize].to_vec(),
            agent: false,
            action: Some(ActionId(self.domain.actions.len() as u32)),
        });
        self.domain.actions.push(action);
    }
}

/// Whether a variable of these types may be any object.
fn is_root(types: &[TypeId]) -> bool {
    types.is_empty() || types.contains(&OBJECT)
}

/// Replaces the root of all types.
fn under(types: &mut Vec<TypeId>, root: TypeId) {
    if is_root(types) {
        *types = vec![root];
    }
}

/// All names of a domain and a problem, in lower case.
fn names(domain: &Domain, problem: &Problem) -> HashSet<String> {
    let types = domain.types.iter().map(|one| &one.name);
    let predicates = domain.predicates.iter().map(|one| &one.name);
    let objects = problem.objects.iter().map(|one| &one.name);
    let actions = domain.actions.iter().map(|one| &one.name);
    let all = types.chain(predicates).chain(objects).chain(actions);
    let words = ["object", "number", "either", "total-cost"].map(str::to_owned);
    all.map(|name| name.text.to_lowercase()).chain(words).collect()
}

/// A formula and, besides, literals.
pub(super) fn also(formula: Formula, literals: Vec<(Atom, bool)>, span: Span) -> Formula {
    let mut nodes = formula.nodes;
    let mut parts = match nodes.pop() {
        Some(Node { kind: NodeKind::And(parts), .. }) => parts,
        Some(root) => {
            nodes.push(root);
            vec![NodeId(nodes.len() as u32 - 1)]
        }
        None => Vec::new(),
    };
    for (atom, holds) in literals {
        nodes.push(Node { kind: NodeKind::Atom(atom), span });
        if !holds {
            let atom = NodeId(nodes.len() as u32 - 1);
            nodes.push(Node { kind: NodeKind::Not(atom), span });
        }
        parts.push(NodeId(nodes.len() as u32 - 1));
    }
    if let [part] = parts[..]
        && part.index() + 1 == nodes.len()
    {
        return Formula { nodes };
    }
    nodes.push(Node { kind: NodeKind::And(parts), span });
    Formula { nodes }
}
