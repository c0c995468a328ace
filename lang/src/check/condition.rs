//! Conditions: preconditions, goals, bodies of axioms, what `when` demands, and constraints on the whole plan.

use super::requirement::Need;
use super::scope::{Bindings, Callee, Hidden};
use super::{Report, World, agents, value};
use crate::ast::{
    Application, Connective, Feature, Formula, Modality, NodeKind as Ast, Quantifier, Time,
};
use crate::diagnostic::{
    misplaced_modality, misplaced_time_specifier, missing_time_specifier, unexpected_item,
    when_in_condition, wrong_operand_count,
};
use crate::model::{self, Node, NodeId, NodeKind, VariableId};
use crate::source::Span;

/// What a condition is about.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Setting {
    /// One state.
    State,
    /// Several points in time of a durative action: each part says which.
    Durative,
    /// The whole plan.
    Plan,
}

/// A node whose operands are being checked.
struct Frame<'a> {
    kind: Kind<'a>,
    children: Vec<NodeId>,
    /// The node of the formula after its last operand.
    end: u32,
    span: Span,
}

enum Kind<'a> {
    Connective(Connective),
    Quantifier(Quantifier, Vec<VariableId>, Hidden<'a>),
    Timed(Time),
    Preference,
    Trajectory(Modality),
}

/// Checks the node `root` of `formula` and what is in it.
pub(super) fn check<'a>(
    formula: &Formula<'a>,
    root: usize,
    setting: Setting,
    bindings: &mut Bindings<'a>,
    world: &World<'_, 'a>,
    report: &mut Report<'_>,
) -> model::Formula {
    let end = formula.nodes[root].next;
    let nodes = &formula.nodes[root..end as usize];
    let some_timed = nodes.iter().any(|node| matches!(node.kind, Ast::Timed(_)));
    let mut condition = Condition {
        nodes: Vec::new(),
        open: Vec::new(),
        setting,
        timed: 0,
        untimed: false,
        some_timed,
        bindings,
        world,
        report,
    };
    let mut at = root as u32;
    loop {
        while let Some(frame) = condition.open.pop_if(|frame| frame.end == at) {
            let id = condition.finish(frame);
            condition.give(id);
        }
        if at >= end {
            break;
        }
        let node = &formula.nodes[at as usize];
        let span = node.place.0;
        if let Some(kind) = condition.opens(formula, at as usize) {
            condition.open.push(Frame { kind, children: Vec::new(), end: node.next, span });
            at += 1;
        } else {
            let id = condition.leaf(formula, at as usize);
            condition.give(id);
            at = node.next;
        }
    }
    model::Formula { nodes: condition.nodes }
}

/// Both must hold.
pub(crate) fn conjoin(parts: Vec<model::Formula>, span: Span) -> model::Formula {
    let mut parts: Vec<_> = parts.into_iter().filter(|part| !part.is_truth()).collect();
    if parts.len() <= 1 {
        return parts.pop().unwrap_or_else(|| model::Formula::truth(span));
    }
    let mut nodes: Vec<Node> = Vec::new();
    let mut roots = Vec::new();
    for part in parts {
        let offset = nodes.len() as u32;
        let shift = |id: &mut NodeId| id.0 += offset;
        for mut node in part.nodes {
            match &mut node.kind {
                NodeKind::Atom(_) | NodeKind::Equal(..) | NodeKind::Action(_) => {}
                NodeKind::Not(child) | NodeKind::Forall(_, child) | NodeKind::Exists(_, child) => {
                    shift(child);
                }
                NodeKind::And(children) | NodeKind::Or(children) => {
                    children.iter_mut().for_each(shift);
                }
                NodeKind::Imply(left, right) => {
                    shift(left);
                    shift(right);
                }
            }
            nodes.push(node);
        }
        roots.push(NodeId(nodes.len() as u32 - 1));
    }
    nodes.push(Node { kind: NodeKind::And(roots), span });
    model::Formula { nodes }
}

/// A condition while it is built.
struct Condition<'c, 'w, 'd, 'a> {
    nodes: Vec<Node>,
    open: Vec<Frame<'a>>,
    setting: Setting,
    /// How many of the open nodes are time specifiers.
    timed: usize,
    /// Whether it has been said that a part has no time specifier.
    untimed: bool,
    /// Whether some part has one.
    some_timed: bool,
    bindings: &'c mut Bindings<'a>,
    world: &'c World<'w, 'a>,
    report: &'c mut Report<'d>,
}

impl<'a> Condition<'_, '_, '_, 'a> {
    fn push(&mut self, kind: NodeKind, span: Span) -> NodeId {
        self.nodes.push(Node { kind, span });
        NodeId(self.nodes.len() as u32 - 1)
    }

    /// Makes a node an operand of the innermost open one.
    fn give(&mut self, id: NodeId) {
        if let Some(parent) = self.open.last_mut() {
            parent.children.push(id);
        }
    }

    /// What stands for a part that has been reported as wrong, or that the model does not hold.
    fn truth(&mut self, span: Span) -> NodeId {
        self.push(NodeKind::And(Vec::new()), span)
    }

    /// A node that has conditions as operands.
    fn opens(&mut self, formula: &Formula<'a>, at: usize) -> Option<Kind<'a>> {
        let node = &formula.nodes[at];
        let keyword = node.keyword.0;
        match &node.kind {
            Ast::Connective(Connective::When) => None,
            Ast::Connective(connective) => {
                self.need(formula, at, *connective);
                Some(Kind::Connective(*connective))
            }
            Ast::Quantifier(quantifier, list) => {
                // Every goal, preference or constraint of a plan may be quantified.
                if self.setting != Setting::Plan {
                    let need = match quantifier {
                        Quantifier::Forall => Need::Forall,
                        Quantifier::Exists => Need::Exists,
                    };
                    self.report.need(need, keyword);
                }
                let (variables, hidden) = self.bindings.bind(list, self.world, self.report);
                Some(Kind::Quantifier(*quantifier, variables, hidden))
            }
            Ast::Timed(time) => {
                self.timed(*time, keyword);
                self.timed += 1;
                Some(Kind::Timed(*time))
            }
            Ast::Preference(name) => {
                self.report.need(Need::Preference, keyword);
                self.report.uses(Feature::Preferences, keyword);
                if let Some(name) = name {
                    self.report.prefers(*name);
                }
                Some(Kind::Preference)
            }
            Ast::Trajectory(modality, times) => {
                if self.setting != Setting::Plan {
                    let word = modality.word();
                    self.report.push(misplaced_modality::misplaced_modality(word, keyword));
                }
                self.report.need(Need::Constraint, keyword);
                self.report.uses(Feature::Constraints, keyword);
                let (wanted, _) = modality.operands();
                let numbers = times.iter().filter(|time| crate::syntax::is_number(time.text));
                if numbers.count() != wanted {
                    let what = if wanted == 1 { "a point in time" } else { "two points in time" };
                    let expected = format!("{what} after `{}`", modality.word());
                    let span = times.first().map_or(keyword, |time| time.span);
                    self.report.push(unexpected_item::unexpected_item(&expected, span));
                }
                Some(Kind::Trajectory(*modality))
            }
            _ => None,
        }
    }

    /// A time specifier, which has its place in durative actions; the end of a plan is one too.
    fn timed(&mut self, time: Time, keyword: Span) {
        let inside = self.timed > 0;
        let allowed = match self.setting {
            Setting::State => false,
            Setting::Durative => !inside,
            Setting::Plan => time == Time::AtEnd && !inside,
        };
        if !allowed {
            let diagnostic = misplaced_time_specifier::in_condition(
                time.words(),
                &self.bindings.owner,
                inside,
                keyword,
            );
            self.report.push(diagnostic);
        }
    }

    /// The requirement that a connective needs.
    fn need(&mut self, formula: &Formula<'a>, at: usize, connective: Connective) {
        let need = match connective {
            Connective::And | Connective::When => return,
            Connective::Or | Connective::Imply => Need::Disjunction,
            Connective::Not => match formula.nodes.get(at + 1).map(|node| &node.kind) {
                Some(Ast::Apply(_) | Ast::Nested(_)) => Need::Negation,
                Some(Ast::Connective(_)) => Need::Disjunction,
                _ => return,
            },
        };
        self.report.need(need, formula.nodes[at].keyword.0);
    }

    /// Reports a part of the condition of a durative action that does not say when it holds.
    fn demand_time(&mut self, span: Span) {
        if self.setting != Setting::Durative || self.timed > 0 {
            return;
        }
        // Where no part says when it holds, that is one mistake.
        if self.some_timed || !self.untimed {
            self.untimed = true;
            let negated = self
                .open
                .last()
                .filter(|frame| matches!(frame.kind, Kind::Connective(Connective::Not)));
            let span = negated.map_or(span, |frame| frame.span);
            self.report.push(missing_time_specifier::in_condition(&self.bindings.owner, span));
        }
    }

    /// A node that has no conditions as operands.
    fn leaf(&mut self, formula: &Formula<'a>, at: usize) -> NodeId {
        let node = &formula.nodes[at];
        let span = node.place.0;
        // What cannot be understood is one mistake, whenever it should hold.
        let understood = match &node.kind {
            Ast::Apply(Application { name, .. }) | Ast::Nested(name) => {
                let names = self.world.names;
                names.predicates.find(name.text).or(names.actions.find(name.text)).is_some()
            }
            kind => !matches!(kind, Ast::Unread(_) | Ast::Connective(_)),
        };
        if understood {
            self.demand_time(span);
        }
        let kind = match &node.kind {
            Ast::Apply(application) => {
                let arguments = formula.arguments(application);
                if agents::is_action_atom(application.name, arguments.len(), self.world) {
                    agents::action_atom(
                        application.name,
                        arguments,
                        span,
                        self.bindings,
                        self.world,
                        self.report,
                    )
                    .map(NodeKind::Action)
                } else {
                    self.bindings
                        .atom(application.name, arguments, span, self.world, self.report)
                        .map(NodeKind::Atom)
                }
            }
            Ast::Nested(name) => {
                self.nested(*name, formula, at);
                None
            }
            Ast::Operator(operator) if operator.compares() => {
                value::comparison(*operator, formula, at, self.bindings, self.world, self.report)
                    .map(|(left, right)| NodeKind::Equal(left, right))
            }
            Ast::Operator(operator) => {
                self.bindings.unsure = true;
                let what = if operator.changes() { "is an effect" } else { "makes a number" };
                self.report.push(unexpected_item::unexpected_item(
                    &format!("a condition; `{}` {what}", operator.word()),
                    node.keyword.0,
                ));
                None
            }
            Ast::Connective(_) => {
                self.report.push(when_in_condition::when_in_condition(node.keyword.0));
                self.bindings.unsure = true;
                None
            }
            Ast::Unread(part) => {
                self.bindings.unsure = true;
                self.report.uses(part.feature, part.keyword.span);
                None
            }
            Ast::Word(_)
            | Ast::Quantifier(..)
            | Ast::Timed(_)
            | Ast::Preference(_)
            | Ast::Trajectory(..) => None,
        };
        match kind {
            Some(kind) => self.push(kind, span),
            None => self.truth(span),
        }
    }

    /// A predicate with values of functions among its arguments.
    fn nested(&mut self, name: crate::ast::Name<'a>, formula: &Formula<'a>, at: usize) {
        let node = &formula.nodes[at];
        let Some(predicate) = super::scope::predicate(name, self.world, self.report) else {
            self.bindings.unsure = true;
            return;
        };
        let values = value::operands(formula, at, self.bindings, self.world, self.report);
        let callee = Callee::predicate(predicate, self.world);
        value::arguments(&callee, &values, node.place.0, self.world, self.report);
    }

    /// Puts a node together from its operands.
    fn finish(&mut self, frame: Frame<'a>) -> NodeId {
        let Frame { kind, mut children, span, .. } = frame;
        self.timed -= usize::from(matches!(kind, Kind::Timed(_)));
        let given = children.len();
        let (word, before, expected) = match &kind {
            Kind::Connective(connective) => {
                let expected = match connective {
                    Connective::Not => Some(1),
                    Connective::Imply => Some(2),
                    _ => None,
                };
                (connective.word(), 0, expected)
            }
            // A quantifier's list of variables counts as an operand for the reader.
            Kind::Quantifier(quantifier, ..) => (quantifier.word(), 1, Some(1)),
            Kind::Timed(time) => (time.words(), 0, Some(1)),
            Kind::Preference => ("preference", 0, Some(1)),
            Kind::Trajectory(modality) => {
                let (times, conditions) = modality.operands();
                (modality.word(), times, Some(conditions))
            }
        };
        if let Some(expected) = expected.filter(|&expected| expected != given) {
            self.report.push(wrong_operand_count::wrong_operand_count(
                word,
                expected + before,
                given + before,
                span,
            ));
        }
        match (kind, children.as_slice()) {
            (Kind::Quantifier(quantifier, variables, hidden), _) => {
                self.bindings.restore(hidden);
                let body = match children.pop() {
                    Some(body) if given == 1 => body,
                    _ => return self.truth(span),
                };
                let kind = match quantifier {
                    Quantifier::Forall => NodeKind::Forall(variables, body),
                    Quantifier::Exists => NodeKind::Exists(variables, body),
                };
                self.push(kind, span)
            }
            (Kind::Connective(Connective::And | Connective::Or), &[only]) => only,
            (Kind::Connective(Connective::And), _) => self.push(NodeKind::And(children), span),
            (Kind::Connective(Connective::Or), _) => self.push(NodeKind::Or(children), span),
            (Kind::Connective(Connective::Not), &[child]) => self.push(NodeKind::Not(child), span),
            (Kind::Connective(Connective::Imply), &[left, right]) => {
                self.push(NodeKind::Imply(left, right), span)
            }
            // What has been reported is not in the model, and neither is what cannot be run: what is only preferred, and what holds at other times.
            (Kind::Connective(_) | Kind::Timed(_) | Kind::Preference | Kind::Trajectory(_), _) => {
                self.truth(span)
            }
        }
    }
}
