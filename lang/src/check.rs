//! An [`ast::Domain`] or an [`ast::Problem`] goes in; a [`model::Domain`] or a [`model::Problem`] comes out, with every name resolved.
//!
//! What cannot be resolved is reported once and then left out, so that one mistake gives one message.

mod index;
mod record;
mod requirement;
mod hierarchy;
mod scope;
mod condition;
mod effect;
mod domain;
mod problem;

use hashbrown::HashSet;

use crate::ast::{self, Feature, Unread};
use crate::diagnostic::{
    Diagnostic, Diagnostics, Rule, agent_without_multi_agent, missing_requirement, unexpected_item,
    unknown_predicate,
};
use crate::model::{self, Object, TypeId, Use, Variable};
use crate::near::nearest;
use crate::source::Span;
use crate::symbol::{Occurrences, Role};

use index::Index;
use requirement::{Flags, Need};

pub use domain::domain;
pub use problem::problem;

/// The type that everything has.
pub(crate) const OBJECT: TypeId = TypeId(0);

/// What has been said so far about one text, so that nothing is said twice.
struct Report<'d> {
    diagnostics: &'d mut Diagnostics,
    /// The names that have been reported, in lower case, each with the code of the mistake.
    said: HashSet<(&'static str, String)>,
    /// What is used and not resolved, each once.
    uses: Vec<Use>,
    declared: Flags,
    /// The requirements that have been reported as missing.
    missing: Flags,
    /// Whether parts that are not read may declare names, so that nothing can be said about unknown ones.
    blind: bool,
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
        occurrences: Option<&'d mut Occurrences>,
    ) -> Self {
        Self {
            diagnostics,
            said: HashSet::new(),
            uses: Vec::new(),
            declared,
            missing: Flags::default(),
            blind: false,
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
        !self.blind && self.said.insert((rule.code, name.to_ascii_lowercase()))
    }

    /// The name that was probably meant.
    fn nearest<'a>(&mut self, name: &str, index: &Index<'a>) -> Option<&'a str> {
        self.comparisons = self.comparisons.checked_sub(index.len())?;
        index.nearest(name)
    }

    /// Notes once for each feature that it is used.
    fn uses(&mut self, unread: &Unread<'_>) {
        if unread.keyword.is(":agent") && !self.declared.agents() {
            if self.said.insert((agent_without_multi_agent::RULE.code, String::new())) {
                self.push(agent_without_multi_agent::agent_without_multi_agent(
                    unread.keyword.span,
                ));
            }
            return;
        }
        self.blind |= unread.keyword.is(":private");
        if self.uses.iter().all(|one| one.feature != unread.feature) {
            self.uses.push(Use { feature: unread.feature, span: unread.keyword.span });
        }
    }

    /// Says once for each requirement that something needs it.
    fn need(&mut self, need: Need, span: Span) {
        let (flags, proposed, name, what) = need.describe();
        if !self.declared.meets(flags) && !self.missing.meets(flags) {
            self.missing.add(proposed);
            self.push(missing_requirement::missing_requirement(name, span, what));
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
    /// Whether some function may have objects as values.
    object_functions: bool,
    objects: Index<'a>,
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
fn describe_parameters(table: &[model::Type], parameters: &[Variable]) -> String {
    let shown = parameters.iter().map(|parameter| {
        if parameter.types.is_empty() || parameter.types == [OBJECT] {
            return parameter.name.text.clone();
        }
        format!("{} - {}", parameter.name.text, describe_types(table, &parameter.types))
    });
    shown.collect::<Vec<_>>().join(" ")
}

/// Says what is wrong with a formula that could not be read, or notes what it uses.
fn unread(world: &World<'_, '_>, unread: &Unread<'_>, report: &mut Report<'_>) {
    if unread.feature == Feature::ObjectFluents
        && !world.names.object_functions
        && unread.keyword.text != "="
    {
        let words = ["and", "or", "not", "imply", "forall", "exists", "when"];
        let near = nearest(unread.keyword.text, words);
        if near.is_some() || world.names.predicates.find(unread.keyword.text).is_none() {
            report.push(unknown_predicate::unknown_predicate(
                unread.keyword.text,
                unread.keyword.span,
                near,
            ));
        } else {
            let message = "objects and variables as arguments, not a formula";
            report.push(unexpected_item::unexpected_item(message, unread.node.span));
        }
        return;
    }
    report.uses(unread);
}

fn name(name: ast::Name<'_>) -> model::Name {
    model::Name { text: name.text.to_owned(), span: name.span }
}
