//! Instances to ground operators and axioms: conditions become literals over numbered facts, universals and quantified effects are expanded.

use std::ops::Range;

use lang::model::{FunctionId, ObjectId, PredicateId, Problem};
use rustc_hash::FxHashMap;

use crate::grounded::{Axiom, Effect, Fact, FactId, Grounded, Literal, Operator};
use crate::limits::{Limits, Stop};
use crate::normal::{
    self, Condition, Cost, Filter, Kind, Normal, Schema, Term, Universal, Variable,
};
use crate::normalize::scaled;

use super::join::{Body, Join, Plan, Purse, key_of, plan};
use super::reach::{Reach, rows};
use super::relation::Relation;
use super::world::World;

/// How many instances pass between two looks at the limits.
const INSTANCES_PER_POLL: u32 = 1 << 10;

/// A condition ready to be instantiated.
struct Template {
    literals: Vec<normal::Literal>,
    universals: Vec<Expansion>,
}

/// A universal condition: its literals for every match of its guard.
struct Expansion {
    body: Body,
    plan: Plan,
    literals: Vec<normal::Literal>,
}

/// An effect ready to be instantiated: for every match of its condition, or once where it has none.
struct EffectTemplate {
    matches: Option<(Body, Plan)>,
    condition: Template,
    literal: normal::Literal,
}

/// Turns a fixpoint into a ground problem.
pub struct Emission<'a> {
    normal: &'a Normal,
    world: &'a World,
    limits: &'a Limits,
    relations: Vec<Relation>,
    /// The number of the first fact of each predicate that changes.
    offsets: Vec<u32>,
    values: FxHashMap<(FunctionId, Box<[u32]>), u32>,
    /// What is made so far.
    pub grounded: Grounded,
    /// Whether it is to be known which objects operators and axioms are about.
    open: bool,
    /// Whether an instance fell away, so that less is reachable than the fixpoint found.
    pub dropped: bool,
    scratch: Vec<Literal>,
    steps: u32,
}

impl<'a> Emission<'a> {
    /// Numbers the facts of `relations`.
    pub fn new(
        normal: &'a Normal,
        problem: &Problem,
        world: &'a World,
        limits: &'a Limits,
        relations: Vec<Relation>,
        initial: &[u32],
        open: bool,
    ) -> Self {
        let mut grounded = Grounded { uses_metric: normal.uses_metric, ..Grounded::default() };
        let mut offsets = vec![0; normal.predicates.len()];
        for (number, predicate) in normal
            .predicates
            .iter()
            .enumerate()
            .filter(|(_, predicate)| predicate.kind != Kind::Static)
        {
            let relation = &relations[number];
            offsets[number] = grounded.facts.len() as u32;
            for row in 0..relation.len() {
                let start = grounded.arguments.len() as u32;
                grounded.arguments.extend(relation.row(row).iter().map(|&object| ObjectId(object)));
                let arguments = start..grounded.arguments.len() as u32;
                grounded.facts.push(Fact { predicate: PredicateId(number as u32), arguments });
                grounded.initial.push(row < initial[number]);
                grounded.derived.push(predicate.kind == Kind::Derived);
            }
        }
        let values = problem
            .values
            .iter()
            .filter_map(|value| {
                let arguments = value.arguments.iter().map(|object| object.0).collect();
                Some((
                    (value.function, arguments),
                    scaled(value.value, normal.scale, value.span).ok()?,
                ))
            })
            .collect();
        Self {
            normal,
            world,
            limits,
            relations,
            offsets,
            values,
            grounded,
            open,
            dropped: false,
            scratch: Vec::new(),
            steps: 0,
        }
    }

    /// Emits every instance of `reach` and the goal.
    ///
    /// # Errors
    /// Why it was stopped, if it was.
    pub fn run(&mut self, reach: &Reach) -> Result<bool, Stop> {
        self.reserve(reach)?;
        for (number, schema) in self.normal.schemas.iter().enumerate() {
            self.schema(schema, &reach.instances[number], reach.counts[number])?;
        }
        for (number, rule) in self.normal.rules.iter().enumerate() {
            let template = self.template(&rule.condition, &rule.variables, rule.bound);
            let mut binding = vec![0; rule.variables.len()];
            for (count, instance) in
                rows(&reach.derivations[number], rule.bound, reach.derivation_counts[number])
                    .enumerate()
            {
                self.poll(count)?;
                binding[..rule.bound].copy_from_slice(instance);
                let Some(conditions) = self.condition(&template, &mut binding, &[]) else {
                    self.dropped = true;
                    continue;
                };
                let head = self
                    .fact(&rule.head, &binding)
                    .expect("the fixpoint knows the heads of its derivations");
                let all = if self.open { rule.bound } else { 0 };
                let bound = self.arguments(&binding[..all]);
                self.grounded.axioms.push(Axiom { head, bound, conditions });
            }
        }
        self.goal()
    }

    /// Makes room for what is about as much as the instances need, so that little is copied while it grows.
    fn reserve(&mut self, reach: &Reach) -> Result<(), Stop> {
        let (mut operators, mut literals, mut effects) = (0, 0, 0);
        for (schema, &count) in self.normal.schemas.iter().zip(&reach.counts) {
            let dynamic = |literal: &&normal::Literal| {
                self.normal.predicates[literal.atom.predicate.index()].kind != Kind::Static
            };
            let count = count as usize;
            let conditions = [&schema.condition].into_iter();
            let conditions =
                conditions.chain(schema.effects.iter().map(|effect| &effect.condition));
            let each: usize =
                conditions.map(|one| one.literals.iter().filter(dynamic).count()).sum();
            operators += count;
            literals += count.saturating_mul(each);
            effects += count.saturating_mul(schema.effects.len());
        }
        let grounded = &mut self.grounded;
        let made = grounded.operators.try_reserve_exact(operators);
        let made = made.and_then(|()| grounded.literals.try_reserve_exact(literals));
        let made = made.and_then(|()| grounded.effects.try_reserve_exact(effects));
        made.map_err(|_| Stop::Memory)
    }

    fn poll(&self, count: usize) -> Result<(), Stop> {
        match self.limits.stopped() {
            Some(stop) if count.is_multiple_of(INSTANCES_PER_POLL as usize) => Err(stop),
            _ => Ok(()),
        }
    }

    /// The goal; false if it cannot be reached.
    fn goal(&mut self) -> Result<bool, Stop> {
        let variables = &self.normal.goal_variables;
        let goal = &self.normal.goal;
        let body = Body::new(
            goal,
            Vec::new(),
            variables,
            &[],
            &self.normal.predicates,
            &self.relations,
            self.world,
        );
        let order = plan(&body, &[], None, &mut self.relations, self.world.count as u32);
        let mut binding = vec![0; variables.len()];
        let mut holds = false;
        let finished = self.join(&body, &order, &mut binding, &mut |_| holds = true);
        if let (false, Some(stop)) = (finished, self.limits.stopped()) {
            return Err(stop);
        }
        let template = self.template(goal, variables, 0);
        let conditions = if holds { self.condition(&template, &mut binding, &[]) } else { None };
        if let Some(range) = &conditions {
            self.grounded.goal = self.grounded.literals.split_off(range.start as usize);
        }
        Ok(conditions.is_some())
    }

    fn schema(&mut self, schema: &Schema, instances: &[u32], count: u32) -> Result<(), Stop> {
        let template = self.template(&schema.condition, &schema.variables, schema.bound);
        let effects: Vec<EffectTemplate> =
            schema.effects.iter().map(|effect| self.effect_template(effect, schema)).collect();
        let mut binding = vec![0; schema.variables.len()];
        for (number, instance) in rows(instances, schema.bound, count).enumerate() {
            self.poll(number)?;
            binding[..schema.bound].copy_from_slice(instance);
            if !self.operator(schema, &template, &effects, &mut binding) {
                self.dropped = true;
            }
        }
        Ok(())
    }

    /// Emits one operator; false if it can never apply.
    fn operator(
        &mut self,
        schema: &Schema,
        template: &Template,
        effects: &[EffectTemplate],
        binding: &mut [u32],
    ) -> bool {
        let Some(cost) = self.cost(&schema.costs, binding) else { return false };
        let (literals_before, effects_before) =
            (self.grounded.literals.len(), self.grounded.effects.len());
        let Some(precondition) = self.condition(template, binding, &[]) else { return false };
        for effect in effects {
            self.effect(effect, binding, precondition.clone());
        }
        let range = effects_before as u32..self.grounded.effects.len() as u32;
        if range.is_empty() {
            self.grounded.literals.truncate(literals_before);
            return true;
        }
        let all = if self.open { schema.bound.max(schema.parameters) } else { schema.parameters };
        let bound = self.arguments(&binding[..all]);
        self.grounded.operators.push(Operator {
            action: schema.action,
            arguments: bound.start..bound.start + schema.parameters as u32,
            bound,
            precondition,
            effects: range,
            cost,
        });
        true
    }

    /// Keeps some objects.
    fn arguments(&mut self, objects: &[u32]) -> Range<u32> {
        let start = self.grounded.arguments.len() as u32;
        self.grounded.arguments.extend(objects.iter().map(|&object| ObjectId(object)));
        start..self.grounded.arguments.len() as u32
    }

    /// The cost of an instance; none where a function that it depends on has no value, so that it cannot be applied.
    fn cost(&self, costs: &[Cost], binding: &[u32]) -> Option<u32> {
        if !self.normal.uses_metric {
            return Some(1);
        }
        let mut sum = 0_u32;
        for cost in costs {
            sum = sum.checked_add(match cost {
                Cost::Constant(value) => *value,
                Cost::Function(function, arguments) => {
                    let mut buffer = [0; 16];
                    let key =
                        key_of(arguments, binding, &mut buffer).into_owned().into_boxed_slice();
                    *self.values.get(&(*function, key))?
                }
            })?;
        }
        Some(sum)
    }

    fn effect(&mut self, effect: &EffectTemplate, binding: &mut [u32], precondition: Range<u32>) {
        let Some((body, order)) = &effect.matches else {
            self.conditional_effect(effect, binding, precondition);
            return;
        };
        let mut matches = Vec::new();
        self.join(body, order, &mut binding.to_vec(), &mut |found| {
            matches.push(found.to_vec());
        });
        for mut found in matches {
            self.conditional_effect(effect, &mut found, precondition.clone());
        }
    }

    fn conditional_effect(
        &mut self,
        effect: &EffectTemplate,
        binding: &mut [u32],
        precondition: Range<u32>,
    ) {
        // What is deleted but never reachable need not be deleted.
        let Some(fact) = self.fact(&effect.literal.atom, binding) else { return };
        let conditions =
            if effect.condition.literals.is_empty() && effect.condition.universals.is_empty() {
                0..0
            } else {
                let known = self.grounded.literals
                    [precondition.start as usize..precondition.end as usize]
                    .to_vec();
                let Some(conditions) = self.condition(&effect.condition, binding, &known) else {
                    return;
                };
                conditions
            };
        self.grounded.effects.push(Effect {
            conditions,
            literal: Literal { fact, positive: effect.literal.positive },
        });
    }

    /// Writes the literals of a condition under `binding`, without those `known` to hold; none if it can never hold.
    fn condition(
        &mut self,
        template: &Template,
        binding: &mut [u32],
        known: &[Literal],
    ) -> Option<Range<u32>> {
        let mut literals = std::mem::take(&mut self.scratch);
        literals.clear();
        let possible = self.collect(template, binding, &mut literals);
        literals.sort_unstable();
        literals.dedup();
        let consistent = possible && literals.windows(2).all(|pair| pair[0].fact != pair[1].fact);
        let start = self.grounded.literals.len() as u32;
        if consistent {
            self.grounded
                .literals
                .extend(literals.iter().filter(|literal| known.binary_search(literal).is_err()));
        }
        // A condition that a known literal contradicts never holds.
        let contradicted = literals.iter().any(|literal| {
            known
                .binary_search(&Literal { fact: literal.fact, positive: !literal.positive })
                .is_ok()
        });
        self.scratch = literals;
        if contradicted {
            self.grounded.literals.truncate(start as usize);
        }
        (consistent && !contradicted).then_some(start..self.grounded.literals.len() as u32)
    }

    fn collect(
        &mut self,
        template: &Template,
        binding: &mut [u32],
        literals: &mut Vec<Literal>,
    ) -> bool {
        for literal in &template.literals {
            if !self.literal(literal, binding, literals) {
                return false;
            }
        }
        for universal in &template.universals {
            let mut matches = Vec::new();
            self.join(&universal.body, &universal.plan, &mut binding.to_vec(), &mut |found| {
                matches.push(found.to_vec());
            });
            for found in matches {
                for literal in &universal.literals {
                    if !self.literal(literal, &found, literals) {
                        return false;
                    }
                }
            }
        }
        true
    }

    /// Adds a ground literal; false if it can never hold.
    fn literal(
        &self,
        literal: &normal::Literal,
        binding: &[u32],
        literals: &mut Vec<Literal>,
    ) -> bool {
        match self.fact(&literal.atom, binding) {
            Some(fact) => {
                literals.push(Literal { fact, positive: literal.positive });
                true
            }
            None => !literal.positive,
        }
    }

    fn fact(&self, atom: &normal::Atom, binding: &[u32]) -> Option<FactId> {
        let mut buffer = [0; 16];
        let row = key_of(&atom.arguments, binding, &mut buffer);
        let predicate = atom.predicate.index();
        self.relations[predicate].find(&row).map(|row| FactId(self.offsets[predicate] + row))
    }

    fn join(
        &mut self,
        body: &Body,
        plan: &Plan,
        binding: &mut [u32],
        found: &mut impl FnMut(&[u32]),
    ) -> bool {
        let relations = &self.relations;
        Join {
            body,
            plan,
            relations,
            excluded: u32::MAX,
            limits: self.limits,
            binding,
            steps: &mut self.steps,
            purse: &mut Purse::new(u32::MAX, (u32::MAX, 0)),
        }
        .run(found)
    }

    /// The literals of a condition over facts that change, and its universals ready to be expanded.
    fn template(
        &mut self,
        condition: &Condition,
        variables: &[Variable],
        bound: usize,
    ) -> Template {
        let changes = |literal: &&normal::Literal| {
            self.normal.predicates[literal.atom.predicate.index()].kind != Kind::Static
        };
        let literals = condition.literals.iter().filter(changes).cloned().collect();
        let outer: Vec<u32> = (0..bound as u32).collect();
        let universals = condition
            .universals
            .iter()
            .map(|universal| self.expansion(universal, variables, &outer))
            .collect();
        Template { literals, universals }
    }

    fn expansion(
        &mut self,
        universal: &Universal,
        variables: &[Variable],
        outer: &[u32],
    ) -> Expansion {
        let mut guard = Condition::default();
        let parts = match &universal.guard {
            Filter::All(parts) => parts.clone(),
            other => vec![other.clone()],
        };
        for part in parts {
            match part {
                Filter::Atom(atom) => guard.literals.push(normal::Literal { positive: true, atom }),
                other => guard.filters.push(other),
            }
        }
        let mut matched: Vec<u32> = outer.to_vec();
        matched.extend(&universal.variables);
        // Whatever is not bound by this universal is bound outside: the instance, or the effect around it.
        let given = given(&guard, &universal.literals, &universal.variables, outer);
        let (body, plan) = self.query(&guard, variables, &matched, &given);
        Expansion { body, plan, literals: universal.literals.clone() }
    }

    fn effect_template(&mut self, effect: &normal::Effect, schema: &Schema) -> EffectTemplate {
        let condition = &effect.condition;
        let simple = effect.variables.is_empty()
            && condition.literals.is_empty()
            && condition.filters.is_empty();
        let given: Vec<u32> = (0..schema.bound as u32).collect();
        let matches = (!simple).then(|| {
            let mut matched = given.clone();
            matched.extend(&effect.variables);
            self.query(condition, &schema.variables, &matched, &given)
        });
        let template = self.template(condition, &schema.variables, schema.bound);
        EffectTemplate { matches, condition: template, literal: effect.literal.clone() }
    }

    fn query(
        &mut self,
        condition: &Condition,
        variables: &[Variable],
        matched: &[u32],
        given: &[u32],
    ) -> (Body, Plan) {
        let body = Body::new(
            condition,
            Vec::new(),
            variables,
            matched,
            &self.normal.predicates,
            &self.relations,
            self.world,
        );
        let order = plan(&body, given, None, &mut self.relations, self.world.count as u32);
        (body, order)
    }
}

/// The variables of a universal that are bound outside it.
fn given(guard: &Condition, literals: &[normal::Literal], own: &[u32], outer: &[u32]) -> Vec<u32> {
    let atoms = guard.literals.iter().chain(literals).map(|literal| &literal.atom);
    let mut given: Vec<u32> = atoms
        .flat_map(|atom| &atom.arguments)
        .filter_map(|&term| if let Term::Variable(variable) = term { Some(variable) } else { None })
        .chain(outer.iter().copied())
        .filter(|variable| !own.contains(variable))
        .collect();
    given.sort_unstable();
    given.dedup();
    given
}
