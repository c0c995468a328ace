//! Each name that the checker resolves goes in; what must be known of it afterwards is kept.

use super::Report;
use crate::ast::Name;
use crate::diagnostic::unknown_preference;
use crate::model::{FunctionId, Variable};
use crate::near::nearest;
use crate::source::Span;
use crate::symbol::{Namespace, Occurrence, Role, Symbol};

/// What becomes of the values of functions that are read.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(super) enum Reading {
    /// A plan depends on them.
    Asked,
    /// They only count for the cost.
    #[default]
    Beside,
}

impl Report<'_> {
    /// The value of a function is asked for.
    pub(super) fn reads(&mut self, function: FunctionId, span: Span) {
        if self.reading == Reading::Asked {
            self.read.entry(function).or_insert(span);
        }
    }

    /// A preference is named where it is declared.
    pub(super) fn prefers(&mut self, name: Name<'_>) {
        self.declared_here(name, Namespace::Preference);
        let known = self.preferences.iter().any(|known| name.is(&known.text));
        if !known {
            self.preferences.push(super::name(name));
        }
    }

    /// A preference is named in a metric.
    pub(super) fn violated(&mut self, name: Name<'_>) {
        let known = self.preferences.iter().find(|known| name.is(&known.text));
        if let Some(known) = known {
            let declared = known.span;
            return self.found(name, Symbol::at(Namespace::Preference, declared));
        }
        self.lost(name, Namespace::Preference);
        if self.first(&unknown_preference::RULE, name.text) {
            let near = nearest(name.text, self.preferences.iter().map(|known| known.text.as_str()));
            let diagnostic = unknown_preference::unknown_preference(name.text, name.span, near);
            self.push(diagnostic);
        }
    }

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
