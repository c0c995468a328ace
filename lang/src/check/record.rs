//! Each name that the checker resolves goes in; an [`Occurrence`] of it is kept, if somebody asked for them.

use super::Report;
use crate::ast::Name;
use crate::model::Variable;
use crate::symbol::{Namespace, Occurrence, Role, Symbol};

impl Report<'_> {
    /// What the next predicate or function that is resolved does there; without this it is read.
    pub(super) fn next(&mut self, role: Role) {
        self.role = role;
    }

    /// A name is declared.
    pub(super) fn declared(&mut self, spelling: Name<'_>, symbol: impl Into<Symbol>) {
        self.keep(spelling, symbol.into(), Role::Declare);
    }

    /// Something that has no table in the model is declared.
    pub(super) fn declared_here(&mut self, spelling: Name<'_>, namespace: Namespace) {
        self.declared(spelling, Symbol::at(namespace, spelling.span));
    }

    /// A variable is declared.
    pub(super) fn declared_variable(&mut self, spelling: Name<'_>, variable: &Variable) {
        self.declared_here(spelling, Namespace::Variable);
        if let Some(occurrences) = self.occurrences.as_deref_mut() {
            occurrences.variables.push(variable.clone());
        }
    }

    /// A name is used and means something.
    pub(super) fn found(&mut self, spelling: Name<'_>, symbol: impl Into<Symbol>) {
        let symbol = symbol.into();
        let role = self.role_of(symbol.namespace());
        self.keep(spelling, symbol, role);
    }

    /// A name is used and means nothing, though one of this kind is wanted.
    pub(super) fn lost(&mut self, spelling: Name<'_>, wanted: Namespace) {
        let role = self.role_of(wanted);
        self.keep(spelling, Symbol::Unknown(wanted), role);
    }

    fn role_of(&mut self, namespace: Namespace) -> Role {
        match namespace {
            Namespace::Predicate | Namespace::Function => std::mem::take(&mut self.role),
            _ => Role::Read,
        }
    }

    fn keep(&mut self, spelling: Name<'_>, symbol: Symbol, role: Role) {
        if let Some(occurrences) = self.occurrences.as_deref_mut()
            && !spelling.text.is_empty()
        {
            occurrences.list.push(Occurrence { span: spelling.span, symbol, role });
        }
    }
}
