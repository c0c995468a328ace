//! The sections of a domain.

use super::Reader;
use super::list::Names;
use crate::ast::{
    ActionKind, Axiom, Derived, Domain, DomainSection, Feature, Formula, Name, TypedList,
};
use crate::diagnostic::{
    Diagnostics, several_formulas, suspicious_type_list, unexpected_item, unknown_section,
};
use crate::near::nearest;
use crate::tree::{NodeId, Tree};

/// What can stand directly in a domain.
const SECTIONS: [&str; 20] = [
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
    ":timeless",
    ":safety",
    ":extends",
];

/// The fields of an axiom of PDDL 1.2.
const AXIOM: [&str; 3] = [":vars", ":context", ":implies"];

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
                if self.tree.is_list(item) {
                    self.unexpected("a section in parentheses", item);
                } else {
                    self.stray("a section in parentheses", item);
                }
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
        let read = match section {
            ":requirements" => DomainSection::Requirements(self.words(item)),
            ":types" => {
                let list = self.typed_list(content, Names::Words);
                self.swallowed(&list);
                DomainSection::Types(list)
            }
            ":constants" => DomainSection::Constants(self.typed_list(content, Names::Words)),
            ":predicates" => DomainSection::Predicates(self.predicates(content)),
            ":functions" => DomainSection::Functions(self.functions(content)),
            ":action" => DomainSection::Action(self.action(ActionKind::Instant, item)),
            ":durative-action" => DomainSection::Action(self.action(ActionKind::Durative, item)),
            ":process" => DomainSection::Action(self.action(ActionKind::Process, item)),
            ":event" => DomainSection::Action(self.action(ActionKind::Event, item)),
            ":derived" => match self.derived(item) {
                Some(derived) => DomainSection::Derived(derived),
                None => return,
            },
            ":axiom" => DomainSection::Axiom(self.axiom(head, item)),
            ":constraints" => DomainSection::Constraints(head, self.all_formulas(section, item)),
            ":task" => DomainSection::Task(self.task(item)),
            ":method" => DomainSection::Method(self.method(item)),
            ":concurrency-constraint" => DomainSection::Concurrency(self.concurrency(item)),
            ":positive-dependence" => DomainSection::Dependence(head, self.words(item)),
            ":invariant" => DomainSection::Unread(self.unread(Feature::Invariants, head, item)),
            _ => DomainSection::Unread(self.unread(Feature::Axioms, head, item)),
        };
        sections.push(read);
    }

    /// The formulas of a section that has one.
    pub(super) fn all_formulas(&mut self, section: &str, item: NodeId) -> Vec<Formula<'a>> {
        let values: Vec<NodeId> = self.tree.children(item).skip(1).collect();
        let mut formulas = Vec::new();
        self.formulas(section, &values, &mut formulas);
        formulas
    }

    /// `(:axiom :vars (…) :context CONDITION :implies LITERAL)`
    fn axiom(&mut self, keyword: Name<'a>, item: NodeId) -> Axiom<'a> {
        let mut fields = self.fields(item, 1, "the axiom".to_owned(), &AXIOM);
        let (mut variables, mut context, mut implies) =
            (TypedList::default(), Vec::new(), Vec::new());
        while let Some((field, _, values)) = self.next_field(&mut fields) {
            match field {
                ":vars" => self.parameters(&values, &mut variables),
                ":context" => self.formulas(field, &values, &mut context),
                _ => self.formulas(field, &values, &mut implies),
            }
        }
        let (context, implies) = (context.into_iter().next(), implies.into_iter().next());
        Axiom { keyword, variables, context, implies }
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
}
