//! What each agent knows of the problem goes in: what holds at first, what is wanted and what is minimised; all of it together comes out.

use hashbrown::{HashMap, HashSet};

use super::Merger;
use crate::diagnostic::parts_disagree::{self, Sides};
use crate::factored::translate::{Conjunct, conjoin, conjuncts};
use crate::factored::written;
use crate::model::{Fact, FunctionId, NodeKind, ObjectId, PredicateId, Scope, Term};
use crate::source::Span;

impl Merger<'_> {
    /// What holds at first, and the values of functions.
    pub(super) fn initial(&mut self) {
        let mut seen: HashSet<Fact> = HashSet::new();
        let mut own: Vec<HashSet<Fact>> = Vec::new();
        let mut values: HashMap<(FunctionId, Box<[ObjectId]>), usize> = HashMap::new();
        for at in 0..self.parts.len() {
            let problem = &self.parts[at].problem;
            let facts: Vec<Fact> =
                problem.init.iter().filter_map(|fact| self.ids[at].fact(fact)).collect();
            for fact in &facts {
                if seen.insert(fact.clone()) {
                    self.problem.init.push(fact.clone());
                }
            }
            own.push(facts.into_iter().collect());
            for value in problem
                .values
                .iter()
                .filter_map(|value| self.ids[at].value(value))
                .collect::<Vec<_>>()
            {
                let next = self.problem.values.len();
                let id = *values.entry((value.function, value.arguments.clone())).or_insert(next);
                if id == next {
                    self.problem.values.push(value);
                    continue;
                }
                let before = &self.problem.values[id];
                if before.value != value.value {
                    let name = &self.domain.functions[value.function.index()].name.text;
                    let about = format!("the value of `{name}`");
                    let how = [before.value.to_string(), value.value.to_string()];
                    let spans = [before.span, value.span];
                    self.disagree(&about, Sides { how, spans });
                }
            }
        }
        self.missing(&own);
    }

    /// Warns of a public fact that an agent does not know though it knows all that is named in it.
    fn missing(&mut self, own: &[HashSet<Fact>]) {
        for (at, facts) in own.iter().enumerate() {
            let ids = &self.ids[at];
            let predicates: HashSet<PredicateId> =
                ids.predicates.iter().flatten().copied().collect();
            let objects: HashSet<ObjectId> = ids.objects.iter().flatten().copied().collect();
            let public = |fact: &&Fact| {
                self.domain.predicates[fact.predicate.index()].owner.is_none()
                    && predicates.contains(&fact.predicate)
                    && fact.arguments.iter().all(|object| objects.contains(object))
            };
            let Some(fact) =
                self.problem.init.iter().filter(public).find(|fact| !facts.contains(*fact))
            else {
                continue;
            };
            let shown = written(fact, &self.domain, &self.problem);
            let knows = own.iter().position(|facts| facts.contains(fact)).unwrap_or(at);
            let spans = [knows, at].map(|at| self.parts[at].problem.name.span);
            let how = ["it holds at first".to_owned(), "it does not".to_owned()];
            let about = format!("the public fact `{shown}`");
            let diagnostic = parts_disagree::parts_disagree(&about, Sides { how, spans });
            self.diagnostics.push(parts_disagree::only_a_warning(diagnostic));
        }
    }

    /// What all agents want. Those that do not want the same of what all know are told so.
    pub(super) fn goal(&mut self) {
        let mut all: Vec<Conjunct> = Vec::new();
        let mut wanted: Vec<Vec<usize>> = Vec::new();
        for (part, ids) in self.parts.iter().zip(&self.ids) {
            let mut own = Vec::new();
            for conjunct in conjuncts(&part.problem.goal, &part.problem.goal_scope) {
                let Ok(formula) = ids.formula(&conjunct.formula) else { continue };
                let variables = ids.variables(&conjunct.scope.variables);
                let conjunct = Conjunct { formula, scope: Scope { variables, parameters: 0 } };
                let place = all.iter().position(|one| one.same(&conjunct));
                if self.public(&conjunct) {
                    own.push(place.unwrap_or(all.len()));
                }
                if place.is_none() {
                    all.push(conjunct);
                }
            }
            wanted.push(own);
        }
        if let Some(first) = self.parts.first() {
            let span = first.problem.goal.nodes[first.problem.goal.root().index()].span;
            for at in 1..wanted.len() {
                if wanted[at].len() == wanted[0].len()
                    && wanted[at].iter().all(|goal| wanted[0].contains(goal))
                {
                    continue;
                }
                let goal = &self.parts[at].problem.goal;
                let spans = [span, goal.nodes[goal.root().index()].span];
                let how = [0, at].map(|at| format!("what `{}` wants", self.parts[at].agent));
                let diagnostic = parts_disagree::parts_disagree("the goal", Sides { how, spans });
                self.diagnostics.push(parts_disagree::only_a_warning(diagnostic));
            }
            (self.problem.goal, self.problem.goal_scope) = conjoin(all, span);
        }
    }

    /// Whether all agents can know what is named in a part of a goal.
    fn public(&self, conjunct: &Conjunct) -> bool {
        let common = |term: &Term| match term {
            Term::Object(id) => self.problem.objects[id.index()].holder.is_none(),
            Term::Variable(_) => true,
        };
        conjunct.formula.nodes.iter().all(|node| match &node.kind {
            NodeKind::Atom(atom) => {
                self.domain.predicates[atom.predicate.index()].owner.is_none()
                    && atom.arguments.iter().all(common)
            }
            NodeKind::Equal(left, right) => common(left) && common(right),
            _ => true,
        })
    }

    pub(super) fn metric(&mut self) {
        let mut first: Option<(Option<FunctionId>, Span)> = None;
        for (part, ids) in self.parts.iter().zip(&self.ids) {
            let mut metric = part.problem.metric.clone();
            if let Some(metric) = &mut metric {
                metric.function = ids.functions[metric.function.index()];
            }
            let function = metric.as_ref().map(|metric| metric.function);
            let span = metric.as_ref().map_or(part.problem.name.span, |metric| metric.span);
            let (before, place) = *first.get_or_insert((function, span));
            if before == function {
                self.problem.metric = self.problem.metric.take().or(metric);
                continue;
            }
            let shown = |function: Option<FunctionId>| {
                function.map_or("none".to_owned(), |id| {
                    self.domain.functions[id.index()].name.text.clone()
                })
            };
            let how = [shown(before), shown(function)];
            let diagnostic =
                parts_disagree::parts_disagree("the metric", Sides { how, spans: [place, span] });
            self.diagnostics.push(diagnostic);
        }
    }
}
