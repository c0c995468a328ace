//! The kinds of annotation: one row for each, with its name, where it may stand, and its own check.
//!
//! To add a kind is to add a row, its function, and a line in `docs/annotations.md`.

use super::place::Place;
use super::{Annotation, Models, shape};
use crate::diagnostic::Diagnostics;

/// A kind of annotation.
#[derive(Debug)]
pub struct Kind {
    /// Its keyword.
    pub name: &'static str,
    /// What it says, in a few words.
    pub summary: &'static str,
    /// Where it may stand.
    pub stands: &'static [Stand],
    /// Says what is wrong with one. It may look at the models, as far as there are any.
    pub check: fn(&Annotation, Models<'_>, &mut Diagnostics),
}

/// A place where a kind may stand.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Stand {
    /// In a domain, between its sections.
    Domain,
    /// In a problem, between its sections.
    Problem,
    /// In the section with this keyword.
    Section(&'static str),
    /// In an action, or in a field of one.
    Action,
    /// In the precondition of an action, or the condition of a durative one.
    Condition,
}

/// All kinds.
pub static KINDS: [Kind; 6] = [
    Kind {
        name: ":causal",
        summary: "how likely the action succeeds, by a causal model",
        stands: &[Stand::Condition],
        check: shape::causal,
    },
    Kind {
        name: ":measured",
        summary: "quantities that are measured or controlled when a plan is carried out",
        stands: &[Stand::Domain],
        check: shape::measured,
    },
    Kind {
        name: ":observed",
        summary: "values of measured quantities in the initial state",
        stands: &[Stand::Problem, Stand::Section(":init")],
        check: shape::observed,
    },
    Kind {
        name: ":exactly-one",
        summary: "atoms of which one is true in every state",
        stands: &[Stand::Domain, Stand::Section(":predicates")],
        check: shape::group,
    },
    Kind {
        name: ":at-most-one",
        summary: "atoms of which no two are true in any state",
        stands: &[Stand::Domain, Stand::Section(":predicates")],
        check: shape::group,
    },
    Kind {
        name: ":seen",
        summary: "where a learned action comes from",
        stands: &[Stand::Action],
        check: shape::seen,
    },
];

/// The kind of this name.
pub fn find(name: &str) -> Option<&'static Kind> {
    KINDS.iter().find(|kind| kind.name.eq_ignore_ascii_case(name))
}

impl Stand {
    /// Whether `place` is such a place.
    pub fn admits(self, place: &Place) -> bool {
        match (self, place) {
            (Self::Domain, Place::Domain)
            | (Self::Problem, Place::Problem)
            | (Self::Action, Place::Action { .. } | Place::Field { .. }) => true,
            (Self::Section(keyword), Place::Section { keyword: found }) => keyword == found,
            (Self::Condition, Place::Field { field, .. }) => {
                matches!(field.as_str(), ":precondition" | ":condition")
            }
            _ => false,
        }
    }

    /// In words, to stand after "it stands".
    pub fn describe(self) -> String {
        match self {
            Self::Domain => "in a domain, between its sections".to_owned(),
            Self::Problem => "in a problem, between its sections".to_owned(),
            Self::Section(keyword) => format!("in `{keyword}`"),
            Self::Action => "in an action".to_owned(),
            Self::Condition => "in the precondition of an action".to_owned(),
        }
    }
}
