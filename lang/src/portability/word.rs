//! The words that a [`Tool`] takes in `:requirements`, and those that it does not take as names.

use super::Tool;
use super::survey::Feature;

/// Whether `tool` reads a file with this flag.
pub(super) fn takes_flag(tool: Tool, flag: &str) -> bool {
    let among = |flags: &str| flags.split_whitespace().any(|known| known == flag);
    match tool {
        Tool::FastDownward => among(FAST_DOWNWARD),
        Tool::UnifiedPlanning | Tool::Tamer => among(UNIFIED_PLANNING),
        Tool::Pddl => among(PDDL),
        Tool::Enhsp => flag != ":constraints",
        Tool::Val | Tool::Popf | Tool::Optic | Tool::Aries => true,
    }
}

const FAST_DOWNWARD: &str = ":strips :adl :typing :negation :equality :negative-preconditions :disjunctive-preconditions \
        :existential-preconditions :universal-preconditions :quantified-preconditions \
        :conditional-effects :derived-predicates :action-costs";

const UNIFIED_PLANNING: &str = ":strips :typing :negative-preconditions :disjunctive-preconditions :equality \
        :existential-preconditions :universal-preconditions :quantified-preconditions \
        :conditional-effects :fluents :numeric-fluents :adl :durative-actions \
        :duration-inequalities :timed-initial-literals :timed-initial-effects :action-costs \
        :hierarchy :method-preconditions :constraints :contingent :preferences :time \
        :continuous-effects";

const PDDL: &str = ":strips :typing :negative-preconditions :disjunctive-preconditions :universal-preconditions \
        :existential-preconditions :quantified-preconditions :equality :conditional-effects :adl \
        :derived-predicates :non-deterministic :fluents :numeric-fluents :action-costs";

/// Whether `tool` reads `name` as a keyword where it names something of the kind `role`.
pub(super) fn is_reserved(tool: Tool, name: &str, role: Feature) -> bool {
    let among = |words: &str| words.split_whitespace().any(|known| known == name);
    match (tool, role) {
        (Tool::Val, Feature::Name | Feature::Variable) => among(VAL_WORDS),
        (Tool::Enhsp, Feature::Name) => among(ENHSP_WORDS),
        (Tool::Enhsp, Feature::Variable) => name == "duration",
        (Tool::UnifiedPlanning | Tool::Tamer, Feature::PredicateName) => {
            among(UNIFIED_PLANNING_WORDS)
        }
        (Tool::Pddl, Feature::Name | Feature::Variable) => among(PDDL_WORDS),
        _ => false,
    }
}

const VAL_WORDS: &str = "after always always-within and assign at-most-once decrease define domain duration either \
        exists forall hold-after hold-during imply increase is-violated maximize minimize name not \
        number or preference problem scale-down scale-up sometime sometime-after sometime-before \
        supply-demand total-time when within";

const ENHSP_WORDS: &str = "all always always-within and assign at-most-once decrease define domain either end exists \
        forall hold-after hold-during imply increase is-violated maximize minimize not number oneof \
        or over preference problem scale-down scale-up sometime sometime-after sometime-before \
        start when within";

const UNIFIED_PLANNING_WORDS: &str = "always and at-most-once exists forall imply not oneof or sometime sometime-after \
        sometime-before";

const PDDL_WORDS: &str = "assign decrease define domain either increase maximize minimize object oneof \
     problem scale-down scale-up when";
