//! What there is to say about a text: one [`Diagnostic`] per mistake, gathered in [`Diagnostics`].
//!
//! A diagnostic is plain data. How it looks is decided in the renderers.

use crate::source::Span;

/// How bad it is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Severity {
    /// Worth knowing; the text means what it says.
    Warning,
    /// The text has no meaning as it stands.
    Error,
}

/// A place that helps to understand the mistake, and what is to be seen there.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Label {
    /// Where.
    pub span: Span,
    /// What is to be seen there; may be empty.
    pub text: String,
}

/// A change of the text that mends the mistake without changing anything else.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Fix {
    /// What it does, as an instruction: "replace with `:predicates`".
    pub title: String,
    /// The ranges to replace, and by what.
    pub edits: Vec<(Span, String)>,
}

/// One mistake.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Diagnostic {
    /// The stable code, such as `E0101`.
    pub code: &'static str,
    /// The stable name in kebab-case, such as `unknown-predicate`.
    pub name: &'static str,
    /// Error or warning.
    pub severity: Severity,
    /// One terse sentence without a full stop.
    pub message: String,
    /// Where the mistake is, and what is wrong there.
    pub primary: Label,
    /// Places that show the cause: the declaration, the enclosing action.
    pub secondary: Vec<Label>,
    /// What to do about it.
    pub help: Option<String>,
    /// Ways to mend it that a machine can apply.
    pub fixes: Vec<Fix>,
}

/// All mistakes found so far, in the order in which they were found.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Diagnostics {
    /// The mistakes.
    pub list: Vec<Diagnostic>,
}

impl Diagnostics {
    /// Whether one of them is an error.
    pub fn has_errors(&self) -> bool {
        self.list.iter().any(|diagnostic| diagnostic.severity == Severity::Error)
    }

    /// Adds one.
    pub fn push(&mut self, diagnostic: Diagnostic) {
        self.list.push(diagnostic);
    }

    /// Adds all of `other`.
    pub fn append(&mut self, mut other: Self) {
        self.list.append(&mut other.list);
    }
}
