//! Groups that several variables share go in; their tokens come out, and the actions with which what a change makes true claims them.
//!
//! There is a token for each group: it is free as long as no fact of the group holds, or the one that does still has to claim it.

use std::collections::BTreeMap;

use lang::model::{Atom, Fact, ObjectId, PredicateId, Term, TypeId, Variable};

use super::begin::Phases;
use super::change;
use super::choices::Choices;
use super::task::{Draft, Task};
use crate::excuse::Choice;

/// The tokens of groups, if there are any.
pub(super) struct Tokens {
    of: TypeId,
    /// The token of each group.
    objects: Vec<ObjectId>,
    /// A group has no fact, or only one that still has to claim it; a variable has a fact that still has to claim its groups.
    states: Option<(PredicateId, PredicateId)>,
}

/// Makes a token for each group.
pub(super) fn tokens(task: &mut Task, choices: &Choices, variables: TypeId) -> Tokens {
    if choices.groups.is_empty() {
        return Tokens { of: variables, objects: Vec::new(), states: None };
    }
    let of = task.new_type("group");
    let objects = choices
        .groups
        .iter()
        .map(|group| {
            let facts: Vec<&Fact> = group.facts.iter().collect();
            let name = format!("one-of-{}", change::name(task, &facts));
            task.object(&name, of)
        })
        .collect();
    let group = task.variable("?group", &[of]);
    let words = "Nothing has claimed the group, of which at most one fact may hold.";
    let unclaimed = task.predicate("unclaimed", vec![group], words);
    let variable = task.variable("?variable", &[variables]);
    let words = "What the variable was changed to still has to claim its groups.";
    let unsettled = task.predicate("unsettled", vec![variable], words);
    Tokens { of, objects, states: Some((unclaimed, unsettled)) }
}

impl Tokens {
    /// Variables for so many groups.
    pub(super) fn parameters(&self, task: &Task, count: usize) -> Vec<Variable> {
        let name = |number: usize| {
            if number == 0 { "?group".to_owned() } else { format!("?group-{}", number + 1) }
        };
        (0..count).map(|number| task.variable(&name(number), &[self.of])).collect()
    }

    /// The tokens of the groups of a fact.
    pub(super) fn of(&self, choices: &Choices, fact: &Fact) -> Vec<ObjectId> {
        choices.groups(fact).iter().map(|&group| self.objects[group]).collect()
    }

    /// What a change does to tokens.
    pub(super) fn change(
        &self,
        draft: &mut Draft,
        variable: Term,
        groups: Vec<Term>,
        claims: bool,
    ) {
        let Some((unclaimed, unsettled)) = self.states else { return };
        for group in groups {
            draft.makes(unclaimed, vec![group], true);
        }
        if claims {
            draft.makes(unsettled, vec![variable], true);
        }
    }

    /// Asks that what a variable is changed to has claimed its groups in the end.
    pub(super) fn settles(
        &self,
        task: &mut Task,
        choices: &Choices,
        choice: &Choice,
        object: ObjectId,
    ) {
        let mut made = choice.to.iter().filter_map(|(to, _)| to.as_ref());
        if let Some((_, unsettled)) = self.states
            && made.any(|fact| !choices.groups(fact).is_empty())
        {
            let arguments = vec![Term::Object(object)];
            task.goal(vec![(Atom { predicate: unsettled, arguments }, false)]);
        }
    }

    /// Says which groups are free initially, and asks that those which need a fact are not free in the end.
    pub(super) fn fill(&self, task: &mut Task, choices: &Choices) {
        let Some((unclaimed, _)) = self.states else { return };
        for (group, &object) in choices.groups.iter().zip(&self.objects) {
            if !group.held {
                task.init(unclaimed, vec![object]);
            }
            if group.exactly {
                let arguments = vec![Term::Object(object)];
                task.goal(vec![(Atom { predicate: unclaimed, arguments }, false)]);
            }
        }
    }
}

/// Which groups facts have to claim.
pub(super) struct Claims {
    /// By predicate and number of groups.
    tables: BTreeMap<(PredicateId, usize), PredicateId>,
}

/// Makes a table for each predicate and number of groups to claim.
pub(super) fn tables(
    task: &mut Task,
    choices: &Choices,
    tokens: &Tokens,
    variable: &Variable,
) -> Claims {
    let mut tables: BTreeMap<(PredicateId, usize), PredicateId> = BTreeMap::new();
    let facts = choices.variables.iter().flat_map(|choice| &choice.to);
    for fact in facts.filter_map(|(to, _)| to.as_ref()) {
        let groups = choices.groups(fact).len();
        let words = if tables.is_empty() { "The groups that it then has to claim." } else { "" };
        if groups > 0 {
            tables.entry((fact.predicate, groups)).or_insert_with(|| {
                let mut parameters = change::columns(task, variable, Some(fact.predicate));
                parameters.extend(tokens.parameters(task, groups));
                let name = &task.domain.predicates[fact.predicate.index()].name.text;
                task.predicate(&format!("claims-{name}"), parameters, words)
            });
        }
    }
    Claims { tables }
}

impl Claims {
    /// Says what a fact has to claim, if anything; `row` has its variable and its arguments.
    pub(super) fn init(
        &self,
        task: &mut Task,
        choices: &Choices,
        tokens: &Tokens,
        mut row: Vec<ObjectId>,
        fact: &Fact,
    ) {
        if let Some(&table) = self.tables.get(&(fact.predicate, choices.groups(fact).len())) {
            row.extend(tokens.of(choices, fact));
            task.init(table, row);
        }
    }

    /// Adds the actions that claim.
    pub(super) fn actions(
        &self,
        task: &mut Task,
        phases: &Phases,
        tokens: &Tokens,
        variable: &Variable,
    ) {
        let Some((unclaimed, unsettled)) = tokens.states else { return };
        for (&(predicate, count), &table) in &self.tables {
            let name = task.domain.predicates[predicate.index()].name.text.clone();
            let mut draft = Draft::new(format!("claim-{name}"), String::new());
            let of = draft.parameter(variable.clone());
            let declared = change::parameters(task, predicate);
            let terms: Vec<Term> = declared.into_iter().map(|one| draft.parameter(one)).collect();
            let groups = tokens.parameters(task, count);
            let groups: Vec<Term> = groups.into_iter().map(|one| draft.parameter(one)).collect();
            let fact = change::atom(task, &draft.scope, predicate, &terms);
            draft.note = format!("{fact}, which a change has made true, claims its groups.");
            draft.needs(phases.editing, Vec::new());
            draft.needs(unsettled, vec![of]);
            draft.needs(predicate, terms.clone());
            draft.needs(table, [&[of], &terms[..], &groups].concat());
            for &group in &groups {
                draft.needs(unclaimed, vec![group]);
            }
            draft.makes(unsettled, vec![of], false);
            for group in groups {
                draft.makes(unclaimed, vec![group], false);
            }
            task.action(draft);
        }
    }
}
