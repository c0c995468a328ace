//! What was learned goes in; a PDDL domain comes out, with the evidence as comments and as `;@ (:seen …)`.
//!
//! Parameters are named after their types, unless the vocabulary has names for them.
//! What nothing needs is left out: types and constants without use, and predicates that no action is about.

use std::collections::BTreeMap;

use lang::condition::Condition;
use lang::model::{
    self, ActionAtom, ActionId, Atom, Domain, Effect, Formula, Literal, PredicateId, Term,
    Variable, VariableId,
};
use lang::source::Span;
use lang::write::Style;

use crate::rule::{Action, Doubt, Learned, Partner, Rule};
use crate::trace::vocabulary;

/// The learned actions as a domain, and what is said of them beside it.
///
/// Actions that were refused are not in it.
pub fn domain(learned: &Learned, rule: Rule) -> (Domain, Style) {
    let mut domain = learned.domain.clone();
    let mut style = Style { head: head(learned), ..Style::default() };
    let ids: BTreeMap<ActionId, ActionId> = learned
        .actions
        .iter()
        .enumerate()
        .map(|(at, action)| (action.action, ActionId(at as u32)))
        .collect();
    domain.actions =
        learned.actions.iter().map(|action| model(learned, action, rule, &ids)).collect();
    domain.signatures.retain_mut(|signature| {
        signature.action = signature.action.and_then(|id| ids.get(&id).copied());
        signature.action.is_some()
    });
    for (at, action) in learned.actions.iter().enumerate() {
        let id = ActionId(at as u32);
        style.actions.insert(id, comment(learned, action));
        style.annotations.insert(id, seen(action));
    }
    drop_unused(&mut domain);
    (domain, style)
}

/// The learned actions as the text of a domain.
pub fn text(learned: &Learned) -> String {
    let (domain, style) = domain(learned, learned.rule);
    lang::write::domain(&domain, &style)
}

/// A learned action as one of a domain. `ids` says which actions there are, and what they are called in that domain.
pub fn model(
    learned: &Learned,
    action: &Action,
    rule: Rule,
    ids: &BTreeMap<ActionId, ActionId>,
) -> model::Action {
    let mut bare = learned.domain.actions[action.action.index()].clone();
    let mut parts: Vec<Condition> = Vec::new();
    let held = action.precondition(rule).iter();
    parts.extend(held.map(|atom| Condition::Atom(atom.clone(), true)));
    parts.extend(action.absent.iter().map(|atom| Condition::Atom(atom.clone(), false)));
    parts.extend(action.same.iter().map(|(one, other)| Condition::Equal(*one, *other, true)));
    parts.extend(action.distinct.iter().map(|(one, other)| Condition::Equal(*one, *other, false)));
    for partner in &action.partners {
        parts.extend(company(learned, partner, &mut bare, ids));
    }
    bare.precondition = Condition::All(parts).formula(Span::default());
    let literal = |positive: bool| {
        move |atom: &Atom| Literal { positive, atom: atom.clone(), span: Span::default() }
    };
    let adds = action.adds.iter().map(literal(true));
    let literals = adds.chain(action.deletes.iter().map(literal(false))).collect();
    bare.effects = vec![Effect {
        variables: Vec::new(),
        condition: Formula::truth(Span::default()),
        literals,
        span: Span::default(),
    }];
    bare
}

/// That a partner acts at the same time.
fn company(
    learned: &Learned,
    partner: &Partner,
    bare: &mut model::Action,
    ids: &BTreeMap<ActionId, ActionId>,
) -> Option<Condition> {
    let id = *ids.get(&partner.action)?;
    let parameters = &learned.domain.actions[partner.action.index()].scope.variables;
    let mut bound = Vec::new();
    let mut arguments = Vec::new();
    for (argument, parameter) in partner.arguments.iter().zip(parameters) {
        arguments.push(argument.unwrap_or_else(|| {
            let new = VariableId(bare.scope.variables.len() as u32);
            bare.scope.variables.push(other_name(parameter, &bare.scope.variables));
            bound.push(new);
            Term::Variable(new)
        }));
    }
    let atom = Condition::Action(ActionAtom { action: id, arguments }, true);
    Some(Condition::exists(bound, atom))
}

/// The same variable under a name that is not taken.
fn other_name(variable: &Variable, taken: &[Variable]) -> Variable {
    let is_taken = |name: &str| taken.iter().any(|one| one.name.text.eq_ignore_ascii_case(name));
    let mut name = format!("?other-{}", &variable.name.text[1..]);
    let mut number = 2;
    while is_taken(&name) {
        name = format!("?other-{}-{number}", &variable.name.text[1..]);
        number += 1;
    }
    Variable { name: vocabulary::name(name), types: variable.types.clone() }
}

fn head(learned: &Learned) -> String {
    let mut lines = vec!["Learned from demonstrations.".to_owned()];
    for refusal in &learned.refused {
        lines.push(format!("Left out: {}.", refusal.describe(&learned.domain)));
    }
    if learned.strays > 0 {
        lines.push(format!(
            "{} changes were seen of things that no action of the step was about.",
            learned.strays
        ));
    }
    lines.join("\n")
}

/// How often an action was seen, and what is doubtful about it.
fn comment(learned: &Learned, action: &Action) -> String {
    let times = |count: u32| if count == 1 { "once".to_owned() } else { format!("{count} times") };
    let mut text = match action.sources.as_slice() {
        [] => format!("Seen {}.", times(action.count)),
        [(name, _)] => format!("Seen {} in {name}.", times(action.count)),
        [(first, _), others @ ..] => {
            let more = others.len();
            let others = if more == 1 { "another".to_owned() } else { format!("{more} others") };
            format!("Seen {} in {first} and {others}.", times(action.count))
        }
    };
    if learned.rule == Rule::Both && !action.doubts.is_empty() {
        text.push_str("\nPerhaps not needed:");
        for doubt in &action.doubts {
            text.push_str("\n  ");
            text.push_str(&evidence(learned, action, doubt));
        }
    }
    text
}

/// A doubtful precondition with what speaks for it.
fn evidence(learned: &Learned, action: &Action, doubt: &Doubt) -> String {
    let atom = crate::rule::describe(&learned.domain, action.action, &doubt.atom);
    let Doubt { seen, of, usual, .. } = doubt;
    let mut text = format!("{atom} held {seen} of {of} times");
    if usual.possible > 0 {
        let share = (100 * usual.held).div_ceil(usual.possible).min(100);
        text.push_str(&format!("; of all such facts {share} % hold"));
    }
    text
}

/// `(:seen 3 "monday.jsonl" …)` for each trace.
fn seen(action: &Action) -> String {
    let one = |(name, count): &(String, u32)| {
        let name: String = name.chars().filter(|letter| !"\"\n\r".contains(*letter)).collect();
        if name.is_empty() {
            format!("(:seen {count})")
        } else {
            format!("(:seen {count} \"{name}\")")
        }
    };
    let lines: Vec<String> = action.sources.iter().map(one).collect();
    if lines.is_empty() { format!("(:seen {})", action.count) } else { lines.join("\n") }
}

/// Leaves out predicates that no action is about, and so nothing reads or changes.
fn drop_unused(domain: &mut Domain) {
    let mut used = vec![false; domain.predicates.len()];
    for action in &domain.actions {
        for node in &action.precondition.nodes {
            if let model::NodeKind::Atom(atom) = &node.kind {
                used[atom.predicate.index()] = true;
            }
        }
        for literal in action.effects.iter().flat_map(|effect| &effect.literals) {
            used[literal.atom.predicate.index()] = true;
        }
    }
    let mut ids = Vec::new();
    let mut kept = 0;
    for used in &used {
        ids.push(PredicateId(kept));
        kept += u32::from(*used);
    }
    let mut at = 0;
    domain.predicates.retain(|_| {
        at += 1;
        used[at - 1]
    });
    let rename = |atom: &mut Atom| atom.predicate = ids[atom.predicate.index()];
    for action in &mut domain.actions {
        for node in &mut action.precondition.nodes {
            if let model::NodeKind::Atom(atom) = &mut node.kind {
                rename(atom);
            }
        }
        let literals = action.effects.iter_mut().flat_map(|effect| &mut effect.literals);
        literals.for_each(|literal| rename(&mut literal.atom));
    }
}
