//! Problems.

use hashbrown::HashTable;
use hashbrown::hash_table::Entry;
use rust_decimal::Decimal;
use rustc_hash::FxHasher;

use std::hash::{Hash, Hasher};

use super::condition::Setting;
use super::record::Reading;
use super::requirement::{self, Flags, Need};
use super::scope::{self, Bindings, Callee};
use super::value::{self, Value};
use super::{Names, Report, World, agents, condition, domain, name, network};
use crate::ast::{self, EntryKind, Feature, ProblemSection};
use crate::diagnostic::{
    Diagnostics, domain_name_mismatch, unexpected_item, uninitialised_function, variable_in_init,
    wrong_value,
};
use crate::model::{
    Doing, Domain, Expression, Fact, Formula, FunctionId, FunctionValue, Metric, ObjectId, Problem,
    Use,
};
use crate::source::Span;
use crate::symbol::{Namespace, Occurrences, Role, Symbol};
use crate::syntax;

/// Resolves a problem against its domain.
pub fn problem(
    ast: &ast::Problem<'_>,
    domain: &Domain,
    diagnostics: &mut Diagnostics,
    occurrences: Option<&mut Occurrences>,
) -> Problem {
    let sections = || {
        ast.sections.iter().filter_map(|section| match section {
            ProblemSection::Requirements(names) => Some(names),
            _ => None,
        })
    };
    let declared = requirement::read(sections().flatten().copied(), diagnostics);
    let place = requirement::place(sections().flatten().last().copied(), ast.name);
    let mut report = Report::new(diagnostics, declared, place, occurrences);
    report.declared_here(ast.name, Namespace::Problem);
    report.declare(Flags::from_model(&domain.requirements));
    // A domain that has types has been told already if it does not say so.
    if domain.types.len() > 1 {
        report.declare(Flags::TYPES);
    }
    // Without a domain no name can be called unknown.
    report.blind = domain.name.text.is_empty() && domain.predicates.is_empty();
    report.preferences.clone_from(&domain.preferences);
    let mut names = table(domain);
    let mut problem = Problem {
        name: name(ast.name),
        objects: domain.constants.clone(),
        init: Vec::new(),
        values: Vec::new(),
        goal_scope: crate::model::Scope::default(),
        goal: Formula::truth(ast.name.span),
        metric: None,
        uses: Vec::new(),
    };
    let place = format!("`:types` of domain `{}`", domain.name.text);
    for section in &ast.sections {
        match section {
            ProblemSection::Objects(list) => {
                domain::objects(
                    list,
                    "object",
                    &place,
                    &mut problem.objects,
                    &mut names,
                    &mut report,
                );
            }
            ProblemSection::Domain(asked) if asked.is(&domain.name.text) => {
                report.found(*asked, Symbol::at(Namespace::Domain, domain.name.span));
            }
            ProblemSection::Domain(asked) if !domain.name.text.is_empty() => {
                report.lost(*asked, Namespace::Domain);
                let mismatch = domain_name_mismatch::domain_name_mismatch;
                report.push(mismatch(asked.text, asked.span, &domain.name.text, domain.name.span));
            }
            ProblemSection::Unread(unread) => report.uses(unread.feature, unread.keyword.span),
            _ => {}
        }
    }
    let objects = std::mem::take(&mut problem.objects);
    let places = format!("`:objects` nor in `:constants` of domain `{}`", domain.name.text);
    let world = World { domain, objects: &objects, names: &names, places: &places };
    contents(ast, &world, &mut problem, &mut report);
    (problem.objects, problem.uses) = (objects, report.uses);
    problem
}

/// The names of the domain.
fn table(domain: &Domain) -> Names<'_> {
    let mut names = Names::default();
    for (id, of) in domain.types.iter().enumerate() {
        names.types.insert(&of.name.text, id as u32);
    }
    for (id, of) in domain.predicates.iter().enumerate() {
        names.predicates.insert(&of.name.text, id as u32);
    }
    for (id, of) in domain.functions.iter().enumerate() {
        names.functions.insert(&of.name.text, id as u32);
    }
    for (id, of) in domain.constants.iter().enumerate() {
        names.objects.insert(&of.name.text, id as u32);
    }
    for (id, of) in domain.signatures.iter().enumerate() {
        let table = if of.doing == Doing::Task { &mut names.tasks } else { &mut names.actions };
        table.insert(&of.name.text, id as u32);
    }
    names
}

/// The initial state, the goal, the constraints and the metric.
fn contents<'a>(
    ast: &ast::Problem<'a>,
    world: &World<'_, 'a>,
    problem: &mut Problem,
    report: &mut Report<'_>,
) {
    let mut state = State { seen: HashTable::new(), valued: HashTable::new(), world, report };
    let mut goal = None;
    let mut metrics = Vec::new();
    for section in &ast.sections {
        match section {
            ProblemSection::Init(init) => state.init(init, problem),
            ProblemSection::Goal(read) => {
                let (conditions, bindings): &mut (Vec<Formula>, Bindings<'a>) =
                    goal.get_or_insert_with(|| (Vec::new(), Bindings::new("the goal".to_owned())));
                let agent = read
                    .agent
                    .as_ref()
                    .and_then(|agent| agents::agent(agent, bindings, world, state.report));
                for formula in &read.formulas {
                    let condition =
                        condition::check(formula, 0, Setting::State, bindings, world, state.report);
                    conditions.push(agents::of_each(agent.as_ref(), condition));
                }
            }
            ProblemSection::Constraints(keyword, formulas) => {
                state.report.need(Need::Constraint, keyword.span);
                state.report.uses(Feature::Constraints, keyword.span);
                let mut bindings = Bindings::new("`:constraints`".to_owned());
                for formula in formulas {
                    let setting = Setting::Plan;
                    condition::check(formula, 0, setting, &mut bindings, world, state.report);
                }
            }
            ProblemSection::Network(asked) => network::initial(asked, world, state.report),
            ProblemSection::Metric(metric) => metrics.push(metric),
            _ => {}
        }
    }
    if let Some((conditions, bindings)) = goal {
        let span = conditions
            .first()
            .map_or(problem.name.span, |first| first.nodes[first.root().index()].span);
        problem.goal = condition::conjoin(conditions, span);
        problem.goal_scope = bindings.scope;
    } else if !problem.name.text.is_empty() && !report.uses.iter().any(Use::replaces_goal) {
        report
            .push(unexpected_item::missing_item("a `(:goal …)` in the problem", problem.name.span));
    }
    for metric in metrics {
        let read = read_metric(metric, world, report);
        let before = problem.metric.take();
        if let (Some(one), Some(other)) = (&read, &before)
            && one.function != other.function
        {
            report.uses(Feature::Metrics, metric.keyword.span);
        }
        problem.metric = read.or(before);
    }
    uninitialised(world.domain, problem, report);
}

/// What a metric asks for, if it is to minimise a function without parameters; else its use is noted.
fn read_metric<'a>(
    metric: &ast::Metric<'a>,
    world: &World<'_, 'a>,
    report: &mut Report<'_>,
) -> Option<Metric> {
    let mut bindings = Bindings::new("the metric".to_owned());
    let agent =
        metric.agent.as_ref().and_then(|agent| agents::agent(agent, &mut bindings, world, report));
    let formula = metric.value.as_ref()?;
    let span = formula.nodes[0].place.0;
    report.metric = true;
    report.reading = Reading::Asked;
    let value = value::check(formula, 0, &mut bindings, world, report);
    (report.metric, report.reading) = (false, Reading::Beside);
    value::number(&value, span, "`:metric`", world, report);
    let function = match value {
        Value::Number(Some(Expression::Function(function, terms)))
            if terms.is_empty()
                || agents::sums(agent.as_ref(), function, &terms, &bindings, world) =>
        {
            function
        }
        Value::Number(_) => {
            report.uses(Feature::Metrics, metric.keyword.span);
            return None;
        }
        _ => return None,
    };
    if !metric.direction.is("minimize") {
        report.uses(Feature::Metrics, metric.keyword.span);
        return None;
    }
    Some(Metric { function, span })
}

/// Warns of functions whose values a plan depends on, and that never have one.
fn uninitialised(domain: &Domain, problem: &Problem, report: &mut Report<'_>) {
    if report.strange {
        return;
    }
    let mut valued = vec![false; domain.functions.len()];
    problem.values.iter().for_each(|value| valued[value.function.index()] = true);
    let here = std::mem::take(&mut report.read);
    for (index, function) in domain.functions.iter().enumerate() {
        let id = FunctionId(index as u32);
        let place = here.get(&id).map(|&span| (span, true));
        let place = place.or(function.read.map(|span| (span, false)));
        let Some((span, here)) = place.filter(|_| !valued[index] && !function.assigned) else {
            continue;
        };
        if report.timed.contains(&id) {
            continue;
        }
        let name = &function.name.text;
        report.push(uninitialised_function::uninitialised_function(
            name,
            !function.parameters.is_empty(),
            span,
            here,
        ));
    }
}

/// The initial state while it is read.
struct State<'c, 'w, 'd, 'a> {
    /// The facts by their position, to drop repetitions.
    seen: HashTable<u32>,
    /// The values of functions by their position, likewise.
    valued: HashTable<u32>,
    world: &'c World<'w, 'a>,
    report: &'c mut Report<'d>,
}

impl<'a> State<'_, '_, '_, 'a> {
    fn init(&mut self, init: &ast::Init<'a>, problem: &mut Problem) {
        for entry in &init.entries {
            let span = entry.place.0;
            if let Some(time) = entry.time {
                self.report.need(Need::TimedLiteral, time.span);
                self.report.uses(Feature::TimedLiterals, time.span);
            }
            match &entry.kind {
                EntryKind::Fact(fact) if entry.time.is_none() => {
                    if let Some(fact) = self.fact(fact.name, init.arguments(fact), span) {
                        self.add(fact, &mut problem.init);
                    }
                }
                // What is not listed is false anyway; the names must be right all the same.
                EntryKind::Fact(fact) | EntryKind::Absent(fact) => {
                    self.fact(fact.name, init.arguments(fact), span);
                }
                EntryKind::Value(function, value) => {
                    let arguments = init.arguments(function);
                    self.report.next(Role::Initial);
                    let Some(id) = scope::function(function.name, self.world, self.report) else {
                        self.report.strange = true;
                        continue;
                    };
                    let arguments =
                        self.arguments(&Callee::function(id, self.world), arguments, span);
                    let value = self.value(id, *value);
                    // What is said of a function in the future is a value all the same.
                    let later = entry.time.is_some() || value.is_none();
                    if later {
                        self.report.timed.insert(id);
                    }
                    if let (Some(arguments), Some(value), false) = (arguments, value, later) {
                        let value = FunctionValue { function: id, arguments, value, span };
                        self.set(function.name, value, &mut problem.values);
                    }
                }
                EntryKind::Unread(unread) => {
                    self.report.uses(unread.feature, unread.keyword.span);
                }
            }
        }
    }

    /// The number that a function has, or nothing if it has an object or something is wrong.
    fn value(&mut self, function: FunctionId, value: ast::Name<'a>) -> Option<Decimal> {
        let numeric = syntax::is_number(value.text);
        let declared = &self.world.domain.functions[function.index()];
        let callee = Callee::function(function, self.world).describe();
        let Some(types) = &declared.values else {
            if numeric {
                let number = number(value.text);
                if number.is_none() {
                    self.report.push(unexpected_item::unexpected_item("a number", value.span));
                }
                return number;
            }
            self.report.push(wrong_value::initial(&callee, "a number", value.span));
            return None;
        };
        let wanted = format!("of type `{}`", self.world.describe_types(types));
        if numeric {
            self.report.push(wrong_value::initial(&callee, &wanted, value.span));
        } else if !value.is("undefined")
            && let Some(object) = scope::object(value, self.world, self.report)
        {
            let have = &self.world.objects[object.index()].types;
            if !self.world.fits(have, true, types) {
                self.report.push(wrong_value::initial(&callee, &wanted, value.span));
            }
        }
        self.report.uses(Feature::ObjectFluents, value.span);
        None
    }

    fn add(&mut self, fact: Fact, facts: &mut Vec<Fact>) {
        let id = facts.len() as u32;
        let same = |&other: &u32| facts[other as usize] == fact;
        let rehash = |&other: &u32| hash(&facts[other as usize]);
        if let Entry::Vacant(entry) = self.seen.entry(hash(&fact), same, rehash) {
            entry.insert(id);
            facts.push(fact);
        }
    }

    /// Adds a value, unless there is one for the same function and arguments.
    fn set(
        &mut self,
        spelling: ast::Name<'a>,
        value: FunctionValue,
        values: &mut Vec<FunctionValue>,
    ) {
        let key = |value: &FunctionValue| {
            let mut hasher = FxHasher::default();
            (value.function, &value.arguments).hash(&mut hasher);
            hasher.finish()
        };
        let same = |&other: &u32| {
            let other = &values[other as usize];
            other.function == value.function && other.arguments == value.arguments
        };
        match self.valued.entry(key(&value), same, |&other| key(&values[other as usize])) {
            Entry::Vacant(entry) => {
                entry.insert(values.len() as u32);
                values.push(value);
            }
            Entry::Occupied(entry) => {
                let first = &values[*entry.get() as usize];
                if first.value != value.value {
                    let detail = format!(", as {} and as {}", first.value, value.value);
                    let again = ast::Name { span: value.span, ..spelling };
                    domain::report_duplicate(
                        "the value of",
                        again,
                        &detail,
                        first.span,
                        self.report,
                    );
                }
            }
        }
    }

    fn fact(
        &mut self,
        spelling: ast::Name<'a>,
        arguments: &[ast::Name<'a>],
        span: Span,
    ) -> Option<Fact> {
        self.report.next(Role::Initial);
        let predicate = scope::predicate(spelling, self.world, self.report)?;
        let arguments =
            self.arguments(&Callee::predicate(predicate, self.world), arguments, span)?;
        Some(Fact { predicate, arguments })
    }

    fn arguments(
        &mut self,
        callee: &Callee<'_>,
        spellings: &[ast::Name<'a>],
        span: Span,
    ) -> Option<Box<[ObjectId]>> {
        let mut ids = Vec::with_capacity(spellings.len());
        for &spelling in spellings {
            if spelling.is_variable() {
                if self.report.first(&variable_in_init::RULE, spelling.text) {
                    self.report
                        .push(variable_in_init::variable_in_init(spelling.text, spelling.span));
                }
                continue;
            }
            ids.extend(scope::object(spelling, self.world, self.report));
        }
        if spellings.len() != callee.parameters.len() {
            callee.report_arity(spellings, spellings.len(), span, self.world, self.report);
            return None;
        }
        if ids.len() != spellings.len() {
            return None;
        }
        for ((&id, &spelling), parameter) in ids.iter().zip(spellings).zip(callee.parameters) {
            let have = &self.world.objects[id.index()].types;
            if !self.world.fits(have, true, &parameter.types) {
                let found = self.world.describe_types(have);
                callee.report_type(spelling, &found, &parameter.types, self.world, self.report);
                return None;
            }
        }
        Some(ids.into_boxed_slice())
    }
}

fn hash(fact: &Fact) -> u64 {
    let mut hasher = FxHasher::default();
    fact.hash(&mut hasher);
    hasher.finish()
}

/// A number in any of the forms that tools write: `4`, `4.0`, `.5`, `5.`, `-1`, `1e3`.
pub(super) fn number(text: &str) -> Option<Decimal> {
    let text = text.strip_prefix('+').unwrap_or(text);
    let text = text.strip_suffix('.').unwrap_or(text);
    if text.contains(['e', 'E']) { Decimal::from_scientific(text).ok() } else { text.parse().ok() }
}
