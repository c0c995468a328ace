//! An [`ast::Domain`] or an [`ast::Problem`] goes in; a [`model::Domain`] or a [`model::Problem`] comes out, with every name resolved.
//!
//! What cannot be resolved is reported once and then left out, so that one mistake gives one message.

mod index;
mod record;
mod requirement;
mod hierarchy;
mod scope;
mod value;
mod condition;
mod effect;
mod temporal;
mod agents;
mod concurrency;
mod network;
mod action;
mod domain;
mod problem;

use std::collections::{BTreeMap, BTreeSet};

use hashbrown::HashSet;

use crate::ast::{self, Feature};
use crate::diagnostic::{Diagnostic, Diagnostics, Rule, missing_requirement, unknown_variable};
use crate::model::{self, FunctionId, Object, TypeId, Use, Variable};
use crate::source::Span;
use crate::symbol::{Occurrences, Role};

use index::Index;
use record::Reading;
use requirement::{Flags, Need};

pub(crate) use condition::conjoin;
pub use domain::domain;
pub use problem::problem;

/// The type that everything has.
pub(crate) const OBJECT: TypeId = TypeId(0);

/// What has been said so far about one text, so that nothing is said twice.
#[expect(clippy::struct_excessive_bools, reason = "each is a question of its own about the text")]
struct Report<'d> {
    diagnostics: &'d mut Diagnostics,
    /// The names that have been reported, in lower case, each with the code of the mistake.
    said: HashSet<(&'static str, String)>,
    /// What is used and not resolved, each once.
    uses: Vec<Use>,
    declared: Flags,
    /// The requirements that have been reported as missing.
    missing: Flags,
    /// Where a missing requirement can be written, and whether the list of them must be written too.
    flags: (Span, bool),
    /// Whether a domain declares no requirements at all, which is a way of writing and no mistake.
    undeclared: bool,
    /// Whether there is no domain, or only a piece of one, so that nothing can be said about unknown names but variables.
    blind: bool,
    /// Whether a metric is read, where more words have a meaning.
    metric: bool,
    /// The named preferences so far.
    preferences: Vec<model::Name>,
    /// What the values that are read are for.
    reading: Reading,
    /// The functions whose values a plan depends on, with the first place of each.
    read: BTreeMap<FunctionId, Span>,
    /// The functions to which some effect assigns a value.
    assigned: BTreeSet<FunctionId>,
    /// The functions that the initial state gives a value that the model does not hold.
    timed: BTreeSet<FunctionId>,
    /// Whether it gives a value to a function that is unknown, and so perhaps to any.
    strange: bool,
    /// How many more names may be compared with a misspelt one.
    comparisons: usize,
    /// The names that have been resolved, if somebody wants to know.
    occurrences: Option<&'d mut Occurrences>,
    /// What the next predicate or function does where it stands.
    role: Role,
}

/// How many names are compared with misspelt ones in all, so that a text full of mistakes is read fast too.
const COMPARISONS: usize = 200_000;

impl<'d> Report<'d> {
    fn new(
        diagnostics: &'d mut Diagnostics,
        declared: Flags,
        flags: (Span, bool),
        occurrences: Option<&'d mut Occurrences>,
    ) -> Self {
        Self {
            diagnostics,
            said: HashSet::new(),
            uses: Vec::new(),
            declared,
            missing: Flags::default(),
            flags,
            undeclared: false,
            blind: false,
            metric: false,
            preferences: Vec::new(),
            reading: Reading::default(),
            read: BTreeMap::new(),
            assigned: BTreeSet::new(),
            timed: BTreeSet::new(),
            strange: false,
            comparisons: COMPARISONS,
            occurrences,
            role: Role::default(),
        }
    }

    fn push(&mut self, diagnostic: Diagnostic) {
        self.diagnostics.push(diagnostic);
    }

    /// Whether this is the first mistake of this kind about this name.
    fn first(&mut self, rule: &Rule, name: &str) -> bool {
        (!self.blind || rule.code == unknown_variable::RULE.code)
            && self.said.insert((rule.code, name.to_ascii_lowercase()))
    }

    /// The name that was probably meant.
    fn nearest<'a>(&mut self, name: &str, index: &Index<'a>) -> Option<&'a str> {
        self.comparisons = self.comparisons.checked_sub(index.len())?;
        index.nearest(name)
    }

    /// Notes once for each feature that it is used.
    fn uses(&mut self, feature: Feature, span: Span) {
        if self.uses.iter().all(|one| one.feature != feature) {
            self.uses.push(Use { feature, span });
        }
    }

    /// Says once for each requirement that something needs it.
    fn need(&mut self, need: Need, span: Span) {
        let (flags, proposed, name, what) = need.describe();
        if !self.undeclared
            && !self.blind
            && !self.declared.meets(flags)
            && !self.missing.meets(flags)
        {
            self.missing.add(proposed);
            let diagnostic = missing_requirement::missing_requirement(name, span, what);
            self.push(diagnostic.fix_requirement(name, self.flags));
        }
    }
}

/// What names mean where a formula is checked.
#[derive(Clone, Copy)]
struct World<'w, 'a> {
    domain: &'w model::Domain,
    objects: &'w [Object],
    names: &'w Names<'a>,
    /// Where objects are declared, for messages.
    places: &'w str,
}

/// Finds ids by name, one table for each kind, because PDDL keeps the kinds apart.
#[derive(Default)]
struct Names<'a> {
    types: Index<'a>,
    predicates: Index<'a>,
    functions: Index<'a>,
    objects: Index<'a>,
    /// The actions of all kinds, by their position among the signatures.
    actions: Index<'a>,
    /// The tasks, likewise.
    tasks: Index<'a>,
    /// The actions that conditions or constraints name, likewise.
    asked: BTreeSet<u32>,
}

impl World<'_, '_> {
    /// Whether something of the types `have`, of all of them or of one of them, may stand where one of `wanted` is asked for.
    ///
    /// No types at all means that a mistake has been reported about them.
    fn fits(&self, have: &[TypeId], all: bool, wanted: &[TypeId]) -> bool {
        let below = |&sub: &TypeId| wanted.iter().any(|&above| self.domain.is_subtype(sub, above));
        have.is_empty()
            || wanted.is_empty()
            || if all { have.iter().any(below) } else { have.iter().all(below) }
    }

    /// Whether something may be of one of the types `have` and of one of `other`.
    fn overlap(&self, have: &[TypeId], other: &[TypeId]) -> bool {
        let table = &self.domain.types;
        let both = |&one: &TypeId, &two: &TypeId| {
            table.iter().any(|of| of.ancestors.contains(&one) && of.ancestors.contains(&two))
        };
        have.iter().any(|one| other.iter().any(|two| both(one, two)))
    }

    /// The types as a message shows them.
    fn describe_types(&self, types: &[TypeId]) -> String {
        describe_types(&self.domain.types, types)
    }
}

fn describe_types(table: &[model::Type], types: &[TypeId]) -> String {
    let name = |id: &TypeId| table[id.index()].name.text.as_str();
    match types {
        [] => "object".to_owned(),
        [one] => name(one).to_owned(),
        several => format!("(either {})", several.iter().map(name).collect::<Vec<_>>().join(" ")),
    }
}

/// Parameters as they are declared: `?a - block ?b`.
pub(crate) fn describe_parameters(table: &[model::Type], parameters: &[Variable]) -> String {
    let shown = parameters.iter().map(|parameter| {
        if parameter.types.is_empty() || parameter.types == [OBJECT] {
            return parameter.name.text.clone();
        }
        format!("{} - {}", parameter.name.text, describe_types(table, &parameter.types))
    });
    shown.collect::<Vec<_>>().join(" ")
}

fn name(name: ast::Name<'_>) -> model::Name {
    model::Name { text: name.text.to_owned(), span: name.span }
}
