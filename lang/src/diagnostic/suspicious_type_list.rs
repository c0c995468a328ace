#![doc = include_str!("suspicious_type_list.md")]

use super::{Diagnostic, Rule, Severity};
use crate::source::Span;

/// The kind `suspicious-type-list`.
pub const RULE: Rule = Rule {
    code: "W0201",
    name: "suspicious-type-list",
    severity: Severity::Warning,
    page: include_str!("suspicious_type_list.md"),
};

/// `name` stands on a line of its own and gets the type `above`, which stands at `reference`; `list` is all that gets it.
pub fn suspicious_type_list(
    name: &str,
    span: Span,
    above: &str,
    reference: Span,
    list: &str,
) -> Diagnostic {
    let after = Span { start: span.end, ..span };
    RULE.at(
        span,
        format!("`{name}` becomes a subtype of `{above}`"),
        "on a line of its own, but the list runs on to the next `-`",
    )
    .label(reference, format!("this supertype applies to `{list}`"))
    .help(format!("write `{name} - object`, or move untyped names to the end of `:types`"))
    .fix(format!("write `{name} - object`"), after, " - object")
}

#[cfg(test)]
mod tests {
    use crate::diagnostic::fixture::check;

    #[test]
    fn a_line_of_its_own() {
        check(&["(define (domain d)
  (:requirements :typing)
  (:types
    room ; no type
;   ^^^^ W0201: `room` becomes a subtype of `dish`
    cup plate - dish
    dish))
"]);
    }

    #[test]
    fn one_name_in_each_line_is_a_style() {
        check(&["(define (domain d)
  (:requirements :typing)
  (:types
    cup
    plate
    bowl - dish
    room
    hall corridor - object
    dish))
"]);
    }

    #[test]
    fn a_long_list_is_wrapped() {
        check(&["(define (domain d)
  (:requirements :typing)
  (:types cup plate bowl
    glass pan - dish))
"]);
    }
}
