//! The variables that are bound at a place, and what terms mean there.

use super::agents::{self, Acting};
use super::index::Index;
use super::requirement::Need;
use super::{Report, World, describe_parameters, hierarchy, name};
use crate::ast::{Name, TypedList};
use crate::diagnostic::{
    action_atom_arity, duplicate_parameter, function_as_predicate, predicate_as_function,
    shadowed_variable, subtask_arity, type_mismatch, unknown_function, unknown_object,
    unknown_predicate, unknown_variable, wrong_arity,
};
use crate::model::{
    Atom, FunctionId, ObjectId, PredicateId, Scope, Signature, Term, TypeId, Variable, VariableId,
};
use crate::source::Span;
use crate::symbol::{Namespace, Symbol};

/// The variables of an action, an axiom or a goal while it is checked.
#[expect(clippy::struct_excessive_bools, reason = "each is a question of its own about the place")]
pub(super) struct Bindings<'a> {
    pub(super) scope: Scope,
    visible: Index<'a>,
    /// Which variables have been used.
    pub(super) used: Vec<bool>,
    /// Whether something was used that is not bound, or could not be read, so that nothing can be said about what is unused.
    pub(super) unsure: bool,
    /// Whether a name is bound twice in one list, so that another name that was meant is not bound.
    pub(super) doubled: bool,
    /// Whose variables these are: "action `drive`".
    pub(super) owner: String,
    /// Whether `?duration` stands for a number here.
    pub(super) durative: bool,
    /// Whether `#t` stands for the time that has passed here.
    pub(super) continuous: bool,
    /// Who acts, in MA-PDDL.
    pub(super) acting: Option<Acting>,
    /// The atoms that an action of an agent demands.
    pub(super) demanded: Vec<Atom>,
    /// Whether there is a joint action here that action atoms can ask about.
    pub(super) joint: bool,
}

/// What a list of variables hid, to be restored at its end.
pub(super) type Hidden<'a> = Vec<(&'a str, Option<u32>)>;

impl<'a> Bindings<'a> {
    /// No variables yet.
    pub(super) fn new(owner: String) -> Self {
        Self {
            scope: Scope::default(),
            visible: Index::default(),
            used: Vec::new(),
            unsure: false,
            doubled: false,
            owner,
            durative: false,
            continuous: false,
            acting: None,
            demanded: Vec::new(),
            joint: false,
        }
    }

    /// Binds a list of variables.
    pub(super) fn bind(
        &mut self,
        list: &TypedList<'a>,
        world: &World<'_, 'a>,
        report: &mut Report<'_>,
    ) -> (Vec<VariableId>, Hidden<'a>) {
        let first = self.scope.variables.len() as u32;
        let mut hidden = Vec::new();
        for group in &list.groups {
            let types =
                hierarchy::resolve(group.types.as_ref(), &world.names.types, "`:types`", report);
            if let Some(reference) = &group.types {
                report.need(Need::Types, reference.names[0].span);
            }
            for &spelling in &group.names {
                let id = self.scope.variables.len() as u32;
                let before = self.visible.insert(bare(spelling.text), id);
                if let Some(earlier) = before.filter(|&earlier| earlier >= first) {
                    let earlier = self.scope.variables[earlier as usize].name.span;
                    report.push(duplicate_parameter::duplicate_parameter(
                        spelling.text,
                        &self.owner,
                        spelling.span,
                        earlier,
                    ));
                    (self.unsure, self.doubled) = (true, true);
                } else {
                    if let Some(outer) = before {
                        // Being hidden explains why it is not used.
                        self.used[outer as usize] = true;
                        let outer = self.scope.variables[outer as usize].name.span;
                        report.push(shadowed_variable::shadowed_variable(
                            spelling.text,
                            &self.owner,
                            spelling.span,
                            outer,
                        ));
                    }
                    hidden.push((bare(spelling.text), before));
                }
                let variable = Variable { name: name(spelling), types: types.clone() };
                report.declared_variable(spelling, &variable);
                self.scope.variables.push(variable);
                self.used.push(false);
            }
        }
        let bound = (first..self.scope.variables.len() as u32).map(VariableId).collect();
        (bound, hidden)
    }

    /// Ends what [`Self::bind`] began.
    pub(super) fn restore(&mut self, hidden: Hidden<'a>) {
        for (spelling, before) in hidden {
            match before {
                Some(id) => {
                    self.visible.insert(spelling, id);
                }
                None => self.visible.remove(spelling),
            }
        }
    }

    /// Whether a variable is bound here.
    pub(super) fn binds(&self, spelling: Name<'_>) -> bool {
        self.visible.find(bare(spelling.text)).is_some()
    }

    /// A variable that is bound here.
    fn variable(
        &mut self,
        spelling: Name<'a>,
        world: &World<'_, 'a>,
        report: &mut Report<'_>,
    ) -> Option<VariableId> {
        if let Some(id) = self.visible.find(bare(spelling.text)) {
            self.used[id as usize] = true;
            let declared = self.scope.variables[id as usize].name.span;
            report.found(spelling, Symbol::at(Namespace::Variable, declared));
            return Some(VariableId(id));
        }
        self.unsure = true;
        report.lost(spelling, Namespace::Variable);
        let key = format!("{} in {}", spelling.text, self.owner);
        if !self.doubled && report.first(&unknown_variable::RULE, &key) {
            let near = report.nearest(bare(spelling.text), &self.visible);
            let near = near.map(|near| format!("?{near}"));
            let variables = self.scope.variables.iter().take(SHOWN);
            let scope: Vec<String> = variables
                .map(|variable| {
                    describe_parameters(&world.domain.types, std::slice::from_ref(variable))
                })
                .collect();
            report.push(unknown_variable::unknown_variable(
                spelling.text,
                spelling.span,
                &self.owner,
                &scope,
                near.as_deref(),
            ));
        }
        None
    }

    /// What a term stands for.
    pub(super) fn term(
        &mut self,
        spelling: Name<'a>,
        world: &World<'_, 'a>,
        report: &mut Report<'_>,
    ) -> Option<Term> {
        if spelling.is_variable() {
            return self.variable(spelling, world, report).map(Term::Variable);
        }
        let found = world.names.objects.find(spelling.text);
        if found.is_none() && self.visible.find(bare(spelling.text)).is_some() {
            self.unsure = true;
            report.lost(spelling, Namespace::Object);
            if report.first(&unknown_object::RULE, spelling.text) {
                let variable = format!("?{}", spelling.text);
                let (text, span) = (spelling.text, spelling.span);
                report.push(unknown_object::unknown_object(
                    text,
                    span,
                    world.places,
                    Some(&variable),
                ));
            }
            return None;
        }
        object(spelling, world, report).map(Term::Object)
    }

    /// The types of a term, and whether it has all of them.
    pub(super) fn types<'w>(&'w self, term: Term, world: &World<'w, 'a>) -> (&'w [TypeId], bool) {
        match term {
            Term::Variable(id) => (&self.scope.variables[id.index()].types, false),
            Term::Object(id) => (&world.objects[id.index()].types, true),
        }
    }

    /// The arguments of a predicate or a function, if all are right.
    pub(super) fn arguments(
        &mut self,
        callee: &Callee<'_>,
        spellings: &[Name<'a>],
        span: Span,
        world: &World<'_, 'a>,
        report: &mut Report<'_>,
    ) -> Option<Vec<Term>> {
        let mut terms = Vec::with_capacity(spellings.len());
        for &spelling in spellings {
            terms.extend(self.term(spelling, world, report));
        }
        if spellings.len() != callee.parameters.len() {
            callee.report_arity(spellings, spellings.len(), span, world, report);
            return None;
        }
        if terms.len() != spellings.len() {
            return None;
        }
        for ((&term, &spelling), parameter) in terms.iter().zip(spellings).zip(callee.parameters) {
            let (have, all) = self.types(term, world);
            // That another agent acts is a question with an answer for every object that could be the argument.
            let fits = match callee.what {
                What::ActionAtom => {
                    have.is_empty()
                        || parameter.types.is_empty()
                        || world.overlap(have, &parameter.types)
                }
                _ => world.fits(have, all, &parameter.types),
            };
            if !fits {
                let found = world.describe_types(have);
                callee.report_type(spelling, &found, &parameter.types, world, report);
                return None;
            }
        }
        Some(terms)
    }

    /// A predicate applied to terms.
    pub(super) fn atom(
        &mut self,
        spelling: Name<'a>,
        arguments: &[Name<'a>],
        span: Span,
        world: &World<'_, 'a>,
        report: &mut Report<'_>,
    ) -> Option<Atom> {
        let misspelt = if self.joint {
            agents::misspelt(spelling, arguments.len(), world, report)
        } else {
            None
        };
        if let Some(action) = misspelt {
            self.look_at(arguments, world, report);
            report.lost(spelling, Namespace::Action);
            if report.first(&unknown_predicate::RULE, spelling.text) {
                let (text, span) = (spelling.text, spelling.span);
                report.push(unknown_predicate::nor_action(text, span, &action.name.text));
            }
            return None;
        }
        let Some(predicate) = predicate(spelling, world, report) else {
            self.look_at(arguments, world, report);
            return None;
        };
        let callee = Callee::predicate(predicate, world);
        let arguments = self.arguments(&callee, arguments, span, world, report)?;
        agents::access(predicate, &arguments, span, self, world, report);
        Some(Atom { predicate, arguments })
    }

    /// A function applied to terms.
    pub(super) fn function(
        &mut self,
        spelling: Name<'a>,
        arguments: &[Name<'a>],
        span: Span,
        world: &World<'_, 'a>,
        report: &mut Report<'_>,
    ) -> Option<(FunctionId, Vec<Term>)> {
        let Some(function) = function(spelling, world, report) else {
            self.look_at(arguments, world, report);
            return None;
        };
        let callee = Callee::function(function, world);
        let arguments = self.arguments(&callee, arguments, span, world, report)?;
        Some((function, arguments))
    }

    /// Checks terms whose meaning does not matter.
    fn look_at(&mut self, arguments: &[Name<'a>], world: &World<'_, 'a>, report: &mut Report<'_>) {
        for &argument in arguments {
            self.term(argument, world, report);
        }
    }
}

/// A variable without its `?`, which a declaration may lack by mistake.
fn bare(variable: &str) -> &str {
    variable.strip_prefix('?').unwrap_or(variable)
}

/// How many variables a message lists.
const SHOWN: usize = 12;

/// What is applied to arguments.
pub(super) struct Callee<'w> {
    what: What,
    name: &'w str,
    pub(super) parameters: &'w [Variable],
    declared: Span,
}

/// Which kind of thing that is.
#[derive(Clone, Copy)]
enum What {
    Predicate,
    Function,
    ActionAtom,
    Task,
}

impl<'w> Callee<'w> {
    pub(super) fn predicate(id: PredicateId, world: &World<'w, '_>) -> Self {
        let declared = &world.domain.predicates[id.index()];
        Self {
            what: What::Predicate,
            name: &declared.name.text,
            parameters: &declared.parameters,
            declared: declared.name.span,
        }
    }

    pub(super) fn function(id: FunctionId, world: &World<'w, '_>) -> Self {
        let declared = &world.domain.functions[id.index()];
        Self {
            what: What::Function,
            name: &declared.name.text,
            parameters: &declared.parameters,
            declared: declared.name.span,
        }
    }

    /// An action that a condition names.
    pub(super) fn action_atom(declared: &'w Signature) -> Self {
        Self {
            what: What::ActionAtom,
            name: &declared.name.text,
            parameters: &declared.parameters,
            declared: declared.name.span,
        }
    }

    /// A task or an action as a part of a task network.
    pub(super) fn task(declared: &'w Signature) -> Self {
        Self { what: What::Task, ..Self::action_atom(declared) }
    }

    /// As messages say it: "predicate `at`".
    pub(super) fn describe(&self) -> String {
        let what = match self.what {
            What::Predicate => "predicate",
            What::Function => "function",
            What::ActionAtom => "action",
            What::Task => "task",
        };
        format!("{what} `{}`", self.name)
    }

    pub(super) fn report_arity(
        &self,
        arguments: &[Name<'_>],
        given: usize,
        span: Span,
        world: &World<'_, '_>,
        report: &mut Report<'_>,
    ) {
        let types = &world.domain.types;
        let missing = describe_parameters(types, &self.missing(arguments, given));
        let count = (self.parameters.len(), given);
        let all = format!("{} {}", self.name, describe_parameters(types, self.parameters));
        report.push(match self.what {
            What::ActionAtom => action_atom_arity::action_atom_arity(
                self.name,
                count,
                &missing,
                all.trim_end(),
                span,
                self.declared,
            ),
            What::Task => subtask_arity::subtask_arity(
                self.name,
                count,
                &missing,
                all.trim_end(),
                span,
                self.declared,
            ),
            What::Predicate | What::Function => wrong_arity::wrong_arity(
                &self.describe(),
                self.parameters.len(),
                given,
                &missing,
                span,
                self.declared,
            ),
        });
    }

    /// The parameters that have no argument: those whose names do not stand among the arguments if that explains the difference, else the last ones.
    fn missing(&self, arguments: &[Name<'_>], given: usize) -> Vec<Variable> {
        let absent = |parameter: &&Variable| {
            !arguments.iter().any(|argument| argument.is(&parameter.name.text))
        };
        let unnamed: Vec<Variable> = self.parameters.iter().filter(absent).cloned().collect();
        if unnamed.len() + given == self.parameters.len() {
            return unnamed;
        }
        self.parameters.get(given..).unwrap_or_default().to_vec()
    }

    pub(super) fn report_type(
        &self,
        spelling: Name<'_>,
        found: &str,
        wanted: &[TypeId],
        world: &World<'_, '_>,
        report: &mut Report<'_>,
    ) {
        let wanted = world.describe_types(wanted);
        report.push(type_mismatch::type_mismatch(
            spelling.text,
            found,
            &self.describe(),
            &wanted,
            spelling.span,
            self.declared,
        ));
    }
}

/// The predicate of this name.
pub(super) fn predicate(
    spelling: Name<'_>,
    world: &World<'_, '_>,
    report: &mut Report<'_>,
) -> Option<PredicateId> {
    if let Some(id) = world.names.predicates.find(spelling.text) {
        report.found(spelling, PredicateId(id));
        return Some(PredicateId(id));
    }
    report.lost(spelling, Namespace::Predicate);
    if let Some(id) = world.names.functions.find(spelling.text) {
        if report.first(&function_as_predicate::RULE, spelling.text) {
            let declared = world.domain.functions[id as usize].name.span;
            report.push(function_as_predicate::function_as_predicate(
                spelling.text,
                spelling.span,
                declared,
            ));
        }
    } else if let Some(action) = world.names.actions.find(spelling.text) {
        if report.first(&unknown_predicate::RULE, spelling.text) {
            let declared = world.domain.signatures[action as usize].name.span;
            report.push(unknown_predicate::an_action(spelling.text, spelling.span, declared));
        }
    } else if report.first(&unknown_predicate::RULE, spelling.text) {
        let near = report.nearest(spelling.text, &world.names.predicates);
        report.push(unknown_predicate::unknown_predicate(spelling.text, spelling.span, near));
    }
    None
}

/// The function of this name.
pub(super) fn function(
    spelling: Name<'_>,
    world: &World<'_, '_>,
    report: &mut Report<'_>,
) -> Option<FunctionId> {
    if let Some(id) = world.names.functions.find(spelling.text) {
        report.found(spelling, FunctionId(id));
        return Some(FunctionId(id));
    }
    report.lost(spelling, Namespace::Function);
    if let Some(id) = world.names.predicates.find(spelling.text) {
        if report.first(&predicate_as_function::RULE, spelling.text) {
            let declared = world.domain.predicates[id as usize].name.span;
            report.push(predicate_as_function::predicate_as_function(
                spelling.text,
                spelling.span,
                declared,
            ));
        }
    } else if report.first(&unknown_function::RULE, spelling.text) {
        let near = report.nearest(spelling.text, &world.names.functions);
        let none = world.names.functions.len() == 0;
        report.push(unknown_function::unknown_function(spelling.text, spelling.span, none, near));
    }
    None
}

/// The object of this name.
pub(super) fn object(
    spelling: Name<'_>,
    world: &World<'_, '_>,
    report: &mut Report<'_>,
) -> Option<ObjectId> {
    if let Some(id) = world.names.objects.find(spelling.text) {
        report.found(spelling, ObjectId(id));
        return Some(ObjectId(id));
    }
    report.lost(spelling, Namespace::Object);
    if report.first(&unknown_object::RULE, spelling.text) {
        let near = report.nearest(spelling.text, &world.names.objects);
        report.push(unknown_object::unknown_object(
            spelling.text,
            spelling.span,
            world.places,
            near,
        ));
    }
    None
}
