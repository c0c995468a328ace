//! Conditions, effects and expressions as they are written: flat lists of nodes, each before its operands.

use std::ops::Range;

use super::{Name, Place, TypedList, Unread};

/// A word that joins formulas.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[expect(missing_docs, reason = "each is the word of its own name")]
pub enum Connective {
    And,
    Or,
    Not,
    Imply,
    When,
}

impl Connective {
    /// As PDDL writes it.
    pub fn word(self) -> &'static str {
        match self {
            Self::And => "and",
            Self::Or => "or",
            Self::Not => "not",
            Self::Imply => "imply",
            Self::When => "when",
        }
    }
}

/// `forall` or `exists`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[expect(missing_docs, reason = "each is the word of its own name")]
pub enum Quantifier {
    Forall,
    Exists,
}

impl Quantifier {
    /// As PDDL writes it.
    pub fn word(self) -> &'static str {
        match self {
            Self::Forall => "forall",
            Self::Exists => "exists",
        }
    }
}

/// A word that compares, computes or changes values.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[expect(missing_docs, reason = "each is the word of its own name")]
pub enum Operator {
    Equal,
    Less,
    LessEqual,
    Greater,
    GreaterEqual,
    Add,
    Subtract,
    Multiply,
    Divide,
    Assign,
    Increase,
    Decrease,
    ScaleUp,
    ScaleDown,
}

impl Operator {
    const ALL: [Self; 14] = [
        Self::Equal,
        Self::Less,
        Self::LessEqual,
        Self::Greater,
        Self::GreaterEqual,
        Self::Add,
        Self::Subtract,
        Self::Multiply,
        Self::Divide,
        Self::Assign,
        Self::Increase,
        Self::Decrease,
        Self::ScaleUp,
        Self::ScaleDown,
    ];

    /// The operator that is written like this, in lower case.
    pub fn of(word: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|operator| operator.word() == word)
    }

    /// As PDDL writes it.
    pub fn word(self) -> &'static str {
        match self {
            Self::Equal => "=",
            Self::Less => "<",
            Self::LessEqual => "<=",
            Self::Greater => ">",
            Self::GreaterEqual => ">=",
            Self::Add => "+",
            Self::Subtract => "-",
            Self::Multiply => "*",
            Self::Divide => "/",
            Self::Assign => "assign",
            Self::Increase => "increase",
            Self::Decrease => "decrease",
            Self::ScaleUp => "scale-up",
            Self::ScaleDown => "scale-down",
        }
    }

    /// Whether it makes a condition of two values.
    pub fn compares(self) -> bool {
        matches!(
            self,
            Self::Equal | Self::Less | Self::LessEqual | Self::Greater | Self::GreaterEqual
        )
    }

    /// Whether it makes a number of numbers.
    pub fn computes(self) -> bool {
        matches!(self, Self::Add | Self::Subtract | Self::Multiply | Self::Divide)
    }

    /// Whether it is an effect on a function.
    pub fn changes(self) -> bool {
        !self.compares() && !self.computes()
    }
}

/// When a part of a durative action holds or happens.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[expect(missing_docs, reason = "each is the words of its own name")]
pub enum Time {
    AtStart,
    AtEnd,
    OverAll,
}

impl Time {
    /// As PDDL writes it.
    pub fn words(self) -> &'static str {
        match self {
            Self::AtStart => "at start",
            Self::AtEnd => "at end",
            Self::OverAll => "over all",
        }
    }
}

/// A word that says in which states of a plan a condition must hold, as `:constraints` do.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[expect(missing_docs, reason = "each is the word of its own name")]
pub enum Modality {
    Always,
    Sometime,
    Within,
    AtMostOnce,
    SometimeAfter,
    SometimeBefore,
    AlwaysWithin,
    HoldDuring,
    HoldAfter,
}

impl Modality {
    const ALL: [Self; 9] = [
        Self::Always,
        Self::Sometime,
        Self::Within,
        Self::AtMostOnce,
        Self::SometimeAfter,
        Self::SometimeBefore,
        Self::AlwaysWithin,
        Self::HoldDuring,
        Self::HoldAfter,
    ];

    /// The modality that is written like this, in lower case.
    pub fn of(word: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|modality| modality.word() == word)
    }

    /// As PDDL writes it.
    pub fn word(self) -> &'static str {
        match self {
            Self::Always => "always",
            Self::Sometime => "sometime",
            Self::Within => "within",
            Self::AtMostOnce => "at-most-once",
            Self::SometimeAfter => "sometime-after",
            Self::SometimeBefore => "sometime-before",
            Self::AlwaysWithin => "always-within",
            Self::HoldDuring => "hold-during",
            Self::HoldAfter => "hold-after",
        }
    }

    /// How many points in time come first, and how many conditions follow.
    pub fn operands(self) -> (usize, usize) {
        match self {
            Self::Always | Self::Sometime | Self::AtMostOnce => (0, 1),
            Self::Within | Self::HoldAfter => (1, 1),
            Self::HoldDuring => (2, 1),
            Self::SometimeAfter | Self::SometimeBefore => (0, 2),
            Self::AlwaysWithin => (1, 2),
        }
    }
}

/// A name applied to words, which stand in the `terms` of the formula or the initial state at hand.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Application<'a> {
    /// The predicate, the function, or the action.
    pub name: Name<'a>,
    /// Its arguments.
    pub arguments: Range<u32>,
}

/// What a [`Node`] says. Where operands are spoken of, they are the nodes that follow.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum NodeKind<'a> {
    /// `(NAME TERM …)`: a predicate where a condition is wanted, a function where a value is wanted.
    Apply(Application<'a>),
    /// The same with values of functions among the arguments, which are the operands.
    Nested(Name<'a>),
    /// A variable, an object, a number, `#t` or a function without parentheses as an operand.
    Word(Name<'a>),
    /// A connective with its operands; `()` is an `and` without any.
    Connective(Connective),
    /// A quantifier with its variables; its body is the operand.
    Quantifier(Quantifier, TypedList<'a>),
    /// A comparison, a computation or a change with its operands.
    Operator(Operator),
    /// `at start`, `at end` or `over all`, with one operand.
    Timed(Time),
    /// `preference` with its name, if it has one, and one operand.
    Preference(Option<Name<'a>>),
    /// A modality of `:constraints` with its points in time and its operands.
    Trajectory(Modality, Vec<Name<'a>>),
    /// What is not read.
    Unread(Unread<'a>),
}

/// One node of a [`Formula`].
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Node<'a> {
    /// What it says.
    pub kind: NodeKind<'a>,
    /// The node after this one and all of its operands.
    pub next: u32,
    /// The whole of it.
    pub place: Place,
    /// Its first word.
    pub keyword: Place,
}

/// A condition, an effect or an expression: nodes, each before its operands.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Formula<'a> {
    /// The nodes; the first is the outermost.
    pub nodes: Vec<Node<'a>>,
    /// The arguments of all nodes.
    pub terms: Vec<Name<'a>>,
}

impl<'a> Formula<'a> {
    /// The arguments of an application in this formula.
    pub fn arguments(&self, application: &Application<'a>) -> &[Name<'a>] {
        &self.terms[application.arguments.start as usize..application.arguments.end as usize]
    }

    /// The operands of the node at `index`.
    pub fn operands(&self, index: usize) -> impl Iterator<Item = usize> + '_ {
        let end = self.nodes[index].next as usize;
        let mut at = index + 1;
        std::iter::from_fn(move || {
            let current = at;
            (current < end).then(|| {
                at = self.nodes[current].next as usize;
                current
            })
        })
    }
}
