//! What each [`Tool`] makes of each [`Feature`], as a table.
//!
//! Fast Downward 26.6, unified-planning 1.3.0, Tamer (`up-tamer` 1.1.6), ENHSP (of `up-enhsp` 0.1.1) and the Python package `pddl` 0.5
//! were given files with one feature each. VAL is judged by its grammar (of October 2021), POPF and OPTIC by their own pages,
//! aries by what its reader took in a comparison of readers. What is not known is not in the table.

use super::survey::{Feature, Found};
use super::{Tool, word};

use Tool::{
    Aries, Enhsp, FastDownward as Fast, Optic, Pddl, Popf, Tamer, UnifiedPlanning as Unified, Val,
};

/// What a tool does with something.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Does {
    /// It says that it does not read this.
    Refuses,
    /// It ends with an error of its own.
    Fails,
    /// It reads this as something else, or leaves it out, and goes on.
    Misreads,
    /// It reads this and does not plan with it.
    Lacks,
}

use Does::{Fails, Lacks, Misreads, Refuses};

/// What a tool makes of something that was found.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Judged {
    /// The verb.
    pub does: &'static str,
    /// What it does this with.
    pub what: String,
    /// What to write instead.
    pub instead: String,
}

/// A row: something, what to write instead, and what some tools make of it. `{}` stands for the detail.
struct Fact(Feature, &'static str, &'static str, &'static [(Tool, Does)]);

/// No tool reads the parts of MA-PDDL that are not PDDL.
const ALL: &[(Tool, Does)] = &[
    (Fast, Refuses),
    (Val, Refuses),
    (Popf, Refuses),
    (Optic, Refuses),
    (Enhsp, Refuses),
    (Unified, Refuses),
    (Aries, Refuses),
    (Pddl, Refuses),
];

const FACTS: &[Fact] = &[
    Fact(
        Feature::ByteOrderMark,
        "a byte order mark",
        "save the file without one",
        &[(Fast, Refuses), (Aries, Refuses), (Pddl, Refuses)],
    ),
    Fact(
        Feature::EmptyRequirements,
        "`:requirements` without a flag",
        "name `:strips`, or leave it out",
        &[(Enhsp, Refuses), (Unified, Refuses), (Pddl, Refuses)],
    ),
    Fact(
        Feature::UpperCaseKeyword,
        "keywords in upper case",
        "write all keywords in lower case",
        &[(Enhsp, Refuses), (Pddl, Refuses)],
    ),
    Fact(
        Feature::DeclarationAfterAction,
        "declarations behind actions",
        "put `:action` behind all declarations",
        &[(Fast, Refuses), (Val, Refuses)],
    ),
    Fact(
        Feature::DeclarationOrder,
        "declarations in another order than its own",
        "put `:requirements`, `:types`, `:constants`, `:predicates`, `:functions` in this order, and actions behind them",
        &[(Enhsp, Refuses), (Unified, Refuses), (Pddl, Refuses)],
    ),
    Fact(
        Feature::ActionAfterProcess,
        "actions behind processes and events",
        "put processes and events last",
        &[(Unified, Refuses)],
    ),
    Fact(
        Feature::RepeatedSection,
        "`{}` twice",
        "put both into one",
        &[(Fast, Refuses), (Enhsp, Refuses), (Unified, Refuses), (Pddl, Refuses)],
    ),
    Fact(
        Feature::DomainConstraints,
        "`:constraints` in a domain",
        "put them into the problem",
        &[(Unified, Refuses)],
    ),
    Fact(Feature::UnaryMinus, "`-` with one operand", "subtract from 0", &[(Enhsp, Fails)]),
    Fact(
        Feature::EitherInObjects,
        "`either`",
        "give the types a common supertype, and name that",
        &[(Fast, Refuses), (Enhsp, Fails), (Unified, Refuses), (Pddl, Refuses)],
    ),
    Fact(
        Feature::ProblemOrder,
        "the parts of a problem in another order than its own",
        "put `:objects`, `:init`, `:goal`, `:metric` in this order",
        &[(Fast, Refuses), (Enhsp, Misreads), (Unified, Refuses), (Pddl, Refuses)],
    ),
    Fact(
        Feature::FieldOrder,
        "the fields of an action in another order than its own",
        "put `:parameters`, `:precondition`, `:effect` in this order",
        &[(Fast, Refuses), (Val, Refuses), (Enhsp, Refuses), (Unified, Refuses), (Pddl, Refuses)],
    ),
    Fact(
        Feature::MissingParameters,
        "an action without `:parameters`",
        "write `:parameters ()`",
        &[(Val, Refuses), (Unified, Refuses), (Pddl, Refuses)],
    ),
    Fact(
        Feature::MissingPrecondition,
        "an action without `:precondition`",
        "write `:precondition ()`",
        &[(Val, Refuses), (Pddl, Fails)],
    ),
    Fact(
        Feature::MissingEffect,
        "an action without `:effect`",
        "write `:effect ()`",
        &[(Fast, Refuses), (Val, Refuses), (Pddl, Fails)],
    ),
    Fact(Feature::Field, "`{}` in an action", "make it a parameter", ALL),
    Fact(Feature::Privacy, "`:private`", "declare what is private like everything else", ALL),
    Fact(
        Feature::GluedVariable,
        "a variable without a blank before it",
        "put a blank before each `?`",
        &[(Unified, Refuses), (Aries, Refuses)],
    ),
    Fact(
        Feature::GluedDash,
        "a `-` without blanks around it as part of a name",
        "put blanks around `-`",
        &[(Fast, Misreads)],
    ),
    Fact(
        Feature::DigitName,
        "names that begin with a digit",
        "begin names with a letter",
        &[(Val, Refuses), (Enhsp, Misreads), (Unified, Refuses), (Pddl, Refuses)],
    ),
    Fact(
        Feature::UnderscoreName,
        "names that begin with `_`",
        "begin names with a letter",
        &[(Enhsp, Refuses), (Unified, Refuses), (Pddl, Refuses)],
    ),
    Fact(
        Feature::OddName,
        "names with other characters than letters, digits, `-` and `_`",
        "use letters, digits, `-` and `_`",
        &[(Val, Refuses), (Enhsp, Refuses), (Unified, Refuses), (Pddl, Refuses)],
    ),
    Fact(
        Feature::SharedName,
        "one name for {}",
        "give each a name of its own",
        &[(Unified, Refuses)],
    ),
    Fact(
        Feature::Either,
        "`either`",
        "give the types a common supertype, and name that",
        &[(Fast, Refuses), (Enhsp, Fails), (Unified, Refuses)],
    ),
    Fact(
        Feature::EitherInPredicate,
        "`either`",
        "give the types a common supertype, and name that",
        &[(Enhsp, Fails), (Unified, Refuses)],
    ),
    Fact(
        Feature::SeveralSupertypes,
        "a type with several supertypes",
        "declare `{}` once, below one type",
        &[(Unified, Refuses), (Pddl, Refuses)],
    ),
    Fact(
        Feature::Supertype,
        "types below other types",
        "declare types without supertypes",
        &[(Tamer, Lacks)],
    ),
    Fact(
        Feature::TypeNumber,
        "a type `number`",
        "leave it out: it is there already",
        &[(Fast, Refuses), (Enhsp, Refuses)],
    ),
    Fact(
        Feature::ObjectFluent,
        "functions to objects",
        "use a predicate with one argument more",
        &[
            (Fast, Refuses),
            (Val, Refuses),
            (Popf, Refuses),
            (Optic, Refuses),
            (Enhsp, Refuses),
            (Unified, Refuses),
            (Pddl, Refuses),
        ],
    ),
    Fact(
        Feature::DecimalNumber,
        "numbers with a fraction",
        "scale all numbers to integers",
        &[(Fast, Refuses)],
    ),
    Fact(
        Feature::NegativeNumber,
        "negative numbers",
        "use numbers from 0 on",
        &[(Fast, Refuses), (Pddl, Refuses)],
    ),
    Fact(
        Feature::PlusNumber,
        "numbers with `+`",
        "leave out the `+`",
        &[(Fast, Refuses), (Val, Refuses), (Enhsp, Misreads), (Pddl, Refuses)],
    ),
    Fact(
        Feature::ExponentNumber,
        "numbers with an exponent",
        "write the number out",
        &[(Fast, Refuses), (Val, Refuses), (Enhsp, Misreads), (Pddl, Refuses), (Aries, Refuses)],
    ),
    Fact(
        Feature::FractionNumber,
        "fractions with `/`",
        "write a decimal number",
        &[(Fast, Refuses), (Val, Refuses), (Pddl, Refuses), (Aries, Refuses)],
    ),
    Fact(
        Feature::OpenDecimal,
        "numbers that begin with `.`",
        "write a 0 before the `.`",
        &[(Val, Refuses), (Pddl, Refuses)],
    ),
    Fact(
        Feature::ClosedDecimal,
        "numbers that end with `.`",
        "write a 0 behind the `.`",
        &[(Enhsp, Misreads), (Pddl, Refuses)],
    ),
    Fact(
        Feature::NegativeCondition,
        "conditions that an atom be false",
        "declare a predicate for the opposite, and keep both up to date",
        &[(Popf, Lacks), (Optic, Lacks)],
    ),
    Fact(
        Feature::Disjunction,
        "disjunctive conditions",
        "write an action for each case",
        &[(Popf, Lacks), (Optic, Lacks)],
    ),
    Fact(
        Feature::Existential,
        "`exists` in conditions",
        "make its variables parameters of the action",
        &[(Tamer, Lacks)],
    ),
    Fact(
        Feature::Universal,
        "`forall` in conditions",
        "write a conjunction, or keep count with a predicate",
        &[(Tamer, Lacks)],
    ),
    Fact(
        Feature::NumericCondition,
        "conditions on numbers",
        "count with predicates",
        &[(Fast, Refuses)],
    ),
    Fact(
        Feature::NumericEffect,
        "numeric effects other than `(increase (total-cost) …)`",
        "count with predicates",
        &[(Fast, Refuses)],
    ),
    Fact(
        Feature::ScaleEffect,
        "`scale-up` and `scale-down`",
        "use `assign` with a product",
        &[(Unified, Refuses)],
    ),
    Fact(
        Feature::CostExpression,
        "costs that are computed",
        "use a number, or a function with initial values",
        &[(Fast, Fails)],
    ),
    Fact(
        Feature::ConditionalCost,
        "costs under `when` or `forall`",
        "write an action for each cost",
        &[(Fast, Fails)],
    ),
    Fact(
        Feature::ConditionalEffect,
        "conditional effects",
        "write an action for each case",
        &[(Popf, Lacks), (Optic, Lacks), (Tamer, Lacks)],
    ),
    Fact(
        Feature::NestedCondition,
        "`when` or `forall` within `when`",
        "join the conditions with `and`, and put `forall` outside",
        &[(Enhsp, Refuses), (Pddl, Refuses)],
    ),
    Fact(
        Feature::UniversalEffect,
        "`forall` in effects",
        "write an effect for each object",
        &[(Tamer, Lacks)],
    ),
    Fact(
        Feature::ContinuousEffect,
        "continuous effects",
        "use effects at the start or the end",
        &[(Fast, Refuses), (Tamer, Lacks), (Aries, Lacks)],
    ),
    Fact(
        Feature::Nondeterminism,
        "effects by chance",
        "write an action for each outcome",
        &[(Fast, Refuses), (Val, Refuses), (Enhsp, Refuses), (Unified, Refuses)],
    ),
    Fact(
        Feature::Preference,
        "preferences",
        "make them goals, or leave them out",
        &[(Fast, Refuses), (Popf, Lacks), (Enhsp, Misreads), (Unified, Refuses), (Pddl, Refuses)],
    ),
    Fact(
        Feature::TimedLiteral,
        "timed initial literals",
        "make the change an action",
        &[(Fast, Refuses), (Enhsp, Misreads), (Pddl, Refuses)],
    ),
    Fact(
        Feature::TimedFluent,
        "timed initial values of functions",
        "make the change an action",
        &[(Unified, Refuses), (Aries, Refuses)],
    ),
    Fact(
        Feature::WideSpecifier,
        "time specifiers with other than one blank",
        "put one blank between the two words",
        &[(Val, Refuses)],
    ),
    Fact(Feature::Metric, "metrics", "leave `:metric` out", &[(Tamer, Lacks)]),
    Fact(
        Feature::OddMetric,
        "metrics other than `minimize (total-cost)`",
        "write `(:metric minimize (total-cost))`",
        &[(Fast, Refuses)],
    ),
];

/// A section, what to write instead, and what some tools make of it.
struct Section(&'static str, &'static str, &'static [(Tool, Does)]);

/// Sections that a tool does not read, or not plan with.
const SECTIONS: &[Section] = &[
    Section(
        ":durative-action",
        "use `:action`",
        &[(Fast, Refuses), (Enhsp, Refuses), (Pddl, Refuses)],
    ),
    Section(
        ":derived",
        "make it an effect of the actions that change it",
        &[(Popf, Lacks), (Optic, Lacks), (Enhsp, Refuses), (Unified, Refuses), (Aries, Refuses)],
    ),
    Section(
        ":process",
        "use a durative action with continuous effects",
        &[
            (Fast, Refuses),
            (Popf, Lacks),
            (Optic, Lacks),
            (Tamer, Lacks),
            (Aries, Refuses),
            (Pddl, Refuses),
        ],
    ),
    Section(
        ":event",
        "make it an action, or an effect of those that cause it",
        &[
            (Fast, Refuses),
            (Popf, Lacks),
            (Optic, Lacks),
            (Tamer, Lacks),
            (Aries, Refuses),
            (Pddl, Refuses),
        ],
    ),
    Section(
        ":constraints",
        "keep track of it in preconditions and effects",
        &[(Fast, Refuses), (Popf, Lacks), (Tamer, Lacks), (Pddl, Refuses)],
    ),
    Section(":length", "leave it out", &[(Fast, Refuses), (Unified, Refuses), (Pddl, Refuses)]),
    Section(
        ":task",
        "flatten the hierarchy",
        &[(Fast, Refuses), (Val, Refuses), (Enhsp, Refuses), (Tamer, Lacks), (Pddl, Refuses)],
    ),
    Section(
        ":method",
        "flatten the hierarchy",
        &[(Fast, Refuses), (Val, Refuses), (Enhsp, Refuses), (Tamer, Lacks), (Pddl, Refuses)],
    ),
    Section(
        ":htn",
        "write a `:goal`",
        &[(Fast, Refuses), (Val, Refuses), (Enhsp, Refuses), (Tamer, Lacks), (Pddl, Refuses)],
    ),
];

/// What `tool` makes of something, if it makes something of it that is worth a word.
pub(super) fn judge(tool: Tool, found: &Found) -> Option<Judged> {
    let detail = found.detail.as_str();
    let judged = |does: Does, what: &str, instead: &str| Judged {
        does: match does {
            Refuses => "refuses",
            Fails => "fails at",
            Misreads => "misreads",
            Lacks => "does not plan with",
        },
        what: what.replace("{}", detail),
        instead: instead.replace("{}", detail),
    };
    match found.feature {
        Feature::Requirement => {
            let instead = "leave it out where nothing needs it";
            (!word::takes_flag(tool, detail))
                .then(|| judged(Refuses, "the requirement `{}`", instead))
        }
        Feature::Section => {
            let Section(_, instead, tools) =
                SECTIONS.iter().find(|Section(section, ..)| *section == detail)?;
            does(tool, tools).map(|does| judged(does, "`{}`", instead))
        }
        role @ (Feature::Name | Feature::PredicateName | Feature::Variable) => {
            let what = match role {
                Feature::Variable => "`?{}` as a variable",
                Feature::PredicateName => "`{}` as a predicate",
                _ => "`{}` as a name",
            };
            let instead = "it is a keyword there; use another name";
            word::is_reserved(tool, detail, role).then(|| judged(Refuses, what, instead))
        }
        feature => {
            let Fact(_, what, instead, tools) =
                FACTS.iter().find(|Fact(known, ..)| *known == feature)?;
            does(tool, tools).map(|does| judged(does, what, instead))
        }
    }
}

/// What `tool` does; Tamer reads files through unified-planning.
fn does(tool: Tool, tools: &[(Tool, Does)]) -> Option<Does> {
    let of = |wanted: Tool| tools.iter().find(|(tool, _)| *tool == wanted).map(|&(_, does)| does);
    of(tool).or_else(|| if tool == Tamer { of(Unified) } else { None })
}
