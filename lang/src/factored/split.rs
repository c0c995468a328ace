//! The domain and the problem of all agents go in; the files of each come out, or what no agent's file could say.

use hashbrown::HashSet;

use super::translate::{Conjunct, Ids, conjoin, conjuncts};
use super::{Part, agents, signatures, written};
use crate::diagnostic::{Diagnostics, unsupported_feature};
use crate::model::{
    Action, Domain, Formula, FunctionId, Holder, NodeKind, Object, ObjectId, Owner, Predicate,
    PredicateId, Problem, Requirement, Term, TypeId,
};
use crate::source::Span;

/// Takes a task apart into what each agent knows: all that is public, and what is private to it.
pub fn split(domain: &Domain, problem: &Problem) -> Result<Vec<Part>, Diagnostics> {
    let mut splitter = Splitter {
        domain,
        problem,
        goals: conjuncts(&problem.goal, &problem.goal_scope),
        said: HashSet::new(),
        lost: Lost::of(domain, problem),
        diagnostics: Diagnostics::default(),
    };
    splitter.lost.goals = vec![true; splitter.goals.len()];
    let agents = agents(domain, problem);
    if agents.is_empty() {
        splitter.refuse(domain.name.span, "no object of this problem is an agent".to_owned());
    }
    for action in domain.actions.iter().filter(|action| !action.agent) {
        let message =
            format!("action `{}` has no agent, so it belongs to nobody", action.name.text);
        splitter.refuse(action.name.span, message);
    }
    let parts = agents.iter().map(|&agent| splitter.part(agent)).collect();
    splitter.report();
    if splitter.diagnostics.has_errors() { Err(splitter.diagnostics) } else { Ok(parts) }
}

/// What no part has got so far.
struct Lost {
    facts: Vec<bool>,
    values: Vec<bool>,
    goals: Vec<bool>,
    axioms: Vec<bool>,
}

impl Lost {
    fn of(domain: &Domain, problem: &Problem) -> Self {
        Self {
            facts: vec![true; problem.init.len()],
            values: vec![true; problem.values.len()],
            goals: Vec::new(),
            axioms: vec![true; domain.axioms.len()],
        }
    }
}

struct Splitter<'m> {
    domain: &'m Domain,
    problem: &'m Problem,
    /// What the goal demands, one by one.
    goals: Vec<Conjunct>,
    /// The places about which something has been said.
    said: HashSet<Span>,
    lost: Lost,
    diagnostics: Diagnostics,
}

impl Splitter<'_> {
    fn refuse(&mut self, span: Span, message: String) {
        if self.said.insert(span) {
            let label = "no file of one agent can say this";
            self.diagnostics.push(unsupported_feature::RULE.at(span, message, label));
        }
    }

    /// Says what belongs to nobody, the first of each kind.
    fn report(&mut self) {
        let first = |lost: &[bool]| lost.iter().position(|&lost| lost);
        let name = self.problem.name.span;
        if let Some(fact) = first(&self.lost.facts) {
            let fact = &self.problem.init[fact];
            let fact = written(fact, self.domain, self.problem);
            self.refuse(name, format!("no agent knows all of the fact `{fact}`"));
        }
        if let Some(value) = first(&self.lost.values) {
            let message = "no agent knows all of this value".to_owned();
            self.refuse(self.problem.values[value].span, message);
        }
        if let Some(goal) = first(&self.lost.goals) {
            let goal = &self.goals[goal].formula;
            let span = goal.nodes[goal.root().index()].span;
            self.refuse(span, "no agent knows all of this goal".to_owned());
        }
        if let Some(axiom) = first(&self.lost.axioms) {
            let message = "no agent knows all of this rule".to_owned();
            self.refuse(self.domain.axioms[axiom].span, message);
        }
    }

    /// What one agent knows.
    fn part(&mut self, agent: ObjectId) -> Part {
        let (domain, ids) = self.domain_of(agent);
        let problem = self.problem_of(agent, &domain, &ids);
        Part { agent: self.problem.objects[agent.index()].name.text.clone(), domain, problem }
    }

    fn domain_of(&mut self, agent: ObjectId) -> (Domain, Ids) {
        let whole = self.domain;
        let actor = &self.problem.objects[agent.index()];
        let owns = |predicate: &Predicate| {
            predicate.owner.as_ref().is_none_or(|owner| whole.has_type(actor, &owner.types))
        };
        let knows = |(id, object): (u32, &Object)| {
            id == agent.0
                || matches!(object.holder, None | Some(Holder::File))
                || object.holder == Some(Holder::Agent(agent))
        };
        let objects = (0..).zip(&self.problem.objects);
        let ids = Ids {
            types: (0..whole.types.len() as u32).map(TypeId).collect(),
            predicates: positions(whole.predicates.iter().map(owns))
                .map(|id| id.map(PredicateId))
                .collect(),
            functions: (0..whole.functions.len() as u32).map(FunctionId).collect(),
            objects: positions(objects.map(knows)).map(|id| id.map(ObjectId)).collect(),
            shift: 0,
        };
        let constants = whole.constants.len();
        let mut requirements = whole.requirements.clone();
        requirements.remove(&Requirement::UnfactoredPrivacy);
        requirements.insert(Requirement::FactoredPrivacy);
        let mut domain = Domain {
            requirements,
            constants: self.objects(0..constants, &ids),
            predicates: whole.predicates.iter().filter(|one| owns(one)).map(private).collect(),
            axioms: Vec::new(),
            actions: Vec::new(),
            ..whole.clone()
        };
        for (at, axiom) in whole.axioms.iter().enumerate() {
            if let Ok(axiom) = ids.axiom(axiom) {
                domain.axioms.push(axiom);
                self.lost.axioms[at] = false;
            }
        }
        for action in whole.actions.iter().filter(|action| action.agent) {
            if whole.has_type(actor, &action.scope.variables[0].types) {
                match ids.action(action) {
                    Ok(translated) => domain.actions.push(Action { agent: false, ..translated }),
                    Err(span) => self.strange(action, agent, span),
                }
            }
        }
        domain.signatures = signatures(&domain.actions);
        (domain, ids)
    }

    /// Says why an action cannot stand in the file of its agent.
    fn strange(&mut self, action: &Action, agent: ObjectId, span: Span) {
        let name = &action.name.text;
        let asks = |formula: &Formula| {
            formula
                .nodes
                .iter()
                .any(|node| node.span == span && matches!(node.kind, NodeKind::Action(_)))
        };
        let conditions = action.effects.iter().map(|effect| &effect.condition);
        let joint = conditions.chain([&action.precondition]).any(asks);
        let agent = &self.problem.objects[agent.index()].name.text;
        self.refuse(
            span,
            if joint {
                format!("action `{name}` asks what other agents do at the same time")
            } else {
                format!("action `{name}` of agent `{agent}` uses what is private to another agent")
            },
        );
    }

    /// The known ones of some objects, with what is private to the agent.
    fn objects(&self, range: std::ops::Range<usize>, ids: &Ids) -> Vec<Object> {
        let known = range.filter(|&at| ids.objects[at].is_some());
        let object = |at: usize| {
            let object = &self.problem.objects[at];
            Object { holder: object.holder.map(|_| Holder::File), ..object.clone() }
        };
        known.map(object).collect()
    }

    fn problem_of(&mut self, agent: ObjectId, domain: &Domain, ids: &Ids) -> Problem {
        let whole = self.problem;
        let mut init = Vec::new();
        for (at, fact) in whole.init.iter().enumerate() {
            let predicate = &self.domain.predicates[fact.predicate.index()];
            if is_own(predicate, agent, |position| Some(fact.arguments[position]))
                && let Some(fact) = ids.fact(fact)
            {
                init.push(fact);
                self.lost.facts[at] = false;
            }
        }
        let mut values = Vec::new();
        for (at, value) in whole.values.iter().enumerate() {
            if let Some(value) = ids.value(value) {
                values.push(value);
                self.lost.values[at] = false;
            }
        }
        let mut goals = Vec::new();
        for (at, goal) in self.goals.iter().enumerate() {
            let own = goal.formula.nodes.iter().all(|node| match &node.kind {
                NodeKind::Atom(atom) => {
                    let predicate = &self.domain.predicates[atom.predicate.index()];
                    is_own(predicate, agent, |position| match atom.arguments[position] {
                        Term::Object(id) => Some(id),
                        Term::Variable(_) => None,
                    })
                }
                _ => true,
            });
            if own && let Ok(formula) = ids.formula(&goal.formula) {
                goals.push(Conjunct { formula, scope: goal.scope.clone() });
                self.lost.goals[at] = false;
            }
        }
        let span = whole.goal.nodes[whole.goal.root().index()].span;
        let (goal, goal_scope) = conjoin(goals, span);
        let mut objects = domain.constants.clone();
        objects.extend(self.objects(self.domain.constants.len()..whole.objects.len(), ids));
        Problem { objects, init, values, goal_scope, goal, ..whole.clone() }
    }
}

/// Whether an atom of a predicate is the agent's, as far as one can see from its arguments.
fn is_own(
    predicate: &Predicate,
    agent: ObjectId,
    argument: impl Fn(usize) -> Option<ObjectId>,
) -> bool {
    let position = predicate.owner.as_ref().and_then(|owner| owner.position);
    position.and_then(argument).is_none_or(|owner| owner == agent)
}

/// A predicate as the file of its owner declares it: what was the agent is called so.
fn private(predicate: &Predicate) -> Predicate {
    let mut predicate = predicate.clone();
    if let Some(Owner { position, span, .. }) = predicate.owner {
        if let Some(parameter) = position.and_then(|at| predicate.parameters.get_mut(at)) {
            super::AGENT.clone_into(&mut parameter.name.text);
        }
        predicate.owner = Some(Owner { position: None, types: Vec::new(), span });
    }
    predicate
}

/// Counts those that are kept.
fn positions(kept: impl Iterator<Item = bool>) -> impl Iterator<Item = Option<u32>> {
    let mut next = 0;
    kept.map(move |kept| {
        next += u32::from(kept);
        kept.then(|| next - 1)
    })
}
