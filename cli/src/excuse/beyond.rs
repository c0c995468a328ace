//! What lies beyond the initial state: goals that cannot be had together, and operators that are missing.

use lang::model::{ObjectId, Term};
use lang::plan;
use planner::excuse::goals::{self, Conflicts};
use planner::excuse::operators::{self, Abstract, Missing, Step};
use planner::excuse::{Outcome, Question};
use serde_json::{Value, json};

use super::report::FEW;
use super::words::{Words, add, listed};
use crate::args::excuse::Excuse;
use crate::input::{self, Input};
use crate::limits::Watch;
use crate::terminal::Terminal;

/// So many conflicts are looked for.
const MOST_CONFLICTS: usize = 100;

/// What was found out beyond the initial state.
#[derive(Debug, Default)]
pub struct Beyond {
    /// Which parts of the goal cannot be had together, if that was asked.
    pub conflicts: Option<Conflicts>,
    /// Which missing operators would be enough, if that was asked, and whether no smaller set would be.
    pub missing: Option<(Vec<Missing>, bool)>,
}

impl Beyond {
    /// Looks at what was asked for, and at both where no change of the initial state helps.
    pub fn look(
        arguments: &Excuse,
        input: &Input,
        question: &Question,
        outcome: &Outcome,
        watch: &Watch,
        terminal: &mut Terminal,
    ) -> Self {
        let (domain, problem, limits) = (&input.domain, &input.problem, &watch.limits);
        let lost = matches!(outcome, Outcome::None { .. });
        let solvable = matches!(outcome, Outcome::Solvable(_) | Outcome::Undecided(_));
        let mut beyond = Self::default();
        if solvable {
            return beyond;
        }
        let mut told = |unsupported| {
            let format = arguments.output_format.of_diagnostics();
            input.report(input::unsupported(&unsupported), format, terminal);
        };
        if arguments.goals || lost {
            match goals::conflicts(domain, problem, MOST_CONFLICTS, limits) {
                Ok(conflicts) => beyond.conflicts = conflicts,
                Err(unsupported) => told(unsupported),
            }
        }
        if arguments.operators || lost {
            match operators::missing(domain, problem, &question.policy, limits) {
                Ok(missing) => beyond.missing = Some(missing),
                Err(unsupported) => told(unsupported),
            }
        }
        beyond
    }

    /// In words.
    pub fn text(&self, input: &Input) -> String {
        let words = Words { domain: &input.domain, problem: &input.problem };
        let mut text = String::new();
        if let Some(conflicts) = &self.conflicts {
            text.push_str(&conflicts_text(conflicts, words));
        }
        if let Some((missing, refuted)) = &self.missing {
            text.push_str(&missing_text(missing, *refuted, words));
        }
        text
    }

    /// Adds it to a JSON document.
    pub fn add_to(&self, document: &mut Value, input: &Input) {
        let words = Words { domain: &input.domain, problem: &input.problem };
        if let Some(conflicts) = &self.conflicts {
            let sets = |sets: &[u64]| -> Vec<Vec<String>> {
                sets.iter().map(|&set| parts(conflicts, set, words)).collect()
            };
            document["goals"] = json!({
                "conflicts": sets(&conflicts.conflicts),
                "feasible": sets(&conflicts.feasible),
                "complete": conflicts.complete,
            });
        }
        if let Some((missing, refuted)) = &self.missing {
            let sets: Vec<Value> = missing
                .iter()
                .map(|one| {
                    let operators: Vec<Value> = one
                        .operators
                        .iter()
                        .map(|operator| {
                            json!({
                                "pddl": pddl(operator, words),
                                "makes": operator.uses.iter().map(|fact| words.atom(fact)).collect::<Vec<_>>(),
                            })
                        })
                        .collect();
                    json!({ "operators": operators, "plan": plan(one, words) })
                })
                .collect();
            document["operators"] = json!({ "sets": sets, "proven": refuted });
        }
    }
}

/// The parts of a goal that are in a set.
fn parts(conflicts: &Conflicts, set: u64, words: Words<'_>) -> Vec<String> {
    goals::bits(set).map(|part| words.condition(&conflicts.parts[part])).collect()
}

fn conflicts_text(conflicts: &Conflicts, words: Words<'_>) -> String {
    let mut text = String::from("\nOf the goal ");
    let all = conflicts.parts.len();
    let alone: Vec<String> = conflicts
        .conflicts
        .iter()
        .filter(|set| set.is_power_of_two())
        .flat_map(|&set| parts(conflicts, set, words))
        .collect();
    let together: Vec<&u64> =
        conflicts.conflicts.iter().filter(|set| set.count_ones() > 1).collect();
    if !alone.is_empty() {
        text.push_str("there is no plan for\n");
        for part in &alone {
            add(&mut text, format_args!("  {part}\n"));
        }
    }
    if !together.is_empty() {
        let word = if alone.is_empty() { "" } else { "Of the rest, " };
        add(&mut text, format_args!("{word}these cannot be had together:\n"));
        for &&set in &together {
            add(&mut text, format_args!("  {}\n", listed(&parts(conflicts, set, words))));
        }
    }
    if let Some(&best) = conflicts.feasible.iter().max_by_key(|set| set.count_ones()) {
        add(
            &mut text,
            format_args!("A plan can have {} of its {all} parts at once.\n", best.count_ones()),
        );
    } else if alone.len() < all {
        text.push_str("No part of it alone is known to have a plan.\n");
    }
    if !conflicts.complete {
        text.push_str("There may be more conflicts.\n");
    }
    text
}

fn missing_text(missing: &[Missing], refuted: bool, words: Words<'_>) -> String {
    let mut text = String::from("\n");
    if missing.is_empty() {
        text.push_str(if refuted {
            "No three missing operators would be enough, each of which makes facts of one predicate true.\n"
        } else {
            "No missing operator was found that would be enough.\n"
        });
        return text;
    }
    let count = missing[0].operators.len();
    match count {
        1 => text.push_str("One missing operator would be enough"),
        count => add(&mut text, format_args!("{count} missing operators would be enough")),
    }
    text.push_str(if missing.len() == 1 { ":\n" } else { "; any of these:\n" });
    for (number, one) in missing.iter().enumerate() {
        add(&mut text, format_args!("\n{}. ", number + 1));
        let shown: Vec<String> =
            one.operators.iter().map(|operator| pddl(operator, words)).collect();
        text.push_str(&shown.join("\n   ").replace('\n', "\n   "));
        let uses: usize = one.operators.iter().map(|operator| operator.uses.len()).sum();
        let times = if uses == 1 { "once".to_owned() } else { format!("{uses} times") };
        add(
            &mut text,
            format_args!("\n   It is used {times} in a plan of {} steps:\n", one.plan.len()),
        );
        let steps = plan(one, words);
        let shown = if number == 0 || steps.len() <= FEW { steps.len() } else { FEW };
        for step in &steps[..shown] {
            add(&mut text, format_args!("     {step}\n"));
        }
        if shown < steps.len() {
            add(&mut text, format_args!("     … and {} more\n", steps.len() - shown));
        }
    }
    text
}

/// A plan with missing operators, a step a line.
fn plan(missing: &Missing, words: Words<'_>) -> Vec<String> {
    let step = |step: &Step| match step {
        Step::Known(step) => plan::line(step, words.domain, words.problem),
        Step::Missing(fact) => format!("* something that {}", words.makes(fact)),
    };
    missing.plan.iter().map(step).collect()
}

/// A missing operator as an action that is still to be written.
fn pddl(operator: &Abstract, words: Words<'_>) -> String {
    let domain = words.domain;
    let declaration = &domain.predicates[operator.predicate.index()];
    let name = |term: &Term| match term {
        Term::Variable(variable) => declaration.parameters[variable.index()].name.text.clone(),
        Term::Object(object) => words.object(ObjectId(object.0)),
    };
    let atom = |atom: &lang::model::Atom| {
        let mut text = format!("({}", domain.predicates[atom.predicate.index()].name.text);
        for term in &atom.arguments {
            text.push(' ');
            text.push_str(&name(term));
        }
        text.push(')');
        text
    };
    let typed = domain.types.len() > 1;
    let parameters: Vec<String> = declaration
        .parameters
        .iter()
        .map(|parameter| {
            let types: Vec<&str> = parameter
                .types
                .iter()
                .map(|of| domain.types[of.index()].name.text.as_str())
                .collect();
            match types.as_slice() {
                [one] if typed => format!("{} - {one}", parameter.name.text),
                several if typed && several.len() > 1 => {
                    format!("{} - (either {})", parameter.name.text, several.join(" "))
                }
                _ => parameter.name.text.clone(),
            }
        })
        .collect();
    let mut made = vec![atom(&lang::model::Atom {
        predicate: operator.predicate,
        arguments: (0..declaration.parameters.len() as u32)
            .map(|one| Term::Variable(lang::model::VariableId(one)))
            .collect(),
    })];
    made.extend(operator.removes.iter().map(|one| format!("(not {})", atom(one))));
    let before: Vec<String> = operator.before.iter().map(atom).collect();
    let all = |parts: &[String]| match parts {
        [] => "()".to_owned(),
        [one] => one.clone(),
        parts => format!("(and {})", parts.join(" ")),
    };
    format!(
        "(:action make-{}\n  :parameters ({})\n  :precondition {}\n  :effect {})",
        declaration.name.text,
        parameters.join(" "),
        all(&before),
        all(&made)
    )
}
