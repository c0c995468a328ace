//! A group of schemas goes in; actions come out that put any joint action of the group together and take it as one.
//!
//! `begin` opens the block; `select` chooses an action for each agent that takes part, while the state is still the one before;
//! `close` ends the choice; `check` makes sure that what a part asks of the others is so, and notes which of its effects will come about;
//! `apply` begins the change, `do` makes the effects of one part, `end` closes the block.
//! No effect comes before the last check, so every condition reads the state before and the whole joint action.
//!
//! The idea of selecting and applying is Furelos-Blanco & Jonsson's (AAAI 2019). Where they derive what is forbidden by quantified conditions,
//! projected predicates (`used`, `forbidden`) remember it here; and checking before any effect is what makes the parts simultaneous.

mod mark;

use super::assembly::{Assembly, Draft};
use super::interact::Feeds;
use super::schema::{Effect, Schema};
use super::world::World;
use super::{Objective, Role};
use crate::condition::{self, Condition};
use crate::model::{
    ActionAtom, Atom, Expression, FunctionId, Increase, Literal, PredicateId, Scope, Term, TypeId,
    VariableId,
};

/// What blocks share.
pub(super) struct Tokens {
    /// No block is open.
    pub(super) idle: PredicateId,
    /// An agent has nothing to do in the open block.
    pub(super) free: PredicateId,
    /// What an agent is to do is still to be checked.
    pub(super) pending: PredicateId,
    /// The same for actions without agent.
    pub(super) nobody: Option<[PredicateId; 2]>,
    /// The order of agents.
    pub(super) before: PredicateId,
    /// The types of agents.
    pub(super) agents: Vec<TypeId>,
    /// What costs are counted in, where they are not the domain's own.
    pub(super) counted: Option<FunctionId>,
    /// The counter of parts and its successor relation, where their number is limited.
    pub(super) counter: Option<Counter>,
}

/// Counts the parts of a joint action.
pub(super) struct Counter {
    pub(super) count: PredicateId,
    pub(super) next: PredicateId,
    pub(super) number: TypeId,
    pub(super) zero: PredicateId,
}

/// A pattern of action atoms that must be false: the action, and which of its arguments are given.
type Pattern = (usize, Vec<usize>);

/// Writes the block of one group.
pub(super) struct Block<'a> {
    pub(super) world: &'a World<'a>,
    pub(super) feeds: &'a Feeds,
    pub(super) schemas: &'a [Schema],
    pub(super) group: Vec<usize>,
    pub(super) tokens: &'a Tokens,
    pub(super) objective: Objective,
    /// Whether agents must be chosen in their order, so that each joint action is put together in one way.
    pub(super) ordered: bool,
}

/// The predicates of one block.
struct Stage {
    selecting: PredicateId,
    /// Absent where there is nothing to check.
    checking: Option<PredicateId>,
    applying: PredicateId,
    /// For each schema of the group, that an instance is chosen.
    chosen: Vec<PredicateId>,
    /// For each pattern, that an instance is used and that it is forbidden.
    patterns: Vec<(Pattern, [PredicateId; 2])>,
    /// What says that the block has gone wrong, if effects may clash.
    broken: Option<PredicateId>,
    /// For each predicate whose facts may clash, that a part has added or deleted a fact of it.
    marks: Vec<(PredicateId, [PredicateId; 2])>,
    /// For each schema and each of its effects that must be decided before others happen, that it fires.
    fires: Vec<Vec<Option<PredicateId>>>,
}

impl Block<'_> {
    /// Adds the actions of the block to the assembly.
    pub(super) fn write(&self, assembly: &mut Assembly) {
        let suffix: Vec<&str> =
            self.group.iter().take(2).map(|&at| self.schemas[at].name.as_str()).collect();
        let suffix = suffix.join("-");
        let stage = self.stage(&suffix, assembly);
        self.frame(&suffix, &stage, assembly);
        for at in 0..self.group.len() {
            self.select(at, &stage, assembly);
            if self.must_check(at, &stage) {
                self.check(at, &stage, assembly);
            }
            self.apply(at, &stage, assembly);
        }
    }

    fn schema(&self, at: usize) -> &Schema {
        &self.schemas[self.group[at]]
    }

    /// The place in the group of an action, if it is in it.
    fn place(&self, atom: &ActionAtom) -> Option<usize> {
        self.group.iter().position(|&schema| schema == atom.action.index())
    }

    fn stage(&self, suffix: &str, assembly: &mut Assembly) -> Stage {
        let selecting = assembly.predicate(&format!("selecting-{suffix}"), Vec::new());
        let applying = assembly.predicate(&format!("applying-{suffix}"), Vec::new());
        let chosen = self.group.iter().map(|&at| {
            let schema = &self.schemas[at];
            let parameters = schema.parameters().to_vec();
            assembly.predicate(&format!("chosen-{}", schema.name), parameters)
        });
        let chosen = chosen.collect();
        let fires = (0..self.group.len())
            .map(|at| {
                let effects = &self.schema(at).effects;
                let number = |(number, effect): (usize, &Effect)| {
                    self.early(at, effect).then(|| {
                        let schema = self.schema(at);
                        let mut parameters = schema.parameters().to_vec();
                        let variables = effect.variables.iter();
                        parameters
                            .extend(variables.map(|id| schema.scope.variables[id.index()].clone()));
                        let name = format!("fires-{}-{}", schema.name, number + 1);
                        assembly.predicate(&name, parameters)
                    })
                };
                effects.iter().enumerate().map(number).collect()
            })
            .collect();
        let (patterns, marks) = (Vec::new(), self.marks(assembly));
        let broken = (!marks.is_empty())
            .then(|| assembly.predicate(&format!("broken-{suffix}"), Vec::new()));
        let mut stage =
            Stage { selecting, checking: None, applying, chosen, patterns, broken, marks, fires };
        self.patterns(&mut stage, assembly);
        if (0..self.group.len()).any(|at| self.must_check(at, &stage)) {
            stage.checking = Some(assembly.predicate(&format!("checking-{suffix}"), Vec::new()));
        }
        stage
    }

    /// Whether an effect must be decided before the effects of others happen: it asks about the joint action, or about what they may change.
    fn early(&self, at: usize, effect: &Effect) -> bool {
        let own = self.schema(at);
        effect.condition.some(|leaf| match leaf {
            Condition::Action(..) => true,
            Condition::Atom(atom, _) => self.group.iter().any(|&other| {
                let other = &self.schemas[other];
                let literals = other.effects.iter().flat_map(|effect| &effect.literals);
                literals.into_iter().any(|literal: &Literal| {
                    self.feeds.touches(self.world, (other, literal), (own, atom))
                })
            }),
            _ => false,
        })
    }

    /// Finds the patterns that parts of preconditions are.
    fn patterns(&self, stage: &mut Stage, assembly: &mut Assembly) {
        for at in 0..self.group.len() {
            for part in self.schema(at).stated() {
                let Some((pattern, _)) = self.pattern(at, part) else { continue };
                if stage.patterns.iter().any(|(known, _)| *known == pattern) {
                    continue;
                }
                let name = &self.schema(pattern.0).name;
                let places: Vec<String> = pattern.1.iter().map(ToString::to_string).collect();
                let predicate = |word: &str, assembly: &mut Assembly| {
                    let parameters = pattern
                        .1
                        .iter()
                        .map(|at| assembly.variable(&format!("?x{at}"), &[crate::check::OBJECT]))
                        .collect();
                    let name = [&[format!("{word}-{name}")], places.as_slice()].concat().join("-");
                    assembly.predicate(&name, parameters)
                };
                let pair = [predicate("used", assembly), predicate("forbidden", assembly)];
                stage.patterns.push((pattern, pair));
            }
        }
    }

    /// A conjunct that says that no instance of an action with certain arguments stands in the joint action, and these arguments.
    fn pattern(&self, at: usize, part: &Condition) -> Option<(Pattern, Vec<Term>)> {
        let (bound, atom): (&[VariableId], _) = match part {
            Condition::Action(atom, false) => (&[], atom),
            Condition::Forall(bound, body) => match &**body {
                Condition::Action(atom, false) => (bound, atom),
                _ => return None,
            },
            _ => return None,
        };
        let other = self.place(atom)?;
        let own = &self.schema(at).scope.variables;
        let parameters = self.schema(other).parameters();
        let (mut given, mut terms, mut seen) = (Vec::new(), Vec::new(), Vec::new());
        for (place, (&term, parameter)) in atom.arguments.iter().zip(parameters).enumerate() {
            match term {
                Term::Variable(id) if bound.contains(&id) => {
                    let types = &own[id.index()].types;
                    if seen.contains(&id) || !self.world.covers(types, &parameter.types) {
                        return None;
                    }
                    seen.push(id);
                }
                term => {
                    given.push(place);
                    terms.push(term);
                }
            }
        }
        Some(((other, given), terms))
    }

    /// Whether a part of a precondition is looked at only when all are chosen.
    fn is_late(&self, at: usize, part: &Condition) -> bool {
        part.some(|leaf| matches!(leaf, Condition::Action(..))) && self.pattern(at, part).is_none()
    }

    fn must_check(&self, at: usize, stage: &Stage) -> bool {
        let late = |part: &Condition| {
            self.is_late(at, part) && self.asked(at, part.clone(), stage) != Condition::TRUE
        };
        stage.fires[at].iter().any(Option::is_some) || self.schema(at).stated().any(late)
    }

    /// A condition with chosen instances in place of action atoms; in a precondition, a negative one does not count the own.
    fn asked(&self, at: usize, condition: Condition, stage: &Stage) -> Condition {
        self.translate(at, condition, stage, true)
    }

    fn translate(&self, at: usize, condition: Condition, stage: &Stage, exempt: bool) -> Condition {
        let own = self.group[at];
        let count = self.schema(at).scope.parameters;
        condition.map(&mut |leaf| {
            let Condition::Action(atom, holds) = leaf else { return leaf };
            let Some(place) = self.place(&atom) else {
                return if holds { Condition::FALSE } else { Condition::TRUE };
            };
            let same = atom.arguments.iter().zip(0..count).map(|(&argument, at)| {
                condition::equal(argument, Term::Variable(VariableId(at)), true)
            });
            let is_own =
                (atom.action.index() == own).then(|| Condition::all(same.collect::<Vec<_>>()));
            let chosen = Atom { predicate: stage.chosen[place], arguments: atom.arguments };
            let chosen = Condition::Atom(chosen, holds);
            match is_own {
                Some(is_own) if exempt && !holds => Condition::any([chosen, is_own]),
                _ => chosen,
            }
        })
    }

    fn draft(&self, word: &str, at: usize, note: &str) -> Draft {
        let schema = self.schema(at);
        Draft::new(format!("{word}-{}", schema.name), schema.scope.clone(), note.to_owned())
    }

    fn own(&self, at: usize) -> Vec<Term> {
        (0..self.schema(at).scope.parameters).map(|at| Term::Variable(VariableId(at))).collect()
    }

    fn chosen(&self, at: usize, stage: &Stage) -> Atom {
        Atom { predicate: stage.chosen[at], arguments: self.own(at) }
    }

    /// `free` or `pending` of the agent of a schema.
    fn token(&self, at: usize, pending: bool) -> Atom {
        let tokens = self.tokens;
        if self.schema(at).agent {
            let predicate = if pending { tokens.pending } else { tokens.free };
            return Atom { predicate, arguments: vec![Term::Variable(VariableId(0))] };
        }
        let nobody = tokens.nobody.expect("it is there if an action has no agent");
        Atom { predicate: nobody[usize::from(pending)], arguments: Vec::new() }
    }

    /// That all agents are free, or that nothing is pending.
    fn settled(&self, draft: &mut Draft, pending: bool) {
        let tokens = self.tokens;
        let all = self.group.iter().any(|&at| self.schemas[at].agent);
        if all {
            let agent = self.declare(&mut draft.scope, "?other");
            let predicate = if pending { tokens.pending } else { tokens.free };
            let atom = Atom { predicate, arguments: vec![Term::Variable(agent)] };
            draft
                .precondition
                .push(Condition::forall(vec![agent], Condition::Atom(atom, !pending)));
        }
        if let Some(nobody) = tokens.nobody {
            let atom = Atom { predicate: nobody[usize::from(pending)], arguments: Vec::new() };
            draft.needs(atom, !pending);
        }
    }

    /// That the agents before this one have been dealt with, so that the order of checks and of effects is no choice.
    fn in_order(&self, at: usize, draft: &mut Draft, pending: bool, after: bool) {
        if !self.schema(at).agent {
            return;
        }
        let own = Term::Variable(VariableId(0));
        let agent = self.declare(&mut draft.scope, "?other");
        let other = Term::Variable(agent);
        let order = if after { vec![own, other] } else { vec![other, own] };
        let before =
            Condition::Atom(Atom { predicate: self.tokens.before, arguments: order }, false);
        let predicate = if pending { self.tokens.pending } else { self.tokens.free };
        let done = Condition::Atom(Atom { predicate, arguments: vec![other] }, !pending);
        draft.precondition.push(Condition::forall(vec![agent], Condition::any([before, done])));
    }

    fn declare(&self, scope: &mut Scope, name: &str) -> VariableId {
        let span = self.world.domain.name.span;
        let name = crate::model::Name { text: name.to_owned(), span };
        let types = self.tokens.agents.clone();
        scope.variables.push(crate::model::Variable { name, types });
        VariableId(scope.variables.len() as u32 - 1)
    }

    /// The actions that open and close the block and lead from one phase to the next.
    fn frame(&self, suffix: &str, stage: &Stage, assembly: &mut Assembly) {
        let fact = |predicate| Atom { predicate, arguments: Vec::new() };
        let mut begin = Draft::new(
            format!("begin-{suffix}"),
            Scope::default(),
            "a joint action begins: agents are chosen one by one".to_owned(),
        );
        begin.needs(fact(self.tokens.idle), true);
        begin.makes(fact(self.tokens.idle), false);
        begin.makes(fact(stage.selecting), true);
        if let Some(Counter { count, zero, number, .. }) = &self.tokens.counter {
            let variable = self.declare(&mut begin.scope, "?n");
            begin.scope.variables[variable.index()].types = vec![*number];
            begin.scope.parameters = 1;
            let none = vec![Term::Variable(variable)];
            begin.needs(Atom { predicate: *zero, arguments: none.clone() }, true);
            begin.makes(Atom { predicate: *count, arguments: none }, true);
        }
        if self.objective == Objective::Steps {
            begin.increases.extend(self.price(1));
        }
        assembly.action(begin, Role::Frame);
        let mut last = stage.selecting;
        if let Some(checking) = stage.checking {
            let mut close = Draft::new(
                format!("close-{suffix}"),
                Scope::default(),
                "nobody else takes part".to_owned(),
            );
            close.needs(fact(stage.selecting), true);
            close.makes(fact(stage.selecting), false);
            close.makes(fact(checking), true);
            assembly.action(close, Role::Frame);
            last = checking;
        }
        let mut apply = Draft::new(
            format!("apply-{suffix}"),
            Scope::default(),
            "all is well: the effects come about".to_owned(),
        );
        apply.needs(fact(last), true);
        if stage.checking.is_some() {
            self.settled(&mut apply, true);
        }
        apply.makes(fact(last), false);
        apply.makes(fact(stage.applying), true);
        assembly.action(apply, Role::Frame);
        let mut end = Draft::new(
            format!("end-{suffix}"),
            Scope::default(),
            "the joint action is over".to_owned(),
        );
        end.needs(fact(stage.applying), true);
        self.settled(&mut end, false);
        end.makes(fact(stage.applying), false);
        end.makes(fact(self.tokens.idle), true);
        self.forget(stage, &mut end);
        if let Some(Counter { count, number, .. }) = &self.tokens.counter {
            let variable = self.declare(&mut end.scope, "?n");
            end.scope.variables[variable.index()].types = vec![*number];
            let atom = Atom { predicate: *count, arguments: vec![Term::Variable(variable)] };
            end.effects.push((vec![variable], Condition::TRUE, vec![(atom, false)]));
        }
        assembly.action(end, Role::End);
    }

    fn price(&self, value: u32) -> Option<Increase> {
        let function = self.tokens.counted?;
        let span = self.world.domain.name.span;
        Some(Increase {
            variables: Vec::new(),
            condition: crate::model::Formula::truth(span),
            function,
            arguments: Vec::new(),
            value: Expression::Number(value.into()),
            span,
        })
    }

    fn select(&self, at: usize, stage: &Stage, assembly: &mut Assembly) {
        let mut draft = self.draft("select", at, "chosen for the joint action");
        let fact = |predicate| Atom { predicate, arguments: Vec::new() };
        draft.needs(fact(stage.selecting), true);
        draft.needs(self.token(at, false), true);
        if self.ordered {
            self.in_order(at, &mut draft, false, true);
        }
        for part in self.schema(at).stated() {
            if let Some((pattern, terms)) = self.pattern(at, part) {
                let (_, [used, forbidden]) = stage
                    .patterns
                    .iter()
                    .find(|(known, _)| *known == pattern)
                    .expect("it was found");
                draft.needs(Atom { predicate: *used, arguments: terms.clone() }, false);
                draft.makes(Atom { predicate: *forbidden, arguments: terms }, true);
            } else if !part.some(|leaf| matches!(leaf, Condition::Action(..))) {
                draft.precondition.push(part.clone());
            }
        }
        for (used, forbidden) in self.uses(at, stage) {
            draft.needs(forbidden, false);
            draft.makes(used, true);
        }
        draft.makes(self.token(at, false), false);
        draft.makes(self.chosen(at, stage), true);
        if self.must_check(at, stage) {
            draft.makes(self.token(at, true), true);
        }
        match self.objective {
            Objective::Steps => {}
            Objective::Actions => draft.increases.extend(self.price(1)),
            Objective::Cost => draft.increases.clone_from(&self.schema(at).increases),
        }
        let mut arguments = self.own(at);
        if let Some(Counter { count, next, number, .. }) = &self.tokens.counter {
            arguments = self.numbered(at, &mut draft, (*count, *next, *number));
        }
        assembly.action(draft, Role::Select(self.schema(at).id, arguments));
    }

    /// Counts one more part: two more parameters, behind the own ones. Where the own ones are now is returned.
    fn numbered(
        &self,
        at: usize,
        draft: &mut Draft,
        (count, next, number): (PredicateId, PredicateId, TypeId),
    ) -> Vec<Term> {
        let own = self.schema(at).scope.parameters;
        let shift =
            |id: VariableId| Term::Variable(VariableId(if id.0 < own { id.0 } else { id.0 + 2 }));
        let term = |term: Term| match term {
            Term::Variable(id) => shift(id),
            object @ Term::Object(_) => object,
        };
        let name = |text: &str| crate::model::Name {
            text: text.to_owned(),
            span: self.world.domain.name.span,
        };
        let added = ["?n", "?m"]
            .map(|text| crate::model::Variable { name: name(text), types: vec![number] });
        draft.scope.variables.splice(own as usize..own as usize, added);
        draft.scope.parameters = own + 2;
        let conditions = std::mem::take(&mut draft.precondition);
        draft.precondition =
            conditions.into_iter().map(|condition| condition.rename(&shift)).collect();
        for (_, _, literals) in &mut draft.effects {
            for (atom, _) in literals {
                atom.arguments.iter_mut().for_each(|argument| *argument = term(*argument));
            }
        }
        for increase in &mut draft.increases {
            increase.arguments.iter_mut().for_each(|argument| *argument = term(*argument));
            if let Expression::Function(_, arguments) = &mut increase.value {
                for argument in arguments {
                    *argument = term(*argument);
                }
            }
        }
        let [from, to] = [own, own + 1].map(|at| Term::Variable(VariableId(at)));
        draft.needs(Atom { predicate: count, arguments: vec![from] }, true);
        draft.needs(Atom { predicate: next, arguments: vec![from, to] }, true);
        draft.makes(Atom { predicate: count, arguments: vec![from] }, false);
        draft.makes(Atom { predicate: count, arguments: vec![to] }, true);
        self.own(at)
    }

    /// The patterns that an instance of a schema fits: the facts that it is used and that it is forbidden.
    #[expect(clippy::unused_self, reason = "it reads like the other questions about a schema")]
    fn uses(&self, at: usize, stage: &Stage) -> Vec<(Atom, Atom)> {
        let fitting = stage.patterns.iter().filter(|((other, _), _)| *other == at);
        fitting
            .map(|((_, given), [used, forbidden])| {
                let arguments: Vec<Term> =
                    given.iter().map(|&at| Term::Variable(VariableId(at as u32))).collect();
                let used = Atom { predicate: *used, arguments: arguments.clone() };
                (used, Atom { predicate: *forbidden, arguments })
            })
            .collect()
    }

    fn check(&self, at: usize, stage: &Stage, assembly: &mut Assembly) {
        let mut draft = self.draft("check", at, "what it asks of the others is so");
        let checking = stage.checking.expect("it is there if there is something to check");
        draft.needs(Atom { predicate: checking, arguments: Vec::new() }, true);
        draft.needs(self.token(at, true), true);
        draft.needs(self.chosen(at, stage), true);
        self.in_order(at, &mut draft, true, false);
        for part in self.schema(at).stated() {
            if self.is_late(at, part) {
                draft.precondition.push(self.asked(at, part.clone(), stage));
            }
        }
        draft.makes(self.token(at, true), false);
        for (effect, fires) in self.schema(at).effects.iter().zip(&stage.fires[at]) {
            let Some(fires) = *fires else { continue };
            let condition = self.translate(at, effect.condition.clone(), stage, false);
            if condition != Condition::FALSE {
                let fact = self.fires(at, effect, fires);
                draft.effects.push((effect.variables.clone(), condition, vec![(fact, true)]));
            }
        }
        assembly.action(draft, Role::Frame);
    }

    fn fires(&self, at: usize, effect: &Effect, predicate: PredicateId) -> Atom {
        let mut arguments = self.own(at);
        arguments.extend(effect.variables.iter().map(|&id| Term::Variable(id)));
        Atom { predicate, arguments }
    }

    fn apply(&self, at: usize, stage: &Stage, assembly: &mut Assembly) {
        let mut draft = self.draft("do", at, "its effects, decided before");
        draft.needs(Atom { predicate: stage.applying, arguments: Vec::new() }, true);
        draft.needs(self.chosen(at, stage), true);
        self.in_order(at, &mut draft, false, false);
        draft.makes(self.chosen(at, stage), false);
        draft.makes(self.token(at, false), true);
        for (used, _) in self.uses(at, stage) {
            draft.makes(used, false);
        }
        for part in self.schema(at).stated() {
            if let Some((pattern, terms)) = self.pattern(at, part) {
                let (_, [_, forbidden]) = stage
                    .patterns
                    .iter()
                    .find(|(known, _)| *known == pattern)
                    .expect("it was found");
                draft.makes(Atom { predicate: *forbidden, arguments: terms }, false);
            }
        }
        for (effect, fires) in self.schema(at).effects.iter().zip(&stage.fires[at]) {
            let mut literals: Vec<(Atom, bool)> = effect
                .literals
                .iter()
                .map(|literal| (literal.atom.clone(), literal.positive))
                .collect();
            let condition = match *fires {
                None => effect.condition.clone(),
                Some(fires) => {
                    let fact = self.fires(at, effect, fires);
                    literals.push((fact.clone(), false));
                    Condition::Atom(fact, true)
                }
            };
            for literal in &effect.literals {
                self.mark(effect, literal, &condition, stage, &mut literals, &mut draft);
            }
            draft.effects.push((effect.variables.clone(), condition, literals));
        }
        assembly.action(draft, Role::Frame);
    }
}
