//! Formulas in negation normal form to conjunctions: splits disjunctions into schemas and rules, or hides them behind auxiliary derived predicates.

use lang::model::{self, ActionId, PredicateId, Problem, Scope};

use super::formula::{self, Nnf, free, free_of_all, negate};
use crate::normal::{
    Atom, Condition, Cost, Effect, Filter, Kind, Literal, Predicate, Rule, Schema, Term, Universal,
    Variable,
};

/// How many conjunctions one condition may become before its disjunctions are hidden behind derived predicates.
const MOST_DISJUNCTS: usize = 64;

/// A conjunction in the variables of the scope it stems from, with the variables that existential quantifiers bind.
#[derive(Debug, Clone, Default)]
struct Conjunction {
    exists: Vec<u32>,
    condition: Condition,
}

/// Collects auxiliary predicates and rules while conditions are split.
pub struct Builder {
    /// The domain's predicates, then the auxiliary ones.
    pub predicates: Vec<Predicate>,
    /// The axioms found so far.
    pub rules: Vec<Rule>,
}

impl Builder {
    /// A builder that knows the domain's own predicates.
    pub fn new(predicates: Vec<Predicate>) -> Self {
        Self { predicates, rules: Vec::new() }
    }

    /// Adds the schemas of `action`, one for each conjunction of its precondition.
    pub fn schemas(
        &mut self,
        id: ActionId,
        action: &model::Action,
        costs: &[Cost],
        schemas: &mut Vec<Schema>,
    ) {
        let precondition = formula::nnf(&action.precondition, &self.predicates);
        let mut effects = Vec::new();
        for effect in &action.effects {
            let condition = formula::nnf(&effect.condition, &self.predicates);
            let outer: Vec<u32> = effect.variables.iter().map(|variable| variable.0).collect();
            for conjunction in self.split(&condition, &action.scope) {
                for literal in &effect.literals {
                    let mut variables = outer.clone();
                    variables.extend(&conjunction.exists);
                    let literal =
                        Literal { positive: literal.positive, atom: formula::atom(&literal.atom) };
                    effects.push(Effect {
                        variables,
                        condition: conjunction.condition.clone(),
                        literal,
                    });
                }
            }
        }
        for conjunction in self.split(&precondition, &action.scope) {
            let numbering = Numbering::new(&action.scope, &conjunction.exists);
            schemas.push(Schema {
                action: id,
                variables: numbering.variables(),
                parameters: action.scope.parameters as usize,
                bound: action.scope.parameters as usize + conjunction.exists.len(),
                condition: numbering.condition(conjunction.condition),
                effects: effects.iter().cloned().map(|effect| numbering.effect(effect)).collect(),
                costs: costs.iter().cloned().map(|cost| numbering.cost(cost)).collect(),
            });
        }
    }

    /// Adds the rules of an axiom of the domain.
    pub fn axiom(&mut self, axiom: &model::Axiom) {
        let body = formula::nnf(&axiom.body, &self.predicates);
        let arguments = (0..axiom.scope.parameters).map(Term::Variable).collect();
        let body = self.split(&body, &axiom.scope);
        self.derive(&Atom { predicate: axiom.head, arguments }, body, &axiom.scope);
    }

    /// The goal as a conjunction without existential variables.
    pub fn goal(&mut self, problem: &Problem) -> (Condition, Vec<Variable>) {
        let scope = &problem.goal_scope;
        let goal = formula::nnf(&problem.goal, &self.predicates);
        let mut conjunctions = self.split(&goal, scope);
        let conjunction = if conjunctions.len() == 1 && conjunctions[0].exists.is_empty() {
            conjunctions.pop().expect("there is one")
        } else {
            let literal = self.hide(conjunctions, &free(&goal), scope, "goal");
            let condition = Condition { literals: vec![literal], ..Condition::default() };
            Conjunction { condition, ..Conjunction::default() }
        };
        let numbering = Numbering::new(scope, &[]);
        (numbering.condition(conjunction.condition), numbering.variables())
    }

    /// Adds the rules that derive `head` wherever one of the conjunctions holds.
    fn derive(&mut self, head: &Atom, body: Vec<Conjunction>, scope: &Scope) {
        for conjunction in body {
            let outer: Vec<u32> = head
                .arguments
                .iter()
                .filter_map(|term| match term {
                    Term::Variable(variable) => Some(*variable),
                    Term::Object(_) => None,
                })
                .collect();
            let numbering = Numbering::with_outer(scope, &outer, &conjunction.exists);
            self.rules.push(Rule {
                variables: numbering.variables(),
                bound: outer.len() + conjunction.exists.len(),
                head: numbering.atom(head.clone()),
                condition: numbering.condition(conjunction.condition),
            });
        }
    }

    /// A new derived predicate that holds wherever one of the conjunctions does, applied to the variables that are `free` in them.
    fn hide(&mut self, body: Vec<Conjunction>, free: &[u32], scope: &Scope, what: &str) -> Literal {
        let arguments: Vec<Term> = free.iter().copied().map(Term::Variable).collect();
        let predicate = PredicateId(self.predicates.len() as u32);
        // The `@` cannot stand in a name of PDDL files that the lexer accepts as one word, so no domain has this name.
        let name = format!("{what}@{}", predicate.0);
        self.predicates.push(Predicate { name, arity: arguments.len(), kind: Kind::Derived });
        let head = Atom { predicate, arguments };
        self.derive(&head, body, scope);
        Literal { positive: true, atom: head }
    }

    /// The conjunctions whose disjunction `formula` is.
    fn split(&mut self, formula: &Nnf, scope: &Scope) -> Vec<Conjunction> {
        let alone = |condition| vec![Conjunction { condition, ..Conjunction::default() }];
        match formula {
            Nnf::Filter(filter) => alone(static_condition(filter.clone())),
            Nnf::Literal(literal) => {
                alone(Condition { literals: vec![literal.clone()], ..Condition::default() })
            }
            Nnf::Exists(bound, child) => {
                let mut conjunctions = self.split(child, scope);
                for conjunction in &mut conjunctions {
                    conjunction.exists.splice(0..0, bound.iter().copied());
                }
                conjunctions
            }
            Nnf::Any(children) => self.split_any(children, scope),
            Nnf::All(children) => self.split_all(children, scope),
            Nnf::Forall(bound, child) => {
                let universal = self.universal(bound.clone(), child, scope);
                alone(Condition { universals: vec![universal], ..Condition::default() })
            }
        }
    }

    /// A disjunction. Where its static part holds nothing else is asked, so the other disjuncts are for where it does not:
    /// no instance is made twice for the same reason.
    fn split_any(&mut self, children: &[Nnf], scope: &Scope) -> Vec<Conjunction> {
        let mut conjunctions = Vec::new();
        let mut otherwise = None;
        for child in children {
            if let Nnf::Filter(filter) = child {
                otherwise = Some(static_condition(negate(filter.clone())));
                conjunctions.extend(self.split(child, scope));
                continue;
            }
            for mut conjunction in self.split(child, scope) {
                if let Some(condition) = &otherwise {
                    merge(&mut conjunction.condition, condition.clone());
                }
                conjunctions.push(conjunction);
            }
        }
        conjunctions
    }

    /// A conjunction: the product of what its children split into, with the largest disjunctions hidden where that would be too many.
    fn split_all(&mut self, children: &[Nnf], scope: &Scope) -> Vec<Conjunction> {
        let mut parts: Vec<(&Nnf, Vec<Conjunction>)> = Vec::with_capacity(children.len());
        for child in children {
            parts.push((child, self.split(child, scope)));
        }
        let product = |parts: &[(&Nnf, Vec<Conjunction>)]| {
            parts.iter().fold(1_usize, |product, (_, conjunctions)| {
                product.saturating_mul(conjunctions.len().max(1))
            })
        };
        while product(&parts) > MOST_DISJUNCTS {
            let (_, largest) = parts
                .iter()
                .enumerate()
                .map(|(index, (_, conjunctions))| (conjunctions.len(), usize::MAX - index))
                .max()
                .expect("a product above one has parts");
            let (formula, conjunctions) = &mut parts[usize::MAX - largest];
            let literal = self.hide(std::mem::take(conjunctions), &free(formula), scope, "any");
            let condition = Condition { literals: vec![literal], ..Condition::default() };
            conjunctions.push(Conjunction { condition, ..Conjunction::default() });
        }
        // What does not split stands in every conjunction; it is gathered once, since goals may have thousands of parts.
        let mut shared = Conjunction::default();
        let mut choices = Vec::new();
        for (_, mut conjunctions) in parts {
            if conjunctions.len() == 1 {
                join(&mut shared, conjunctions.pop().expect("it has one conjunction"));
            } else {
                choices.push(conjunctions);
            }
        }
        let mut product = vec![shared];
        for conjunctions in choices {
            let mut next = Vec::with_capacity(product.len() * conjunctions.len());
            for left in &product {
                for right in &conjunctions {
                    let mut both = left.clone();
                    join(&mut both, right.clone());
                    next.push(both);
                }
            }
            product = next;
        }
        product
    }

    /// A universal condition over facts: literals under a static guard, or an auxiliary predicate for all bindings.
    fn universal(&mut self, variables: Vec<u32>, child: &Nnf, scope: &Scope) -> Universal {
        let (guard, rest) = match child {
            Nnf::Any(children) => match children.split_first() {
                Some((Nnf::Filter(filter), rest)) => (negate(filter.clone()), rest),
                _ => (Filter::All(Vec::new()), children.as_slice()),
            },
            other => (Filter::All(Vec::new()), std::slice::from_ref(other)),
        };
        let literals = match rest {
            [Nnf::Literal(literal)] => Some(vec![literal.clone()]),
            [Nnf::All(children)] => children.iter().map(literal).collect(),
            _ => None,
        };
        let literals = literals.unwrap_or_else(|| {
            let body = self.split_any(rest, scope);
            vec![self.hide(body, &free_of_all(rest), scope, "all")]
        });
        Universal { variables, guard, literals }
    }
}

/// The literal that a formula is, if it is one.
fn literal(formula: &Nnf) -> Option<Literal> {
    match formula {
        Nnf::Literal(literal) => Some(literal.clone()),
        _ => None,
    }
}

/// A static part as a condition: positive and negative atoms and (in)equalities as filters, positive atoms as literals to join over.
pub fn static_condition(filter: Filter) -> Condition {
    let mut condition = Condition::default();
    let mut parts = vec![filter];
    while let Some(part) = parts.pop() {
        match part {
            Filter::All(children) => parts.extend(children.into_iter().rev()),
            Filter::Atom(atom) => condition.literals.push(Literal { positive: true, atom }),
            Filter::Not(child) => match *child {
                Filter::Any(children) => parts.extend(children.into_iter().rev().map(negate)),
                child => condition.filters.push(negate(child)),
            },
            other => condition.filters.push(other),
        }
    }
    condition
}

fn join(conjunction: &mut Conjunction, other: Conjunction) {
    conjunction.exists.extend(other.exists);
    merge(&mut conjunction.condition, other.condition);
}

fn merge(condition: &mut Condition, other: Condition) {
    condition.literals.extend(other.literals);
    condition.filters.extend(other.filters);
    condition.universals.extend(other.universals);
}

/// Gives the variables of a scope new numbers: the outer ones first, then the existential ones, then all others.
struct Numbering<'a> {
    scope: &'a Scope,
    new: Vec<u32>,
}

impl<'a> Numbering<'a> {
    fn new(scope: &'a Scope, exists: &[u32]) -> Self {
        let outer: Vec<u32> = (0..scope.parameters).collect();
        Self::with_outer(scope, &outer, exists)
    }

    fn with_outer(scope: &'a Scope, outer: &[u32], exists: &[u32]) -> Self {
        let mut new = vec![u32::MAX; scope.variables.len()];
        let rest = 0..scope.variables.len() as u32;
        let order = outer.iter().chain(exists).copied().chain(rest);
        let mut count = 0;
        for variable in order {
            if new[variable as usize] == u32::MAX {
                new[variable as usize] = count;
                count += 1;
            }
        }
        Self { scope, new }
    }

    fn variables(&self) -> Vec<Variable> {
        let mut variables =
            vec![Variable { name: String::new(), types: Vec::new() }; self.new.len()];
        for (variable, &new) in self.scope.variables.iter().zip(&self.new) {
            variables[new as usize] =
                Variable { name: variable.name.text.clone(), types: variable.types.clone() };
        }
        variables
    }

    fn term(&self, term: Term) -> Term {
        match term {
            Term::Variable(variable) => Term::Variable(self.new[variable as usize]),
            object @ Term::Object(_) => object,
        }
    }

    fn atom(&self, mut atom: Atom) -> Atom {
        for argument in &mut atom.arguments {
            *argument = self.term(*argument);
        }
        atom
    }

    fn literal(&self, literal: Literal) -> Literal {
        Literal { positive: literal.positive, atom: self.atom(literal.atom) }
    }

    fn list(&self, variables: &[u32]) -> Vec<u32> {
        variables.iter().map(|&variable| self.new[variable as usize]).collect()
    }

    fn filter(&self, filter: Filter) -> Filter {
        match filter {
            Filter::Atom(atom) => Filter::Atom(self.atom(atom)),
            Filter::Equal(left, right) => Filter::Equal(self.term(left), self.term(right)),
            Filter::Not(child) => Filter::Not(Box::new(self.filter(*child))),
            Filter::All(children) => {
                Filter::All(children.into_iter().map(|child| self.filter(child)).collect())
            }
            Filter::Any(children) => {
                Filter::Any(children.into_iter().map(|child| self.filter(child)).collect())
            }
            Filter::Exists(bound, child) => {
                Filter::Exists(self.list(&bound), Box::new(self.filter(*child)))
            }
            Filter::Forall(bound, child) => {
                Filter::Forall(self.list(&bound), Box::new(self.filter(*child)))
            }
        }
    }

    fn condition(&self, condition: Condition) -> Condition {
        Condition {
            literals: condition.literals.into_iter().map(|literal| self.literal(literal)).collect(),
            filters: condition.filters.into_iter().map(|filter| self.filter(filter)).collect(),
            universals: condition
                .universals
                .into_iter()
                .map(|universal| Universal {
                    variables: self.list(&universal.variables),
                    guard: self.filter(universal.guard),
                    literals: universal
                        .literals
                        .into_iter()
                        .map(|literal| self.literal(literal))
                        .collect(),
                })
                .collect(),
        }
    }

    fn effect(&self, effect: Effect) -> Effect {
        Effect {
            variables: self.list(&effect.variables),
            condition: self.condition(effect.condition),
            literal: self.literal(effect.literal),
        }
    }

    fn cost(&self, cost: Cost) -> Cost {
        match cost {
            Cost::Constant(_) => cost,
            Cost::Function(function, arguments) => Cost::Function(
                function,
                arguments.into_iter().map(|term| self.term(term)).collect(),
            ),
        }
    }
}
