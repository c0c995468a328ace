//! The second interpreter: sets of facts, recursion on formulas, and the product of all objects for every variable.

use std::collections::{BTreeSet, HashMap};

use lang::model::{
    ActionId, Atom, Domain, Expression, Fact, Formula, NodeId, NodeKind, ObjectId, PredicateId,
    Problem, Scope, Term, VariableId,
};
use lang::plan::{Plan, Step};
use rust_decimal::Decimal;

pub type Facts = BTreeSet<Fact>;
type Binding = HashMap<VariableId, ObjectId>;

pub struct Naive<'a> {
    domain: &'a Domain,
    problem: &'a Problem,
    level: Vec<usize>,
}

impl<'a> Naive<'a> {
    /// Nothing if negation goes round in a circle.
    pub fn new(domain: &'a Domain, problem: &'a Problem) -> Option<Self> {
        let mut level = vec![0; domain.predicates.len()];
        loop {
            let before = level.clone();
            for axiom in &domain.axioms {
                for (predicate, positive) in occurrences(&axiom.body, axiom.body.root(), true) {
                    if !domain.predicates[predicate.index()].derived {
                        continue;
                    }
                    let least = level[predicate.index()] + usize::from(!positive);
                    level[axiom.head.index()] = level[axiom.head.index()].max(least);
                }
            }
            if level == before {
                return Some(Self { domain, problem, level });
            }
            if level.iter().any(|&level| level > domain.predicates.len()) {
                return None;
            }
        }
    }

    pub fn initial(&self) -> Facts {
        self.problem.init.iter().cloned().collect()
    }

    fn products(&self, count: usize) -> Vec<Vec<ObjectId>> {
        let mut products = vec![Vec::new()];
        for _ in 0..count {
            products = products
                .iter()
                .flat_map(|product: &Vec<ObjectId>| {
                    (0..self.problem.objects.len() as u32)
                        .map(move |object| [product.as_slice(), &[ObjectId(object)]].concat())
                })
                .collect();
        }
        products
    }

    pub fn all_facts(&self) -> Vec<Fact> {
        let mut facts = Vec::new();
        for (at, predicate) in self.domain.predicates.iter().enumerate() {
            for product in self.products(predicate.parameters.len()) {
                facts.push(Fact { predicate: PredicateId(at as u32), arguments: product.into() });
            }
        }
        facts
    }

    fn bindings(&self, scope: &Scope, variables: &[VariableId], outer: &Binding) -> Vec<Binding> {
        let mut bindings = Vec::new();
        for product in self.products(variables.len()) {
            let mut binding = outer.clone();
            let fits = variables.iter().zip(product).all(|(&variable, object)| {
                binding.insert(variable, object);
                let types = &scope.variables[variable.index()].types;
                self.domain.has_type(&self.problem.objects[object.index()], types)
            });
            if fits {
                bindings.push(binding);
            }
        }
        bindings
    }

    /// The facts and all that the axioms derive from them.
    pub fn derived(&self, facts: &Facts) -> Facts {
        let mut facts = facts.clone();
        for level in 0..=self.domain.predicates.len() {
            loop {
                let mut new = Facts::new();
                for axiom in self
                    .domain
                    .axioms
                    .iter()
                    .filter(|axiom| self.level[axiom.head.index()] == level)
                {
                    let parameters: Vec<_> = (0..axiom.scope.parameters).map(VariableId).collect();
                    for binding in self.bindings(&axiom.scope, &parameters, &Binding::new()) {
                        if self.holds(
                            &facts,
                            &axiom.scope,
                            &axiom.body,
                            axiom.body.root(),
                            &binding,
                        ) {
                            let arguments =
                                parameters.iter().map(|variable| binding[variable]).collect();
                            new.insert(Fact { predicate: axiom.head, arguments });
                        }
                    }
                }
                let count = facts.len();
                facts.append(&mut new);
                if facts.len() == count {
                    break;
                }
            }
        }
        facts
    }

    fn holds(
        &self,
        facts: &Facts,
        scope: &Scope,
        formula: &Formula,
        node: NodeId,
        binding: &Binding,
    ) -> bool {
        let below =
            |child: NodeId, binding: &Binding| self.holds(facts, scope, formula, child, binding);
        match formula.kind(node) {
            NodeKind::Atom(atom) => facts.contains(&ground(atom, binding)),
            NodeKind::Action(_) => panic!("nothing here asks about joint actions"),
            NodeKind::Equal(left, right) => object(*left, binding) == object(*right, binding),
            NodeKind::Not(child) => !below(*child, binding),
            NodeKind::And(children) => children.iter().all(|&child| below(child, binding)),
            NodeKind::Or(children) => children.iter().any(|&child| below(child, binding)),
            NodeKind::Imply(left, right) => !below(*left, binding) || below(*right, binding),
            NodeKind::Forall(variables, child) => self
                .bindings(scope, variables, binding)
                .iter()
                .all(|binding| below(*child, binding)),
            NodeKind::Exists(variables, child) => self
                .bindings(scope, variables, binding)
                .iter()
                .any(|binding| below(*child, binding)),
        }
    }

    pub fn goal(&self, facts: &Facts) -> bool {
        let goal = &self.problem.goal;
        self.holds(
            &self.derived(facts),
            &self.problem.goal_scope,
            goal,
            goal.root(),
            &Binding::new(),
        )
    }

    fn binding(step: &Step) -> Binding {
        step.arguments
            .iter()
            .enumerate()
            .map(|(at, &object)| (VariableId(at as u32), object))
            .collect()
    }

    pub fn applicable(&self, facts: &Facts, step: &Step) -> bool {
        let action = &self.domain.actions[step.action.index()];
        let parameters = &action.scope.variables[..action.scope.parameters as usize];
        step.arguments.len() == parameters.len()
            && step.arguments.iter().zip(parameters).all(|(&object, parameter)| {
                self.domain.has_type(&self.problem.objects[object.index()], &parameter.types)
            })
            && self.holds(
                &self.derived(facts),
                &action.scope,
                &action.precondition,
                action.precondition.root(),
                &Self::binding(step),
            )
    }

    pub fn apply(&self, facts: &Facts, step: &Step) -> Facts {
        let action = &self.domain.actions[step.action.index()];
        let derived = self.derived(facts);
        let (mut deletes, mut adds) = (Facts::new(), Facts::new());
        for effect in &action.effects {
            for binding in self.bindings(&action.scope, &effect.variables, &Self::binding(step)) {
                let condition = &effect.condition;
                if self.holds(&derived, &action.scope, condition, condition.root(), &binding) {
                    for literal in &effect.literals {
                        let facts = if literal.positive { &mut adds } else { &mut deletes };
                        facts.insert(ground(&literal.atom, &binding));
                    }
                }
            }
        }
        facts.difference(&deletes).chain(&adds).cloned().collect()
    }

    pub fn cost(&self, facts: &Facts, step: &Step) -> Option<Decimal> {
        let Some(metric) = &self.problem.metric else { return Some(Decimal::ONE) };
        let action = &self.domain.actions[step.action.index()];
        let derived = self.derived(facts);
        let mut sum = Decimal::ZERO;
        for increase in
            action.increases.iter().filter(|increase| increase.function == metric.function)
        {
            for binding in self.bindings(&action.scope, &increase.variables, &Self::binding(step)) {
                let condition = &increase.condition;
                if !self.holds(&derived, &action.scope, condition, condition.root(), &binding) {
                    continue;
                }
                sum += match &increase.value {
                    Expression::Number(number) => *number,
                    Expression::Function(function, arguments) => {
                        let arguments: Box<[_]> =
                            arguments.iter().map(|&term| object(term, &binding)).collect();
                        let known = |value: &&lang::model::FunctionValue| {
                            value.function == *function && value.arguments == arguments
                        };
                        self.problem.values.iter().find(known)?.value
                    }
                };
            }
        }
        Some(sum)
    }

    /// The cost of a valid plan.
    pub fn validate(&self, plan: &Plan) -> Option<Decimal> {
        let mut facts = self.initial();
        let mut cost = Decimal::ZERO;
        for step in &plan.steps {
            if !self.applicable(&facts, step) {
                return None;
            }
            cost += self.cost(&facts, step)?;
            facts = self.apply(&facts, step);
        }
        self.goal(&facts).then_some(cost)
    }

    /// Whether the plan is valid but for steps without a cost.
    pub fn is_executable(&self, plan: &Plan) -> bool {
        let mut facts = self.initial();
        plan.steps.iter().all(|step| {
            let applicable = self.applicable(&facts, step);
            facts = if applicable { self.apply(&facts, step) } else { facts.clone() };
            applicable
        }) && self.goal(&facts)
    }

    /// A shortest plan of at most `longest` steps.
    pub fn plan(&self, longest: usize) -> Option<Plan> {
        let mut steps = Vec::new();
        for (at, action) in self.domain.actions.iter().enumerate() {
            for product in self.products(action.scope.parameters as usize) {
                steps.push(Step { action: ActionId(at as u32), arguments: product.into() });
            }
        }
        let mut layer = vec![(self.initial(), Plan::default())];
        for _ in 0..=longest {
            if let Some((_, plan)) = layer.iter().find(|(facts, _)| self.goal(facts)) {
                return Some(plan.clone());
            }
            let mut next: Vec<(Facts, Plan)> = Vec::new();
            for (facts, plan) in &layer {
                for step in steps.iter().filter(|step| self.applicable(facts, step)) {
                    let after = self.apply(facts, step);
                    if next.len() < 30 && !next.iter().any(|(seen, _)| *seen == after) {
                        let mut plan = plan.clone();
                        plan.steps.push(step.clone());
                        next.push((after, plan));
                    }
                }
            }
            layer = next;
        }
        None
    }
}

fn object(term: Term, binding: &Binding) -> ObjectId {
    match term {
        Term::Variable(variable) => binding[&variable],
        Term::Object(object) => object,
    }
}

fn ground(atom: &Atom, binding: &Binding) -> Fact {
    let arguments = atom.arguments.iter().map(|&term| object(term, binding)).collect();
    Fact { predicate: atom.predicate, arguments }
}

/// The predicates of a formula, each with whether it stands under an even number of negations.
fn occurrences(formula: &Formula, node: NodeId, positive: bool) -> Vec<(PredicateId, bool)> {
    let below = |child: &NodeId, positive| occurrences(formula, *child, positive);
    match formula.kind(node) {
        NodeKind::Atom(atom) => vec![(atom.predicate, positive)],
        NodeKind::Equal(..) | NodeKind::Action(_) => Vec::new(),
        NodeKind::Not(child) => below(child, !positive),
        NodeKind::And(children) | NodeKind::Or(children) => {
            children.iter().flat_map(|child| below(child, positive)).collect()
        }
        NodeKind::Imply(left, right) => [below(left, !positive), below(right, positive)].concat(),
        NodeKind::Forall(_, child) | NodeKind::Exists(_, child) => below(child, positive),
    }
}
