//! Schemas go in; teams come out: lifted joint actions whose parts are all that their action atoms ask for.
//!
//! A team of one is an action that needs nobody. Where an action needs another one, which its positive action atoms say,
//! the other one joins, unified with the atom, and so on until nothing is missing. Such teams are the collaborative actions
//! of Shekhar & Brafman (ICAPS 2018), found rather than written down.

use std::collections::BTreeSet;
use std::fmt::Write;

use super::schema::Schema;
use super::world::{Simplifier, World};
use crate::condition::{self, Condition};
use crate::model::{ActionAtom, Scope, Term, Variable, VariableId};

/// How many teams are looked at for one schema before it is left to the general block.
const MOST: usize = 200;

/// A part of a team.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Member {
    /// Its place among the schemas.
    pub(super) schema: usize,
    /// In the variables of the team.
    pub(super) arguments: Vec<Term>,
}

/// A set of parts with common variables.
#[derive(Debug, Clone)]
pub(super) struct Team {
    pub(super) variables: Vec<Variable>,
    pub(super) members: Vec<Member>,
}

impl Team {
    /// One instance of a schema.
    pub(super) fn solo(schema: usize, schemas: &[Schema]) -> Self {
        let variables = schemas[schema].parameters().to_vec();
        let arguments =
            (0..variables.len() as u32).map(|at| Term::Variable(VariableId(at))).collect();
        Self { variables, members: vec![Member { schema, arguments }] }
    }

    /// The agents of the parts, of which no two are the same.
    pub(super) fn agents(&self, schemas: &[Schema]) -> Vec<Term> {
        let acting = self.members.iter().filter(|member| schemas[member.schema].agent);
        acting.map(|member| member.arguments[0]).collect()
    }

    /// The team with one more part that makes `atom`, of the part `of`, true; none if that cannot be.
    fn with(
        &self,
        of: usize,
        atom: &ActionAtom,
        (world, schemas): (&World<'_>, &[Schema]),
    ) -> Option<Self> {
        let schema = atom.action.index();
        let own = &schemas[self.members[of].schema].scope;
        let mut team = self.clone();
        let mut bound: Vec<(VariableId, Term)> = Vec::new();
        let mut arguments = Vec::new();
        for (&term, parameter) in atom.arguments.iter().zip(schemas[schema].parameters()) {
            let argument = match term {
                Term::Object(_) => term,
                Term::Variable(id) if id.0 < own.parameters => {
                    self.members[of].arguments[id.index()]
                }
                Term::Variable(id) => {
                    if let Some(&(_, argument)) = bound.iter().find(|(known, _)| *known == id) {
                        argument
                    } else {
                        // The variable of the atom may be narrower than the parameter.
                        let mut variable = parameter.clone();
                        let types = &own.variables[id.index()].types;
                        if world.covers(&parameter.types, types) {
                            variable.types.clone_from(types);
                        }
                        team.variables.push(variable);
                        let argument = Term::Variable(VariableId(team.variables.len() as u32 - 1));
                        bound.push((id, argument));
                        argument
                    }
                }
            };
            team.narrow(argument, parameter, world)?;
            arguments.push(argument);
        }
        let taken = self.agents(schemas);
        let clash = schemas[schema].agent && taken.contains(&arguments[0]);
        let nobody = |member: &Member| !schemas[member.schema].agent;
        let crowded = !schemas[schema].agent && self.members.iter().any(nobody);
        team.members.push(Member { schema, arguments });
        (!clash && !crowded).then_some(team)
    }

    /// Makes a term fit a parameter; none if no object is of both types, or if it cannot be said.
    fn narrow(&mut self, term: Term, parameter: &Variable, world: &World<'_>) -> Option<()> {
        let have = world.types(term, &self.variables);
        if world.covers(&parameter.types, have) {
            return Some(());
        }
        let Term::Variable(id) = term else { return None };
        if !world.covers(have, &parameter.types) {
            return None;
        }
        self.variables[id.index()].types.clone_from(&parameter.types);
        Some(())
    }

    /// A text that is the same for teams that differ only in the names of variables and the order of parts.
    fn key(&self) -> String {
        let mut best: Option<String> = None;
        let mut order: Vec<usize> = (0..self.members.len()).collect();
        // Few members: all orders are tried. More: the order in which they came.
        loop {
            let mut numbers: Vec<Option<usize>> = vec![None; self.variables.len()];
            let (mut next, mut text) = (0, String::new());
            for &at in &order {
                let member = &self.members[at];
                write!(text, "{}(", member.schema).expect("a string takes all");
                for &term in &member.arguments {
                    match term {
                        Term::Object(id) => {
                            write!(text, "o{} ", id.0).expect("a string takes all");
                        }
                        Term::Variable(id) => {
                            let number = *numbers[id.index()].get_or_insert_with(|| {
                                next += 1;
                                next
                            });
                            write!(text, "{number} ").expect("a string takes all");
                        }
                    }
                }
                text.push(')');
            }
            if best.as_ref().is_none_or(|best| text < *best) {
                best = Some(text);
            }
            if self.members.len() > 5 || !permute(&mut order) {
                return best.expect("there is at least one order");
            }
        }
    }

    /// The pairs of parts that may be exchanged without changing the team: each pair has one joint action in two ways.
    pub(super) fn interchangeable(&self) -> Vec<(usize, usize)> {
        let count = self.members.len();
        let pairs = (0..count).flat_map(|one| (one + 1..count).map(move |other| (one, other)));
        pairs.filter(|&(one, other)| self.exchanged(one, other)).collect()
    }

    fn exchanged(&self, one: usize, other: usize) -> bool {
        let (left, right) = (&self.members[one], &self.members[other]);
        if left.schema != right.schema {
            return false;
        }
        let mut image: Vec<Term> =
            (0..self.variables.len() as u32).map(|at| Term::Variable(VariableId(at))).collect();
        for (&from, &to) in left.arguments.iter().zip(&right.arguments) {
            for (from, to) in [(from, to), (to, from)] {
                let Term::Variable(id) = from else {
                    if from != to {
                        return false;
                    }
                    continue;
                };
                let identity = Term::Variable(id);
                if image[id.index()] != identity && image[id.index()] != to {
                    return false;
                }
                image[id.index()] = to;
            }
        }
        let types = |term: Term| match term {
            Term::Variable(id) => Some(&self.variables[id.index()].types),
            Term::Object(_) => None,
        };
        let same = (0..self.variables.len() as u32).all(|at| {
            let variable = Term::Variable(VariableId(at));
            types(variable) == types(image[at as usize])
        });
        let swap = |term: Term| match term {
            Term::Variable(id) => image[id.index()],
            object @ Term::Object(_) => object,
        };
        let mut swapped: Vec<Member> = self.members.clone();
        for member in &mut swapped {
            member.arguments.iter_mut().for_each(|term| *term = swap(*term));
        }
        let (before, after): (BTreeSet<_>, BTreeSet<_>) =
            (self.members.iter().collect(), swapped.iter().collect());
        same && before == after
    }
}

/// The next order of the same numbers; false after the last one.
fn permute(order: &mut [usize]) -> bool {
    let Some(at) = order.windows(2).rposition(|pair| pair[0] < pair[1]) else { return false };
    let next = (at + 1..order.len())
        .rev()
        .find(|&other| order[other] > order[at])
        .expect("its right neighbour is greater");
    order.swap(at, next);
    order[at + 1..].reverse();
    true
}

/// Finds teams.
pub(super) struct Finder<'a> {
    pub(super) world: &'a World<'a>,
    pub(super) schemas: &'a [Schema],
    /// How many parts a team has at most.
    pub(super) size: usize,
    /// How many agents there are.
    pub(super) agents: usize,
}

impl Finder<'_> {
    /// All minimal closed teams that begin with each schema, and each schema with what its effects ask about.
    pub(super) fn teams(&self) -> Vec<Team> {
        let mut seen = BTreeSet::new();
        let mut teams = Vec::new();
        for schema in 0..self.schemas.len() {
            let solo = Team::solo(schema, self.schemas);
            let mut open = vec![solo.clone()];
            for effect in &self.schemas[schema].effects {
                effect.condition.visit(&mut |leaf| {
                    if let Condition::Action(atom, _) = leaf {
                        open.extend(solo.with(0, atom, (self.world, self.schemas)));
                    }
                });
            }
            open.reverse();
            self.close(open, &mut seen, &mut teams);
        }
        teams
    }

    /// Adds to `teams` all that the `open` ones become when what is missing joins.
    fn close(&self, mut open: Vec<Team>, seen: &mut BTreeSet<String>, teams: &mut Vec<Team>) {
        let mut looked = 0;
        while let Some(team) = open.pop() {
            looked += 1;
            if looked > MOST || !self.fits(&team) || !seen.insert(team.key()) {
                continue;
            }
            match self.wants(&team) {
                Wants::Impossible => {}
                Wants::Atoms(atoms) => {
                    let joined = atoms
                        .iter()
                        .rev()
                        .filter_map(|(of, atom)| team.with(*of, atom, (self.world, self.schemas)));
                    open.extend(joined.collect::<Vec<_>>());
                }
                Wants::Nothing(choices) => {
                    let joined = choices
                        .iter()
                        .rev()
                        .filter_map(|(of, atom)| team.with(*of, atom, (self.world, self.schemas)));
                    open.extend(joined.collect::<Vec<_>>());
                    teams.push(team);
                }
            }
        }
    }

    /// Whether there may be so many parts, and are so many agents.
    fn fits(&self, team: &Team) -> bool {
        team.members.len() <= self.size && team.agents(self.schemas).len() <= self.agents
    }

    /// What a team lacks.
    fn wants(&self, team: &Team) -> Wants {
        let mut choices = Vec::new();
        let mut missing = Vec::new();
        for (of, member) in team.members.iter().enumerate() {
            let schema = &self.schemas[member.schema];
            for (at, part) in schema.demands().enumerate() {
                let mut scope = self.scope(team);
                let value = self.value(team, of, part, &mut scope);
                // Nobody joins to make good what others destroy: that is left to blocks.
                let asks = at < schema.precondition.conjuncts().len();
                let atoms = if asks { positive(part) } else { Vec::new() };
                if value == Condition::FALSE {
                    if atoms.is_empty() {
                        return Wants::Impossible;
                    }
                    // The first that is missing comes first; the others may be met by then.
                    if missing.is_empty() {
                        missing.extend(atoms.into_iter().map(|atom| (of, atom)));
                    }
                } else if value.some(|leaf| matches!(leaf, Condition::Equal(.., true))) {
                    // It is met only by parts with the same arguments, which is more than is asked.
                    choices.extend(atoms.into_iter().map(|atom| (of, atom)));
                }
            }
        }
        if missing.is_empty() { Wants::Nothing(choices) } else { Wants::Atoms(missing) }
    }

    /// The variables of a team as a scope in which conditions can be written.
    #[expect(clippy::unused_self, reason = "it reads like the other questions about a team")]
    pub(super) fn scope(&self, team: &Team) -> Scope {
        Scope { variables: team.variables.clone(), parameters: team.variables.len() as u32 }
    }

    /// A part of the precondition of the member `of`, when exactly the team acts.
    pub(super) fn value(
        &self,
        team: &Team,
        of: usize,
        part: &Condition,
        scope: &mut Scope,
    ) -> Condition {
        let instance = self.instance(team, of, part.clone(), scope);
        let value = substitute(instance, team, Some(of));
        self.simplify(team, value, scope)
    }

    /// The condition of an effect of the member `of`, when exactly the team acts; `renamed` is what [`Finder::renaming`] gave.
    pub(super) fn effect_value(
        &self,
        team: &Team,
        condition: &Condition,
        renamed: &[Term],
        scope: &Scope,
    ) -> Condition {
        let instance = condition.clone().rename(&|variable| renamed[variable.index()]);
        self.simplify(team, substitute(instance, team, None), scope)
    }

    fn simplify(&self, team: &Team, condition: Condition, scope: &Scope) -> Condition {
        let distinct = team.agents(self.schemas);
        let simplifier =
            Simplifier { world: self.world, variables: &scope.variables, distinct: &distinct };
        simplifier.simplify(condition)
    }

    fn instance(
        &self,
        team: &Team,
        of: usize,
        condition: Condition,
        scope: &mut Scope,
    ) -> Condition {
        let renamed = self.renaming(team, of, scope);
        condition.rename(&|variable| renamed[variable.index()])
    }

    /// What the variables of the schema of member `of` are in the scope of the team; bound ones are new in it.
    pub(super) fn renaming(&self, team: &Team, of: usize, scope: &mut Scope) -> Vec<Term> {
        let member = &team.members[of];
        let own = &self.schemas[member.schema].scope;
        let parameters = own.parameters as usize;
        let mut terms = member.arguments.clone();
        for variable in &own.variables[parameters..] {
            scope.variables.push(variable.clone());
            terms.push(Term::Variable(VariableId(scope.variables.len() as u32 - 1)));
        }
        terms
    }
}

/// What a team lacks.
enum Wants {
    /// A condition that no further part can make true is false.
    Impossible,
    /// One of these, each of a member.
    Atoms(Vec<(usize, ActionAtom)>),
    /// Nothing; though others than its own parts could be what these ask for.
    Nothing(Vec<(usize, ActionAtom)>),
}

/// The action atoms that must be true.
fn positive(condition: &Condition) -> Vec<ActionAtom> {
    let mut atoms = Vec::new();
    condition.visit(&mut |leaf| {
        if let Condition::Action(atom, true) = leaf {
            atoms.push(atom.clone());
        }
    });
    atoms
}

/// The condition when exactly the team acts; a negative atom does not count the part `exempt`.
fn substitute(condition: Condition, team: &Team, exempt: Option<usize>) -> Condition {
    condition.map(&mut |leaf| match leaf {
        Condition::Action(atom, holds) => {
            let members = team.members.iter().enumerate().filter(|(at, member)| {
                member.schema == atom.action.index() && (holds || Some(*at) != exempt)
            });
            let same = members.map(|(_, member)| {
                let pairs = atom.arguments.iter().zip(&member.arguments);
                Condition::all(pairs.map(|(&one, &other)| condition::equal(one, other, true)))
            });
            let acts = Condition::any(same);
            if holds { acts } else { acts.not() }
        }
        other => other,
    })
}
