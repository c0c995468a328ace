//! Changes of variables go in; a sentence that a person can act on comes out.
//!
//! The words come from a small vocabulary that people edit: for each variable whose it is, what was done with it, and what to say where
//! there was too much or too little. Whatever the vocabulary does not have is said with the name and the values of the variable.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use crate::contrast::Change;
use crate::network::Network;
use crate::variable::{State, States, Variable};

/// Words for variables, by their names.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub struct Vocabulary {
    /// The words of each variable.
    pub variables: BTreeMap<String, Words>,
    /// How a situation looks, where it can be drawn.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub scene: Option<Scene>,
}

/// Cubes on a table, seen from the side.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub struct Scene {
    /// The edge of a cube, in the unit of the variables.
    pub edge: f64,
    /// The cubes on the first one, from below.
    pub cubes: Vec<SceneCube>,
}

/// A cube that is let go over the one below.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub struct SceneCube {
    /// The variable that says how far to the right.
    pub x: String,
    /// The variable that says from how high.
    pub drop: String,
}

/// The words of a variable: "the upper cube" "was dropped" "too high" or "too low".
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub struct Words {
    /// Who or what it is about.
    pub subject: String,
    /// What was done, or `was`.
    pub verb: String,
    /// What was wrong where the value was greater than it should have been.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub more: Option<String>,
    /// What was wrong where it was less.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub less: Option<String>,
    /// What a state without an order is called, where that is not its name.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub states: BTreeMap<String, String>,
    /// Other words for whoever looks inside the robot.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub engineer: Option<Box<Words>>,
}

/// To whom something is said.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Audience {
    /// Somebody who sees what happens.
    #[default]
    User,
    /// Somebody who looks inside: values and names are told, too.
    Engineer,
}

/// When what is told happens.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Time {
    /// It has happened.
    Past,
    /// It would happen: `was` becomes `would be`.
    Ahead,
}

/// What was wrong, as a sentence: "The upper cube was dropped too high and too far to the right of the lower cube."
pub fn explain(
    network: &Network,
    changes: &[Change],
    vocabulary: &Vocabulary,
    audience: Audience,
    time: Time,
) -> String {
    // What is said of one subject with one verb is said together.
    let mut groups: Vec<((String, String), Vec<String>)> = Vec::new();
    for change in changes {
        let variable = network.variable(change.variable);
        let (head, what) = phrase(variable, *change, vocabulary, audience);
        match groups.iter_mut().find(|(other, _)| *other == head) {
            Some((_, whats)) => whats.push(what),
            None => groups.push((head, vec![what])),
        }
    }
    let clauses: Vec<String> = groups
        .into_iter()
        .map(|((subject, verb), whats)| {
            let verb = match verb.strip_prefix("was") {
                Some(rest) if time == Time::Ahead => format!("would be{rest}"),
                _ => verb,
            };
            format!("{subject} {verb} {}", joined(&without_common_end(whats)))
        })
        .collect();
    sentence(&joined(&clauses))
}

/// The subject with its verb, and what was wrong.
fn phrase(
    variable: &Variable,
    change: Change,
    vocabulary: &Vocabulary,
    audience: Audience,
) -> ((String, String), String) {
    let words = vocabulary.variables.get(&variable.name);
    let words = match audience {
        Audience::User => words,
        Audience::Engineer => words.map(|words| words.engineer.as_deref().unwrap_or(words)),
    };
    let instead = || {
        let (from, to) = (said(variable, change.from), said(variable, change.to));
        format!("{from} instead of {to}")
    };
    let Some(words) = words else {
        return ((format!("`{}`", variable.name), "was".to_owned()), instead());
    };
    let head = (words.subject.clone(), words.verb.clone());
    let chosen = if change.from > change.to { &words.more } else { &words.less };
    let what = match (variable.is_ordered(), chosen) {
        (true, Some(what)) => what.clone(),
        (true, None) => instead(),
        (false, _) => {
            let called = |state: State| {
                let label = variable.label(state);
                words.states.get(&label).cloned().unwrap_or(label)
            };
            format!("{} instead of {}", called(change.from), called(change.to))
        }
    };
    // An engineer is told the values, too, unless they have just been told.
    if audience == Audience::Engineer && (words.engineer.is_none() || variable.is_ordered()) {
        return (head, format!("{what} (`{}` {})", variable.name, instead()));
    }
    (head, what)
}

/// A state in words: an interval as `4.5 to 5.5 cm`.
pub fn said(variable: &Variable, state: State) -> String {
    match &variable.states {
        States::Intervals(edges) => {
            let at = usize::from(state);
            let unit = variable.unit.as_ref().map_or_else(String::new, |unit| format!(" {unit}"));
            format!("{} to {}{unit}", rounded(edges[at]), rounded(edges[at + 1]))
        }
        _ => variable.label(state),
    }
}

/// A number with as many digits as a person reads.
pub fn rounded(value: f64) -> String {
    let text = format!("{value:.2}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if text == "-0" { "0".to_owned() } else { text.to_owned() }
}

/// Phrases that end alike, such as "too far to the left of the lower cube" and "too far to the back of the lower cube", need that end once.
fn without_common_end(mut phrases: Vec<String>) -> Vec<String> {
    // Values in parentheses are each variable's own.
    let Some(last) = phrases.last().filter(|last| !last.ends_with(')')) else { return phrases };
    let ends: Vec<String> =
        last.match_indices(" of ").map(|(at, _)| last[at..].to_owned()).collect();
    for end in ends {
        if phrases.iter().all(|phrase| phrase.ends_with(&end)) {
            let many = phrases.len();
            for phrase in &mut phrases[..many - 1] {
                phrase.truncate(phrase.len() - end.len());
            }
            break;
        }
    }
    phrases
}

/// `a`, `a and b`, `a, b and c`.
pub fn joined(parts: &[String]) -> String {
    match parts {
        [] => String::new(),
        [one] => one.clone(),
        [first @ .., last] => format!("{} and {last}", first.join(", ")),
    }
}

/// A text with a capital at its beginning and a full stop at its end.
pub fn sentence(text: &str) -> String {
    let mut letters = text.chars();
    match letters.next() {
        Some(first) => format!("{}{}.", first.to_uppercase(), letters.as_str()),
        None => String::new(),
    }
}
