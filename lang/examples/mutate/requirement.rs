//! A text goes in; which requirements it really needs, and on which lines, comes out.
//!
//! This is told from the text alone, without the checker that is put to the test.

use std::collections::BTreeMap;

use lang::lexer;
use lang::tree::NodeId;

use crate::text::{Text, line_of};

/// What a requirement allows.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Feature {
    Types,
    Equality,
    Negation,
    Disjunction,
    Exists,
    Forall,
    Conditional,
    Derived,
    Costs,
    Numbers,
    Durations,
}

use Feature::{
    Conditional, Costs, Derived, Disjunction, Durations, Equality, Exists, Forall, Negation,
    Numbers, Types,
};

/// The requirements and what each allows. Those that are not listed here are never dropped.
const ALLOW: [(&str, &[Feature]); 16] = [
    (":typing", &[Types]),
    (":equality", &[Equality]),
    (":negative-preconditions", &[Negation]),
    // By the grammar it allows `not` of any condition.
    (":disjunctive-preconditions", &[Disjunction, Negation]),
    (":existential-preconditions", &[Exists]),
    (":universal-preconditions", &[Forall]),
    (":quantified-preconditions", &[Exists, Forall]),
    (":conditional-effects", &[Conditional]),
    (":adl", &[Types, Equality, Negation, Disjunction, Exists, Forall, Conditional]),
    (":ucpop", &[Types, Equality, Negation, Disjunction, Exists, Forall, Conditional, Derived]),
    (":derived-predicates", &[Derived]),
    (":domain-axioms", &[Derived]),
    (":action-costs", &[Costs]),
    (":fluents", &[Costs, Numbers]),
    (":numeric-fluents", &[Costs, Numbers]),
    (":durative-actions", &[Durations]),
];

/// What a requirement allows; nothing of one that is not known here.
pub fn allows(word: &str) -> &'static [Feature] {
    let found = ALLOW.iter().find(|(name, _)| name.eq_ignore_ascii_case(word));
    found.map_or(&[], |(_, features)| features)
}

/// The lines on which each feature is used.
pub fn uses(text: &Text<'_>) -> BTreeMap<Feature, Vec<usize>> {
    let mut found: BTreeMap<Feature, Vec<usize>> = BTreeMap::new();
    let tree = &text.tree;
    let mut note = |feature: Feature, at: NodeId| {
        found.entry(feature).or_default().push(line_of(text.whole, tree.node(at).start as usize));
    };
    for (section, keyword) in text.sections() {
        let word = tree.slice(keyword).to_ascii_lowercase();
        match word.as_str() {
            ":types" => tree.children(section).skip(1).for_each(|name| note(Types, name)),
            ":derived" => note(Derived, keyword),
            ":durative-action" => note(Durations, keyword),
            _ => {}
        }
        let mut side = Side::Neither;
        let mut open: Vec<(NodeId, Side)> = Vec::new();
        if word == ":derived" {
            open.extend(tree.children(section).nth(2).map(|body| (body, Side::Condition)));
        }
        if word == ":goal" {
            open.extend(tree.children(section).nth(1).map(|body| (body, Side::Condition)));
        }
        for child in tree.children(section) {
            if tree.is_list(child) {
                open.push((child, side));
            } else {
                side = match tree.slice(child).to_ascii_lowercase().as_str() {
                    ":precondition" | ":condition" => Side::Condition,
                    ":effect" => Side::Effect,
                    _ => Side::Neither,
                };
            }
        }
        while let Some((list, side)) = open.pop() {
            let head = tree.children(list).next().map_or("", |head| tree.slice(head));
            let head = head.to_ascii_lowercase();
            let operands: Vec<NodeId> = tree.children(list).skip(1).collect();
            let plain = operands.iter().all(|&operand| !tree.is_list(operand));
            match (head.as_str(), side) {
                ("=", Side::Condition) if plain => note(Equality, list),
                ("not", Side::Condition) => {
                    // That the negation of `=` needs more than `=` itself is disputed.
                    let inner = operands.first().and_then(|&inner| tree.children(inner).next());
                    if inner.is_some_and(|inner| tree.slice(inner) != "=") {
                        note(Negation, list);
                    }
                }
                ("or" | "imply", Side::Condition) => note(Disjunction, list),
                ("exists", Side::Condition) => note(Exists, list),
                ("forall", Side::Condition) => note(Forall, list),
                ("forall" | "when", Side::Effect) => note(Conditional, list),
                ("increase", Side::Effect) => note(Costs, list),
                ("decrease" | "assign" | "scale-up" | "scale-down", Side::Effect)
                | ("<" | ">" | "<=" | ">=", Side::Condition) => note(Numbers, list),
                _ => {}
            }
            for (number, &operand) in operands.iter().enumerate() {
                let condition = head == "when" && number == 0;
                if tree.is_list(operand) {
                    open.push((operand, if condition { Side::Condition } else { side }));
                }
            }
        }
    }
    // A dash in the middle of a list gives a type, whatever the list is.
    for id in (0..tree.nodes().len() as u32).map(NodeId) {
        if tree.is_list(id) {
            let words = tree.children(id).skip(1).filter(|&word| !tree.is_list(word));
            words.filter(|&word| lexer::is_dash(tree.slice(word))).for_each(|word| {
                // The head of `(- 5 2)` is skipped; a function's `- number` gives no type.
                note(Types, word);
            });
        }
    }
    found
}

/// Whether a formula is a condition or an effect.
#[derive(Clone, Copy)]
enum Side {
    Condition,
    Effect,
    Neither,
}
