//! Effects, taken apart into groups of literals under one condition.

use hashbrown::HashMap;

use super::condition::Setting;
use super::record::Reading;
use super::requirement::Need;
use super::scope::{Bindings, Callee, Hidden};
use super::value::{self, Value};
use super::{Report, World, condition, scope};
use crate::ast::{
    ActionKind, Application, Connective, Feature, Formula, NodeKind as Ast, Operator, Quantifier,
    Time,
};
use crate::diagnostic::{
    contradictory_effect, disjunctive_effect, misplaced_time_specifier, missing_time_specifier,
    unexpected_item, wrong_operand_count, wrong_value,
};
use crate::model::{self, Atom, Effect, FunctionId, Increase, Literal, Term, VariableId};
use crate::source::Span;
use crate::symbol::Role;

/// A group while its literals are gathered. Its `forall`s and `when`s add to those of the group around it.
struct Draft {
    parent: Option<usize>,
    variables: Vec<VariableId>,
    condition: Option<model::Formula>,
    literals: Vec<Literal>,
    /// When it happens in a durative action; none where the group around it says so.
    time: Option<Time>,
    span: Span,
}

/// A node whose operands are being read.
struct Frame<'a> {
    end: u32,
    group: usize,
    hidden: Hidden<'a>,
    /// Whether it stands at a point in time.
    timed: bool,
}

/// The effects of an action while they are taken apart.
struct Effects<'c, 'w, 'd, 'a> {
    drafts: Vec<Draft>,
    increases: Vec<(usize, Increase)>,
    kind: ActionKind,
    /// Whether it has been said that an effect has no time specifier.
    untimed: bool,
    /// Whether some effect has one.
    some_timed: bool,
    bindings: &'c mut Bindings<'a>,
    world: &'c World<'w, 'a>,
    report: &'c mut Report<'d>,
}

/// Checks the effects of an action.
pub(super) fn check<'a>(
    formulas: &[Formula<'a>],
    kind: ActionKind,
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
        time: None,
        span: whole,
    };
    let nodes = formulas.iter().flat_map(|formula| &formula.nodes);
    let some_timed = nodes.into_iter().any(|node| matches!(node.kind, Ast::Timed(_)));
    let mut effects = Effects {
        drafts: vec![outermost],
        increases: Vec::new(),
        kind,
        untimed: false,
        some_timed,
        bindings,
        world,
        report,
    };
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
            let timed = open.last().is_some_and(|frame| frame.timed);
            let node = &formula.nodes[at as usize];
            let (span, end) = (node.place.0, node.next);
            let frame = |group, hidden, timed| Frame { end, group, hidden, timed };
            at = match &node.kind {
                Ast::Connective(Connective::And) => {
                    open.push(frame(group, Vec::new(), timed));
                    at + 1
                }
                Ast::Timed(time) => {
                    let group = self.timed(*time, node.keyword.0, span, group, timed);
                    open.push(frame(group, Vec::new(), true));
                    at + 1
                }
                Ast::Connective(Connective::When) => {
                    match self.when(formula, at as usize, group, timed) {
                        Some(first) => {
                            open.push(frame(self.drafts.len() - 1, Vec::new(), timed));
                            first
                        }
                        None => end,
                    }
                }
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
                    self.draft(group, variables, None, span);
                    open.push(frame(self.drafts.len() - 1, hidden, timed));
                    at + 1
                }
                _ => {
                    self.leaf(formula, at as usize, group, timed);
                    end
                }
            };
        }
        self.close(&mut open, formula.nodes.len() as u32);
    }

    /// Opens a group within another.
    fn draft(
        &mut self,
        parent: usize,
        variables: Vec<VariableId>,
        condition: Option<model::Formula>,
        span: Span,
    ) {
        let literals = Vec::new();
        self.drafts.push(Draft {
            parent: Some(parent),
            variables,
            condition,
            literals,
            time: None,
            span,
        });
    }

    /// The group of what happens at a point in time.
    fn timed(
        &mut self,
        time: Time,
        keyword: Span,
        span: Span,
        group: usize,
        inside: bool,
    ) -> usize {
        if self.kind != ActionKind::Durative || time == Time::OverAll || inside {
            self.report.push(misplaced_time_specifier::in_effect(
                time.words(),
                &self.bindings.owner,
                self.kind == ActionKind::Durative,
                keyword,
            ));
        }
        let same = |draft: &Draft| draft.parent == Some(group) && draft.time == Some(time);
        if let Some(found) = self.drafts.iter().position(same) {
            return found;
        }
        self.draft(group, Vec::new(), None, span);
        let found = self.drafts.len() - 1;
        self.drafts[found].time = Some(time);
        found
    }

    /// Reports an effect of a durative action that does not say when it happens.
    fn demand_time(&mut self, span: Span, timed: bool) {
        if self.kind != ActionKind::Durative || timed {
            return;
        }
        // Where no effect says when it happens, that is one mistake.
        if self.some_timed || !self.untimed {
            self.untimed = true;
            self.report.push(missing_time_specifier::in_effect(&self.bindings.owner, span));
        }
    }

    /// An effect that has no effects in it.
    fn leaf(&mut self, formula: &Formula<'a>, at: usize, group: usize, timed: bool) {
        let node = &formula.nodes[at];
        let span = node.place.0;
        match &node.kind {
            Ast::Connective(Connective::Not) => {
                self.demand_time(span, timed);
                self.delete(formula, at, group);
            }
            Ast::Apply(Application { name, .. }) | Ast::Nested(name) => {
                if self.world.names.predicates.find(name.text).is_some() {
                    self.demand_time(span, timed);
                }
                self.literal(formula, at, group, true, span);
            }
            Ast::Operator(operator) if operator.changes() => {
                self.change(*operator, formula, at, group, timed);
            }
            Ast::Unread(part) => {
                self.bindings.unsure = true;
                self.report.uses(part.feature, part.keyword.span);
            }
            kind => {
                let word = match kind {
                    Ast::Connective(connective) => connective.word(),
                    Ast::Quantifier(quantifier, _) => quantifier.word(),
                    Ast::Operator(operator) => operator.word(),
                    Ast::Preference(_) => "preference",
                    Ast::Trajectory(modality, _) => modality.word(),
                    _ => return,
                };
                self.bindings.unsure = true;
                self.report.push(disjunctive_effect::disjunctive_effect(word, node.keyword.0));
            }
        }
    }

    fn close(&mut self, open: &mut Vec<Frame<'a>>, at: u32) {
        while let Some(frame) = open.pop_if(|frame| frame.end <= at) {
            self.bindings.restore(frame.hidden);
        }
    }

    /// Opens a group for `(when CONDITION EFFECT)` and returns the node of the effect.
    fn when(
        &mut self,
        formula: &Formula<'a>,
        at: usize,
        parent: usize,
        timed: bool,
    ) -> Option<u32> {
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
        // Within one point in time, that is when the condition is looked at.
        let durative = self.kind == ActionKind::Durative && !timed;
        let setting = if durative { Setting::Durative } else { Setting::State };
        let condition =
            condition::check(formula, demand, setting, self.bindings, self.world, self.report);
        self.draft(parent, Vec::new(), Some(condition), node.place.0);
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
                Ast::Apply(_) | Ast::Nested(_) => {
                    self.literal(formula, operand, group, false, node.place.0);
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
        let place = node.place.0;
        self.report.next(if positive { Role::Add } else { Role::Delete });
        match &node.kind {
            Ast::Apply(atom) => {
                let arguments = formula.arguments(atom);
                let atom = self.bindings.atom(atom.name, arguments, place, self.world, self.report);
                if let Some(atom) = atom {
                    self.drafts[group].literals.push(Literal { positive, atom, span });
                }
            }
            Ast::Nested(name) => {
                let Some(predicate) = scope::predicate(*name, self.world, self.report) else {
                    self.bindings.unsure = true;
                    return;
                };
                let callee = Callee::predicate(predicate, self.world);
                let values = value::operands(formula, at, self.bindings, self.world, self.report);
                value::arguments(&callee, &values, place, self.world, self.report);
            }
            _ => {}
        }
    }

    /// `(increase FUNCTION VALUE)` and the other effects on functions.
    fn change(
        &mut self,
        operator: Operator,
        formula: &Formula<'a>,
        at: usize,
        group: usize,
        timed: bool,
    ) {
        let node = &formula.nodes[at];
        let (keyword, span) = (node.keyword.0, node.place.0);
        let operands: Vec<usize> = formula.operands(at).collect();
        let &[target, amount] = operands.as_slice() else {
            let given = operands.len();
            let word = operator.word();
            self.report.push(wrong_operand_count::wrong_operand_count(word, 2, given, span));
            self.bindings.unsure = true;
            return;
        };
        let flows = formula.nodes[amount..node.next as usize]
            .iter()
            .any(|node| matches!(node.kind, Ast::Word(word) if word.is("#t")));
        if !flows {
            self.demand_time(span, timed);
        }
        let target = self.target(formula, target, operator);
        self.report.reading = match operator {
            Operator::Increase => Reading::Beside,
            _ => Reading::Asked,
        };
        let value = value::check(formula, amount, self.bindings, self.world, self.report);
        self.report.reading = Reading::Beside;
        let place = formula.nodes[amount].place.0;
        let Some((function, arguments)) = target else { return };
        if let Some(types) = &self.world.domain.functions[function.index()].values {
            return self.assign(operator, types, &value, keyword, place);
        }
        let wanted = format!("`{}`", operator.word());
        value::number(&value, place, &wanted, self.world, self.report);
        if operator == Operator::Assign {
            self.report.assigned.insert(function);
        }
        match (operator, value, arguments) {
            (_, Value::Unknown, _) => {}
            (Operator::Increase, Value::Number(Some(value)), Some(arguments))
                if self.kind == ActionKind::Instant =>
            {
                self.report.need(Need::Costs, keyword);
                let increase = Increase {
                    variables: Vec::new(),
                    condition: model::Formula::truth(span),
                    function,
                    arguments,
                    value,
                    span,
                };
                self.increases.push((group, increase));
            }
            _ => {
                self.report.need(Need::NumericEffect, keyword);
                self.report.uses(Feature::NumericEffects, keyword);
            }
        }
    }

    /// The function that an effect changes, with its arguments if they are words.
    fn target(
        &mut self,
        formula: &Formula<'a>,
        at: usize,
        operator: Operator,
    ) -> Option<(FunctionId, Option<Vec<Term>>)> {
        let node = &formula.nodes[at];
        let span = node.place.0;
        self.report.next(Role::Write);
        let (name, arguments) = match &node.kind {
            Ast::Apply(application) => (application.name, formula.arguments(application)),
            Ast::Word(name) if !name.is_variable() => (*name, &[][..]),
            Ast::Nested(name) => {
                let function = scope::function(*name, self.world, self.report);
                let values = value::operands(formula, at, self.bindings, self.world, self.report);
                let callee = Callee::function(function?, self.world);
                value::arguments(&callee, &values, span, self.world, self.report);
                return Some((function?, None));
            }
            _ => {
                self.bindings.unsure = true;
                let expected = format!("a function after `{}`", operator.word());
                self.report.push(unexpected_item::unexpected_item(&expected, span));
                return None;
            }
        };
        let (function, terms) =
            self.bindings.function(name, arguments, span, self.world, self.report)?;
        Some((function, Some(terms)))
    }

    /// An effect on a function that has objects as values.
    fn assign(
        &mut self,
        operator: Operator,
        types: &[model::TypeId],
        value: &Value,
        keyword: Span,
        place: Span,
    ) {
        self.report.need(Need::ObjectFluent, keyword);
        self.report.uses(Feature::ObjectFluents, keyword);
        let wanted = self.world.describe_types(types);
        match value {
            _ if operator != Operator::Assign => {
                let wanted = format!("`{}`", operator.word());
                self.report.push(wrong_value::object(
                    &self.world.describe_types(types),
                    &wanted,
                    keyword,
                ));
            }
            Value::Number(_) => {
                self.report.push(wrong_value::assigned(&wanted, "number", place));
            }
            Value::Object(have, term)
                if !self.world.fits(have, matches!(term, Some(Term::Object(_))), types) =>
            {
                let have = self.world.describe_types(have);
                self.report.push(wrong_value::assigned(&wanted, &have, place));
            }
            _ => {}
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
        if self.bindings.doubled
            || literals.iter().all(|literal| literal.positive)
            || !literals.iter().any(|literal| literal.positive)
        {
            return;
        }
        let mut seen: HashMap<&Atom, &Literal> = HashMap::new();
        for literal in literals {
            match seen.get(&literal.atom) {
                Some(first) if first.positive != literal.positive => {
                    if self.holds(&literal.atom) {
                        continue;
                    }
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

    /// Whether an action takes what it demands and gives it back, and so keeps other agents from it for as long as it lasts:
    /// no other part of a joint action may add or delete the same.
    fn holds(&self, atom: &Atom) -> bool {
        let own = Term::Variable(VariableId(0));
        self.bindings.demanded.contains(atom) && !atom.arguments.contains(&own)
    }

    fn describe(&self, atom: &Atom) -> String {
        let mut text =
            format!("({}", self.world.domain.predicates[atom.predicate.index()].name.text);
        for &argument in &atom.arguments {
            text.push(' ');
            text.push_str(match argument {
                Term::Variable(id) => &self.bindings.scope.variables[id.index()].name.text,
                Term::Object(id) => &self.world.objects[id.index()].name.text,
            });
        }
        text.push(')');
        text
    }
}
