//! Typed lists, declarations and applications.

use super::{Reader, is_number};
use crate::ast::{
    Application, FunctionGroup, Group, Head, Name, Private, TypeReference, TypedList,
};
use crate::diagnostic::{dash_not_separated, unexpected_item};
use crate::lexer;
use crate::source::Span;
use crate::tree::NodeId;

/// What the names of a typed list are.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Names {
    /// `?x`
    Variables,
    /// Objects, constants or types.
    Words,
}

impl<'a> Reader<'a, '_> {
    /// `a b - t c - (either u v) d`
    pub(super) fn typed_list(
        &mut self,
        items: impl Iterator<Item = NodeId>,
        names: Names,
    ) -> TypedList<'a> {
        let mut private = Vec::new();
        let groups = self.groups(items, names, &mut private);
        let private = private.into_iter().map(|(keyword, item)| {
            let content = self.tree.children(item).skip(1);
            // What is private in something private is only private.
            let groups = self.groups(content, names, &mut Vec::new());
            Private { keyword, groups }
        });
        let private = private.collect();
        TypedList { groups, private }
    }

    /// The names with their types; the lists that start with `:private` are handed out.
    fn groups(
        &mut self,
        items: impl Iterator<Item = NodeId>,
        names: Names,
        private: &mut Vec<(Name<'a>, NodeId)>,
    ) -> Vec<Group<'a>> {
        let mut groups = Vec::new();
        let mut pending: Vec<Name<'a>> = Vec::new();
        let mut items = items;
        let mut nested = false;
        let mut inner = Vec::new();
        while let Some(item) = items.next() {
            if self.tree.is_list(item) {
                match self.head(item) {
                    Some(head) if head.is(":private") && names == Names::Words => {
                        private.push((head, item));
                    }
                    Some(head) if head.is_variable() && names == Names::Variables => {
                        // `((?a - t) (?b - u))` is a list of variables with too many parentheses.
                        if !std::mem::replace(&mut nested, true) {
                            self.unexpected(names.describe(), item);
                        }
                        let content = self.tree.children(item);
                        if !pending.is_empty() {
                            let names = std::mem::take(&mut pending);
                            groups.push(Group { names, types: None });
                        }
                        inner.push((groups.len(), content));
                    }
                    _ => self.unexpected(names.describe(), item),
                }
                continue;
            }
            let name = self.name(item);
            let types = if lexer::is_dash(name.text) {
                self.type_reference(items.next(), name.span)
            } else if let Some(glued) = self.glued_type(name) {
                Some(glued)
            } else {
                if name.is_variable() != (names == Names::Variables) {
                    self.unexpected(names.describe(), item);
                }
                pending.push(name);
                continue;
            };
            if pending.is_empty() {
                self.diagnostics.push(unexpected_item::missing_item(
                    &format!("{} before `-`", names.describe()),
                    name.span,
                ));
            } else if types.is_some() {
                groups.push(Group { names: std::mem::take(&mut pending), types });
            }
        }
        if !pending.is_empty() {
            groups.push(Group { names: pending, types: None });
        }
        for (place, content) in inner.into_iter().rev() {
            let words = content.filter(|&part| !self.tree.is_list(part));
            let words: Vec<NodeId> = words.collect();
            let read = self.groups(words.into_iter(), names, private);
            groups.splice(place..place, read);
        }
        groups
    }

    /// `-truck`, which stands for `- truck`.
    pub(super) fn glued_type(&mut self, name: Name<'a>) -> Option<TypeReference<'a>> {
        let bare = name.text.strip_prefix('-')?;
        if is_number(name.text) {
            return None;
        }
        self.diagnostics.push(dash_not_separated::dash_not_separated(name.text, name.span));
        let span = Span { start: name.span.start + 1, ..name.span };
        Some(TypeReference { names: vec![Name { text: bare, span }] })
    }

    /// What follows a `-`: a type or `(either …)`.
    pub(super) fn type_reference(
        &mut self,
        item: Option<NodeId>,
        dash: Span,
    ) -> Option<TypeReference<'a>> {
        // A type without a name, of which nothing more is said.
        let missing = Some(TypeReference { names: vec![Name { text: "", span: dash }] });
        let Some(item) = item else {
            self.diagnostics.push(unexpected_item::missing_item("a type after `-`", dash));
            return missing;
        };
        if !self.tree.is_list(item) {
            return Some(TypeReference { names: vec![self.name(item)] });
        }
        if self.head(item).is_some_and(|head| head.is("either")) {
            let names: Vec<_> = self
                .tree
                .children(item)
                .skip(1)
                .filter(|&child| !self.tree.is_list(child))
                .map(|child| self.name(child))
                .collect();
            if !names.is_empty() {
                return Some(TypeReference { names });
            }
        }
        self.unexpected("a type or `(either TYPE …)`", item);
        missing
    }

    /// `(NAME ?x - t …)`
    pub(super) fn declaration(&mut self, item: NodeId, what: &str) -> Option<Head<'a>> {
        let Some(name) = self.head(item) else {
            let expected = format!("{what} in parentheses");
            if self.tree.is_list(item) {
                self.unexpected(&expected, item);
            } else {
                self.stray(&expected, item);
            }
            return None;
        };
        let parameters = self.typed_list(self.tree.children(item).skip(1), Names::Variables);
        Some(Head { name, parameters, place: self.place(item) })
    }

    /// The content of `(:functions …)`.
    pub(super) fn functions(
        &mut self,
        items: impl Iterator<Item = NodeId>,
    ) -> Vec<FunctionGroup<'a>> {
        let mut groups = Vec::new();
        let mut heads = Vec::new();
        let mut items = items;
        while let Some(item) = items.next() {
            if self.tree.is_list(item) {
                heads.extend(self.declaration(item, "a function"));
                continue;
            }
            let name = self.name(item);
            let types = if lexer::is_dash(name.text) {
                self.type_reference(items.next(), name.span)
            } else {
                let glued = self.glued_type(name);
                if glued.is_none() {
                    self.unexpected("a function in parentheses", item);
                }
                glued
            };
            if types.is_some() && !heads.is_empty() {
                groups.push(FunctionGroup { heads: std::mem::take(&mut heads), types });
            }
        }
        if !heads.is_empty() {
            groups.push(FunctionGroup { heads, types: None });
        }
        groups
    }

    /// `(NAME TERM …)` with words as terms, which go to `terms`; nothing if there is a list among them.
    pub(super) fn application(
        &self,
        item: NodeId,
        terms: &mut Vec<Name<'a>>,
    ) -> Option<Application<'a>> {
        let start = terms.len();
        if !self.tree.is_list(item) {
            let arguments = start as u32..start as u32;
            return Some(Application { name: self.name(item), arguments });
        }
        let name = self.head(item)?;
        for child in self.tree.children(item).skip(1) {
            if self.tree.is_list(child) {
                terms.truncate(start);
                return None;
            }
            terms.push(self.name(child));
        }
        Some(Application { name, arguments: start as u32..terms.len() as u32 })
    }
}

impl Names {
    fn describe(self) -> &'static str {
        match self {
            Self::Variables => "a variable such as `?x`",
            Self::Words => "a name",
        }
    }
}
