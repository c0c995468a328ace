#![doc = include_str!("connective_in_init.md")]

use super::{Diagnostic, Rule, Severity};
use crate::source::Span;

/// The kind `connective-in-init`.
pub const RULE: Rule = Rule {
    code: "E0012",
    name: "connective-in-init",
    severity: Severity::Error,
    page: include_str!("connective_in_init.md"),
};

/// `keyword` joins facts in `:init`, which is a list of facts already.
pub fn connective_in_init(keyword: &str, span: Span) -> Diagnostic {
    let diagnostic = RULE.at(
        span,
        format!("`:init` is a list of facts; `{keyword}` is not allowed here"),
        "not a fact",
    );
    if keyword.eq_ignore_ascii_case("and") {
        diagnostic.help("remove `(and` and its closing `)`: all facts of `:init` hold together")
    } else {
        diagnostic.help("list the facts that hold; all others are false")
    }
}
