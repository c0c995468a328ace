//! Effects, taken apart into groups of literals under one condition.

use hashbrown::HashMap;

use super::requirement::Need;
use super::scope::{Bindings, Hidden};
use super::{Report, World, condition, unread};
use crate::ast::{Amount, Connective, Formula, NodeKind as Ast, Quantifier};
use crate::diagnostic::{
    contradictory_effect, disjunctive_effect, unexpected_item, wrong_operand_count,
};
use crate::model::{self, Atom, Effect, Expression, Increase, Literal, VariableId};
use crate::source::Span;
use crate::symbol::Role;

/// A group while its literals are gathered. Its `forall`s and `when`s add to those of the group around it.
struct Draft {
    parent: Option<usize>,
    variables: Vec<VariableId>,
    condition: Option<model::Formula>,
    literals: Vec<Literal>,
    span: Span,
}

/// A node whose operands are being read.
struct Frame<'a> {
    end: u32,
    group: usize,
    hidden: Hidden<'a>,
}

/// The effects of an action while they are taken apart.
struct Effects<'c, 'w, 'd, 'a> {
    drafts: Vec<Draft>,
    increases: Vec<(usize, Increase)>,
    bindings: &'c mut Bindings<'a>,
    world: &'c World<'w, 'a>,
    report: &'c mut Report<'d>,
}

/// Checks the effects of an action.
pub(super) fn check<'a>(
    formulas: &[Formula<'a>],
    span: Span,
    bindings: &mut Bindings<'a>,
    world: &World<'_, 'a>,
    report: &mut Report<'_>,
) -> (Vec<Effect>, Vec<Increase>) {
    let whole = formulas
        .first()
        .and_then(|formula| formula.nodes.first())
        .map_or(span, |node| node.place.0);
    let outermost = Draft {
        parent: None,
        variables: Vec::new(),
        condition: None,
        literals: Vec::new(),
        span: whole,
    };
    let mut effects =
        Effects { drafts: vec![outermost], increases: Vec::new(), bindings, world, report };
    for formula in formulas {
        effects.formula(formula);
    }
    effects.finish()
}

impl<'a> Effects<'_, '_, '_, 'a> {
    fn formula(&mut self, formula: &Formula<'a>) {
        let mut open: Vec<Frame<'a>> = Vec::new();
        let mut at = 0;
        while at < formula.nodes.len() as u32 {
            self.close(&mut open, at);
            let group = open.last().map_or(0, |frame| frame.group);
            let node = &formula.nodes[at as usize];
            let span = node.place.0;
            at = match &node.kind {
                Ast::Connective(Connective::And) => {
                    open.push(Frame { end: node.next, group, hidden: Vec::new() });
                    at + 1
                }
                Ast::Connective(Connective::When) => match self.when(formula, at as usize, group) {
                    Some(first) => {
                        let inner = self.drafts.len() - 1;
                        open.push(Frame { end: node.next, group: inner, hidden: Vec::new() });
                        first
                    }
                    None => node.next,
                },
                Ast::Quantifier(Quantifier::Forall, list) => {
                    self.report.need(Need::ConditionalEffect, node.keyword.0);
                    let (variables, hidden) = self.bindings.bind(list, self.world, self.report);
                    let given = formula.operands(at as usize).count();
                    if given != 1 {
                        self.report.push(wrong_operand_count::wrong_operand_count(
                            "forall",
                            2,
                            given + 1,
                            span,
                        ));
                    }
                    self.drafts.push(Draft {
                        parent: Some(group),
                        variables,
                        condition: None,
                        literals: Vec::new(),
                        span,
                    });
                    open.push(Frame { end: node.next, group: self.drafts.len() - 1, hidden });
                    at + 1
                }
                Ast::Connective(Connective::Not) => {
                    self.delete(formula, at as usize, group);
                    node.next
                }
                Ast::Connective(word @ (Connective::Or | Connective::Imply)) => {
                    self.report
                        .push(disjunctive_effect::disjunctive_effect(word.word(), node.keyword.0));
                    self.bindings.unsure = true;
                    node.next
                }
                Ast::Quantifier(Quantifier::Exists, _) => {
                    self.report
                        .push(disjunctive_effect::disjunctive_effect("exists", node.keyword.0));
                    self.bindings.unsure = true;
                    node.next
                }
                Ast::Equal(equal) => {
                    self.report.push(disjunctive_effect::disjunctive_effect("=", equal.name.span));
                    self.bindings.unsure = true;
                    node.next
                }
                Ast::Atom(_) => {
                    self.literal(formula, at as usize, group, true, span);
                    node.next
                }
                Ast::Increase(..) => {
                    self.increase(formula, at as usize, group);
                    node.next
                }
                Ast::Unread(part) => {
                    self.bindings.unsure = true;
                    unread(self.world, part, self.report);
                    node.next
                }
            };
        }
        self.close(&mut open, formula.nodes.len() as u32);
    }

    fn close(&mut self, open: &mut Vec<Frame<'a>>, at: u32) {
        while let Some(frame) = open.pop_if(|frame| frame.end <= at) {
            self.bindings.restore(frame.hidden);
        }
    }

    /// Opens a group for `(when CONDITION EFFECT)` and returns the node of the effect.
    fn when(&mut self, formula: &Formula<'a>, at: usize, parent: usize) -> Option<u32> {
        let node = &formula.nodes[at];
        self.report.need(Need::ConditionalEffect, node.keyword.0);
        let mut operands = formula.operands(at);
        let (demand, effect) = (operands.next(), operands.next());
        let given = formula.operands(at).count();
        if given != 2 {
            self.report.push(wrong_operand_count::wrong_operand_count(
                "when",
                2,
                given,
                node.place.0,
            ));
        }
        let (demand, effect) = (demand?, effect?);
        let condition = condition::check(formula, demand, self.bindings, self.world, self.report);
        self.drafts.push(Draft {
            parent: Some(parent),
            variables: Vec::new(),
            condition: Some(condition),
            literals: Vec::new(),
            span: node.place.0,
        });
        Some(effect as u32)
    }

    /// `(not ATOM)`
    fn delete(&mut self, formula: &Formula<'a>, at: usize, group: usize) {
        let node = &formula.nodes[at];
        let operands: Vec<usize> = formula.operands(at).collect();
        if operands.len() != 1 {
            self.report.push(wrong_operand_count::wrong_operand_count(
                "not",
                1,
                operands.len(),
                node.place.0,
            ));
        }
        for &operand in &operands {
            match &formula.nodes[operand].kind {
                Ast::Atom(_) => self.literal(formula, operand, group, false, node.place.0),
                Ast::Unread(part) => {
                    self.bindings.unsure = true;
                    unread(self.world, part, self.report);
                }
                _ => {
                    self.bindings.unsure = true;
                    self.report.push(disjunctive_effect::disjunctive_effect("not", node.keyword.0));
                }
            }
        }
    }

    fn literal(
        &mut self,
        formula: &Formula<'a>,
        at: usize,
        group: usize,
        positive: bool,
        span: Span,
    ) {
        let node = &formula.nodes[at];
        let Ast::Atom(atom) = &node.kind else { return };
        let arguments = formula.arguments(atom);
        self.report.next(if positive { Role::Add } else { Role::Delete });
        let atom = self.bindings.atom(atom.name, arguments, node.place.0, self.world, self.report);
        if let Some(atom) = atom {
            self.drafts[group].literals.push(Literal { positive, atom, span });
        }
    }

    fn increase(&mut self, formula: &Formula<'a>, at: usize, group: usize) {
        let node = &formula.nodes[at];
        let Ast::Increase(target, amount) = &node.kind else { return };
        self.report.need(Need::Costs, node.keyword.0);
        let arguments = formula.arguments(target);
        self.report.next(Role::Write);
        let function =
            self.bindings.function(target.name, arguments, node.place.0, self.world, self.report);
        let value = match amount {
            Amount::Number(number) => {
                if let Some(value) = super::problem::number(number.text) {
                    Some(Expression::Number(value))
                } else {
                    self.report.push(unexpected_item::unexpected_item("a number", number.span));
                    None
                }
            }
            Amount::Function(function, place) => {
                let arguments = formula.arguments(function);
                let read = self.bindings.function(
                    function.name,
                    arguments,
                    place.0,
                    self.world,
                    self.report,
                );
                read.map(|(function, arguments)| Expression::Function(function, arguments))
            }
        };
        if let (Some((function, arguments)), Some(value)) = (function, value) {
            let condition = model::Formula::truth(node.place.0);
            let increase = Increase {
                variables: Vec::new(),
                condition,
                function,
                arguments,
                value,
                span: node.place.0,
            };
            self.increases.push((group, increase));
        }
    }

    /// All variables and all conditions that apply to a group, from the outside to the inside.
    fn context(&self, group: usize) -> (Vec<VariableId>, model::Formula) {
        let mut chain = Vec::new();
        let mut at = Some(group);
        while let Some(index) = at {
            chain.push(index);
            at = self.drafts[index].parent;
        }
        let mut variables = Vec::new();
        let mut conditions = Vec::new();
        for index in chain.into_iter().rev() {
            variables.extend_from_slice(&self.drafts[index].variables);
            conditions.extend(self.drafts[index].condition.clone());
        }
        (variables, condition::conjoin(conditions, self.drafts[group].span))
    }

    fn finish(mut self) -> (Vec<Effect>, Vec<Increase>) {
        let mut increases = Vec::new();
        for (group, mut increase) in std::mem::take(&mut self.increases) {
            (increase.variables, increase.condition) = self.context(group);
            increases.push(increase);
        }
        let mut effects = Vec::new();
        for group in 0..self.drafts.len() {
            let literals = std::mem::take(&mut self.drafts[group].literals);
            if literals.is_empty() {
                continue;
            }
            self.contradictions(&literals);
            let (variables, condition) = self.context(group);
            effects.push(Effect { variables, condition, literals, span: self.drafts[group].span });
        }
        (effects, increases)
    }

    /// Warns of atoms that a group both adds and deletes.
    fn contradictions(&mut self, literals: &[Literal]) {
        if literals.iter().all(|literal| literal.positive)
            || !literals.iter().any(|literal| literal.positive)
        {
            return;
        }
        let mut seen: HashMap<&Atom, &Literal> = HashMap::new();
        for literal in literals {
            match seen.get(&literal.atom) {
                Some(first) if first.positive != literal.positive => {
                    let atom = self.describe(&literal.atom);
                    let owner = self.bindings.owner.clone();
                    self.report.push(contradictory_effect::contradictory_effect(
                        &atom,
                        &owner,
                        literal.span,
                        first.span,
                    ));
                }
                Some(_) => {}
                None => {
                    seen.insert(&literal.atom, literal);
                }
            }
        }
    }

    fn describe(&self, atom: &Atom) -> String {
        let mut text =
            format!("({}", self.world.domain.predicates[atom.predicate.index()].name.text);
        for &argument in &atom.arguments {
            text.push(' ');
            text.push_str(match argument {
                model::Term::Variable(id) => &self.bindings.scope.variables[id.index()].name.text,
                model::Term::Object(id) => &self.world.objects[id.index()].name.text,
            });
        }
        text.push(')');
        text
    }
}
