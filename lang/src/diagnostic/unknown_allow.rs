#![doc = include_str!("unknown_allow.md")]

use super::{Diagnostic, Rule, Severity};
use crate::source::Span;

/// The kind `unknown-allow`.
pub const RULE: Rule = Rule {
    code: "W0008",
    name: "unknown-allow",
    severity: Severity::Warning,
    page: include_str!("unknown_allow.md"),
};

/// `name` is no warning; `error` says whether it is an error instead.
pub fn unknown_allow(name: &str, span: Span, error: bool, near: Option<&str>) -> Diagnostic {
    if error {
        let message = format!("`{name}` is an error, which cannot be silenced");
        return RULE.at(span, message, "not a warning").help("mend what it says");
    }
    RULE.at(span, format!("there is no warning `{name}`"), "no such name").suggest(near).safely()
}

#[cfg(test)]
mod tests {
    use super::unknown_allow;
    use crate::source::Span;

    #[test]
    fn errors_and_misspelt_names_are_told_apart() {
        let error = unknown_allow("unknown-type", Span::default(), true, None);
        assert_eq!(error.message, "`unknown-type` is an error, which cannot be silenced");
        let name = unknown_allow("shadow", Span::default(), false, None);
        assert_eq!(name.message, "there is no warning `shadow`");
        let near = unknown_allow("unused", Span::default(), false, Some("unused-parameter"));
        assert_eq!(near.help.as_deref(), Some("did you mean `unused-parameter`?"));
    }
}
