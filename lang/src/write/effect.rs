//! Effects.

use super::Writer;
use super::variable::Variables;
use crate::model::{Action, Effect, Expression, Formula, Increase, VariableId};

impl Writer<'_> {
    /// Writes what an action does, with a blank before it.
    pub(super) fn effects(&mut self, action: &Action, variables: &mut Variables<'_>) {
        let plain = |effect: &&Effect| effect.variables.is_empty() && effect.condition.is_truth();
        let counted = action.effects.iter().map(|effect| {
            if plain(&effect) { effect.literals.len() } else { effect.literals.len().min(1) }
        });
        let single = counted.sum::<usize>() + action.increases.len() == 1;
        self.push(if single { "" } else { " (and" });
        for effect in action.effects.iter().filter(|effect| !effect.literals.is_empty()) {
            let closing = self.context(&effect.variables, &effect.condition, variables);
            self.literals(effect, !plain(&effect), variables);
            closing.end(self, variables);
        }
        for increase in &action.increases {
            let closing = self.context(&increase.variables, &increase.condition, variables);
            self.increase(increase, variables);
            closing.end(self, variables);
        }
        self.push(if single { "" } else { ")" });
    }

    /// What is added and deleted, as one effect if it must be.
    fn literals(&mut self, effect: &Effect, one: bool, variables: &Variables<'_>) {
        let together = one && effect.literals.len() > 1;
        self.push(if together { " (and" } else { "" });
        for literal in &effect.literals {
            let name = &self.domain.predicates[literal.atom.predicate.index()].name.text;
            self.push(if literal.positive { " " } else { " (not " });
            self.apply(name, &literal.atom.arguments, variables);
            self.push(if literal.positive { "" } else { ")" });
        }
        self.push(if together { ")" } else { "" });
    }

    fn increase(&mut self, increase: &Increase, variables: &Variables<'_>) {
        let functions = &self.domain.functions;
        self.push(" (increase ");
        let name = &functions[increase.function.index()].name.text;
        self.apply(name, &increase.arguments, variables);
        self.push(" ");
        match &increase.value {
            Expression::Number(number) => self.push(&number.to_string()),
            Expression::Function(function, arguments) => {
                let name = &functions[function.index()].name.text;
                self.apply(name, arguments, variables);
            }
        }
        self.push(")");
    }

    /// `(forall (VARIABLES) (when CONDITION`, each where it is needed.
    fn context(
        &mut self,
        ids: &[VariableId],
        condition: &Formula,
        variables: &mut Variables<'_>,
    ) -> Context {
        let hidden = (!ids.is_empty()).then(|| {
            self.push(" ");
            self.quantifier("forall", ids, variables)
        });
        let conditional = !condition.is_truth();
        if conditional {
            self.push(" (when");
            self.condition(condition, variables);
        }
        Context { hidden, conditional }
    }
}

/// What stands around an effect and must end after it.
struct Context {
    hidden: Option<super::variable::Hidden>,
    conditional: bool,
}

impl Context {
    fn end(self, writer: &mut Writer<'_>, variables: &mut Variables<'_>) {
        writer.push(if self.conditional { ")" } else { "" });
        if let Some(hidden) = self.hidden {
            variables.release(hidden);
            writer.push(")");
        }
    }
}
