//! A text and the [`Tool`]s that are to read it go in; a warning comes out for each thing that one of them refuses or misreads.
//!
//! What stands in the text is found once ([`survey`]); what each tool makes of it is a table ([`fact`]).
//! Both work on the tree alone, so a text need not be understood, nor even be right.

mod survey;
mod word;
mod fact;

use crate::diagnostic::{Diagnostics, not_portable};
use crate::source::{SourceId, Sources};
use crate::tree;

/// A program that reads PDDL.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[expect(missing_docs, reason = "each is the program of its own name")]
pub enum Tool {
    FastDownward,
    Val,
    Popf,
    Optic,
    Enhsp,
    Tamer,
    UnifiedPlanning,
    Aries,
    Pddl,
}

impl Tool {
    /// All of them.
    pub const ALL: [Self; 9] = [
        Self::FastDownward,
        Self::Val,
        Self::Popf,
        Self::Optic,
        Self::Enhsp,
        Self::Tamer,
        Self::UnifiedPlanning,
        Self::Aries,
        Self::Pddl,
    ];

    /// Its name on a command line.
    pub fn name(self) -> &'static str {
        match self {
            Self::FastDownward => "fast-downward",
            Self::Val => "val",
            Self::Popf => "popf",
            Self::Optic => "optic",
            Self::Enhsp => "enhsp",
            Self::Tamer => "tamer",
            Self::UnifiedPlanning => "unified-planning",
            Self::Aries => "aries",
            Self::Pddl => "pddl",
        }
    }

    /// Its name in a sentence.
    pub fn title(self) -> &'static str {
        match self {
            Self::FastDownward => "Fast Downward",
            Self::Val => "VAL",
            Self::Popf => "POPF",
            Self::Optic => "OPTIC",
            Self::Enhsp => "ENHSP",
            Self::Tamer => "Tamer",
            Self::UnifiedPlanning => "unified-planning",
            Self::Aries => "aries",
            Self::Pddl => "the Python package `pddl`",
        }
    }

    /// The tool of this name.
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|tool| tool.name() == name)
    }
}

/// What `tools` refuse or misread in a text: of each thing the first, once for each tool.
pub fn check(sources: &Sources, id: SourceId, tools: &[Tool]) -> Diagnostics {
    let mut diagnostics = Diagnostics::default();
    if tools.is_empty() {
        return diagnostics;
    }
    let tree = tree::parse(id, &sources.get(id).text, &mut Diagnostics::default());
    for found in survey::survey(&tree) {
        for &tool in Tool::ALL.iter().filter(|tool| tools.contains(tool)) {
            if let Some(judged) = fact::judge(tool, &found) {
                diagnostics.push(not_portable::not_portable(
                    tool.title(),
                    judged.does,
                    &judged.what,
                    found.span,
                    &judged.instead,
                ));
            }
        }
    }
    diagnostics
}

#[cfg(test)]
mod tests;
