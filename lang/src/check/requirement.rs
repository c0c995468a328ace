//! What `:requirements` can declare, what each flag stands for, and what needs which.

use std::collections::BTreeSet;

use super::Report;
use crate::ast::Name;
use crate::diagnostic::{Diagnostics, unknown_requirement};
use crate::model::Requirement;
use crate::near::nearest;
use crate::source::Span;

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
const OBJECTS: u32 = 1 << 12;
const DURATIVE: u32 = 1 << 13;
const INEQUALITIES: u32 = 1 << 14;
const CONTINUOUS: u32 = 1 << 15;
const TIMED: u32 = 1 << 16;
const PREFERENCES: u32 = 1 << 17;
const CONSTRAINTS: u32 = 1 << 18;
const PROCESSES: u32 = 1 << 19;
const HIERARCHY: u32 = 1 << 20;
/// Each file belongs to one agent.
const FACTORED: u32 = 1 << 21;
const NETWORK: u32 = 1 << 22;
/// Private predicates and objects say whose they are.
const UNFACTORED: u32 = 1 << 23;
/// Known by name and without meaning for what is checked.
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
    (":fluents", NUMERIC | OBJECTS),
    (":object-fluents", OBJECTS),
    (":durative-actions", DURATIVE),
    (":duration-inequalities", DURATIVE | INEQUALITIES),
    (":continuous-effects", DURATIVE | CONTINUOUS),
    (":timed-initial-literals", TIMED),
    (":timed-initial-fluents", TIMED),
    (":timed-effects", OTHER),
    (":preferences", PREFERENCES),
    (":constraints", CONSTRAINTS),
    (":goal-utilities", NUMERIC),
    (":time", PROCESSES | CONTINUOUS | NUMERIC),
    (":processes", PROCESSES),
    (":events", PROCESSES),
    (":process", PROCESSES),
    (":event", PROCESSES),
    (":non-deterministic", OTHER),
    (":probabilistic-effects", OTHER),
    (":rewards", OTHER),
    (":mdp", OTHER),
    (":contingent", OTHER),
    (":partial-observability", OTHER),
    (":hierarchy", HIERARCHY),
    (":hierachie", HIERARCHY),
    (":htn", HIERARCHY),
    (":method-preconditions", OTHER),
    (":multi-agent", AGENTS),
    (":unfactored-privacy", AGENTS | UNFACTORED),
    (":factored-privacy", AGENTS | FACTORED),
    (":concurrency-network", NETWORK),
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

    /// Whether the file belongs to one agent, so that what is private needs no owner.
    pub(super) fn factored(self) -> bool {
        self.0 & FACTORED != 0
    }

    /// Those that the model knows.
    pub(super) fn requirements(self) -> BTreeSet<Requirement> {
        MODEL.into_iter().filter(|(flag, _)| self.0 & flag != 0).map(|(_, one)| one).collect()
    }

    /// That of types alone.
    pub(super) const TYPES: Self = Self(TYPING);

    /// What the model knows, as a set again.
    pub(super) fn from_model(requirements: &BTreeSet<Requirement>) -> Self {
        let declared = MODEL.into_iter().filter(|(_, one)| requirements.contains(one));
        Self(declared.fold(0, |all, (flag, _)| all | flag))
    }
}

/// The flags that the model knows.
const MODEL: [(u32, Requirement); 23] = [
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
    (NUMERIC, Requirement::NumericFluents),
    (OBJECTS, Requirement::ObjectFluents),
    (DURATIVE, Requirement::DurativeActions),
    (INEQUALITIES, Requirement::DurationInequalities),
    (CONTINUOUS, Requirement::ContinuousEffects),
    (TIMED, Requirement::TimedInitialLiterals),
    (PREFERENCES, Requirement::Preferences),
    (CONSTRAINTS, Requirement::Constraints),
    (PROCESSES, Requirement::Time),
    (HIERARCHY, Requirement::Hierarchy),
    (AGENTS, Requirement::MultiAgent),
    (FACTORED, Requirement::FactoredPrivacy),
    (UNFACTORED, Requirement::UnfactoredPrivacy),
];

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

/// Where a missing requirement can be written: after the last one, or else after the name of the domain; and whether the list is missing too.
pub(super) fn place(last: Option<Name<'_>>, domain: Name<'_>) -> (Span, bool) {
    match last {
        Some(last) => (Span { start: last.span.end, ..last.span }, false),
        // The `)` of `(domain NAME)` is the byte after the name, unless somebody left a blank there.
        None => (Span { start: domain.span.end, ..domain.span }, true),
    }
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
    NumericCondition,
    NumericEffect,
    ObjectFluent,
    DurativeAction,
    DurationInequality,
    ContinuousEffect,
    TimedLiteral,
    Preference,
    Constraint,
    Process,
    Hierarchy,
    Concurrency,
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
            Self::NumericCondition => (NUMERIC, 0, ":numeric-fluents", "a condition on numbers"),
            Self::NumericEffect => (NUMERIC, 0, ":numeric-fluents", "a numeric effect"),
            Self::ObjectFluent => {
                (OBJECTS, 0, ":object-fluents", "a function with objects as values")
            }
            Self::DurativeAction => (DURATIVE, 0, ":durative-actions", "a durative action"),
            Self::DurationInequality => {
                (INEQUALITIES, 0, ":duration-inequalities", "a bound on the duration")
            }
            Self::ContinuousEffect => (CONTINUOUS, 0, ":continuous-effects", "`#t`"),
            Self::TimedLiteral => {
                (TIMED, 0, ":timed-initial-literals", "a fact at a point in time")
            }
            Self::Preference => (PREFERENCES, 0, ":preferences", "a preference"),
            Self::Constraint => {
                (CONSTRAINTS, PREFERENCES, ":constraints", "a constraint on the whole plan")
            }
            Self::Process => (PROCESSES, 0, ":time", "a process or an event"),
            Self::Hierarchy => (HIERARCHY, 0, ":hierarchy", "a task network"),
            Self::Concurrency => (NETWORK, 0, ":concurrency-network", "a concurrency constraint"),
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
