//! A domain as text and what was learned in its words go in; the same text with what is new comes out: operators added, and preconditions taken away that a demonstration did without.
//!
//! An operator is known if there is an action that changes the same, up to the names of its parameters.
//! Everything else in the text stays as it is, comments too.

use std::collections::BTreeMap;

use lang::format::format;
use lang::lexer::{TokenKind, lex};
use lang::model::{self, ActionId, Atom, Domain, Formula, NodeId, NodeKind, Term, VariableId};
use lang::write::{self, Style};

use crate::rule::{Action, Learned, describe};
use crate::write as learned_write;

/// What became of a domain.
#[derive(Debug, Clone, Default)]
pub struct Extension {
    /// The new text.
    pub text: String,
    /// The operators that were added, as they are called in it.
    pub added: Vec<String>,
    /// What was known and seen again: the action, and how often.
    pub known: Vec<(String, u32)>,
    /// Actions that lost preconditions, each with those.
    pub refined: Vec<(String, Vec<String>)>,
    /// What does not fit together, in sentences.
    pub conflicts: Vec<String>,
    /// For each learned operator, by its learned name, what it is called in the text, and which parameter of that each of its own is.
    pub names: BTreeMap<String, (String, Vec<usize>)>,
}

/// How an operator and an action of the domain are alike.
enum Likeness {
    /// They change the same. Each parameter of the operator is that parameter of the action; the conjuncts of its precondition in the second places did not hold.
    Same(Vec<usize>, Vec<usize>),
    /// They add the same and delete something else.
    Rival,
}

/// Merges what was learned into the domain `text`, of which `domain` is the model.
pub fn extend(text: &str, domain: &Domain, learned: &Learned) -> Extension {
    let mut extension = Extension::default();
    let mut cuts: Vec<(usize, usize, &'static str)> = Vec::new();
    let mut new: Vec<(&Action, String)> = Vec::new();
    for action in &learned.actions {
        let own = &learned.domain.actions[action.action.index()];
        let mut same = None;
        let mut rivals = Vec::new();
        for (place, other) in domain.actions.iter().enumerate() {
            match likeness(learned, domain, action, other) {
                Some(Likeness::Same(places, unmet)) => {
                    same = Some((place, places, unmet));
                    break;
                }
                Some(Likeness::Rival) => rivals.push(place),
                None => {}
            }
        }
        if let Some((place, places, unmet)) = same {
            let other = &domain.actions[place];
            extension.names.insert(own.name.text.clone(), (other.name.text.clone(), places));
            extension.known.push((other.name.text.clone(), action.count));
            if !unmet.is_empty() {
                let dropped =
                    drop_conditions(text, domain, ActionId(place as u32), &unmet, &mut cuts);
                extension.refined.push((other.name.text.clone(), dropped));
            }
            continue;
        }
        let name = free_name(&own.name.text, domain, &new);
        for place in rivals {
            extension.conflicts.push(format!(
                "`{name}` makes the same true as `{}`, but not the same false; both are kept",
                domain.actions[place].name.text
            ));
        }
        if let Some(other) = namesake(&name, domain) {
            extension.conflicts.push(format!(
                "there is an action `{other}` that does something else; what was shown is called `{name}`"
            ));
        }
        extension.added.push(name.clone());
        let places = (0..own.scope.parameters as usize).collect();
        extension.names.insert(own.name.text.clone(), (name.clone(), places));
        new.push((action, name));
    }
    extension.text = edited(text, learned, &new, cuts);
    extension
}

/// The name of an operator, with a number if the domain has another action of this name.
fn free_name(name: &str, domain: &Domain, new: &[(&Action, String)]) -> String {
    let taken = |name: &str| {
        domain.actions.iter().any(|one| one.name.text.eq_ignore_ascii_case(name))
            || new.iter().any(|(_, other)| other == name)
    };
    let mut text = name.to_owned();
    for number in 2.. {
        if !taken(&text) {
            break;
        }
        text = format!("{name}-{number}");
    }
    text
}

/// The action of the domain whose name is this one without its number.
fn namesake<'d>(name: &str, domain: &'d Domain) -> Option<&'d str> {
    let (stem, number) = name.rsplit_once('-')?;
    let is_number = number.bytes().all(|letter| letter.is_ascii_digit());
    let mut names = domain.actions.iter().map(|one| one.name.text.as_str());
    names.find(|other| is_number && other.eq_ignore_ascii_case(stem))
}

/// What an action adds and deletes, if that does not depend on anything.
fn effects(action: &model::Action) -> Option<(Vec<&Atom>, Vec<&Atom>)> {
    let mut adds = Vec::new();
    let mut deletes = Vec::new();
    for effect in &action.effects {
        if !effect.variables.is_empty() || !effect.condition.is_truth() {
            return None;
        }
        for literal in &effect.literals {
            if literal.positive { adds.push(&literal.atom) } else { deletes.push(&literal.atom) }
        }
    }
    Some((adds, deletes))
}

/// How an operator is like an action; none if it is not.
fn likeness(
    learned: &Learned,
    domain: &Domain,
    action: &Action,
    other: &model::Action,
) -> Option<Likeness> {
    let own = &learned.domain.actions[action.action.index()];
    let count = other.scope.parameters as usize;
    if own.scope.parameters as usize != count || own.agent != other.agent {
        return None;
    }
    let (adds, deletes) = effects(other)?;
    let mut rival = false;
    let mut found = None;
    assignments(count, &mut Vec::new(), &mut |places| {
        let fits = own.scope.variables.iter().zip(places).all(|(variable, &place)| {
            let wanted = &other.scope.variables[place].types;
            variable
                .types
                .iter()
                .all(|&has| wanted.iter().any(|&wanted| domain.is_subtype(has, wanted)))
        });
        if !fits {
            return false;
        }
        let mapped = |atom: &Atom| map(atom, places);
        let equal = |mine: &[Atom], theirs: &[&Atom]| {
            mine.len() == theirs.len() && mine.iter().all(|atom| theirs.contains(&&mapped(atom)))
        };
        if !equal(&action.adds, &adds) {
            return false;
        }
        if !equal(&action.deletes, &deletes) {
            rival = true;
            return false;
        }
        let held: Vec<Atom> = action.required.iter().map(mapped).collect();
        let parts = conjuncts(&other.precondition);
        let unmet =
            parts.iter().enumerate().filter(|(_, id)| match other.precondition.kind(**id) {
                NodeKind::Atom(atom) => !held.contains(atom),
                _ => false,
            });
        found = Some((places.to_vec(), unmet.map(|(place, _)| place).collect()));
        true
    });
    found.map(|(places, unmet)| Likeness::Same(places, unmet)).or(rival.then_some(Likeness::Rival))
}

/// Calls `visit` with each order of the first `count` numbers until it says that it is content.
fn assignments(
    count: usize,
    places: &mut Vec<usize>,
    visit: &mut dyn FnMut(&[usize]) -> bool,
) -> bool {
    if places.len() == count {
        return visit(places);
    }
    for place in 0..count {
        if !places.contains(&place) {
            places.push(place);
            if assignments(count, places, visit) {
                return true;
            }
            places.pop();
        }
    }
    false
}

/// An atom with its variables renamed.
fn map(atom: &Atom, places: &[usize]) -> Atom {
    let term = |term: &Term| match *term {
        Term::Variable(variable) => Term::Variable(VariableId(places[variable.index()] as u32)),
        Term::Object(object) => Term::Object(object),
    };
    Atom { predicate: atom.predicate, arguments: atom.arguments.iter().map(term).collect() }
}

/// The parts of a conjunction; any other formula is its own only part.
fn conjuncts(formula: &Formula) -> Vec<NodeId> {
    match formula.kind(formula.root()) {
        NodeKind::And(parts) => parts.clone(),
        _ => vec![formula.root()],
    }
}

/// Notes where the conjuncts in these places stand; gives back what they say.
fn drop_conditions(
    text: &str,
    domain: &Domain,
    id: ActionId,
    unmet: &[usize],
    cuts: &mut Vec<(usize, usize, &'static str)>,
) -> Vec<String> {
    let formula = &domain.actions[id.index()].precondition;
    let root = formula.root();
    let parts = conjuncts(formula);
    let mut dropped = Vec::new();
    for &place in unmet {
        let Some(node) = parts.get(place) else { continue };
        let span = formula.nodes[node.index()].span;
        let (start, end) = (span.start as usize, span.end as usize);
        let whole = *node == root;
        // The space before what goes away goes with it.
        let start = if whole { start } else { text[..start].trim_end().len() };
        cuts.push((start, end, if whole { "()" } else { "" }));
        if let NodeKind::Atom(atom) = formula.kind(*node) {
            dropped.push(describe(domain, id, atom));
        }
    }
    dropped
}

/// The text without the cuts and with the new operators before its last parenthesis; laid out if it was so before.
fn edited(
    text: &str,
    learned: &Learned,
    new: &[(&Action, String)],
    mut cuts: Vec<(usize, usize, &'static str)>,
) -> String {
    let was_even = format(text).is_some_and(|even| even == text);
    let mut out = text.to_owned();
    if !new.is_empty() {
        let last = lex(text).into_iter().rev().find(|token| token.kind == TokenKind::Close);
        let end = last.map_or(text.len(), |token| token.start as usize);
        let mut actions = String::new();
        for (action, name) in new {
            actions.push_str("\n\n");
            actions.push_str(&operator(learned, action, name));
        }
        out.insert_str(end, &actions);
    }
    cuts.sort_unstable();
    for (start, end, instead) in cuts.into_iter().rev() {
        out.replace_range(start..end, instead);
    }
    if was_even { format(&out).unwrap_or(out) } else { out }
}

/// An operator as text under a name.
fn operator(learned: &Learned, action: &Action, name: &str) -> String {
    let mut renamed = learned.clone();
    renamed.domain.actions[action.action.index()].name.text.clear();
    renamed.domain.actions[action.action.index()].name.text.push_str(name);
    let ids: BTreeMap<ActionId, ActionId> =
        renamed.actions.iter().map(|one| (one.action, one.action)).collect();
    let model = learned_write::model(&renamed, action, renamed.rule, &ids);
    let mut domain = renamed.domain.clone();
    domain.actions[action.action.index()] = model;
    let mut style = Style::default();
    style.actions.insert(action.action, learned_write::comment(learned, action));
    style.annotations.insert(action.action, learned_write::seen(action));
    write::action(&domain, action.action, &style)
}
