#![doc = include_str!("parts_disagree.md")]

use super::{Diagnostic, Rule, Severity};
use crate::source::Span;

/// The kind `parts-disagree`.
pub const RULE: Rule = Rule {
    code: "E0811",
    name: "parts-disagree",
    severity: Severity::Error,
    page: include_str!("parts_disagree.md"),
};

/// What two files say, and where.
#[derive(Debug, Clone)]
pub struct Sides {
    /// Both statements in a few words.
    pub how: [String; 2],
    /// Where they stand.
    pub spans: [Span; 2],
}

/// The files of two agents disagree about something: the type of an object, an action.
pub fn parts_disagree(about: &str, sides: Sides) -> Diagnostic {
    let Sides { how: [first, second], spans: [there, here] } = sides;
    let message = format!("the files of two agents disagree about {about}: {first}, and {second}");
    RULE.at(here, message, second).label(there, first)
}

/// A disagreement that leaves the task with a meaning.
#[must_use]
pub fn only_a_warning(mut diagnostic: Diagnostic) -> Diagnostic {
    diagnostic.severity = Severity::Warning;
    diagnostic
}
