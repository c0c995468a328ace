//! A word goes in; what it leads a reader to expect comes out: which lists may stand in its list, and how many.
//!
//! This is the grammar as far as a reader needs it who looks for a parenthesis that is missing.
//! It is asked only where parentheses do not match, and it decides between places for a repair; what is right is not its business.

use super::outline;
use crate::lexer;

/// What a list contains.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Kind {
    /// Its first word has not been read; the role says what may come.
    New(Role),
    /// `(define …)`
    Definition,
    /// `(domain NAME)`
    Title,
    /// `(:action NAME :field value …)`
    Fields,
    /// `(:predicates (p ?x) …)`
    Declarations,
    /// `(:private ?a - agent (p ?x) …)`
    Private,
    /// `(:objects a b - t …)`; keywords too in `(:requirements …)`.
    Names { keywords: bool },
    /// `(:init (p a) …)`
    Facts,
    /// So many formulas and nothing else.
    Formulas { least: u32, most: u32 },
    /// `(:derived (p ?x) FORMULA)`
    Derived,
    /// `(forall (?x) FORMULA)`
    Quantifier,
    /// Two words or lists.
    Operands,
    /// A function in parentheses and its value.
    Value,
    /// `(:metric minimize …)`
    Metric,
    /// `(at …)` and `(over …)`, of which the next word says whether it is about time.
    At,
    /// `(at start FORMULA)`
    Timed,
    /// A name and words.
    Atom,
    /// Words only.
    Words,
    /// `?x - t …`; after a name if it is a declaration.
    Variables,
    /// Formulas, with words between them.
    Loose,
    /// `(+ …)`
    Arithmetic,
    /// Whatever there may be.
    Free,
}

/// What a list is wanted for where it stands.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Role {
    /// Outside all lists.
    Top,
    Title,
    Section,
    Declaration,
    Variables,
    Formula,
    /// Of the initial state.
    Fact,
    Expression,
    /// `(either …)`
    Type,
    /// `(either …)` and `(:private …)`
    Part,
    /// Of a field whose value is written in words.
    Words,
    Free,
}

/// What a word is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Word {
    /// It starts with a colon: what its list contains if it is the first, and what follows it if it is not.
    Keyword(Kind, Role),
    Variable,
    Dash,
    Number,
    Define,
    /// `domain`, `problem`
    Title,
    /// `either`
    Either,
    /// `start`, `end`, `all`
    Time,
    /// The first word of a formula, with what such a list contains.
    Connective(Kind),
    /// `at`, `over`, `+`: a name as well.
    Ambiguous(Kind),
    Name,
}

/// Formulas, however many.
const ANY: Kind = Kind::Formulas { least: 0, most: u32::MAX };

const fn exactly(count: u32) -> Kind {
    Kind::Formulas { least: count, most: count }
}

impl Word {
    /// What `text` is; the case does not matter. Only the first word of a list can be a misspelt section.
    pub(super) fn read(text: &str, first: bool) -> Self {
        let lower = text.to_ascii_lowercase();
        let digits = text.trim_start_matches(['-', '+', '.']);
        match text.as_bytes()[0] {
            b':' => {
                let meant = if first { outline::intended(&lower) } else { None };
                return Self::Keyword(section(meant.unwrap_or(&lower)), field(&lower));
            }
            b'?' => return Self::Variable,
            b'#' => return Self::Number,
            _ if lexer::is_dash(text) => return Self::Dash,
            _ if digits
                .bytes()
                .all(|byte| byte.is_ascii_digit() || matches!(byte, b'.' | b'e'))
                && digits.starts_with(|c: char| c.is_ascii_digit()) =>
            {
                return Self::Number;
            }
            _ => {}
        }
        match lower.as_str() {
            "define" => Self::Define,
            "domain" | "problem" => Self::Title,
            "either" => Self::Either,
            "start" | "end" | "all" => Self::Time,
            "and" | "or" => Self::Connective(ANY),
            "not" => Self::Connective(exactly(1)),
            "imply" | "when" => Self::Connective(exactly(2)),
            "forall" | "exists" => Self::Connective(Kind::Quantifier),
            "=" | "<" | ">" | "<=" | ">=" => Self::Connective(Kind::Operands),
            "increase" | "decrease" | "assign" | "scale-up" | "scale-down" => {
                Self::Ambiguous(Kind::Value)
            }
            "preference" | "always" | "sometime" | "within" | "at-most-once" | "sometime-after"
            | "sometime-before" | "always-within" | "hold-during" | "hold-after" | "oneof"
            | "probabilistic" | "unknown" => Self::Ambiguous(Kind::Loose),
            "at" | "over" => Self::Ambiguous(Kind::At),
            "+" | "*" | "/" => Self::Ambiguous(Kind::Arithmetic),
            _ => Self::Name,
        }
    }
}

/// What a section contains, by its keyword in lower case.
fn section(keyword: &str) -> Kind {
    match keyword {
        ":requirements" => Kind::Names { keywords: true },
        ":types" | ":constants" | ":objects" | ":domain" => Kind::Names { keywords: false },
        ":predicates" | ":functions" => Kind::Declarations,
        ":action"
        | ":durative-action"
        | ":process"
        | ":event"
        | ":method"
        | ":task"
        | ":htn"
        | ":concurrency-constraint" => Kind::Fields,
        ":derived" => Kind::Derived,
        ":init" => Kind::Facts,
        ":metric" => Kind::Metric,
        ":goal" | ":constraints" => exactly(1),
        _ => Kind::Free,
    }
}

/// What is wanted after the keyword of a field.
fn field(keyword: &str) -> Role {
    match keyword {
        ":parameters" | ":vars" => Role::Variables,
        ":precondition" | ":effect" | ":condition" | ":duration" | ":constraints" | ":context"
        | ":implies" | ":observe" => Role::Formula,
        ":agent" | ":comment" => Role::Words,
        _ => Role::Free,
    }
}
