//! What `:requirements` can declare, what each flag stands for, and what needs which.

use std::collections::BTreeSet;

use super::Report;
use crate::ast::Name;
use crate::diagnostic::{Diagnostics, unknown_requirement};
use crate::model::Requirement;
use crate::near::nearest;

/// A set of flags, with the aggregates taken apart.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Flags(u32);

const STRIPS: u32 = 1;
const TYPING: u32 = 1 << 1;
const EQUALITY: u32 = 1 << 2;
const NEGATIVE: u32 = 1 << 3;
const DISJUNCTIVE: u32 = 1 << 4;
const EXISTENTIAL: u32 = 1 << 5;
const UNIVERSAL: u32 = 1 << 6;
const CONDITIONAL: u32 = 1 << 7;
const DERIVED: u32 = 1 << 8;
const COSTS: u32 = 1 << 9;
const NUMERIC: u32 = 1 << 10;
const AGENTS: u32 = 1 << 11;
/// Known by name and without meaning for what is checked so far.
const OTHER: u32 = 0;

const QUANTIFIED: u32 = EXISTENTIAL | UNIVERSAL;
const ADL: u32 = STRIPS | TYPING | EQUALITY | NEGATIVE | DISJUNCTIVE | QUANTIFIED | CONDITIONAL;

/// Every flag that PDDL and its dialects know, with what it stands for.
const KNOWN: [(&str, u32); 60] = [
    (":strips", STRIPS),
    (":typing", TYPING),
    (":equality", EQUALITY),
    (":negative-preconditions", NEGATIVE),
    (":disjunctive-preconditions", DISJUNCTIVE),
    (":existential-preconditions", EXISTENTIAL),
    (":universal-preconditions", UNIVERSAL),
    (":quantified-preconditions", QUANTIFIED),
    (":conditional-effects", CONDITIONAL),
    (":adl", ADL),
    (":ucpop", ADL | DERIVED),
    (":negation", NEGATIVE),
    (":derived-predicates", DERIVED),
    (":domain-axioms", DERIVED),
    (":action-costs", COSTS),
    (":numeric-fluents", NUMERIC),
    (":fluents", NUMERIC),
    (":object-fluents", OTHER),
    (":durative-actions", OTHER),
    (":duration-inequalities", OTHER),
    (":continuous-effects", OTHER),
    (":timed-initial-literals", OTHER),
    (":timed-initial-fluents", OTHER),
    (":timed-effects", OTHER),
    (":preferences", OTHER),
    (":constraints", OTHER),
    (":goal-utilities", OTHER),
    (":time", OTHER),
    (":processes", OTHER),
    (":events", OTHER),
    (":process", OTHER),
    (":event", OTHER),
    (":non-deterministic", OTHER),
    (":probabilistic-effects", OTHER),
    (":rewards", OTHER),
    (":mdp", OTHER),
    (":contingent", OTHER),
    (":partial-observability", OTHER),
    (":hierarchy", OTHER),
    (":hierachie", OTHER),
    (":htn", OTHER),
    (":method-preconditions", OTHER),
    (":multi-agent", AGENTS),
    (":unfactored-privacy", OTHER),
    (":factored-privacy", OTHER),
    (":concurrency-network", OTHER),
    (":action-expansions", OTHER),
    (":foreach-expansions", OTHER),
    (":dag-expansions", OTHER),
    (":subgoal-through-axioms", OTHER),
    (":safety-constraints", OTHER),
    (":expression-evaluation", OTHER),
    (":open-world", OTHER),
    (":true-negation", OTHER),
    (":derived-functions", OTHER),
    (":supply-demand", OTHER),
    (":job-scheduling", OTHER),
    (":numeric-preconditions", NUMERIC),
    (":procedural-attachment", OTHER),
    (":socs", OTHER),
];

impl Flags {
    /// Whether one of `flags` is in the set.
    pub(super) fn meets(self, flags: Self) -> bool {
        self.0 & flags.0 != 0
    }

    /// Whether actions may have agents.
    pub(super) fn agents(self) -> bool {
        self.0 & AGENTS != 0
    }

    /// Puts all of `flags` into the set.
    pub(super) fn add(&mut self, flags: Self) {
        self.0 |= flags.0;
    }

    /// Those that the model knows.
    pub(super) fn requirements(self) -> BTreeSet<Requirement> {
        let table = [
            (STRIPS, Requirement::Strips),
            (TYPING, Requirement::Typing),
            (EQUALITY, Requirement::Equality),
            (NEGATIVE, Requirement::NegativePreconditions),
            (DISJUNCTIVE, Requirement::DisjunctivePreconditions),
            (EXISTENTIAL, Requirement::ExistentialPreconditions),
            (UNIVERSAL, Requirement::UniversalPreconditions),
            (CONDITIONAL, Requirement::ConditionalEffects),
            (DERIVED, Requirement::DerivedPredicates),
            (COSTS, Requirement::ActionCosts),
        ];
        table
            .into_iter()
            .filter(|(flag, _)| self.0 & flag != 0)
            .map(|(_, requirement)| requirement)
            .collect()
    }

    /// That of types alone.
    pub(super) const TYPES: Self = Self(TYPING);

    /// What the model knows, as a set again.
    pub(super) fn from_model(requirements: &BTreeSet<Requirement>) -> Self {
        let flag = |requirement: &Requirement| match requirement {
            Requirement::Strips => STRIPS,
            Requirement::Typing => TYPING,
            Requirement::Equality => EQUALITY,
            Requirement::NegativePreconditions => NEGATIVE,
            Requirement::DisjunctivePreconditions => DISJUNCTIVE,
            Requirement::ExistentialPreconditions => EXISTENTIAL,
            Requirement::UniversalPreconditions => UNIVERSAL,
            Requirement::ConditionalEffects => CONDITIONAL,
            Requirement::DerivedPredicates => DERIVED,
            Requirement::ActionCosts => COSTS,
        };
        Self(requirements.iter().map(flag).fold(0, |all, one| all | one))
    }
}

/// Reads the flags. A misspelt one counts as the one that was probably meant.
pub(super) fn read<'a>(
    names: impl Iterator<Item = Name<'a>>,
    diagnostics: &mut Diagnostics,
) -> Flags {
    let mut flags = Flags(STRIPS);
    for name in names {
        let known = |wanted: &str| KNOWN.iter().find(|(flag, _)| flag.eq_ignore_ascii_case(wanted));
        if let Some(&(_, meaning)) = known(name.text) {
            flags.0 |= meaning;
            continue;
        }
        let near = nearest(name.text, KNOWN.iter().map(|&(flag, _)| flag));
        diagnostics.push(unknown_requirement::unknown_requirement(name.text, name.span, near));
        if let Some(&(_, meaning)) = near.and_then(known) {
            flags.0 |= meaning;
        }
    }
    flags
}

/// Something that a requirement allows.
#[derive(Debug, Clone, Copy)]
pub(super) enum Need {
    Types,
    Equality,
    Negation,
    Disjunction,
    Exists,
    Forall,
    ConditionalEffect,
    Derived,
    Costs,
}

impl Need {
    /// The flags of which one must be declared, the one to propose with its name, and what needs it.
    pub(super) fn describe(self) -> (Flags, Flags, &'static str, &'static str) {
        let (flag, others, name, what) = match self {
            Self::Types => (TYPING, 0, ":typing", "a type"),
            Self::Equality => (EQUALITY, 0, ":equality", "`=`"),
            // By the grammar `:disjunctive-preconditions` allows `not` of any condition, and so of an atom.
            Self::Negation => {
                (NEGATIVE, DISJUNCTIVE, ":negative-preconditions", "`not` in a condition")
            }
            Self::Disjunction => (DISJUNCTIVE, 0, ":disjunctive-preconditions", "a disjunction"),
            Self::Exists => (EXISTENTIAL, 0, ":existential-preconditions", "`exists`"),
            Self::Forall => (UNIVERSAL, 0, ":universal-preconditions", "`forall` in a condition"),
            Self::ConditionalEffect => {
                (CONDITIONAL, 0, ":conditional-effects", "`when` or `forall` in an effect")
            }
            Self::Derived => (DERIVED, 0, ":derived-predicates", "a derived predicate"),
            Self::Costs => (COSTS, NUMERIC, ":action-costs", "an action cost"),
        };
        (Flags(flag | others), Flags(flag), name, what)
    }
}

impl Report<'_> {
    /// Adds flags that are declared elsewhere, such as in the problem.
    pub(super) fn declare(&mut self, flags: Flags) {
        self.declared.add(flags);
    }
}
