//! A condition that is false goes in; its false parts, and the steps that made them so, come out.

use super::words::Words;
use crate::execute::joint::Acting;
use crate::execute::query::{Goal, Query, Shape, shape};
use crate::execute::{Change, Executor, State, View, ground, instance, value};
use crate::model::{Fact, Formula, NodeId, ObjectId, Scope};
use crate::plan::Step;
use crate::source::Span;

/// Disjunctions nested deeper than this are told as a whole.
const DEEPEST: usize = 4;

/// How many parts of one condition are told.
pub(super) const MOST: usize = 20;

/// How many conditions are evaluated to find them.
const EVALUATIONS: usize = 10_000;

/// How much may be evaluated to find when derived facts became what they are.
const WORK: u64 = 3_000_000;

/// A part of a condition that is false.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Part {
    /// What is wrong with it.
    pub what: What,
    /// Where it stands in the domain or the problem.
    pub span: Span,
}

/// What is wrong with a part of a condition.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum What {
    /// The fact must hold and does not.
    Missing {
        /// The fact.
        fact: Fact,
        /// The last step since which it does not hold; none if it never held before.
        since: Option<usize>,
    },
    /// The fact must not hold and does.
    Forbidden {
        /// The fact.
        fact: Fact,
        /// The last step since which it holds; none if it held from the beginning.
        since: Option<usize>,
    },
    /// The action must stand in the joint action and does not, or must not and does.
    Action {
        /// The action.
        step: Step,
        /// Whether it must.
        wanted: bool,
    },
    /// Two terms must be the same object and are these.
    Different {
        /// The condition as it is written.
        text: String,
        /// The objects.
        objects: [ObjectId; 2],
    },
    /// Two terms must be different objects and are both this one.
    Same {
        /// The condition as it is written.
        text: String,
        /// The object.
        object: ObjectId,
    },
    /// No alternative holds, or no object will do.
    Unmet {
        /// The condition, with objects in place of its parameters.
        text: String,
        /// Why each alternative is false; empty where objects would have to be named.
        parts: Vec<Part>,
    },
}

/// A condition that is false, and where.
pub(super) struct Site<'a> {
    pub(super) executor: &'a Executor<'a>,
    /// The state in which it is false.
    pub(super) state: &'a State,
    /// What each step has changed up to there.
    pub(super) history: &'a [Change],
    pub(super) scope: &'a Scope,
    pub(super) formula: &'a Formula,
    pub(super) binding: Vec<Option<ObjectId>>,
    /// The joint action that it may ask about.
    pub(super) joint: Option<Acting<'a>>,
}

/// The false parts of the condition at `site`, in the order of the text.
pub(super) fn parts(site: &Site<'_>) -> Vec<Part> {
    let query = Query::new(site.formula);
    let mut explainer = Explainer { site, query: &query, evaluations: EVALUATIONS };
    let mut parts = explainer.parts(Goal::Holds(site.formula.root()), site.binding.clone(), 0);
    date(site, &mut parts);
    parts
}

struct Explainer<'a> {
    site: &'a Site<'a>,
    query: &'a Query,
    evaluations: usize,
}

type Binding = Vec<Option<ObjectId>>;

impl Explainer<'_> {
    /// The false parts of `goal`, which is false and closed.
    fn parts(&mut self, goal: Goal, binding: Binding, depth: usize) -> Vec<Part> {
        let mut parts = Vec::new();
        let mut open = vec![(goal, binding)];
        while let Some((goal, binding)) = open.pop() {
            if parts.len() == MOST {
                break;
            }
            let (Goal::Holds(node) | Goal::Fails(node)) = goal else {
                unreachable!("a part is a node")
            };
            let span = self.site.formula.nodes[node.index()].span;
            let what = match shape(self.site.formula, goal) {
                Shape::All(goals) => {
                    let alone = goals.len() == 1;
                    for goal in goals {
                        if alone || !self.holds(goal, &binding) {
                            open.push((goal, binding.clone()));
                        }
                    }
                    continue;
                }
                Shape::No(variables, below) => {
                    let goals =
                        variables.iter().map(|&variable| Goal::Binds(variable)).chain([below]);
                    let witness = self.witness(goals.collect(), &binding);
                    open.push((opposite(below), witness));
                    continue;
                }
                Shape::Atom(atom, wanted) => self.atom(ground(atom, &binding), wanted),
                Shape::Action(_, atom, wanted) => {
                    let arguments = instance(&atom.arguments, &binding);
                    What::Action { step: Step { action: atom.action, arguments }, wanted }
                }
                Shape::Equal(left, right, wanted) => {
                    let object = |term| value(term, &binding).expect("the condition is closed");
                    let text = self.text(goal, node, &vec![None; binding.len()]);
                    if wanted {
                        What::Different { text, objects: [object(left), object(right)] }
                    } else {
                        What::Same { text, object: object(left) }
                    }
                }
                Shape::Any(goals) if depth < DEEPEST => {
                    let text = self.text(goal, node, &binding);
                    let each = goals.into_iter().rev();
                    let mut parts: Vec<_> = each
                        .take(MOST)
                        .flat_map(|goal| self.parts(goal, binding.clone(), depth + 1))
                        .collect();
                    parts.truncate(MOST);
                    What::Unmet { text, parts }
                }
                Shape::Any(_) | Shape::Some(..) => {
                    What::Unmet { text: self.text(goal, node, &binding), parts: Vec::new() }
                }
            };
            parts.push(Part { what, span });
        }
        parts
    }

    fn text(&self, goal: Goal, node: NodeId, binding: &[Option<ObjectId>]) -> String {
        let executor = self.site.executor;
        let words = Words { domain: executor.domain(), problem: executor.problem() };
        let text = words.formula(self.site.scope, self.site.formula, node, binding);
        if matches!(goal, Goal::Fails(_)) { format!("(not {text})") } else { text }
    }

    /// Whether a closed goal holds. When too many were asked, it is taken to be false: it is told rather than left out.
    fn holds(&mut self, goal: Goal, binding: &[Option<ObjectId>]) -> bool {
        let Some(left) = self.evaluations.checked_sub(1) else { return false };
        self.evaluations = left;
        let formula = (self.site.formula, self.query);
        self.site
            .executor
            .solutions(self.view(), self.site.scope, formula, binding.to_vec(), vec![goal])
            .advance()
    }

    fn witness(&self, goals: Vec<Goal>, binding: &[Option<ObjectId>]) -> Binding {
        let formula = (self.site.formula, self.query);
        let mut solutions = self.site.executor.solutions(
            self.view(),
            self.site.scope,
            formula,
            binding.to_vec(),
            goals,
        );
        assert!(solutions.advance(), "a universal condition that is false has a counterexample");
        solutions.binding().to_vec()
    }

    fn view(&self) -> View<'_> {
        View { joint: self.site.joint, ..self.site.executor.view(self.site.state) }
    }

    fn atom(&self, fact: Fact, wanted: bool) -> What {
        let since = self.since(&fact, wanted);
        if wanted { What::Missing { fact, since } } else { What::Forbidden { fact, since } }
    }

    /// The last step that made `fact` hold, or not hold if it is `wanted`; nothing of derived facts yet.
    fn since(&self, fact: &Fact, wanted: bool) -> Option<usize> {
        self.site.history.iter().rposition(|change| {
            let facts = if wanted { &change.deleted } else { &change.added };
            facts.contains(fact)
        })
    }
}

/// Dates the derived facts among `parts`: goes back through the states until each is no longer what it is in the last one.
fn date(site: &Site<'_>, parts: &mut [Part]) {
    let Site { executor, history, .. } = site;
    let mut open = Vec::new();
    let mut lists = vec![parts];
    while let Some(parts) = lists.pop() {
        for part in parts {
            match &mut part.what {
                What::Missing { fact, since } => open.push((fact, since, true)),
                What::Forbidden { fact, since } => open.push((fact, since, false)),
                What::Unmet { parts, .. } => lists.push(parts),
                What::Different { .. } | What::Same { .. } | What::Action { .. } => {}
            }
        }
    }
    open.retain(|(fact, ..)| executor.domain().predicates[fact.predicate.index()].derived);
    let mut state = site.state.clone();
    let limit = executor.work() + WORK;
    for (at, change) in history.iter().enumerate().rev() {
        if open.is_empty() || executor.work() > limit {
            return;
        }
        executor.revert(&mut state, change);
        open.retain_mut(|(fact, since, wanted)| {
            let differs = executor.contains(&state, fact) == *wanted;
            if differs {
                **since = Some(at);
            }
            !differs
        });
    }
}

fn opposite(goal: Goal) -> Goal {
    match goal {
        Goal::Holds(node) => Goal::Fails(node),
        Goal::Fails(node) => Goal::Holds(node),
        Goal::Binds(_) => goal,
    }
}
