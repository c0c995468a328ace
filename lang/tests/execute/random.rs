//! Tiny domains, problems and plans, decided by a tape of bytes; a shorter tape and smaller bytes make simpler ones.

use std::collections::BTreeSet;

use lang::model::{
    Action, ActionId, Atom, Axiom, Domain, Effect, Expression, Fact, Formula, Function, FunctionId,
    FunctionValue, Increase, Literal, Metric, Name, Node, NodeId, NodeKind, Object, ObjectId,
    Predicate, PredicateId, Problem, Scope, Term, Type, TypeId, Variable, VariableId,
};
use lang::plan::{Plan, Step};
use lang::source::Span;
use lang::validate::Repair;
use rust_decimal::Decimal;

#[derive(Debug, Clone)]
pub struct Tape {
    bytes: Vec<u8>,
    at: usize,
}

impl Tape {
    pub fn new(bytes: Vec<u8>) -> Self {
        Self { bytes, at: 0 }
    }

    /// A number below `limit`; 0 behind the end.
    fn below(&mut self, limit: usize) -> usize {
        self.at += 1;
        self.bytes.get(self.at - 1).map_or(0, |&byte| byte as usize % limit)
    }

    fn flag(&mut self) -> bool {
        self.below(2) == 1
    }
}

#[derive(Debug)]
pub struct World {
    pub domain: Domain,
    pub problem: Problem,
}

const SPAN: Span = Span { source: lang::source::SourceId(0), start: 0, end: 0 };
const BASE: usize = 4;
const OBJECTS: usize = 3;

fn name(text: impl Into<String>) -> Name {
    Name { text: text.into(), span: SPAN }
}

/// `object`, `top`, `left` and `right` below `top`.
fn types() -> Vec<Type> {
    let named = |text, parents: &[u32], ancestors: &[u32]| Type {
        name: name(text),
        parents: parents.iter().map(|&id| TypeId(id)).collect(),
        ancestors: ancestors.iter().map(|&id| TypeId(id)).collect(),
    };
    vec![
        named("object", &[], &[0]),
        named("top", &[0], &[0, 1]),
        named("left", &[1], &[0, 1, 2]),
        named("right", &[1], &[0, 1, 3]),
    ]
}

fn variable(text: String, tape: &mut Tape) -> Variable {
    let types: &[u32] = [&[0][..], &[0], &[1], &[2], &[3], &[2, 3]][tape.below(6)];
    Variable { name: name(text), types: types.iter().map(|&id| TypeId(id)).collect() }
}

fn scope(parameters: usize, tape: &mut Tape) -> Scope {
    let variables = (0..parameters).map(|at| variable(format!("?p{at}"), tape)).collect();
    Scope { variables, parameters: parameters as u32 }
}

/// Builds formulas over the predicates whose arities it knows.
struct Builder<'a> {
    tape: &'a mut Tape,
    arities: &'a [usize],
    scope: Scope,
}

impl Builder<'_> {
    fn term(&mut self, visible: &[VariableId]) -> Term {
        let choice = self.tape.below(visible.len() * 2 + OBJECTS);
        match visible.get(choice / 2) {
            Some(&variable) if choice < visible.len() * 2 => Term::Variable(variable),
            _ => Term::Object(ObjectId(choice.saturating_sub(visible.len() * 2) as u32)),
        }
    }

    fn atom(&mut self, visible: &[VariableId], predicates: usize) -> Atom {
        let predicate = self.tape.below(predicates);
        let arguments = (0..self.arities[predicate]).map(|_| self.term(visible)).collect();
        Atom { predicate: PredicateId(predicate as u32), arguments }
    }

    fn bind(&mut self, visible: &[VariableId]) -> (Vec<VariableId>, Vec<VariableId>) {
        let count = 1 + self.tape.below(2);
        let new: Vec<_> = (0..count)
            .map(|_| {
                let at = self.scope.variables.len();
                let new = variable(format!("?v{at}"), self.tape);
                self.scope.variables.push(new);
                VariableId(at as u32)
            })
            .collect();
        (new.clone(), [visible, &new].concat())
    }

    fn formula(&mut self, visible: &[VariableId], depth: usize) -> Formula {
        let mut nodes = Vec::new();
        self.node(&mut nodes, visible, depth);
        Formula { nodes }
    }

    fn node(&mut self, nodes: &mut Vec<Node>, visible: &[VariableId], depth: usize) -> NodeId {
        let choice = if depth == 0 { 1 + self.tape.below(3) } else { self.tape.below(12) };
        let mut children = |builder: &mut Self, count: usize| -> Vec<NodeId> {
            (0..count).map(|_| builder.node(nodes, visible, depth - 1)).collect()
        };
        let kind = match choice {
            0 => NodeKind::And(Vec::new()),
            1 | 2 => NodeKind::Atom(self.atom(visible, self.arities.len())),
            3 => NodeKind::Equal(self.term(visible), self.term(visible)),
            4 | 5 => NodeKind::Not(children(self, 1)[0]),
            6 | 7 => {
                let count = self.tape.below(4);
                NodeKind::And(children(self, count))
            }
            8 => {
                let count = self.tape.below(4);
                NodeKind::Or(children(self, count))
            }
            9 => {
                let both = children(self, 2);
                NodeKind::Imply(both[0], both[1])
            }
            10 => {
                let (new, visible) = self.bind(visible);
                NodeKind::Exists(new, self.node(nodes, &visible, depth - 1))
            }
            _ => {
                let (new, visible) = self.bind(visible);
                NodeKind::Forall(new, self.node(nodes, &visible, depth - 1))
            }
        };
        nodes.push(Node { kind, span: SPAN });
        NodeId(nodes.len() as u32 - 1)
    }

    /// The variables and the condition of an effect.
    fn guard(&mut self, visible: &[VariableId]) -> (Vec<VariableId>, Vec<VariableId>, Formula) {
        let (new, visible) =
            if self.tape.flag() { self.bind(visible) } else { (Vec::new(), visible.to_vec()) };
        let condition =
            if self.tape.flag() { self.formula(&visible, 2) } else { Formula::truth(SPAN) };
        (new, visible, condition)
    }
}

fn function(text: &str, parameters: Vec<Variable>) -> Function {
    Function { name: name(text), parameters, values: None, read: None, assigned: false }
}

fn predicate(at: usize, arity: usize, derived: bool) -> Predicate {
    let parameters = (0..arity)
        .map(|at| Variable { name: name(format!("?a{at}")), types: vec![TypeId(0)] })
        .collect();
    Predicate { name: name(format!("p{at}")), parameters, derived, owner: None }
}

fn axiom(head: usize, arities: &[usize], tape: &mut Tape) -> Axiom {
    let scope = scope(arities[head], tape);
    let visible: Vec<_> = (0..scope.parameters).map(VariableId).collect();
    let mut builder = Builder { tape, arities, scope };
    let body = builder.formula(&visible, 3);
    Axiom { head: PredicateId(head as u32), scope: builder.scope, body, span: SPAN }
}

fn action(at: usize, arities: &[usize], tape: &mut Tape) -> Action {
    let scope = scope(tape.below(3), tape);
    let visible: Vec<_> = (0..scope.parameters).map(VariableId).collect();
    let mut builder = Builder { tape, arities, scope };
    let precondition = builder.formula(&visible, 3);
    let effects = (0..=builder.tape.below(3))
        .map(|_| {
            let (variables, visible, condition) = builder.guard(&visible);
            let literals = (0..=builder.tape.below(2))
                .map(|_| {
                    let atom = builder.atom(&visible, BASE);
                    Literal { positive: !builder.tape.flag(), atom, span: SPAN }
                })
                .collect();
            Effect { variables, condition, literals, span: SPAN }
        })
        .collect();
    let increases = (0..builder.tape.below(3))
        .map(|_| {
            let (variables, visible, condition) = builder.guard(&visible);
            let value = if builder.tape.flag() {
                Expression::Function(FunctionId(1), vec![builder.term(&visible)])
            } else {
                Expression::Number(Decimal::new(builder.tape.below(50) as i64, 1))
            };
            let function = FunctionId(if builder.tape.below(4) == 3 { 2 } else { 0 });
            Increase { variables, condition, function, arguments: Vec::new(), value, span: SPAN }
        })
        .collect();
    let name = name(format!("a{at}"));
    Action {
        name,
        scope: builder.scope,
        agent: false,
        precondition,
        effects,
        increases,
        span: SPAN,
    }
}

fn functions() -> Vec<Function> {
    let one = vec![Variable { name: name("?a"), types: vec![TypeId(0)] }];
    vec![function("total-cost", Vec::new()), function("weight", one), function("other", Vec::new())]
}

impl World {
    pub fn new(tape: &mut Tape) -> Self {
        let derived = tape.below(4);
        let mut arities: Vec<_> = [0, 1, 1, 2].to_vec();
        arities.extend((0..derived).map(|_| tape.below(3)));
        let predicates = arities
            .iter()
            .enumerate()
            .map(|(at, &arity)| predicate(at, arity, at >= BASE))
            .collect();
        let mut axioms = Vec::new();
        for head in BASE..arities.len() {
            // An early axiom sees fewer predicates, so that not every domain is circular.
            let seen = if tape.below(4) == 3 { arities.len() } else { head + 1 };
            for _ in 0..=tape.below(2) {
                axioms.push(axiom(head, &arities[..seen], tape));
            }
        }
        let actions = (0..2).map(|at| action(at, &arities, tape)).collect();
        let domain = Domain {
            name: name("d"),
            requirements: BTreeSet::new(),
            types: types(),
            constants: Vec::new(),
            predicates,
            functions: functions(),
            axioms,
            actions,
            signatures: Vec::new(),
            preferences: Vec::new(),
            uses: Vec::new(),
        };
        let problem = problem(&arities, tape);
        Self { domain, problem }
    }

    /// A step, mostly one that fits.
    pub fn step(&self, tape: &mut Tape) -> Step {
        let action = tape.below(self.domain.actions.len());
        let arguments = (0..self.domain.actions[action].scope.parameters)
            .map(|_| ObjectId(tape.below(OBJECTS) as u32))
            .collect();
        Step { action: ActionId(action as u32), arguments }
    }

    /// The plan with a step dropped, altered, doubled, or exchanged with its neighbour.
    pub fn mutate(&self, plan: &Plan, tape: &mut Tape) -> Plan {
        let mut steps = plan.steps.clone();
        if steps.is_empty() {
            return Plan { steps: vec![self.step(tape)] };
        }
        let at = tape.below(steps.len());
        match tape.below(4) {
            0 => drop(steps.remove(at)),
            1 => {
                let next = (at + 1) % steps.len();
                steps.swap(at, next);
            }
            2 => steps[at] = self.step(tape),
            _ => steps.insert(at, steps[at].clone()),
        }
        Plan { steps }
    }
}

fn problem(arities: &[usize], tape: &mut Tape) -> Problem {
    let objects = (0..OBJECTS)
        .map(|at| Object {
            name: name(format!("o{at}")),
            types: vec![TypeId(tape.below(4) as u32)],
            holder: None,
        })
        .collect();
    let mut init = Vec::new();
    for _ in 0..tape.below(8) {
        let predicate = tape.below(BASE);
        let arguments =
            (0..arities[predicate]).map(|_| ObjectId(tape.below(OBJECTS) as u32)).collect();
        let fact = Fact { predicate: PredicateId(predicate as u32), arguments };
        if !init.contains(&fact) {
            init.push(fact);
        }
    }
    let values = (0..OBJECTS as u32)
        .filter(|_| tape.below(5) < 4)
        .map(|at| {
            let arguments = [ObjectId(at)].into();
            FunctionValue {
                function: FunctionId(1),
                arguments,
                value: Decimal::from(at + 1),
                span: SPAN,
            }
        })
        .collect();
    let mut builder = Builder { tape, arities, scope: Scope::default() };
    let goal = builder.formula(&[], 3);
    let goal_scope = builder.scope;
    let metric = tape.flag().then_some(Metric { function: FunctionId(0), span: SPAN });
    Problem { name: name("p"), objects, init, values, goal_scope, goal, metric, uses: Vec::new() }
}

/// The plan as the repair wants it.
pub fn mended(plan: &Plan, repair: &Repair) -> Option<Plan> {
    let mut steps = plan.steps.clone();
    match repair {
        Repair::Move { step, before } => {
            let moved = steps.remove(*step);
            steps.insert(if before > step { before - 1 } else { *before }, moved);
        }
        Repair::Insert { step, before } => steps.insert(*before, step.clone()),
        Repair::Set(_) | Repair::None => return None,
    }
    Some(Plan { steps })
}
