//! What there is to say about a text: one [`Diagnostic`] per mistake, gathered in [`Diagnostics`].
//!
//! A diagnostic is plain data. How it looks is decided in the renderers.

use crate::source::Span;

pub mod unclosed_paren;
pub mod unexpected_close_paren;
pub mod not_a_pddl_file;
pub mod unknown_section;
pub mod unknown_field;
pub mod invalid_character;
pub mod dash_not_separated;
pub mod unknown_allow;
pub mod several_formulas;
pub mod duplicate_field;
pub mod connective_in_init;
pub mod unexpected_item;
pub mod not_utf8;
pub mod misplaced_parenthesis;
pub mod unknown_predicate;
pub mod unused_parameter;
pub mod shadowed_variable;
pub mod unused_predicate;
pub mod unused_function;
pub mod unused_type;
pub mod unused_variable;
pub mod fixed_parameter;
pub mod unknown_variable;
pub mod unknown_object;
pub mod duplicate_definition;
pub mod duplicate_parameter;
pub mod domain_name_mismatch;
pub mod unknown_function;
pub mod unknown_preference;
pub mod unknown_action;
pub mod wrong_arity;
pub mod type_mismatch;
pub mod unknown_type;
pub mod cyclic_types;
pub mod function_as_predicate;
pub mod predicate_as_function;
pub mod suspicious_type_list;
pub mod disjoint_types;
pub mod untyped_tail;
pub mod unknown_requirement;
pub mod missing_requirement;
pub mod unused_requirement;
pub mod repeated_requirement;
pub mod unsupported_feature;
pub mod not_portable;
pub mod wrong_operand_count;
pub mod contradictory_effect;
pub mod constant_condition;
pub mod never_applicable;
pub mod effect_without_change;
pub mod action_without_effect;
pub mod repeated_condition;
pub mod repeated_effect;
pub mod identical_actions;
pub mod decided_condition;
pub mod circular_rule;
pub mod overridden_effect;
pub mod disjunctive_effect;
pub mod when_in_condition;
pub mod unstratified_axioms;
pub mod uninitialised_function;
pub mod wrong_value;
pub mod missing_time_specifier;
pub mod missing_duration;
pub mod misplaced_time_specifier;
pub mod unknown_time_specifier;
pub mod invalid_duration;
pub mod derived_effect;
pub mod misplaced_modality;
pub mod variable_in_init;
pub mod goal_unreachable;
pub mod goal_already_true;
pub mod action_atom_arity;
pub mod repeated_fact;
pub mod contradictory_fact;
pub mod derived_fact;
pub mod constant_metric;
pub mod cost_without_metric;
pub mod contradictory_goal;
pub mod type_without_objects;
pub mod static_predicate;
pub mod unread_predicate;
pub mod agent_without_multi_agent;
pub mod private_access;
pub mod parts_disagree;
pub mod agent_list_mismatch;
pub mod unknown_constraint;
pub mod constraint_position;
pub mod conflicting_effects;
pub mod shared_fact;
pub mod impossible_action_atom;
pub mod ambiguous_action;
pub mod idle_action_atom;
pub mod subtask_arity;
pub mod unknown_task;
pub mod unknown_subtask;
pub mod unknown_annotation;
pub mod unbalanced_annotation;
pub mod misplaced_annotation;
pub mod loose_annotation;
pub mod malformed_annotation;
pub mod plan_syntax;
pub mod plan_unknown_action;
pub mod plan_wrong_arity;
pub mod plan_unknown_object;
pub mod plan_type_mismatch;
pub mod plan_step_order;
pub mod plan_step_fails;
pub mod plan_misses_goal;

#[cfg(test)]
pub(crate) mod fixture;

/// All kinds, in the order of their numbers.
pub const RULES: &[Rule] = &[
    unclosed_paren::RULE,
    unexpected_close_paren::RULE,
    not_a_pddl_file::RULE,
    unknown_section::RULE,
    unknown_field::RULE,
    invalid_character::RULE,
    dash_not_separated::RULE,
    unknown_allow::RULE,
    several_formulas::RULE,
    duplicate_field::RULE,
    connective_in_init::RULE,
    unexpected_item::RULE,
    not_utf8::RULE,
    misplaced_parenthesis::RULE,
    unknown_predicate::RULE,
    unused_parameter::RULE,
    shadowed_variable::RULE,
    unused_predicate::RULE,
    unused_function::RULE,
    unused_type::RULE,
    unused_variable::RULE,
    fixed_parameter::RULE,
    unknown_variable::RULE,
    unknown_object::RULE,
    duplicate_definition::RULE,
    duplicate_parameter::RULE,
    domain_name_mismatch::RULE,
    unknown_function::RULE,
    unknown_preference::RULE,
    unknown_action::RULE,
    wrong_arity::RULE,
    type_mismatch::RULE,
    unknown_type::RULE,
    cyclic_types::RULE,
    function_as_predicate::RULE,
    predicate_as_function::RULE,
    suspicious_type_list::RULE,
    disjoint_types::RULE,
    untyped_tail::RULE,
    unknown_requirement::RULE,
    missing_requirement::RULE,
    unused_requirement::RULE,
    repeated_requirement::RULE,
    unsupported_feature::RULE,
    not_portable::RULE,
    wrong_operand_count::RULE,
    contradictory_effect::RULE,
    constant_condition::RULE,
    never_applicable::RULE,
    effect_without_change::RULE,
    action_without_effect::RULE,
    repeated_condition::RULE,
    repeated_effect::RULE,
    identical_actions::RULE,
    decided_condition::RULE,
    circular_rule::RULE,
    overridden_effect::RULE,
    disjunctive_effect::RULE,
    when_in_condition::RULE,
    unstratified_axioms::RULE,
    uninitialised_function::RULE,
    wrong_value::RULE,
    missing_time_specifier::RULE,
    missing_duration::RULE,
    misplaced_time_specifier::RULE,
    unknown_time_specifier::RULE,
    invalid_duration::RULE,
    derived_effect::RULE,
    misplaced_modality::RULE,
    variable_in_init::RULE,
    goal_unreachable::RULE,
    goal_already_true::RULE,
    action_atom_arity::RULE,
    repeated_fact::RULE,
    contradictory_fact::RULE,
    derived_fact::RULE,
    constant_metric::RULE,
    cost_without_metric::RULE,
    contradictory_goal::RULE,
    type_without_objects::RULE,
    static_predicate::RULE,
    unread_predicate::RULE,
    agent_without_multi_agent::RULE,
    private_access::RULE,
    parts_disagree::RULE,
    agent_list_mismatch::RULE,
    unknown_constraint::RULE,
    constraint_position::RULE,
    conflicting_effects::RULE,
    shared_fact::RULE,
    impossible_action_atom::RULE,
    ambiguous_action::RULE,
    idle_action_atom::RULE,
    subtask_arity::RULE,
    unknown_task::RULE,
    unknown_subtask::RULE,
    unknown_annotation::RULE,
    unbalanced_annotation::RULE,
    misplaced_annotation::RULE,
    loose_annotation::RULE,
    malformed_annotation::RULE,
    plan_syntax::RULE,
    plan_unknown_action::RULE,
    plan_wrong_arity::RULE,
    plan_unknown_object::RULE,
    plan_type_mismatch::RULE,
    plan_step_order::RULE,
    plan_step_fails::RULE,
    plan_misses_goal::RULE,
];

/// One kind of mistake: its code, its name and the page that explains it.
#[derive(Debug, Clone, Copy)]
pub struct Rule {
    /// The stable code, such as `E0101`.
    pub code: &'static str,
    /// The stable name in kebab-case.
    pub name: &'static str,
    /// Error or warning.
    pub severity: Severity,
    /// The page that `caveat explain` prints, in Markdown.
    pub page: &'static str,
}

impl Rule {
    /// A mistake of this kind at `span`, where `label` is to be seen.
    pub fn at(
        &self,
        span: Span,
        message: impl Into<String>,
        label: impl Into<String>,
    ) -> Diagnostic {
        Diagnostic {
            code: self.code,
            name: self.name,
            severity: self.severity,
            message: message.into(),
            primary: Label { span, text: label.into() },
            secondary: Vec::new(),
            help: None,
            fixes: Vec::new(),
        }
    }
}

/// The page of the kind that has this code or this name.
pub fn explain(code_or_name: &str) -> Option<&'static str> {
    let rule = RULES
        .iter()
        .find(|rule| rule.code.eq_ignore_ascii_case(code_or_name) || rule.name == code_or_name)?;
    Some(rule.page)
}

/// How bad it is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Severity {
    /// Worth knowing; the text means what it says.
    Warning,
    /// The text has no meaning as it stands.
    Error,
}

/// A place that helps to understand the mistake, and what is to be seen there.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Label {
    /// Where.
    pub span: Span,
    /// What is to be seen there; may be empty.
    pub text: String,
}

/// How sure it is that a [`Fix`] is what is wanted.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Applicability {
    /// The text means what it was taken to mean already; a program may apply it.
    Safe,
    /// One likely way of several; a person chooses.
    Suggested,
}

/// A change of the text that mends the mistake without changing anything else.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Fix {
    /// Whether a program may apply it unasked.
    pub applicability: Applicability,
    /// What it does, as an instruction: "replace with `:predicates`".
    pub title: String,
    /// The ranges to replace, and by what.
    pub edits: Vec<(Span, String)>,
}

/// One mistake.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Diagnostic {
    /// The stable code, such as `E0101`.
    pub code: &'static str,
    /// The stable name in kebab-case, such as `unknown-predicate`.
    pub name: &'static str,
    /// Error or warning.
    pub severity: Severity,
    /// One terse sentence without a full stop.
    pub message: String,
    /// Where the mistake is, and what is wrong there.
    pub primary: Label,
    /// Places that show the cause: the declaration, the enclosing action.
    pub secondary: Vec<Label>,
    /// What to do about it.
    pub help: Option<String>,
    /// Ways to mend it that a machine can apply.
    pub fixes: Vec<Fix>,
}

impl Diagnostic {
    /// Adds a place that shows the cause.
    #[must_use]
    pub fn label(mut self, span: Span, text: impl Into<String>) -> Self {
        self.secondary.push(Label { span, text: text.into() });
        self
    }

    /// Says what to do about it.
    #[must_use]
    pub fn help(mut self, text: impl Into<String>) -> Self {
        self.help = Some(text.into());
        self
    }

    /// Offers to replace one range.
    #[must_use]
    pub fn fix(
        mut self,
        title: impl Into<String>,
        span: Span,
        replacement: impl Into<String>,
    ) -> Self {
        self.fixes.push(Fix {
            applicability: Applicability::Suggested,
            title: title.into(),
            edits: vec![(span, replacement.into())],
        });
        self
    }

    /// Adds another range to the last fix.
    #[must_use]
    pub fn along(mut self, span: Span, replacement: impl Into<String>) -> Self {
        if let Some(fix) = self.fixes.last_mut() {
            fix.edits.push((span, replacement.into()));
        }
        self
    }

    /// Offers to write something around the place of the mistake.
    #[must_use]
    pub fn wrap(self, before: &str, after: &str) -> Self {
        let Span { source, start, end } = self.primary.span;
        let title = format!("write `{before}…{after}` around it");
        self.fix(title, Span::new(source, start, start), before)
            .along(Span::new(source, end, end), after)
    }

    /// Offers to declare a requirement, at a place in the list of them or before it if the list `is_missing`.
    #[must_use]
    pub fn fix_requirement(self, flag: &str, (place, is_missing): (Span, bool)) -> Self {
        let text =
            if is_missing { format!("\n  (:requirements {flag})") } else { format!(" {flag}") };
        self.fix(format!("declare `{flag}`"), place, text).safely()
    }

    /// Says that the last fix only writes what the text was taken to mean anyway.
    #[must_use]
    pub fn safely(mut self) -> Self {
        if let Some(fix) = self.fixes.last_mut() {
            fix.applicability = Applicability::Safe;
        }
        self
    }

    /// Proposes the name that was probably meant, if there is one.
    #[must_use]
    pub fn suggest(self, near: Option<&str>) -> Self {
        let span = self.primary.span;
        match near {
            Some(near) => self.help(format!("did you mean `{near}`?")).fix(
                format!("replace with `{near}`"),
                span,
                near,
            ),
            None => self,
        }
    }
}

/// All mistakes found so far, in the order in which they were found.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Diagnostics {
    /// The mistakes.
    pub list: Vec<Diagnostic>,
}

impl Diagnostics {
    /// Whether one of them is an error.
    pub fn has_errors(&self) -> bool {
        self.list.iter().any(|diagnostic| diagnostic.severity == Severity::Error)
    }

    /// Adds one.
    pub fn push(&mut self, diagnostic: Diagnostic) {
        self.list.push(diagnostic);
    }

    /// Adds all of `other`.
    pub fn append(&mut self, mut other: Self) {
        self.list.append(&mut other.list);
    }
}
