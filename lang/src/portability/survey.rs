//! A [`Tree`] goes in; what stands in it that some tool cannot read comes out, the first place of each.

mod name;
mod form;

use std::collections::{BTreeMap, BTreeSet};

use crate::source::Span;
use crate::tree::{NodeId, NodeKind, Tree};

/// Something that some tools cannot read or plan with.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Feature {
    ByteOrderMark,
    EmptyRequirements,
    /// A flag in `:requirements`; the detail is the flag.
    Requirement,
    /// A section; the detail is its keyword.
    Section,
    UpperCaseKeyword,
    DeclarationAfterAction,
    DeclarationOrder,
    ActionAfterProcess,
    RepeatedSection,
    ProblemOrder,
    /// `:constraints` in a domain.
    DomainConstraints,
    FieldOrder,
    MissingParameters,
    MissingPrecondition,
    MissingEffect,
    /// `:agent` or `:vars`.
    Field,
    Privacy,
    GluedVariable,
    GluedDash,
    DigitName,
    UnderscoreName,
    OddName,
    /// A name that may be a keyword; the detail is the name.
    Name,
    /// The same of a predicate.
    PredicateName,
    /// A variable whose name may be a keyword; the detail is the name without `?`.
    Variable,
    SharedName,
    Either,
    EitherInPredicate,
    EitherInObjects,
    SeveralSupertypes,
    Supertype,
    TypeNumber,
    ObjectFluent,
    DecimalNumber,
    NegativeNumber,
    PlusNumber,
    ExponentNumber,
    FractionNumber,
    OpenDecimal,
    ClosedDecimal,
    NegativeCondition,
    Disjunction,
    Existential,
    Universal,
    NumericCondition,
    UnaryMinus,
    NumericEffect,
    ScaleEffect,
    CostExpression,
    ConditionalCost,
    ConditionalEffect,
    NestedCondition,
    UniversalEffect,
    ContinuousEffect,
    Nondeterminism,
    Preference,
    TimedLiteral,
    TimedFluent,
    WideSpecifier,
    Metric,
    OddMetric,
}

/// One thing that was found.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Found {
    pub feature: Feature,
    /// Its text where that matters, and else empty.
    pub detail: String,
    /// Its first place.
    pub span: Span,
}

/// What a list is part of.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Part {
    /// The definition, or its title.
    Definition,
    Section,
    Parameters,
    Condition,
    Effect,
    Init,
    Other,
}

/// A list that is being looked at.
struct Frame {
    id: NodeId,
    next: u32,
    part: Part,
    /// Its first word in lower case.
    head: String,
    /// How many words and lists have stood in it so far.
    seen: usize,
    /// The last word in it, unless a list came after that.
    word: Option<NodeId>,
    /// The word right before the list that is looked at.
    before: Option<NodeId>,
}

/// What has been gathered so far.
struct Survey<'t, 'a> {
    tree: &'t Tree<'a>,
    open: Vec<Frame>,
    found: BTreeMap<(Feature, String), Span>,
    problem: bool,
    /// The kinds of section so far; the empty one stands for those that no order mentions.
    sections: BTreeSet<&'static str>,
    /// The places in the usual order of the fields of the action at hand.
    fields: BTreeSet<usize>,
    /// The predicates that effects mention, and those whose negation a condition wants.
    effects: BTreeSet<String>,
    negated: Vec<(String, Span)>,
    /// What each declared name is.
    names: BTreeMap<String, &'static str>,
    types: BTreeSet<String>,
}

/// Everything of that kind in a text, in its order.
pub(super) fn survey(tree: &Tree<'_>) -> Vec<Found> {
    let title = tree.roots().next().and_then(|root| tree.children(root).nth(1));
    let title = title.filter(|&title| tree.is_list(title));
    let word = title.and_then(|title| tree.children(title).next());
    let mut survey = Survey {
        tree,
        open: Vec::new(),
        found: BTreeMap::new(),
        problem: word.is_some_and(|word| tree.slice(word).eq_ignore_ascii_case("problem")),
        sections: BTreeSet::new(),
        fields: BTreeSet::new(),
        effects: BTreeSet::new(),
        negated: Vec::new(),
        names: BTreeMap::new(),
        types: BTreeSet::new(),
    };
    survey.all();
    let mut found: Vec<Found> = survey
        .found
        .into_iter()
        .map(|((feature, detail), span)| Found { feature, detail, span })
        .collect();
    found.sort_by_key(|one| (one.span.start, one.feature));
    found
}

impl Survey<'_, '_> {
    fn all(&mut self) {
        let tree = self.tree;
        if tree.input().starts_with('\u{feff}') {
            self.note(Feature::ByteOrderMark, Span::new(tree.source, 0, 3));
        }
        let nodes = tree.nodes();
        for (at, node) in nodes.iter().enumerate() {
            self.close(at as u32);
            let id = NodeId(at as u32);
            match node.kind {
                NodeKind::Atom => self.atom(id),
                NodeKind::List | NodeKind::OpenList => self.list(id),
                _ => {}
            }
        }
        self.close(nodes.len() as u32);
        // What no effect mentions is static here, unless it is a problem, which does not show its effects.
        let negated = std::mem::take(&mut self.negated);
        for (predicate, span) in negated {
            if self.problem || self.effects.contains(&predicate) {
                self.note(Feature::NegativeCondition, span);
            }
        }
    }

    /// Keeps the first place of a feature.
    fn note(&mut self, feature: Feature, span: Span) {
        self.note_as(feature, "", span);
    }

    fn note_as(&mut self, feature: Feature, detail: &str, span: Span) {
        let first = self.found.entry((feature, detail.to_owned())).or_insert(span);
        if span.start < first.start {
            *first = span;
        }
    }

    fn lower(&self, id: NodeId) -> String {
        self.tree.slice(id).to_ascii_lowercase()
    }

    /// The first word of a list in lower case; empty if there is none.
    fn head(&self, list: NodeId) -> String {
        let first = self.tree.children(list).next().filter(|&first| !self.tree.is_list(first));
        first.map_or_else(String::new, |first| self.lower(first))
    }

    /// The parenthesis of a list with its first word.
    fn opening(&self, list: NodeId) -> Span {
        let span = self.tree.span(list);
        let first = self.tree.children(list).next().filter(|&first| !self.tree.is_list(first));
        Span { end: first.map_or(span.start + 1, |first| self.tree.node(first).end), ..span }
    }

    /// The keyword of the section at hand.
    fn section(&self) -> &str {
        self.open.get(1).map_or("", |frame| frame.head.as_str())
    }

    fn list(&mut self, id: NodeId) {
        let head = self.head(id);
        let part = self.part(id, &head);
        if let Some(frame) = self.open.last_mut() {
            frame.seen += 1;
            frame.before = frame.word.take();
        }
        self.form(id, &head, part);
        let next = self.tree.node(id).next;
        self.open.push(Frame { id, next, part, head, seen: 0, word: None, before: None });
    }

    /// What the list `id`, which begins with `head`, is part of.
    fn part(&self, id: NodeId, head: &str) -> Part {
        let Some(parent) = self.open.last() else { return Part::Definition };
        let section = parent.head.as_str();
        match (self.open.len(), parent.part) {
            (1, _) if head.starts_with(':') => Part::Section,
            (1, _) => Part::Definition,
            (2, _) => {
                let word = parent.word.filter(|word| *word < id).map(|word| self.lower(word));
                match (section, word.as_deref()) {
                    (":init", _) => Part::Init,
                    (":derived", _) if parent.seen > 1 => Part::Condition,
                    (":goal" | ":constraints", _) | (_, Some(":precondition" | ":condition")) => {
                        Part::Condition
                    }
                    (_, Some(":effect")) => Part::Effect,
                    (_, Some(":parameters" | ":vars")) => Part::Parameters,
                    _ => Part::Other,
                }
            }
            (_, Part::Effect) if section == "when" && parent.seen == 1 => Part::Condition,
            (_, Part::Effect | Part::Condition)
                if matches!(section, "forall" | "exists") && parent.seen == 1 =>
            {
                Part::Parameters
            }
            (_, part) => part,
        }
    }

    fn close(&mut self, at: u32) {
        while let Some(frame) = self.open.pop_if(|frame| frame.next <= at) {
            if frame.part == Part::Section {
                self.leave(&frame);
            }
        }
    }
}
