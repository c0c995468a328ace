//! An action of a domain goes in; what it demands and does, as plain lists of atoms, comes out, to be compared and refined.

use lang::condition::Condition;
use lang::model::{self, Atom, Term, TypeId, VariableId};

use super::{Learned, Rule};

/// An action as STRIPS has it. Variables are its parameters, in their order; each list has an atom once.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Schema {
    /// The types of each parameter, any of which will do.
    pub parameters: Vec<Vec<TypeId>>,
    /// Whether the first parameter is the agent.
    pub agent: bool,
    /// What must hold before.
    pub required: Vec<Atom>,
    /// What must not hold before.
    pub absent: Vec<Atom>,
    /// What must be the same object, and what must not.
    pub equal: Vec<(Term, Term, bool)>,
    /// What it adds.
    pub adds: Vec<Atom>,
    /// What it deletes and does not add.
    pub deletes: Vec<Atom>,
}

impl Schema {
    /// The schema of an action; none if it has disjunctions, quantifiers, action atoms or conditional effects, or costs something.
    pub fn of(action: &model::Action) -> Option<Self> {
        if !action.increases.is_empty() {
            return None;
        }
        let variables = &action.scope.variables[..action.scope.parameters as usize];
        let mut schema = Self {
            parameters: variables.iter().map(|variable| variable.types.clone()).collect(),
            agent: action.agent,
            ..Self::default()
        };
        for part in Condition::new(&action.precondition)?.conjuncts() {
            match part {
                Condition::Atom(atom, true) => schema.required.push(atom.clone()),
                Condition::Atom(atom, false) => schema.absent.push(atom.clone()),
                Condition::Equal(one, other, holds) => schema.equal.push((*one, *other, *holds)),
                Condition::All(parts) if parts.is_empty() => {}
                _ => return None,
            }
        }
        for effect in &action.effects {
            if !effect.variables.is_empty() || !effect.condition.is_truth() {
                return None;
            }
            for literal in &effect.literals {
                let list = if literal.positive { &mut schema.adds } else { &mut schema.deletes };
                if !list.contains(&literal.atom) {
                    list.push(literal.atom.clone());
                }
            }
        }
        let adds = schema.adds.clone();
        schema.deletes.retain(|atom| !adds.contains(atom));
        Some(schema)
    }

    /// The schema of a learned action by a rule; none if it demands partners.
    pub fn learned(learned: &Learned, action: &super::Action, rule: Rule) -> Option<Self> {
        if !action.partners.is_empty() {
            return None;
        }
        let bare = &learned.domain.actions[action.action.index()];
        let variables = &bare.scope.variables[..bare.scope.parameters as usize];
        let same = action.same.iter().map(|(one, other)| (*one, *other, true));
        let distinct = action.distinct.iter().map(|(one, other)| (*one, *other, false));
        Some(Self {
            parameters: variables.iter().map(|variable| variable.types.clone()).collect(),
            agent: bare.agent,
            required: action.precondition(rule).to_vec(),
            absent: action.absent.clone(),
            equal: same.chain(distinct).collect(),
            adds: action.adds.clone(),
            deletes: action.deletes.clone(),
        })
    }

    /// Which parameters of `other` those of this one are, if both are equal but for the names and the order of parameters.
    pub fn renaming(&self, other: &Self) -> Option<Vec<VariableId>> {
        let sizes = |of: &Self| {
            let lists = [&of.required, &of.absent, &of.adds, &of.deletes];
            (of.parameters.len(), of.agent, of.equal.len(), lists.map(Vec::len))
        };
        if sizes(self) != sizes(other) {
            return None;
        }
        let mut map = Vec::new();
        self.extend(other, &mut map).then_some(map)
    }

    /// Whether the map, which has a parameter of `other` for each of the first of this, can be completed; then it is.
    fn extend(&self, other: &Self, map: &mut Vec<VariableId>) -> bool {
        if map.len() == self.parameters.len() {
            return self.is(other, map);
        }
        let at = map.len();
        for to in 0..other.parameters.len() {
            let variable = VariableId(to as u32);
            let free = !map.contains(&variable) && (!self.agent || (at == 0) == (to == 0));
            if !free || self.parameters[at] != other.parameters[to] {
                continue;
            }
            map.push(variable);
            if self.agrees(other, map) && self.extend(other, map) {
                return true;
            }
            map.pop();
        }
        false
    }

    /// Whether all atoms whose variables are mapped are atoms of `other`.
    fn agrees(&self, other: &Self, map: &[VariableId]) -> bool {
        let within = |list: &[Atom], target: &[Atom]| {
            let images = list.iter().filter_map(|atom| image(atom, map));
            images.into_iter().all(|atom| target.contains(&atom))
        };
        within(&self.required, &other.required)
            && within(&self.absent, &other.absent)
            && within(&self.adds, &other.adds)
            && within(&self.deletes, &other.deletes)
    }

    fn is(&self, other: &Self, map: &[VariableId]) -> bool {
        let equal = self.equal.iter().all(|(one, two, holds)| {
            let (Some(one), Some(two)) = (term(*one, map), term(*two, map)) else { return false };
            other.equal.contains(&(one, two, *holds)) || other.equal.contains(&(two, one, *holds))
        });
        equal && self.agrees(other, map)
    }
}

/// What an atom is under a map of variables; none if one of its variables is not mapped.
fn image(atom: &Atom, map: &[VariableId]) -> Option<Atom> {
    let arguments = atom.arguments.iter().map(|one| term(*one, map)).collect::<Option<_>>()?;
    Some(Atom { predicate: atom.predicate, arguments })
}

fn term(term: Term, map: &[VariableId]) -> Option<Term> {
    match term {
        Term::Variable(id) => map.get(id.index()).map(|to| Term::Variable(*to)),
        Term::Object(_) => Some(term),
    }
}
