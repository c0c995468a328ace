//! The sections of a domain.

use super::list::Names;
use super::{Reader, lower};
use crate::ast::{Action, Derived, Domain, DomainSection, Feature, Head, Name, TypedList, Unread};
use crate::diagnostic::{
    Diagnostics, duplicate_field, missing_duration, several_formulas, suspicious_type_list,
    unexpected_item, unknown_field, unknown_section,
};
use crate::near::nearest;
use crate::source::Span;
use crate::tree::{NodeId, Tree};

/// What can stand directly in a domain, with what is read later.
const SECTIONS: [&str; 17] = [
    ":requirements",
    ":types",
    ":constants",
    ":predicates",
    ":functions",
    ":action",
    ":derived",
    ":durative-action",
    ":constraints",
    ":process",
    ":event",
    ":axiom",
    ":task",
    ":method",
    ":concurrency-constraint",
    ":positive-dependence",
    ":invariant",
];

/// The fields of an action, with what is read later.
const FIELDS: [&str; 12] = [
    ":parameters",
    ":precondition",
    ":effect",
    ":agent",
    ":duration",
    ":condition",
    ":vars",
    ":context",
    ":expansion",
    ":observe",
    ":constraints",
    ":comment",
];

/// Reads a domain.
pub fn domain<'a>(tree: &Tree<'a>, diagnostics: &mut Diagnostics) -> Domain<'a> {
    let mut reader = Reader { tree, diagnostics, lost: false };
    let (name, items) = reader.definition("domain");
    let mut sections = Vec::with_capacity(items.len());
    for item in items {
        reader.domain_section(item, &mut sections);
    }
    Domain { name, sections }
}

impl<'a> Reader<'a, '_> {
    /// The word that starts a section, taken as the one that was probably meant.
    pub(super) fn section(
        &mut self,
        item: NodeId,
        whole: &str,
        known: &[&'static str],
    ) -> Option<(Name<'a>, &'static str)> {
        let Some(head) = self.head(item) else {
            if !std::mem::replace(&mut self.lost, true) {
                self.unexpected("a section in parentheses", item);
            }
            return None;
        };
        if let Some(&section) = known.iter().find(|section| head.is(section)) {
            self.lost = false;
            return Some((head, section));
        }
        let near = nearest(head.text, known.iter().copied()).or_else(|| {
            known
                .iter()
                .copied()
                .find(|section| section.strip_prefix(':').is_some_and(|bare| head.is(bare)))
        });
        let near = near.and_then(|near| known.iter().copied().find(|&section| section == near));
        // What follows something unknown is mostly the rest of the same mistake.
        if !std::mem::replace(&mut self.lost, near.is_none()) || near.is_some() {
            self.diagnostics
                .push(unknown_section::unknown_section(whole, head.text, head.span, near));
        }
        near.map(|near| (head, near))
    }

    fn domain_section(&mut self, item: NodeId, sections: &mut Vec<DomainSection<'a>>) {
        let tree = self.tree;
        let Some((head, section)) = self.section(item, "domain", &SECTIONS) else { return };
        let content = tree.children(item).skip(1);
        let mut unread = Vec::new();
        let read = match section {
            ":requirements" => DomainSection::Requirements(self.words(item)),
            ":types" => {
                let list = self.typed_list(content, Names::Words, &mut unread);
                self.swallowed(&list);
                DomainSection::Types(list)
            }
            ":constants" => {
                DomainSection::Constants(self.typed_list(content, Names::Words, &mut unread))
            }
            ":predicates" => DomainSection::Predicates(self.predicates(content, &mut unread)),
            ":functions" => DomainSection::Functions(self.functions(content)),
            ":action" => DomainSection::Action(self.action(item)),
            ":derived" => match self.derived(item) {
                Some(derived) => DomainSection::Derived(derived),
                None => return,
            },
            _ => {
                if section == ":durative-action" {
                    self.duration(item);
                }
                let feature = match section {
                    ":durative-action" => Feature::DurativeActions,
                    ":constraints" => Feature::Constraints,
                    ":process" | ":event" => Feature::Processes,
                    ":task" | ":method" => Feature::Hierarchies,
                    ":concurrency-constraint" | ":positive-dependence" => Feature::MultiAgent,
                    ":invariant" => Feature::Invariants,
                    _ => Feature::Axioms,
                };
                DomainSection::Unread(self.unread(feature, head, item))
            }
        };
        sections.push(read);
        sections.extend(unread.into_iter().map(DomainSection::Unread));
    }

    /// Reports a durative action without a duration.
    fn duration(&mut self, item: NodeId) {
        let tree = self.tree;
        let words: Vec<NodeId> = tree.children(item).collect();
        let is = |part: &NodeId, word: &str| tree.slice(*part).eq_ignore_ascii_case(word);
        let name =
            words.get(1).filter(|&&name| !tree.is_list(name) && !tree.slice(name).starts_with(':'));
        if words.iter().any(|part| is(part, ":duration") || is(part, "duration")) {
            return;
        }
        let Some(&name) = name else { return };
        let after =
            words.iter().position(|part| is(part, ":parameters")).and_then(|at| words.get(at + 1));
        let end = tree.span(*after.unwrap_or(&name)).end;
        let place = Span { start: end, end, ..tree.span(name) };
        self.diagnostics.push(missing_duration::missing_duration(
            tree.slice(name),
            tree.span(name),
            place,
        ));
    }

    /// Warns of names that stand on lines of their own and yet get the type after the next `-`.
    ///
    /// Where every name has a line of its own, or the lines are full, the list is only wrapped.
    fn swallowed(&mut self, list: &TypedList<'a>) {
        let input = self.tree.input();
        let breaks = |pair: &[Name<'a>]| {
            input[pair[0].span.end as usize..pair[1].span.start as usize].contains('\n')
        };
        for group in &list.groups {
            let Some(above) = group.types.as_ref().map(|types| types.names[0]) else { continue };
            let last = group.names.windows(2).rposition(breaks);
            let Some(last) = last.filter(|_| !above.is("object")) else { continue };
            let alone = group.names[..=last].windows(2).all(breaks);
            if !alone || last + 2 >= group.names.len() {
                continue;
            }
            let names: Vec<&str> = group.names.iter().map(|name| name.text).collect();
            let first = group.names[0];
            self.diagnostics.push(suspicious_type_list::suspicious_type_list(
                first.text,
                first.span,
                above.text,
                above.span,
                &names.join(" "),
            ));
        }
    }

    /// The words of a list after its first; lists among them are reported.
    pub(super) fn words(&mut self, item: NodeId) -> Vec<Name<'a>> {
        let tree = self.tree;
        let mut words = Vec::new();
        for child in tree.children(item).skip(1) {
            if tree.is_list(child) {
                self.unexpected("a word", child);
            } else {
                words.push(self.name(child));
            }
        }
        words
    }

    fn predicates(
        &mut self,
        items: impl Iterator<Item = NodeId>,
        unread: &mut Vec<Unread<'a>>,
    ) -> Vec<Head<'a>> {
        let mut heads = Vec::new();
        for item in items {
            match self.head(item) {
                Some(head) if head.is(":private") => {
                    unread.push(self.unread(Feature::MultiAgent, head, item));
                    // Whose they are is not read yet; that they exist is.
                    let private =
                        self.tree.children(item).filter(|&child| self.tree.is_list(child));
                    let private: Vec<_> = private.collect();
                    heads.extend(
                        private
                            .into_iter()
                            .filter_map(|child| self.declaration(child, "a predicate")),
                    );
                }
                _ => heads.extend(self.declaration(item, "a predicate")),
            }
        }
        heads
    }

    fn derived(&mut self, item: NodeId) -> Option<Derived<'a>> {
        let tree = self.tree;
        let mut parts = tree.children(item).skip(1);
        let Some(head) = parts.next() else {
            self.unexpected("`(:derived (PREDICATE ?x …) CONDITION)`", item);
            return None;
        };
        let head = self.declaration(head, "the derived predicate")?;
        let body = parts.next().map(|body| self.formula(body));
        if body.is_none() {
            self.diagnostics.push(unexpected_item::missing_item(
                "the condition of the derived predicate",
                head.place.0,
            ));
        }
        if let Some(extra) = parts.next() {
            let span = self.opening(extra);
            self.diagnostics.push(several_formulas::several_formulas(":derived", span));
        }
        Some(Derived { head, body, place: self.place(item) })
    }

    fn action(&mut self, item: NodeId) -> Action<'a> {
        let tree = self.tree;
        let mut parts = tree.children(item).peekable();
        let keyword = parts.next().map_or(tree.span(item), |keyword| tree.span(keyword));
        let name = parts.next_if(|&part| !tree.is_list(part) && !tree.slice(part).starts_with(':'));
        let name = if let Some(name) = name {
            self.name(name)
        } else {
            self.diagnostics.push(unexpected_item::missing_item("the name of the action", keyword));
            Name { text: "", span: keyword }
        };
        let mut action = Action {
            name,
            parameters: TypedList::default(),
            preconditions: Vec::new(),
            effects: Vec::new(),
            unread: Vec::new(),
            place: self.place(item),
        };
        let mut seen: Vec<(&'static str, Span)> = Vec::new();
        while let Some(part) = parts.next() {
            let Some(field) = self.field(part, &action) else {
                while parts.next_if(|&value| tree.is_list(value)).is_some() {}
                continue;
            };
            let keyword = self.name(part);
            let repeated = seen.iter().find(|&&(other, _)| other == field);
            if let Some(&(_, first)) = repeated {
                let owner = format!("action `{}`", action.name);
                self.diagnostics.push(duplicate_field::duplicate_field(
                    field,
                    &owner,
                    keyword.span,
                    first,
                ));
            } else {
                seen.push((field, keyword.span));
            }
            let mut count = 0;
            let agent = field == ":agent";
            while let Some(value) =
                parts.next_if(|&value| tree.is_list(value) || !self.is_field(value, agent))
            {
                count += 1;
                self.field_value(field, keyword, value, count, &mut action);
            }
        }
        action
    }

    /// Whether a word that follows a value starts a field, although it may be misspelt.
    fn is_field(&self, part: NodeId, after_agent: bool) -> bool {
        let word = self.tree.slice(part);
        // The value of `:agent` is no list: in `:agent ?a - agent` the last word is a type.
        word.starts_with(':')
            || !after_agent && FIELDS.iter().any(|field| field[1..].eq_ignore_ascii_case(word))
    }

    /// The field that a word starts, taken as the one that was probably meant.
    fn field(&mut self, part: NodeId, action: &Action<'a>) -> Option<&'static str> {
        if self.tree.is_list(part) {
            self.unexpected("a field such as `:parameters`", part);
            return None;
        }
        let word = self.name(part);
        if let Some(&field) = FIELDS.iter().find(|field| word.is(field)) {
            return Some(field);
        }
        let near = nearest(word.text, FIELDS)
            .or_else(|| FIELDS.into_iter().find(|field| word.is(&field[1..])));
        let near = near.and_then(|near| FIELDS.into_iter().find(|&field| field == near));
        let owner = format!("action `{}`", action.name);
        self.diagnostics.push(unknown_field::unknown_field(&owner, word.text, word.span, near));
        near
    }

    /// The value number `count` of a field.
    fn field_value(
        &mut self,
        field: &'static str,
        keyword: Name<'a>,
        value: NodeId,
        count: usize,
        action: &mut Action<'a>,
    ) {
        let tree = self.tree;
        match field {
            ":precondition" | ":effect" => {
                if count > 1 {
                    let span = self.opening(value);
                    self.diagnostics.push(several_formulas::several_formulas(field, span));
                }
                let formula = self.formula(value);
                if field == ":effect" {
                    action.effects.push(formula);
                } else {
                    action.preconditions.push(formula);
                }
            }
            ":parameters" if count == 1 && tree.is_list(value) => {
                let list = self.typed_list(tree.children(value), Names::Variables, &mut Vec::new());
                action.parameters.groups.extend(list.groups);
            }
            ":parameters" => self.unexpected("one list of parameters", value),
            _ => {
                let feature = match lower(field, &mut [0; 24]) {
                    ":agent" => Feature::MultiAgent,
                    ":duration" | ":condition" => Feature::DurativeActions,
                    ":observe" => Feature::Nondeterminism,
                    ":constraints" => Feature::Constraints,
                    ":comment" => return,
                    _ => Feature::Axioms,
                };
                if count == 1 {
                    action.unread.push(self.unread(feature, keyword, value));
                }
            }
        }
    }
}
