//! Variables and what they may have go in; their objects, the tables about them, and one action for each way to change one come out.

use std::collections::BTreeMap;

use lang::model::{Fact, ObjectId, PredicateId, Scope, Term, TypeId, Variable};

use super::begin::Phases;
use super::choices::Choices;
use super::claim;
use super::task::{Draft, Task};

/// What tells the facts before a change apart: the predicate, and how many groups are freed.
type From = Option<(PredicateId, usize)>;

/// What tells the facts after a change apart: the predicate, and whether groups have to be claimed.
type To = Option<(PredicateId, bool)>;

/// The ways to change a variable that one action says.
struct Way {
    cost: u32,
    /// What holds before and after, of each variable.
    pairs: Vec<(Option<Fact>, Option<Fact>)>,
}

/// Adds variables and their changes.
pub(super) fn add(task: &mut Task, phases: &Phases, choices: &Choices) {
    if choices.variables.is_empty() {
        return;
    }
    let of = task.new_type("variable");
    let tokens = claim::tokens(task, choices, of);
    let variable = task.variable("?variable", &[of]);
    let untouched = task.predicate(
        "untouched",
        vec![variable.clone()],
        "The variable is as it was; each is changed once at most.",
    );
    let ways = ways(choices);
    let mut was: BTreeMap<From, PredicateId> = BTreeMap::new();
    let mut may: BTreeMap<To, PredicateId> = BTreeMap::new();
    for &(from, _) in ways.keys() {
        let words = if was.is_empty() { "What a variable is initially." } else { "" };
        let groups = from.map_or(0, |(_, groups)| groups);
        was.entry(from).or_insert_with(|| {
            let mut parameters = columns(task, &variable, from.map(|(predicate, _)| predicate));
            parameters.extend(tokens.parameters(task, groups));
            task.predicate(
                &format!("was-{}", word(task, from.map(|from| from.0))),
                parameters,
                words,
            )
        });
    }
    for &(_, to) in ways.keys() {
        let words = if may.is_empty() { "What a variable may be instead." } else { "" };
        may.entry(to).or_insert_with(|| {
            let predicate = to.map(|(predicate, _)| predicate);
            let parameters = columns(task, &variable, predicate);
            task.predicate(&format!("may-be-{}", word(task, predicate)), parameters, words)
        });
    }
    let claims = claim::tables(task, choices, &tokens, &variable);
    for choice in &choices.variables {
        let facts = choice.from.iter().chain(choice.to.iter().filter_map(|(to, _)| to.as_ref()));
        let name = name(task, &facts.collect::<Vec<_>>());
        let object = task.object(&name, of);
        task.init(untouched, vec![object]);
        let mut row = row(object, choice.from.as_ref());
        row.extend(choice.from.iter().flat_map(|fact| tokens.of(choices, fact)));
        task.init(was[&before(choices, choice.from.as_ref())], row);
        for (to, _) in &choice.to {
            let row = self::row(object, to.as_ref());
            task.init(may[&after(choices, to.as_ref())], row.clone());
            if let Some(fact) = to {
                claims.init(task, choices, &tokens, row, fact);
            }
        }
        tokens.settles(task, choices, choice, object);
    }
    tokens.fill(task, choices);
    let frame = Frame { phases, untouched, tokens: &tokens, variable: &variable };
    for ((from, to), way) in &ways {
        let tables = (was[from], may[to]);
        task.action(frame.action(task, (*from, *to), tables, way));
    }
    claims.actions(task, phases, &tokens, &variable);
}

fn before(choices: &Choices, fact: Option<&Fact>) -> From {
    fact.map(|fact| (fact.predicate, choices.groups(fact).len()))
}

fn after(choices: &Choices, fact: Option<&Fact>) -> To {
    fact.map(|fact| (fact.predicate, !choices.groups(fact).is_empty()))
}

/// All ways to change a variable, by what tells them apart.
fn ways(choices: &Choices) -> BTreeMap<(From, To), Way> {
    let mut ways: BTreeMap<(From, To), Way> = BTreeMap::new();
    for choice in &choices.variables {
        let from = choice.from.as_ref();
        for (to, cost) in &choice.to {
            let key = (before(choices, from), after(choices, to.as_ref()));
            let way = ways.entry(key).or_insert(Way { cost: *cost, pairs: Vec::new() });
            assert_eq!(way.cost, *cost, "what a change costs depends on the predicate alone");
            way.pairs.push((choice.from.clone(), to.clone()));
        }
    }
    ways
}

/// The name of a predicate, or what stands for none.
fn word(task: &Task, predicate: Option<PredicateId>) -> String {
    match predicate {
        Some(id) => task.domain.predicates[id.index()].name.text.clone(),
        None => "nothing".to_owned(),
    }
}

/// A variable, then what a predicate is about.
pub(super) fn columns(
    task: &Task,
    variable: &Variable,
    predicate: Option<PredicateId>,
) -> Vec<Variable> {
    let mut columns = vec![variable.clone()];
    columns.extend(predicate.iter().flat_map(|id| parameters(task, *id)));
    columns
}

pub(super) fn parameters(task: &Task, predicate: PredicateId) -> Vec<Variable> {
    task.domain.predicates[predicate.index()].parameters.clone()
}

/// A variable, then what a fact is about.
fn row(variable: ObjectId, fact: Option<&Fact>) -> Vec<ObjectId> {
    let mut row = vec![variable];
    row.extend(fact.iter().flat_map(|fact| fact.arguments.iter().copied()));
    row
}

/// What the actions of all ways to change a variable share.
struct Frame<'a> {
    phases: &'a Phases,
    untouched: PredicateId,
    tokens: &'a claim::Tokens,
    variable: &'a Variable,
}

impl Frame<'_> {
    /// The action of a way to change a variable.
    fn action(
        &self,
        task: &Task,
        (from, to): (From, To),
        (was, may): (PredicateId, PredicateId),
        way: &Way,
    ) -> Draft {
        let words = [word(task, from.map(|from| from.0)), word(task, to.map(|to| to.0))];
        let name = format!("change-{}-to-{}", words[0], words[1]);
        let mut draft = Draft::new(name, String::new());
        draft.cost = way.cost;
        let of = draft.parameter(self.variable.clone());
        let declared =
            |id: Option<PredicateId>| id.map_or_else(Vec::new, |id| parameters(task, id));
        let (left, right) = (declared(from.map(|from| from.0)), declared(to.map(|to| to.0)));
        let old: Vec<Term> = left.iter().map(|one| draft.parameter(one.clone())).collect();
        let new: Vec<Term> = right
            .iter()
            .enumerate()
            .map(|(at, one)| {
                if let Some(place) = shared(task, way, &left, one, at) {
                    return old[place];
                }
                let mut one = one.clone();
                if left.iter().any(|other| other.name.text.eq_ignore_ascii_case(&one.name.text)) {
                    let bare = one.name.text.trim_start_matches('?');
                    one.name.text = format!("?new-{bare}");
                }
                draft.parameter(one)
            })
            .collect();
        let groups: Vec<Term> = self
            .tokens
            .parameters(task, from.map_or(0, |(_, groups)| groups))
            .into_iter()
            .map(|group| draft.parameter(group))
            .collect();
        draft.needs(self.phases.editing, Vec::new());
        draft.needs(self.untouched, vec![of]);
        draft.needs(was, [&[of], &old[..], &groups].concat());
        draft.needs(may, [&[of], &new[..]].concat());
        draft.makes(self.untouched, vec![of], false);
        let atom = |predicate, terms: &[Term]| atom(task, &draft.scope, predicate, terms);
        draft.note = match (from, to) {
            (Some((from, _)), Some((to, _))) => {
                format!("Initially {} instead of {}.", atom(to, &new), atom(from, &old))
            }
            (None, Some((to, _))) => format!("Initially {}, too.", atom(to, &new)),
            (Some((from, _)), None) => format!("Initially not {}.", atom(from, &old)),
            (None, None) => String::new(),
        };
        if let Some((predicate, _)) = from {
            draft.makes(predicate, old, false);
        }
        if let Some((predicate, _)) = to {
            draft.makes(predicate, new, true);
        }
        self.tokens.change(&mut draft, of, groups, to.is_some_and(|(_, claims)| claims));
        draft
    }
}

/// An atom in words of PDDL.
pub(super) fn atom(task: &Task, scope: &Scope, predicate: PredicateId, terms: &[Term]) -> String {
    let name = |term: &Term| match term {
        Term::Variable(id) => {
            let text = &scope.variables[id.index()].name.text;
            format!(" ?{}", text.trim_start_matches('?'))
        }
        Term::Object(_) => String::new(),
    };
    let terms: String = terms.iter().map(name).collect();
    format!("({}{terms})", word(task, Some(predicate)))
}

/// Where among the arguments of what holds before, which are declared as `left`, is always what `one`, the argument at `at`, is after a change.
fn shared(task: &Task, way: &Way, left: &[Variable], one: &Variable, at: usize) -> Option<usize> {
    let fits = |types: &[TypeId]| {
        let within =
            |of: &TypeId| one.types.iter().any(|&above| task.domain.is_subtype(*of, above));
        types.iter().all(within)
    };
    let same = |place: usize| {
        way.pairs.iter().all(|(from, to)| {
            let argument = |fact: &Option<Fact>, at: usize| Some(fact.as_ref()?.arguments[at]);
            argument(from, place) == argument(to, at)
        })
    };
    let places: Vec<usize> =
        (0..left.len()).filter(|&place| fits(&left[place].types) && same(place)).collect();
    let named = |&&place: &&usize| left[place].name.text.eq_ignore_ascii_case(&one.name.text);
    places.iter().find(named).or(places.first()).copied()
}

/// What facts that exclude each other, or one alone, are called together.
pub(super) fn name(task: &Task, facts: &[&Fact]) -> String {
    let mut predicates: Vec<String> = Vec::new();
    for fact in facts {
        let name = word(task, Some(fact.predicate));
        if !predicates.contains(&name) {
            predicates.push(name);
        }
    }
    if predicates.len() > 3 {
        predicates.truncate(2);
        predicates.push("more".to_owned());
    }
    let mut common: Vec<ObjectId> = facts[0].arguments.to_vec();
    common.retain(|object| facts.iter().all(|fact| fact.arguments.contains(object)));
    common.dedup();
    let objects: Vec<&str> = common
        .iter()
        .map(|object| task.problem.objects[object.index()].name.text.as_str())
        .collect();
    let mut name = predicates.join("-or-");
    if facts.len() == 1 {
        name = format!("whether-{name}");
    }
    if !objects.is_empty() {
        name = format!("{name}--{}", objects.join("-"));
    }
    name
}
