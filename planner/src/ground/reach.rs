//! Which facts can ever hold, and which instances of schemas and axioms ever apply, when deletes, negative conditions over facts
//! that change and universal conditions are ignored: a fixpoint of joins.
//!
//! The initial facts are joined all at once. After that one new fact at a time is published and joined with all published ones before it,
//! so that every instance is found exactly once and needs no look-up among the instances.

use crate::limits::{Limits, Stop};
use crate::normal::{Atom, Condition, Effect, Filter, Normal, Term, Variable};
use crate::normalize::{negate, static_condition};

use super::join::{Body, Join, Plan, Purse, key_of, plan};
use super::relation::Relation;
use super::world::World;

/// Into how many joins a condition with static disjunctions is split at most.
const MOST_VARIANTS: usize = 16;

/// The fixpoint.
pub struct Reach {
    /// The predicates of the normal form, with what is reachable; then relations of our own.
    pub relations: Vec<Relation>,
    /// For each schema its instances: the values of its bound variables, back to back.
    pub instances: Vec<Vec<u32>>,
    /// How many instances each schema has: it may bind no variables.
    pub counts: Vec<u32>,
    /// For each axiom its instances.
    pub derivations: Vec<Vec<u32>>,
    /// How many instances each axiom has.
    pub derivation_counts: Vec<u32>,
    /// Whether an instance was left out because its facts were too dear.
    pub was_short: bool,
}

/// What a match of a body is good for.
enum Head {
    /// An instance of the schema with this number.
    Schema(usize),
    /// An instance of the axiom with this number.
    Rule(usize),
    /// The fact that an effect adds where its condition holds.
    Add(Atom),
}

/// A body with its head, and its plans by the atom that a new fact matches; the last is for the start.
struct Program {
    body: Body,
    head: Head,
    plans: Vec<Option<(Plan, u32)>>,
}

/// A schema's immediate consequences.
struct Consequences {
    bound: usize,
    /// Adds without a condition.
    adds: Vec<Atom>,
    /// Relations that collect what conditional effects need of an instance.
    projections: Vec<(usize, Vec<u32>)>,
}

struct Fixpoint<'a> {
    world: &'a World,
    limits: &'a Limits,
    reach: Reach,
    programs: Vec<Program>,
    /// For each relation the programs and atoms that it feeds.
    triggers: Vec<Vec<(usize, usize)>>,
    consequences: Vec<Consequences>,
    rule_heads: Vec<Atom>,
    /// New facts, in the order in which they were found.
    queue: Vec<u32>,
    steps: u32,
    published: u32,
    purse: Purse,
}

/// Computes the fixpoint from the static and initial facts that `relations` knows. An instance whose facts and objects cost more than what is in `purse` is left out.
///
/// # Errors
/// Why it was stopped, if it was.
pub fn reach(
    normal: &Normal,
    world: &World,
    relations: Vec<Relation>,
    purse: Purse,
    limits: &Limits,
) -> Result<Reach, Stop> {
    let mut fixpoint = Fixpoint::new(normal, world, relations, limits);
    fixpoint.purse = purse;
    fixpoint.run()?;
    fixpoint.reach.was_short = fixpoint.purse.was_short;
    Ok(fixpoint.reach)
}

impl<'a> Fixpoint<'a> {
    fn new(
        normal: &Normal,
        world: &'a World,
        relations: Vec<Relation>,
        limits: &'a Limits,
    ) -> Self {
        let mut fixpoint = Self {
            world,
            limits,
            reach: Reach {
                relations,
                instances: vec![Vec::new(); normal.schemas.len()],
                counts: vec![0; normal.schemas.len()],
                derivations: vec![Vec::new(); normal.rules.len()],
                derivation_counts: vec![0; normal.rules.len()],
                was_short: false,
            },
            programs: Vec::new(),
            triggers: Vec::new(),
            consequences: Vec::new(),
            rule_heads: Vec::new(),
            queue: Vec::new(),
            steps: 0,
            published: 0,
            purse: Purse::new(0, (u32::MAX, 0)),
        };
        for (number, schema) in normal.schemas.iter().enumerate() {
            let matched: Vec<u32> = (0..schema.bound as u32).collect();
            for condition in variants(&schema.condition) {
                let body =
                    fixpoint.body(normal, &condition, Vec::new(), &schema.variables, &matched);
                fixpoint.add(body, Head::Schema(number));
            }
            let mut consequences =
                Consequences { bound: schema.bound, adds: Vec::new(), projections: Vec::new() };
            for effect in schema.effects.iter().filter(|effect| effect.literal.positive) {
                fixpoint.effect(normal, effect, &schema.variables, &mut consequences);
            }
            fixpoint.consequences.push(consequences);
        }
        for (number, rule) in normal.rules.iter().enumerate() {
            let matched: Vec<u32> = (0..rule.bound as u32).collect();
            for condition in variants(&rule.condition) {
                let body = fixpoint.body(normal, &condition, Vec::new(), &rule.variables, &matched);
                fixpoint.add(body, Head::Rule(number));
            }
            fixpoint.rule_heads.push(rule.head.clone());
        }
        fixpoint.triggers = vec![Vec::new(); fixpoint.reach.relations.len()];
        for (number, program) in fixpoint.programs.iter().enumerate() {
            for (index, atom) in program
                .body
                .atoms
                .iter()
                .enumerate()
                .filter(|&(index, _)| program.body.growing[index])
            {
                fixpoint.triggers[atom.predicate.index()].push((number, index));
            }
        }
        fixpoint
    }

    fn body(
        &self,
        normal: &Normal,
        condition: &Condition,
        extra: Vec<Atom>,
        variables: &[Variable],
        matched: &[u32],
    ) -> Body {
        Body::new(
            condition,
            extra,
            variables,
            matched,
            &normal.predicates,
            &self.reach.relations,
            self.world,
        )
    }

    fn add(&mut self, body: Body, head: Head) {
        let plans = (0..=body.atoms.len()).map(|_| None).collect();
        self.programs.push(Program { body, head, plans });
    }

    /// Compiles an add effect: at once where it has no condition, else as a program over a projection of the instances.
    fn effect(
        &mut self,
        normal: &Normal,
        effect: &Effect,
        variables: &[Variable],
        consequences: &mut Consequences,
    ) {
        let condition = &effect.condition;
        if effect.variables.is_empty()
            && condition.literals.is_empty()
            && condition.filters.is_empty()
        {
            if !consequences.adds.contains(&effect.literal.atom) {
                consequences.adds.push(effect.literal.atom.clone());
            }
            return;
        }
        let shared: Vec<u32> = occurring(effect)
            .into_iter()
            .filter(|&variable| (variable as usize) < consequences.bound)
            .collect();
        let existing = consequences.projections.iter().find(|(_, columns)| *columns == shared);
        let relation = existing.map_or(self.reach.relations.len(), |&(relation, _)| relation);
        if relation == self.reach.relations.len() {
            self.reach.relations.push(Relation::new(shared.len()));
            consequences.projections.push((relation, shared.clone()));
        }
        let instance = Atom {
            predicate: lang::model::PredicateId(relation as u32),
            arguments: shared.iter().copied().map(Term::Variable).collect(),
        };
        let matched: Vec<u32> = shared.iter().chain(&effect.variables).copied().collect();
        let body = self.body(normal, condition, vec![instance], variables, &matched);
        self.add(body, Head::Add(effect.literal.atom.clone()));
    }

    fn run(&mut self) -> Result<(), Stop> {
        for relation in &mut self.reach.relations {
            relation.publish_all();
            self.published += relation.visible();
        }
        for program in 0..self.programs.len() {
            let start = self.programs[program].body.atoms.len();
            self.join(program, start, 0)?;
        }
        let mut next = 0;
        while next < self.queue.len() {
            let relation = self.queue[next] as usize;
            next += 1;
            let row = self.reach.relations[relation].visible();
            self.reach.relations[relation].publish();
            self.published += 1;
            for trigger in 0..self.triggers[relation].len() {
                let (program, atom) = self.triggers[relation][trigger];
                self.join(program, atom, row)?;
            }
        }
        Ok(())
    }

    /// Enumerates the matches of a program in which `atom` matches `row`, or all of them where `atom` is past the last.
    fn join(&mut self, number: usize, atom: usize, row: u32) -> Result<(), Stop> {
        let program = &mut self.programs[number];
        let relations = &mut self.reach.relations;
        if program.body.atoms.iter().any(|atom| relations[atom.predicate.index()].visible() == 0) {
            return Ok(());
        }
        let objects = self.world.count as u32;
        let current = &mut program.plans[atom];
        // Sizes at the time of planning decide the order; when there are twice as many facts it is time to think again.
        if current.as_ref().is_none_or(|(_, planned)| self.published > planned * 2 + 64) {
            let delta = program.body.atoms.get(atom);
            let given: Vec<u32> = delta.map_or_else(Vec::new, |atom| {
                atom.arguments
                    .iter()
                    .filter_map(|&term| {
                        if let Term::Variable(variable) = term { Some(variable) } else { None }
                    })
                    .collect()
            });
            *current = Some((
                plan(&program.body, &given, delta.map(|_| atom), relations, objects),
                self.published,
            ));
        }
        let (plan, _) = current.as_ref().expect("it was planned just now");
        let mut binding = vec![0; program.body.domains.len()];
        let mut join = Join {
            body: &program.body,
            plan,
            relations,
            excluded: row,
            limits: self.limits,
            binding: &mut binding,
            steps: &mut self.steps,
            purse: &mut self.purse,
        };
        let delta = atom < program.body.atoms.len();
        if delta && !join.unify(atom, row) {
            return Ok(());
        }
        let mut matches = Matches { values: Vec::new(), count: 0 };
        let matched = &program.body.matched;
        let limits = self.limits;
        let mut found = |binding: &[u32]| {
            if matches.values.try_reserve(matched.len()).is_err() {
                limits.stop(Stop::Memory);
                return;
            }
            matches.values.extend(matched.iter().map(|&variable| binding[variable as usize]));
            matches.count += 1;
        };
        let finished =
            if delta { join.run_from(atom, row, &mut found) } else { join.run(&mut found) };
        if !finished {
            return Err(self.limits.stopped().expect("a join ends early only when it is stopped"));
        }
        if let Some(stop) = self.limits.stopped().filter(|&stop| stop == Stop::Memory) {
            return Err(stop);
        }
        if matches.count > 0 {
            self.consequences(number, &matches)?;
        }
        Ok(())
    }

    /// Takes the matches of a program in.
    fn consequences(&mut self, number: usize, matches: &Matches) -> Result<(), Stop> {
        let program = &self.programs[number];
        let width = program.body.matched.len();
        match &program.head {
            Head::Schema(schema) => {
                append(&mut self.reach.instances[*schema], &matches.values)?;
                self.reach.counts[*schema] += matches.count;
                let consequences = &self.consequences[*schema];
                for instance in rows(&matches.values, width, matches.count) {
                    for atom in &consequences.adds {
                        insert(&mut self.reach.relations, &mut self.queue, atom, instance);
                    }
                    for (relation, columns) in &consequences.projections {
                        let row: Vec<u32> =
                            columns.iter().map(|&column| instance[column as usize]).collect();
                        if self.reach.relations[*relation].insert(&row).1 {
                            self.queue.push(*relation as u32);
                        }
                    }
                }
            }
            Head::Rule(rule) => {
                append(&mut self.reach.derivations[*rule], &matches.values)?;
                self.reach.derivation_counts[*rule] += matches.count;
                let head = &self.rule_heads[*rule];
                for instance in rows(&matches.values, width, matches.count) {
                    insert(&mut self.reach.relations, &mut self.queue, head, instance);
                }
            }
            Head::Add(atom) => {
                let mut binding = vec![0; program.body.domains.len()];
                for found in rows(&matches.values, width, matches.count) {
                    for (&variable, &object) in program.body.matched.iter().zip(found) {
                        binding[variable as usize] = object;
                    }
                    insert(&mut self.reach.relations, &mut self.queue, atom, &binding);
                }
            }
        }
        Ok(())
    }
}

/// Appends values where there is memory for them.
fn append(values: &mut Vec<u32>, more: &[u32]) -> Result<(), Stop> {
    values.try_reserve(more.len()).map_err(|_| Stop::Memory)?;
    values.extend_from_slice(more);
    Ok(())
}

/// Conditions whose matches are those of `condition`, each match in exactly one of them: its static disjunctions are split,
/// so that what a disjunct says guides the join instead of being tested after it.
fn variants(condition: &Condition) -> Vec<Condition> {
    let mut variants = vec![condition.clone()];
    for (number, filter) in condition.filters.iter().enumerate() {
        let Filter::Any(disjuncts) = filter else { continue };
        if variants.len() * disjuncts.len() > MOST_VARIANTS {
            continue;
        }
        let mut next = Vec::new();
        for variant in &variants {
            for (position, disjunct) in disjuncts.iter().enumerate() {
                let mut variant = variant.clone();
                // The disjunction itself stays in its place, where it holds trivially, so that positions stay the same.
                variant.filters[number] = Filter::All(Vec::new());
                let part = static_condition(disjunct.clone());
                variant.literals.extend(part.literals);
                variant.filters.extend(part.filters);
                variant.filters.extend(disjuncts[..position].iter().cloned().map(negate));
                next.push(variant);
            }
        }
        variants = next;
    }
    variants
}

/// Matches of a program, back to back.
struct Matches {
    values: Vec<u32>,
    count: u32,
}

/// `count` rows of `width` values each; a row may be empty.
pub fn rows(values: &[u32], width: usize, count: u32) -> impl Iterator<Item = &[u32]> {
    (0..count as usize).map(move |row| &values[row * width..(row + 1) * width])
}

/// Makes the fact `atom` under `binding` known, and queues it if it is new.
fn insert(relations: &mut [Relation], queue: &mut Vec<u32>, atom: &Atom, binding: &[u32]) {
    let mut buffer = [0; 16];
    let row = key_of(&atom.arguments, binding, &mut buffer);
    if relations[atom.predicate.index()].insert(&row).1 {
        queue.push(atom.predicate.0);
    }
}

/// The variables that occur in the positive condition, the filters and the literal of an effect.
fn occurring(effect: &Effect) -> Vec<u32> {
    let literals =
        effect.condition.literals.iter().map(|literal| &literal.atom).chain([&effect.literal.atom]);
    let mut found: Vec<u32> = literals
        .flat_map(|atom| &atom.arguments)
        .filter_map(|&term| if let Term::Variable(variable) = term { Some(variable) } else { None })
        .collect();
    for filter in &effect.condition.filters {
        found.extend(super::join::occurring(filter));
    }
    found.sort_unstable();
    found.dedup();
    found
}
