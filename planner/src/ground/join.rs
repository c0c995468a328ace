//! Conjunctive queries over relations: a [`Body`] is planned once for what is bound at the start and then enumerated by backtracking.
//!
//! Nothing intermediate is stored. Inequalities, negated static atoms and static formulas are decided inside the join,
//! as soon as their variables are bound. The order of the atoms follows the sizes of the relations at the time of planning.

use crate::limits::Limits;
use crate::normal::{Atom, Condition, Filter, Kind, Predicate, Term, Variable};

use super::relation::{NONE, Relation};
use super::world::{Objects, World, holds, value};

/// How many columns a look-up uses at most; further bound columns are compared row by row.
const WIDEST_KEY: usize = 16;

/// How many steps of a join pass between two looks at the limits.
const STEPS_PER_POLL: u32 = 1 << 14;

/// A conjunction of atoms over relations, with static formulas that restrict it.
pub struct Body {
    /// The atoms to join: a predicate is the number of its relation.
    pub atoms: Vec<Atom>,
    /// Which atoms are over relations that grow.
    pub growing: Vec<bool>,
    /// For each variable the objects that may stand for it.
    pub domains: Vec<Objects>,
    /// The variables that a match binds.
    pub matched: Vec<u32>,
    /// Static formulas, each with the matched variables that occur in it.
    checks: Vec<(Filter, Vec<u32>)>,
}

impl Body {
    /// The query for `condition`, in which negative literals over facts that change and universals are left out:
    /// both are taken as true. `extra` atoms are joined too; `matched` are the variables that a match binds.
    pub fn new(
        condition: &Condition,
        extra: Vec<Atom>,
        variables: &[Variable],
        matched: &[u32],
        predicates: &[Predicate],
        relations: &[Relation],
        world: &World,
    ) -> Self {
        let mut atoms = extra;
        let mut growing = vec![true; atoms.len()];
        let mut filters = condition.filters.clone();
        for literal in &condition.literals {
            let is_static = predicates[literal.atom.predicate.index()].kind == Kind::Static;
            if literal.positive {
                growing.push(!is_static);
                atoms.push(literal.atom.clone());
            } else if is_static {
                filters.push(Filter::Not(Box::new(Filter::Atom(literal.atom.clone()))));
            }
        }
        let mut domains: Vec<Objects> =
            variables.iter().map(|variable| world.objects(variable)).collect();
        for (atom, _) in atoms.iter().zip(&growing).filter(|(_, growing)| !**growing) {
            restrict(atom, &relations[atom.predicate.index()], &mut domains, world.count);
        }
        let checks = filters
            .into_iter()
            .map(|filter| {
                let needs = occurring(&filter)
                    .into_iter()
                    .filter(|variable| matched.contains(variable))
                    .collect();
                (filter, needs)
            })
            .collect();
        Self { atoms, growing, domains, matched: matched.to_vec(), checks }
    }
}

/// Keeps for each variable of a static atom only the objects that occur in its column.
fn restrict(atom: &Atom, relation: &Relation, domains: &mut [Objects], count: usize) {
    let matches = |row: &[u32]| {
        atom.arguments.iter().zip(row).all(|(&term, &object)| match term {
            Term::Variable(variable) => domains[variable as usize].contains(object),
            Term::Object(wanted) => wanted.0 == object,
        })
    };
    let rows: Vec<u32> = (0..relation.len()).filter(|&row| matches(relation.row(row))).collect();
    for (column, &term) in atom.arguments.iter().enumerate() {
        if let Term::Variable(variable) = term {
            let mut list: Vec<u32> = rows.iter().map(|&row| relation.row(row)[column]).collect();
            list.sort_unstable();
            list.dedup();
            domains[variable as usize] = Objects::new(list, count);
        }
    }
}

/// The variables that occur in a filter, bound inside it or not.
pub fn occurring(filter: &Filter) -> Vec<u32> {
    let mut found = Vec::new();
    let mut parts = vec![filter];
    while let Some(part) = parts.pop() {
        match part {
            Filter::Atom(atom) => found.extend(atom.arguments.iter().copied().filter_map(variable)),
            Filter::Equal(left, right) => {
                found.extend([*left, *right].into_iter().filter_map(variable));
            }
            Filter::Not(child) | Filter::Exists(_, child) | Filter::Forall(_, child) => {
                parts.push(child);
            }
            Filter::All(children) | Filter::Any(children) => parts.extend(children),
        }
    }
    found.sort_unstable();
    found.dedup();
    found
}

fn variable(term: Term) -> Option<u32> {
    match term {
        Term::Variable(variable) => Some(variable),
        Term::Object(_) => None,
    }
}

/// One step of a plan: extend the binding by the rows of a relation, or by the objects of a variable.
struct Step {
    access: Access,
    /// Static formulas that can be decided after this step.
    checks: Vec<u32>,
}

enum Access {
    /// All arguments are bound: the row must be visible, and not the one excluded where that is asked.
    Test { atom: u32, exclude: bool },
    /// Rows that agree with the bound columns.
    Rows {
        atom: u32,
        exclude: bool,
        /// The index over the bound columns; without any, all rows.
        index: Option<usize>,
        columns: Vec<u32>,
        /// Columns whose variable is bound here, in order.
        binds: Vec<(u32, u32)>,
        /// Columns that repeat a variable bound by an earlier column of the same atom.
        repeats: Vec<(u32, u32)>,
    },
    /// The objects of a variable that occurs in no atom.
    Domain { variable: u32 },
    /// The one value that an equality leaves.
    Assign { variable: u32, term: Term },
}

/// The order in which a body is enumerated, for what is bound at the start.
pub struct Plan {
    /// What can be checked at the start.
    checks: Vec<u32>,
    steps: Vec<Step>,
}

/// Plans `body` for a start at which the variables `given` are bound, by a row for the atom `delta` if there is one.
///
/// Atoms before `delta` exclude the row that `delta` is matched with, so that every match is found for exactly one row and atom.
pub fn plan(
    body: &Body,
    given: &[u32],
    delta: Option<usize>,
    relations: &mut [Relation],
    objects: u32,
) -> Plan {
    let mut bound = vec![false; body.domains.len()];
    for &variable in given {
        bound[variable as usize] = true;
    }
    let mut open_checks: Vec<u32> = (0..body.checks.len() as u32).collect();
    let mut ready = |bound: &[bool]| {
        let (now, later): (Vec<u32>, Vec<u32>) = open_checks.iter().partition(|&&check| {
            body.checks[check as usize].1.iter().all(|&variable| bound[variable as usize])
        });
        open_checks = later;
        now
    };
    let checks = ready(&bound);
    let mut steps = Vec::new();
    assign(body, &mut bound, &mut steps, &mut ready);
    let mut open: Vec<usize> = (0..body.atoms.len()).filter(|&atom| Some(atom) != delta).collect();
    while !open.is_empty() {
        let (position, _) = open
            .iter()
            .enumerate()
            .map(|(position, &atom)| {
                (position, estimate(&body.atoms[atom], &bound, relations, objects))
            })
            .min_by(|left, right| left.1.total_cmp(&right.1))
            .expect("there is an open atom");
        let number = open.remove(position);
        let atom = &body.atoms[number];
        let exclude = delta
            .is_some_and(|delta| number < delta && body.atoms[delta].predicate == atom.predicate);
        let mut columns = Vec::new();
        let mut binds: Vec<(u32, u32)> = Vec::new();
        let mut repeats = Vec::new();
        for (column, &term) in atom.arguments.iter().enumerate() {
            match term {
                Term::Variable(variable) if !bound[variable as usize] => {
                    if binds.iter().any(|&(_, earlier)| earlier == variable) {
                        repeats.push((column as u32, variable));
                    } else {
                        binds.push((column as u32, variable));
                    }
                }
                _ => columns.push(column as u32),
            }
        }
        let access = if binds.is_empty() {
            Access::Test { atom: number as u32, exclude }
        } else {
            let relation = &mut relations[atom.predicate.index()];
            let index = (!columns.is_empty())
                .then(|| relation.index(&columns[..columns.len().min(WIDEST_KEY)], objects));
            for &(_, variable) in &binds {
                bound[variable as usize] = true;
            }
            Access::Rows { atom: number as u32, exclude, index, columns, binds, repeats }
        };
        steps.push(Step { access, checks: ready(&bound) });
        assign(body, &mut bound, &mut steps, &mut ready);
    }
    let mut rest: Vec<u32> = body.matched.clone();
    rest.sort_by_key(|&variable| body.domains[variable as usize].list.len());
    for variable in rest {
        if !bound[variable as usize] {
            bound[variable as usize] = true;
            steps.push(Step { access: Access::Domain { variable }, checks: ready(&bound) });
            assign(body, &mut bound, &mut steps, &mut ready);
        }
    }
    Plan { checks, steps }
}

/// Binds every variable that an equality ties to what is bound already.
fn assign(
    body: &Body,
    bound: &mut [bool],
    steps: &mut Vec<Step>,
    ready: &mut impl FnMut(&[bool]) -> Vec<u32>,
) {
    let is_bound =
        |term: Term, bound: &[bool]| variable(term).is_none_or(|variable| bound[variable as usize]);
    loop {
        let open = body.checks.iter().find_map(|(filter, _)| match filter {
            Filter::Equal(left, right) => match (is_bound(*left, bound), is_bound(*right, bound)) {
                (true, false) => Some((*right, *left)),
                (false, true) => Some((*left, *right)),
                _ => None,
            },
            _ => None,
        });
        let Some((Term::Variable(variable), term)) = open else { return };
        bound[variable as usize] = true;
        steps.push(Step { access: Access::Assign { variable, term }, checks: ready(bound) });
    }
}

/// How many rows of its relation agree with the bound arguments of `atom`, as if columns were independent.
fn estimate(atom: &Atom, bound: &[bool], relations: &mut [Relation], objects: u32) -> f64 {
    let relation = &mut relations[atom.predicate.index()];
    let mut rows = f64::from(relation.visible());
    let distinct = relation.distinct(objects);
    let mut all_bound = true;
    for (&term, &distinct) in atom.arguments.iter().zip(distinct) {
        match term {
            Term::Variable(variable) if !bound[variable as usize] => all_bound = false,
            _ => rows /= f64::from(distinct.max(1)),
        }
    }
    // A test costs nothing and can only help; it comes first.
    if all_bound { -1.0 } else { rows }
}

/// A running enumeration.
pub struct Join<'a> {
    /// The query.
    pub body: &'a Body,
    /// How it is enumerated.
    pub plan: &'a Plan,
    /// All relations.
    pub relations: &'a [Relation],
    /// The row that atoms before the delta atom must not match.
    pub excluded: u32,
    /// When to give up.
    pub limits: &'a Limits,
    /// Values of variables; those given at the start are set.
    pub binding: &'a mut [u32],
    /// Steps since the last look at the limits.
    pub steps: &'a mut u32,
    /// What rows with a price may be matched with.
    pub purse: &'a mut Purse,
}

/// What a match may spend on rows that have a price. A row is paid for once, however many atoms it matches.
#[derive(Debug)]
pub struct Purse {
    /// What is left.
    left: u32,
    /// Objects from this one on cost so much each.
    objects: (u32, u32),
    /// What is paid for: rows by relation and number, and objects.
    paid: Vec<(u32, u32)>,
    /// Whether something was ever too dear.
    pub was_short: bool,
}

/// Stands for the relation where an object is paid for.
const OBJECT: u32 = u32::MAX;

/// What was in a purse, and how much of it was paid for.
#[derive(Debug, Clone, Copy)]
struct Receipt {
    left: u32,
    paid: usize,
}

impl Purse {
    /// A purse with so much in it, for rows and for objects from the one that is named first, each of which costs so much.
    pub fn new(left: u32, objects: (u32, u32)) -> Self {
        Self { left, objects, paid: Vec::new(), was_short: false }
    }

    fn receipt(&self) -> Receipt {
        Receipt { left: self.left, paid: self.paid.len() }
    }

    fn spend(&mut self, price: u32, on: (u32, u32)) -> bool {
        if self.paid.contains(&on) {
            return true;
        }
        if price > self.left {
            self.was_short = true;
            return false;
        }
        self.left -= price;
        self.paid.push(on);
        true
    }

    /// Whether nothing of this price can be paid for, and it is known already that something was too dear.
    #[inline]
    fn is_short(&self, price: u32) -> bool {
        price > self.left && self.was_short
    }

    /// The rows of a relation that are paid for, the last first.
    fn paid_of(&self, relation: u32) -> Vec<u32> {
        let of = self.paid.iter().filter(|(of, _)| *of == relation);
        let mut rows: Vec<u32> = of.map(|&(_, row)| row).collect();
        rows.sort_unstable_by(|left, right| right.cmp(left));
        rows
    }

    /// Pays for a row and the objects in it; what to give back when it is matched no longer, or nothing if it is too dear.
    #[inline]
    fn pay(&mut self, relation: &Relation, predicate: u32, row: u32) -> Option<Receipt> {
        let receipt = self.receipt();
        let price = relation.price(row);
        let paid = (price == 0 || self.spend(price, (predicate, row)))
            && (self.objects.0 == u32::MAX
                || relation.row(row).iter().all(|&object| self.pay_object(object)));
        if !paid {
            self.take_back(receipt);
            return None;
        }
        Some(receipt)
    }

    /// Pays for an object; false if it is too dear.
    #[inline]
    fn pay_object(&mut self, object: u32) -> bool {
        object < self.objects.0 || self.spend(self.objects.1, (OBJECT, object))
    }

    #[inline]
    fn take_back(&mut self, receipt: Receipt) {
        self.left = receipt.left;
        self.paid.truncate(receipt.paid);
    }
}

impl Join<'_> {
    /// Calls `found` with the binding of every match; false if the limits ended it before the last.
    pub fn run(&mut self, found: &mut impl FnMut(&[u32])) -> bool {
        let plan = self.plan;
        !self.pass(&plan.checks) || self.step(0, found)
    }

    /// As [`Join::run`], where `atom` is matched with `row`.
    pub fn run_from(&mut self, atom: usize, row: u32, found: &mut impl FnMut(&[u32])) -> bool {
        let predicate = self.body.atoms[atom].predicate;
        let relations = self.relations;
        let Some(price) = self.purse.pay(&relations[predicate.index()], predicate.0, row) else {
            return true;
        };
        let finished = self.run(found);
        self.purse.take_back(price);
        finished
    }

    /// Binds the variables of `atom` to a row of its relation; false if it does not fit.
    pub fn unify(&mut self, atom: usize, row: u32) -> bool {
        let body = self.body;
        let atom = &body.atoms[atom];
        let row = self.relations[atom.predicate.index()].row(row);
        let mut fits = true;
        for (column, &term) in atom.arguments.iter().enumerate() {
            match term {
                Term::Object(object) => fits &= object.0 == row[column],
                Term::Variable(variable) => {
                    let earlier = atom.arguments[..column].iter().position(|&other| other == term);
                    match earlier {
                        Some(earlier) => fits &= row[earlier] == row[column],
                        None => fits &= body.domains[variable as usize].contains(row[column]),
                    }
                    self.binding[variable as usize] = row[column];
                }
            }
        }
        fits
    }

    fn pass(&mut self, checks: &[u32]) -> bool {
        let body = self.body;
        checks.iter().all(|&check| {
            holds(&body.checks[check as usize].0, self.relations, &body.domains, self.binding)
        })
    }

    fn step(&mut self, depth: usize, found: &mut impl FnMut(&[u32])) -> bool {
        *self.steps += 1;
        if *self.steps >= STEPS_PER_POLL {
            *self.steps = 0;
            if self.limits.stopped().is_some() {
                return false;
            }
        }
        let plan = self.plan;
        let Some(step) = plan.steps.get(depth) else {
            found(self.binding);
            return true;
        };
        match &step.access {
            Access::Test { atom, exclude } => {
                let atom = &self.body.atoms[*atom as usize];
                let relation = &self.relations[atom.predicate.index()];
                let mut key = [0; WIDEST_KEY];
                let key = key_of(&atom.arguments, self.binding, &mut key);
                match relation.find(key.as_ref()) {
                    Some(row)
                        if row < relation.visible() && !(*exclude && row == self.excluded) =>
                    {
                        let price = self.purse.pay(relation, atom.predicate.0, row);
                        let Some(price) = price else { return true };
                        let finished = !self.pass(&step.checks) || self.step(depth + 1, found);
                        self.purse.take_back(price);
                        finished
                    }
                    _ => true,
                }
            }
            Access::Assign { variable, term } => {
                let object = value(*term, self.binding);
                self.binding[*variable as usize] = object;
                let receipt = self.purse.receipt();
                let fits = self.body.domains[*variable as usize].contains(object)
                    && self.purse.pay_object(object)
                    && self.pass(&step.checks);
                let finished = !fits || self.step(depth + 1, found);
                self.purse.take_back(receipt);
                finished
            }
            Access::Domain { variable } => {
                let body = self.body;
                for &object in &body.domains[*variable as usize].list {
                    self.binding[*variable as usize] = object;
                    let receipt = self.purse.receipt();
                    let fits = self.purse.pay_object(object) && self.pass(&step.checks);
                    let finished = !fits || self.step(depth + 1, found);
                    self.purse.take_back(receipt);
                    if !finished {
                        return false;
                    }
                }
                true
            }
            Access::Rows { atom, exclude, index, columns, binds, repeats } => {
                let body = self.body;
                let atom = &body.atoms[*atom as usize];
                let relation = &self.relations[atom.predicate.index()];
                let mut key = [0; WIDEST_KEY];
                for (slot, &column) in key.iter_mut().zip(columns) {
                    *slot = value(atom.arguments[column as usize], self.binding);
                }
                let bound = &key[..columns.len().min(WIDEST_KEY)];
                // Where nothing can be paid for any more, what costs something is passed over at once, except what is paid for already.
                let short = self.purse.is_short(relation.charged());
                let paid = if short { self.purse.paid_of(atom.predicate.0) } else { Vec::new() };
                let mut paid = paid.into_iter();
                let free = match index {
                    _ if !short => NONE,
                    Some(index) => relation.first_free(*index, bound),
                    None => relation.free().wrapping_sub(1),
                };
                let mut row = match index {
                    _ if short => paid.next().unwrap_or(free),
                    Some(index) => relation.first(*index, bound),
                    None => relation.visible().wrapping_sub(1),
                };
                while row != NONE {
                    let values = relation.row(row);
                    let fits = columns
                        .iter()
                        .zip(&key)
                        .all(|(&column, &wanted)| values[column as usize] == wanted)
                        && columns.iter().skip(WIDEST_KEY).all(|&column| {
                            values[column as usize]
                                == value(atom.arguments[column as usize], self.binding)
                        })
                        && !(*exclude && row == self.excluded);
                    if fits
                        && self.bind(values, binds, repeats)
                        && self.pass(&step.checks)
                        && let Some(price) = self.purse.pay(relation, atom.predicate.0, row)
                    {
                        let finished = self.step(depth + 1, found);
                        self.purse.take_back(price);
                        if !finished {
                            return false;
                        }
                    }
                    row = match index {
                        _ if short && relation.price(row) > 0 => paid.next().unwrap_or(free),
                        Some(index) => relation.next(*index, row),
                        None => row.wrapping_sub(1),
                    };
                }
                true
            }
        }
    }

    #[inline]
    fn bind(&mut self, values: &[u32], binds: &[(u32, u32)], repeats: &[(u32, u32)]) -> bool {
        for &(column, variable) in binds {
            let object = values[column as usize];
            if !self.body.domains[variable as usize].contains(object) {
                return false;
            }
            self.binding[variable as usize] = object;
        }
        repeats
            .iter()
            .all(|&(column, variable)| values[column as usize] == self.binding[variable as usize])
    }
}

/// The values of `terms`, in `buffer` where they fit.
pub fn key_of<'a>(
    terms: &[Term],
    binding: &[u32],
    buffer: &'a mut [u32; WIDEST_KEY],
) -> std::borrow::Cow<'a, [u32]> {
    if terms.len() > buffer.len() {
        return terms.iter().map(|&term| value(term, binding)).collect();
    }
    for (slot, &term) in buffer.iter_mut().zip(terms) {
        *slot = value(term, binding);
    }
    std::borrow::Cow::Borrowed(&buffer[..terms.len()])
}
