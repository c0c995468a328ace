//! A domain for several agents goes in; the same comes out with the moves of listing 3.1 of the thesis: to a place that several reach, one goes only
//! if nobody is there and nobody else goes there, or if the one who is there leaves it in the same step.
//!
//! Mended against the print, as in the domain `moves`: two do not follow a third to the same place, and the conditions are those of PDDL.

use lang::condition::Condition;
use lang::model::{
    ActionAtom, ActionId, Atom, Domain, PredicateId, Term, TypeId, Variable, VariableId,
};
use lang::source::Span;
use lang::write::Style;

use crate::trace::vocabulary::{declare_action, name};

/// How an action moves its agent.
#[derive(Debug, Clone, Copy)]
struct Move {
    action: ActionId,
    /// The parameter that the agent leaves.
    from: Option<VariableId>,
    /// The parameter to which it comes.
    to: Option<VariableId>,
}

/// The names of the new actions, each with the one that it refines, and whether it follows another agent to a place.
pub type Constrained = Vec<(String, String, bool)>;

/// Replaces the moves to shared places. `at` is the predicate that says where who acts is, and `reachable` the one that says who gets where.
pub fn constrain(domain: &mut Domain, style: &mut Style, at: &str, reachable: &str) -> Constrained {
    let predicate = |text: &str| {
        let place =
            domain.predicates.iter().position(|one| one.name.text.eq_ignore_ascii_case(text));
        place.map(|place| PredicateId(place as u32))
    };
    let (Some(at), Some(reachable)) = (predicate(at), predicate(reachable)) else {
        return Constrained::new();
    };
    let moves: Vec<Move> = (0..domain.actions.len() as u32)
        .filter_map(|number| as_move(domain, ActionId(number), at))
        .collect();
    let mut made = Constrained::new();
    let mut firsts: Vec<Move> = Vec::new();
    let coming: Vec<Move> = moves.iter().copied().filter(|one| one.to.is_some()).collect();
    for one in &coming {
        let action = copy(domain, style, one.action, "constrained", 1);
        firsts.push(Move { action, ..*one });
    }
    let seconds: Vec<Move> = coming
        .iter()
        .map(|one| Move { action: copy(domain, style, one.action, "constrained", 2), ..*one })
        .collect();
    for (place, one) in coming.iter().enumerate() {
        let to = one.to.expect("only moves that come to a place are here");
        let words = Words { at, reachable, to };
        let (first, second) = (firsts[place].action, seconds[place].action);
        made.push((text(domain, first), text(domain, one.action), false));
        made.push((text(domain, second), text(domain, one.action), true));
        // Nobody is there, and nobody else comes.
        let mut parts = vec![words.shared(domain, first, true)];
        parts.push(words.nobody(domain, first));
        for other in &firsts {
            parts.push(words.comes(domain, first, other, false));
        }
        add(domain, first, parts);
        // Somebody is there and leaves, and nobody else follows.
        let mut parts = vec![words.shared(domain, second, true)];
        let leaving: Vec<Move> =
            moves.iter().chain(&firsts).copied().filter(|one| one.from.is_some()).collect();
        parts.push(words.leaves(domain, second, &leaving));
        for other in &seconds {
            parts.push(words.comes(domain, second, other, false));
        }
        add(domain, second, parts);
        let part = words.shared(domain, one.action, false);
        add(domain, one.action, vec![part]);
    }
    made
}

fn text(domain: &Domain, action: ActionId) -> String {
    domain.actions[action.index()].name.text.clone()
}

/// How an action moves its agent, if it does that and nothing else.
fn as_move(domain: &Domain, id: ActionId, at: PredicateId) -> Option<Move> {
    let action = &domain.actions[id.index()];
    if !action.agent || action.effects.len() != 1 {
        return None;
    }
    let mut found = Move { action: id, from: None, to: None };
    for literal in &action.effects[0].literals {
        let [Term::Variable(VariableId(0)), Term::Variable(place)] = literal.atom.arguments[..]
        else {
            return None;
        };
        let side = if literal.positive { &mut found.to } else { &mut found.from };
        if literal.atom.predicate != at || side.replace(place).is_some() {
            return None;
        }
    }
    (found.from.is_some() || found.to.is_some()).then_some(found)
}

/// The same action under another name.
fn copy(domain: &mut Domain, style: &mut Style, id: ActionId, word: &str, number: u32) -> ActionId {
    let action = domain.actions[id.index()].clone();
    let types: Vec<Vec<TypeId>> = action.scope.variables[..action.scope.parameters as usize]
        .iter()
        .map(|variable| variable.types.clone())
        .collect();
    let new =
        declare_action(domain, &format!("{word}-{}-{number}", action.name.text), &types, true);
    let made = &mut domain.actions[new.index()];
    made.scope = action.scope;
    made.precondition = action.precondition;
    made.effects = action.effects;
    let comment = match number {
        1 => format!(
            "As `{}`, to a place that others reach: nobody is there, and nobody else comes.",
            action.name.text
        ),
        _ => {
            format!("As `{}`, to a place from which another goes away meanwhile.", action.name.text)
        }
    };
    style.actions.insert(new, comment);
    new
}

/// Adds conditions to an action.
fn add(domain: &mut Domain, id: ActionId, parts: Vec<Condition>) {
    let action = &mut domain.actions[id.index()];
    let before = Condition::new(&action.precondition).unwrap_or(Condition::TRUE);
    action.precondition =
        Condition::all(std::iter::once(before).chain(parts)).formula(Span::default());
}

/// What is said of the place that a move leads to.
struct Words {
    at: PredicateId,
    reachable: PredicateId,
    to: VariableId,
}

impl Words {
    /// A new variable of an action, of the type of one of its parameters.
    fn variable(domain: &mut Domain, id: ActionId, like: VariableId, stem: &str) -> VariableId {
        let variables = &mut domain.actions[id.index()].scope.variables;
        let types = variables[like.index()].types.clone();
        let mut text = format!("?{stem}");
        for number in 2.. {
            if variables.iter().all(|one| one.name.text != text) {
                break;
            }
            text = format!("?{stem}{number}");
        }
        variables.push(Variable { name: name(text), types });
        VariableId(variables.len() as u32 - 1)
    }

    fn atom(predicate: PredicateId, terms: [VariableId; 2], holds: bool) -> Condition {
        let arguments = terms.map(Term::Variable).to_vec();
        Condition::Atom(Atom { predicate, arguments }, holds)
    }

    /// That somebody else reaches the place, or that nobody does.
    fn shared(&self, domain: &mut Domain, id: ActionId, holds: bool) -> Condition {
        let agent = VariableId(0);
        let other = Self::variable(domain, id, agent, "other");
        let same = Condition::Equal(Term::Variable(other), Term::Variable(agent), !holds);
        let reaches = Self::atom(self.reachable, [self.to, other], holds);
        if holds {
            Condition::exists(vec![other], Condition::all([same, reaches]))
        } else {
            Condition::forall(vec![other], Condition::any([same, reaches]))
        }
    }

    /// That nobody is at the place.
    fn nobody(&self, domain: &mut Domain, id: ActionId) -> Condition {
        let other = Self::variable(domain, id, VariableId(0), "other");
        Condition::forall(vec![other], Self::atom(self.at, [other, self.to], false))
    }

    /// That another agent takes an action that leads to the place, or that none does.
    fn comes(&self, domain: &mut Domain, id: ActionId, other: &Move, holds: bool) -> Condition {
        let place = other.to.expect("it leads to a place");
        self.done(domain, id, other.action, place, holds)
    }

    fn done(
        &self,
        domain: &mut Domain,
        id: ActionId,
        action: ActionId,
        place: VariableId,
        holds: bool,
    ) -> Condition {
        let count = domain.actions[action.index()].scope.parameters;
        let mut bound = Vec::new();
        let mut arguments = Vec::new();
        for number in 0..count {
            if VariableId(number) == place {
                arguments.push(Term::Variable(self.to));
                continue;
            }
            let like = domain.actions[action.index()].scope.variables[number as usize].clone();
            let stem = if number == 0 { "other" } else { &like.name.text[1..] };
            let new = Self::variable(domain, id, VariableId(0), stem);
            domain.actions[id.index()].scope.variables[new.index()].types = like.types;
            bound.push(new);
            arguments.push(Term::Variable(new));
        }
        let atom = Condition::Action(ActionAtom { action, arguments }, holds);
        if holds { Condition::exists(bound, atom) } else { Condition::forall(bound, atom) }
    }

    /// That the one who is at the place leaves it.
    fn leaves(&self, domain: &mut Domain, id: ActionId, leaving: &[Move]) -> Condition {
        let ways = leaving.iter().map(|one| {
            let place = one.from.expect("it leaves a place");
            self.done(domain, id, one.action, place, true)
        });
        let ways: Vec<Condition> = ways.collect();
        Condition::any(ways)
    }
}
