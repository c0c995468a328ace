//! What was learned goes in; a PDDL domain comes out, with the evidence as comments and as `;@ (:seen …)`.
//!
//! Parameters are named after their types, unless the vocabulary has names for them.
//! All predicates and types of the vocabulary stay, used or not, so that problems in its words can be read.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write;

use lang::condition::Condition;
use lang::diagnostic::Severity;
use lang::model::{
    self, ActionAtom, ActionId, Atom, Domain, Effect, Formula, Literal, Term, Variable, VariableId,
};
use lang::source::{Sources, Span};
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
    quieten(&domain, &mut style);
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
    bare.precondition = Condition::all(parts).formula(Span::default());
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
    match learned.strays {
        0 => {}
        1 => lines.push(
            "One change was seen of a thing that no action of the step was about.".to_owned(),
        ),
        count => lines.push(format!(
            "{count} changes were seen of things that no action of the step was about."
        )),
    }
    lines.join("\n")
}

/// How often an action was seen, and what is doubtful about it.
pub(crate) fn comment(learned: &Learned, action: &Action) -> String {
    let times = |count: u32| match count {
        1 => "once".to_owned(),
        2 => "twice".to_owned(),
        _ => format!("{count} times"),
    };
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
        write!(text, "; of all such facts {share} % hold").expect("a string takes all");
    }
    text
}

/// `(:seen 3 "monday.jsonl" …)` for each trace.
pub(crate) fn seen(action: &Action) -> String {
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

/// Adds to the head of a domain what keeps `caveat check` quiet about it.
///
/// That a parameter or a predicate is of no use is what was learned, and nothing to be mended; other programs and problems may still name it.
pub fn quieten(domain: &Domain, style: &mut Style) {
    let mut sources = Sources::default();
    let id = sources.add("learned", lang::write::domain(domain, style));
    let (read, mut found) = lang::read_domain(&sources, id);
    found.append(lang::lint::domain(&read));
    found.append(lang::lint::text(&sources, id, &read));
    let warnings = found.list.iter().filter(|one| one.severity == Severity::Warning);
    let names: BTreeSet<&str> = warnings.map(|one| one.name).collect();
    if !names.is_empty() {
        let names: Vec<&str> = names.into_iter().collect();
        write!(style.head, "\ncaveat: allow({})", names.join(", ")).expect("a string takes all");
    }
}
