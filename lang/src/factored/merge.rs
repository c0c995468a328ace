//! What each agent knows goes in; the domain and the problem of all of them come out, with everything about which they disagree.

mod problem;

use hashbrown::{HashMap, HashSet};

use super::translate::{Ids, same_action, same_axiom};
use super::{AGENT, Part, highest, same, signatures};
use crate::diagnostic::parts_disagree::{self, Sides};
use crate::diagnostic::{Diagnostics, agent_list_mismatch};
use crate::model::{
    Action, Domain, Formula, Function, FunctionId, Holder, Name, Object, ObjectId, Owner,
    Predicate, PredicateId, Problem, Requirement, Scope, Type, TypeId, Use, Variable,
};
use crate::source::Span;

/// Puts the parts of a task together. There are always models: they contain what could be understood.
pub fn merge(parts: &[Part]) -> (Domain, Problem, Diagnostics) {
    let mut merger = Merger::new(parts);
    merger.types();
    merger.objects();
    merger.agents();
    merger.predicates();
    merger.functions();
    // Where one name means two things, all that names it would seem to differ.
    if !merger.diagnostics.has_errors() {
        merger.axioms();
        merger.actions();
        merger.initial();
        merger.goal();
        merger.metric();
    }
    let Merger { mut domain, problem, diagnostics, .. } = merger;
    domain.signatures = signatures(&domain.actions);
    (domain, problem, diagnostics)
}

struct Merger<'p> {
    parts: &'p [Part],
    /// What the ids of each part have become.
    ids: Vec<Ids>,
    /// The agent of each part, unless there is none.
    agents: Vec<Option<ObjectId>>,
    domain: Domain,
    problem: Problem,
    /// The parts that know each of the private predicates.
    owners: Vec<Vec<usize>>,
    diagnostics: Diagnostics,
}

impl<'p> Merger<'p> {
    fn new(parts: &'p [Part]) -> Self {
        let nowhere = Name { text: String::new(), span: Span::default() };
        let first = parts.first();
        let name =
            |of: fn(&Part) -> &Name| first.map_or_else(|| nowhere.clone(), |part| of(part).clone());
        let mut requirements: std::collections::BTreeSet<Requirement> =
            parts.iter().flat_map(|part| part.domain.requirements.clone()).collect();
        requirements.remove(&Requirement::FactoredPrivacy);
        requirements.extend([Requirement::MultiAgent, Requirement::UnfactoredPrivacy]);
        let domain = Domain {
            requirements,
            uses: uses(parts.iter().map(|part| &part.domain.uses)),
            ..Domain::new(name(|part| &part.domain.name))
        };
        let name = name(|part| &part.problem.name);
        let problem = Problem {
            goal: Formula::truth(name.span),
            name,
            objects: Vec::new(),
            init: Vec::new(),
            values: Vec::new(),
            goal_scope: Scope::default(),
            metric: None,
            uses: uses(parts.iter().map(|part| &part.problem.uses)),
        };
        let ids = parts.iter().map(|_| Ids::default()).collect();
        let mut merger = Self {
            parts,
            ids,
            agents: Vec::new(),
            domain,
            problem,
            owners: Vec::new(),
            diagnostics: Diagnostics::default(),
        };
        for part in parts {
            let (one, other) = (&merger.domain.name, &part.domain.name);
            if !same(&one.text, &other.text) {
                let how = [one.text.clone(), other.text.clone()];
                let spans = [one.span, other.span];
                merger.disagree("the name of the domain", Sides { how, spans });
            }
        }
        merger
    }

    fn disagree(&mut self, about: &str, sides: Sides) {
        self.diagnostics.push(parts_disagree::parts_disagree(about, sides));
    }

    /// The union of the types, each with the parents on which all agree.
    fn types(&mut self) {
        let mut known: HashMap<String, TypeId> = HashMap::new();
        for (part, ids) in self.parts.iter().zip(&mut self.ids) {
            for of in &part.domain.types {
                let next = TypeId(self.domain.types.len() as u32);
                let id = *known.entry(of.name.text.to_ascii_lowercase()).or_insert(next);
                ids.types.push(id);
                if id == next {
                    let (name, parents) = (of.name.clone(), Vec::new());
                    self.domain.types.push(Type { name, parents, ancestors: Vec::new() });
                }
            }
        }
        let mut placed = HashSet::new();
        for at in 0..self.parts.len() {
            for (local, of) in self.parts[at].domain.types.iter().enumerate() {
                let id = self.ids[at].types[local];
                let parents = self.ids[at].types(&of.parents);
                let merged = &mut self.domain.types[id.index()];
                if placed.insert(id) {
                    merged.parents = parents;
                    continue;
                }
                let sets = [&merged.parents, &parents]
                    .map(|list| list.iter().copied().collect::<HashSet<_>>());
                if sets[0] != sets[1] {
                    let merged = merged.clone();
                    let how = [self.named(&merged.parents), self.named(&parents)];
                    let about = format!("what is above type `{}`", of.name.text);
                    self.disagree(&about, Sides { how, spans: [merged.name.span, of.name.span] });
                }
            }
        }
        ancestors(&mut self.domain.types);
    }

    /// Types as messages show them.
    fn named(&self, types: &[TypeId]) -> String {
        let names: Vec<&str> =
            types.iter().map(|id| self.domain.types[id.index()].name.text.as_str()).collect();
        match names.as_slice() {
            [] => "object".to_owned(),
            [one] => (*one).to_owned(),
            several => format!("(either {})", several.join(" ")),
        }
    }

    /// The constants of all, then the objects: those that all know, and then those of each agent.
    fn objects(&mut self) {
        let mut known: HashMap<String, ObjectId> = HashMap::new();
        let mut from: Vec<usize> = Vec::new();
        let mut first = None;
        let constants: Vec<usize> =
            self.parts.iter().map(|part| part.domain.constants.len()).collect();
        let objects = self.parts.iter().map(|part| part.problem.objects.len()).collect();
        for (part, ids) in self.parts.iter().zip(&mut self.ids) {
            ids.objects = vec![None; part.problem.objects.len()];
        }
        for ends in [constants, objects] {
            for public in [true, false] {
                for (at, &end) in ends.iter().enumerate() {
                    for local in 0..end {
                        let object = &self.parts[at].problem.objects[local];
                        if object.holder.is_none() == public
                            && self.ids[at].objects[local].is_none()
                        {
                            let id = self.object(object, at, &mut known, &mut from);
                            self.ids[at].objects[local] = Some(id);
                        }
                    }
                }
            }
            first.get_or_insert(self.problem.objects.len());
        }
        self.agents = self
            .parts
            .iter()
            .map(|part| known.get(&part.agent.to_ascii_lowercase()).copied())
            .collect();
        for (object, &part) in self.problem.objects.iter_mut().zip(&from) {
            if object.holder.is_some() {
                object.holder = self.agents[part].map(Holder::Agent);
            }
        }
        self.domain.constants = self.problem.objects[..first.unwrap_or(0)].to_vec();
    }

    /// The object of all that an object of one part is.
    fn object(
        &mut self,
        object: &Object,
        at: usize,
        known: &mut HashMap<String, ObjectId>,
        from: &mut Vec<usize>,
    ) -> ObjectId {
        let types = self.ids[at].types(&object.types);
        let next = ObjectId(self.problem.objects.len() as u32);
        let id = *known.entry(object.name.text.to_ascii_lowercase()).or_insert(next);
        if id == next {
            self.problem.objects.push(Object { types, ..object.clone() });
            from.push(at);
            return id;
        }
        let before = &self.problem.objects[id.index()];
        let spans = [before.name.span, object.name.span];
        let name = &object.name.text;
        if before.holder.is_some() || object.holder.is_some() {
            let whose = |object: &Object, part: usize| match object.holder {
                Some(_) => format!("private to `{}`", self.parts[part].agent),
                None => "public".to_owned(),
            };
            let how = [whose(before, from[id.index()]), whose(object, at)];
            self.disagree(&format!("whose `{name}` is"), Sides { how, spans });
        } else if before.types != types {
            let how = [self.named(&before.types), self.named(&types)];
            self.disagree(&format!("the type of `{name}`"), Sides { how, spans });
        }
        id
    }

    /// Reports parts of nobody, and two of one agent.
    fn agents(&mut self) {
        for (at, part) in self.parts.iter().enumerate() {
            let (name, span) = (&part.agent, part.problem.name.span);
            match self.agents[at] {
                None => self.diagnostics.push(agent_list_mismatch::no_object(name, span)),
                Some(agent) => {
                    let first = self.agents[..at].iter().position(|other| *other == Some(agent));
                    if let Some(first) = first {
                        let first = self.parts[first].problem.name.span;
                        self.diagnostics.push(agent_list_mismatch::two_files(name, span, first));
                    }
                }
            }
        }
    }

    /// What stands where an agent is asked for: the `declared` types if all their objects are among these agents, or else the types of these.
    fn class(&self, declared: &[TypeId], agents: &[ObjectId]) -> Vec<TypeId> {
        if !declared.is_empty() && self.stranger(declared, agents).is_none() {
            return declared.to_vec();
        }
        let types = agents.iter().flat_map(|agent| &self.problem.objects[agent.index()].types);
        highest(&self.domain, &types.copied().collect::<Vec<_>>())
    }

    /// An object of these types that is not one of the agents.
    fn stranger(&self, types: &[TypeId], agents: &[ObjectId]) -> Option<ObjectId> {
        let ids = (0..self.problem.objects.len() as u32).map(ObjectId);
        ids.filter(|id| !agents.contains(id))
            .find(|id| self.domain.has_type(&self.problem.objects[id.index()], types))
    }

    /// The agents of some parts.
    fn of_parts(&self, parts: &[usize]) -> Vec<ObjectId> {
        parts.iter().filter_map(|&part| self.agents[part]).collect()
    }

    fn predicates(&mut self) {
        let mut known: HashMap<String, PredicateId> = HashMap::new();
        for at in 0..self.parts.len() {
            for predicate in &self.parts[at].domain.predicates {
                let parameters = self.ids[at].variables(&predicate.parameters);
                let next = PredicateId(self.domain.predicates.len() as u32);
                let id = *known.entry(predicate.name.text.to_ascii_lowercase()).or_insert(next);
                self.ids[at].predicates.push(Some(id));
                if id == next {
                    self.domain.predicates.push(Predicate { parameters, ..predicate.clone() });
                    self.owners.push(vec![at]);
                    continue;
                }
                self.owners[id.index()].push(at);
                self.again(id, &Predicate { parameters, ..predicate.clone() });
            }
        }
        for id in 0..self.domain.predicates.len() {
            if self.domain.predicates[id].owner.is_some() {
                self.own(id);
            }
        }
    }

    /// Compares a predicate with what was said of it before.
    fn again(&mut self, id: PredicateId, predicate: &Predicate) {
        let before = &self.domain.predicates[id.index()];
        let spans = [before.name.span, predicate.name.span];
        let how = self.differ(&before.parameters, &predicate.parameters).or_else(|| {
            let whose = |of: &Predicate| if of.owner.is_some() { "private" } else { "public" };
            let how = [before, predicate].map(|of| whose(of).to_owned());
            (how[0] != how[1]).then_some(how)
        });
        let derived = before.derived || predicate.derived;
        self.domain.predicates[id.index()].derived = derived;
        if let Some(how) = how {
            self.disagree(&format!("predicate `{}`", predicate.name.text), Sides { how, spans });
        }
    }

    /// How two lists of parameters differ.
    fn differ(&self, one: &[Variable], other: &[Variable]) -> Option<[String; 2]> {
        if one.len() != other.len() {
            let count = |list: &[Variable]| match list.len() {
                1 => "1 argument".to_owned(),
                more => format!("{more} arguments"),
            };
            return Some([one, other].map(count));
        }
        let differing = one.iter().zip(other).find(|(one, other)| one.types != other.types)?;
        Some([&differing.0.types, &differing.1.types].map(|types| self.named(types)))
    }

    /// Says whose a private predicate is: that of the agents that know it, which is the argument of that name or else of such a type.
    fn own(&mut self, id: usize) {
        let agents = self.of_parts(&self.owners[id]);
        let parameters = &self.domain.predicates[id].parameters;
        let may = |parameter: &Variable| {
            agents.iter().all(|agent| {
                self.domain.has_type(&self.problem.objects[agent.index()], &parameter.types)
            })
        };
        let named = parameters.iter().position(|one| same(&one.name.text, AGENT) && may(one));
        let position = named.or_else(|| parameters.iter().position(may));
        let declared = position.map_or(&[][..], |position| &parameters[position].types);
        let (types, span) = (self.class(declared, &agents), self.domain.predicates[id].name.span);
        self.domain.predicates[id].owner = Some(Owner { position, types, span });
    }

    fn functions(&mut self) {
        let mut known: HashMap<String, FunctionId> = HashMap::new();
        for at in 0..self.parts.len() {
            for function in &self.parts[at].domain.functions {
                let parameters = self.ids[at].variables(&function.parameters);
                let values = function.values.as_ref().map(|types| self.ids[at].types(types));
                let next = FunctionId(self.domain.functions.len() as u32);
                let id = *known.entry(function.name.text.to_ascii_lowercase()).or_insert(next);
                self.ids[at].functions.push(id);
                if id == next {
                    self.domain.functions.push(Function { parameters, values, ..function.clone() });
                    continue;
                }
                let before = &mut self.domain.functions[id.index()];
                before.read = before.read.or(function.read);
                before.assigned |= function.assigned;
                let before = &self.domain.functions[id.index()];
                let spans = [before.name.span, function.name.span];
                let shown = |values: &Option<Vec<TypeId>>| {
                    values.as_ref().map_or_else(|| "number".to_owned(), |types| self.named(types))
                };
                let how = self.differ(&before.parameters, &parameters).or_else(|| {
                    (before.values != values).then(|| [shown(&before.values), shown(&values)])
                });
                if let Some(how) = how {
                    let about = format!("function `{}`", function.name.text);
                    self.disagree(&about, Sides { how, spans });
                }
            }
        }
    }

    fn axioms(&mut self) {
        for (part, ids) in self.parts.iter().zip(&self.ids) {
            for axiom in part.domain.axioms.iter().filter_map(|axiom| ids.axiom(axiom).ok()) {
                if !self.domain.axioms.iter().any(|one| same_axiom(one, &axiom)) {
                    self.domain.axioms.push(axiom);
                }
            }
        }
    }

    /// The actions of all, each of the agents that have it.
    fn actions(&mut self) {
        let mut known: HashMap<String, usize> = HashMap::new();
        let mut actors: Vec<Vec<usize>> = Vec::new();
        let mut declared: Vec<Vec<TypeId>> = Vec::new();
        for at in 0..self.parts.len() {
            for action in &self.parts[at].domain.actions {
                let Some(translated) = self.acting(action, at) else { continue };
                let types = translated.scope.variables[0].types.clone();
                let next = self.domain.actions.len();
                let id = *known.entry(action.name.text.to_ascii_lowercase()).or_insert(next);
                if id == next {
                    self.domain.actions.push(translated);
                    actors.push(vec![at]);
                    declared.push(types);
                    continue;
                }
                actors[id].push(at);
                declared[id].extend(types);
                let before = &self.domain.actions[id];
                if !same_action(before, &translated) {
                    let spans = [before.name.span, action.name.span];
                    let how = [actors[id][0], at]
                        .map(|at| format!("as `{}` does it", self.parts[at].agent));
                    let about = format!("action `{}`", action.name.text);
                    self.disagree(&about, Sides { how, spans });
                }
            }
        }
        let mut strangers = HashSet::new();
        for id in 0..actors.len() {
            let agents = self.of_parts(&actors[id]);
            let types = self.class(&highest(&self.domain, &declared[id]), &agents);
            if let Some(stranger) = self.stranger(&types, &agents)
                && strangers.insert(stranger)
            {
                let (action, object) =
                    (&self.domain.actions[id], &self.problem.objects[stranger.index()]);
                self.diagnostics.push(agent_list_mismatch::stranger(
                    &object.name.text,
                    &action.name.text,
                    object.name.span,
                    action.name.span,
                ));
            }
            self.domain.actions[id].scope.variables[0].types = types;
        }
    }

    /// The action of a part with its agent as the first parameter, which it gets if it has none.
    fn acting(&self, action: &Action, at: usize) -> Option<Action> {
        let agent = self.agents[at]?;
        let object = &self.problem.objects[agent.index()];
        let first = action.scope.variables.first().filter(|_| action.scope.parameters > 0);
        let ids = &self.ids[at];
        if first.is_some_and(|first| self.domain.has_type(object, &ids.types(&first.types))) {
            return Some(Action { agent: true, ..ids.action(action).ok()? });
        }
        let mut translated = ids.shifted(action).ok()?;
        let name = Name { text: AGENT.to_owned(), span: action.name.span };
        translated.scope.variables.insert(0, Variable { name, types: object.types.clone() });
        translated.scope.parameters += 1;
        Some(Action { agent: true, ..translated })
    }
}

/// Each use of some feature once.
fn uses<'u>(lists: impl Iterator<Item = &'u Vec<Use>>) -> Vec<Use> {
    let mut uses: Vec<Use> = Vec::new();
    for one in lists.flatten() {
        if uses.iter().all(|other| other.feature != one.feature) {
            uses.push(*one);
        }
    }
    uses
}

/// Fills in what is above each type.
fn ancestors(types: &mut [Type]) {
    for (id, of) in types.iter_mut().enumerate() {
        of.ancestors = vec![TypeId(id as u32)];
    }
    // Parents nearly always stand before their children or soon after, so few rounds are enough.
    let mut changed = true;
    while changed {
        changed = false;
        for id in 0..types.len() {
            let mut above: Vec<TypeId> = types[id].ancestors.clone();
            for parent in &types[id].parents {
                above.extend_from_slice(&types[parent.index()].ancestors);
            }
            above.sort_unstable();
            above.dedup();
            changed |= above.len() > types[id].ancestors.len();
            types[id].ancestors = above;
        }
    }
}
