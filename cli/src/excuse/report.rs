//! What was found out goes in; the answer for a reader or for a program comes out.

use lang::model::Fact;
use lang::plan;
use planner::excuse::{Excuse, Origin, Outcome, Statistics, Unfinished, Why};
use serde_json::{Value, json};

use super::words::{Mood, Words, add, listed};
use crate::input::Input;

/// So many steps are shown of plans after the first.
pub const FEW: usize = 6;

/// How an answer is said.
pub struct Report<'a> {
    /// What was asked about.
    pub input: &'a Input,
    /// What was done.
    pub statistics: Statistics,
    /// CPU time of the search for excuses, in seconds.
    pub seconds: f64,
}

impl Report<'_> {
    fn words<'b>(&'b self, excuse: &'b Excuse) -> Words<'b> {
        Words { domain: &self.input.domain, problem: &excuse.problem }
    }

    /// The steps of an excuse's plan.
    fn steps(&self, excuse: &Excuse) -> Vec<String> {
        let line = |step| plan::line(step, &self.input.domain, &excuse.problem);
        excuse.plan.steps.iter().map(line).collect()
    }

    /// The whole answer in words.
    pub fn text(&self, outcome: &Outcome) -> String {
        match outcome {
            Outcome::Solvable(plan) => {
                let mut text = format!(
                    "The problem needs no excuse: it has a plan of {}.\n",
                    steps(plan.steps.len())
                );
                for step in &plan.steps {
                    add(
                        &mut text,
                        format_args!(
                            "     {}\n",
                            plan::line(step, &self.input.domain, &self.input.problem)
                        ),
                    );
                }
                text
            }
            Outcome::Excuses { missing, list, proven, complete } => {
                self.excuses(missing, list, *proven, *complete)
            }
            Outcome::None { presumed } => {
                let mut text = String::from(
                    "The problem has no plan, and no change of the initial state that is allowed gives it one.\n",
                );
                if *presumed {
                    text.push_str(
                        "This takes for granted that things are in one place or state where they are so now; `--presume-nothing` does not.\n",
                    );
                }
                text
            }
            Outcome::Unknown { bound, reason } => {
                let why = match reason {
                    Unfinished::Stopped(_) => "a limit was reached",
                    Unfinished::Large => {
                        "there are too many things that might be changed; `--only` and `--protect` leave some out"
                    }
                };
                format!(
                    "The problem has no plan. No excuse was found: {why}.\nNone costs less than {bound}.\n"
                )
            }
            Outcome::Undecided(_) => {
                "A limit was reached before it was known whether the problem has a plan.\n"
                    .to_owned()
            }
        }
    }

    fn excuses(&self, missing: &[Fact], list: &[Excuse], proven: bool, complete: bool) -> String {
        let mut text = String::from("The problem has no plan as it stands.\n");
        for (number, excuse) in list.iter().enumerate() {
            let words = self.words(excuse);
            add(&mut text, format_args!("\n{}. {}\n", number + 1, self.heading(excuse)));
            for change in &excuse.changes {
                add(&mut text, format_args!("     {}\n", formal(words, change)));
            }
            add(&mut text, format_args!("   {}\n", self.sentence(missing, excuse)));
            let steps = self.steps(excuse);
            // The first plan is shown whole; of others so much that they can be told apart.
            let shown = if number == 0 || steps.len() <= FEW { steps.len() } else { FEW };
            for step in &steps[..shown] {
                add(&mut text, format_args!("     {step}\n"));
            }
            if shown < steps.len() {
                add(&mut text, format_args!("     … and {} more\n", steps.len() - shown));
            }
            if let Some(&deeper) = excuse.follows_from.first() {
                add(
                    &mut text,
                    format_args!(
                        "   Excuse {} is the deeper cause: from there a plan leads here.\n",
                        deeper + 1
                    ),
                );
            }
        }
        text.push('\n');
        let cost = list.first().map_or(0, |excuse| excuse.cost);
        let ties = match (list.len(), complete) {
            (1, true) => ", and no other of the same cost",
            (_, true) => ", and no others of the same cost",
            (_, false) => "; there may be more of the same cost",
        };
        if proven {
            add(&mut text, format_args!("No excuse costs less than {cost}{ties}.\n"));
        } else {
            add(
                &mut text,
                format_args!("It is not proven that no excuse costs less than {cost}.\n"),
            );
        }
        text
    }

    /// What would have to be so.
    fn heading(&self, excuse: &Excuse) -> String {
        let words = self.words(excuse);
        let parts: Vec<String> =
            excuse.changes.iter().map(|change| words.change(change, false)).collect();
        format!("If {} (cost {})", listed(&parts), excuse.cost)
    }

    /// Why, in a sentence or three.
    pub fn sentence(&self, missing: &[Fact], excuse: &Excuse) -> String {
        let words = self.words(excuse);
        let mut text = String::new();
        let wishes: Vec<String> = missing.iter().take(3).map(|fact| words.wish(fact)).collect();
        if wishes.is_empty() {
            text.push_str("The goal as a whole is out of reach. ");
        } else {
            let more = if missing.len() > 3 { ", among others" } else { "" };
            add(&mut text, format_args!("The goal needs {}{more}. ", listed(&wishes)));
        }
        let mut subject = None;
        for change in excuse.changes.iter().take(4) {
            let old = self.input.problem.objects.len();
            let new = |fact: &Fact| fact.arguments.iter().any(|object| object.index() >= old);
            let told = change.object.is_some() || change.to.as_ref().is_some_and(new);
            let Some(to) = change.to.as_ref().filter(|_| !told) else { continue };
            let now = match &change.from {
                Some(from) => {
                    let it = words.subject(from) == words.subject(to);
                    words.clause(from, Mood::Is, it && !from.arguments.is_empty())
                }
                None => words.clause(to, Mood::IsNot, true),
            };
            match change.why {
                Why::NoAction => {
                    add(&mut text, format_args!("No action {}, and {now}. ", words.makes(to)));
                }
                Why::OutOfReach => {
                    add(
                        &mut text,
                        format_args!("What {} is out of reach, and {now}. ", words.makes(to)),
                    );
                }
                Why::TooLate | Why::Other => {
                    if let Some(from) = &change.from {
                        let now = words.clause(from, Mood::Is, false);
                        add(&mut text, format_args!("Now {now}. "));
                    }
                }
            }
            subject = to.arguments.first().copied();
        }
        let single = excuse.changes.len() == 1 && subject.is_some();
        let parts: Vec<String> = excuse
            .changes
            .iter()
            .map(|change| {
                words
                    .change(change, single && matches!(change.why, Why::NoAction | Why::OutOfReach))
            })
            .collect();
        let plan = excuse.plan.steps.len();
        add(&mut text, format_args!("If {}, this {plan}-step plan would do.", listed(&parts)));
        text
    }

    /// The whole answer as JSON.
    pub fn json(&self, outcome: &Outcome) -> Value {
        let statistics = json!({
            "seconds": self.seconds,
            "facts": self.statistics.facts,
            "operators": self.statistics.operators,
            "variables": self.statistics.variables,
            "edits": self.statistics.edits,
            "cores": self.statistics.cores,
            "nogoods": self.statistics.nogoods,
            "tried": self.statistics.tried,
        });
        let mut document = match outcome {
            Outcome::Solvable(plan) => {
                let line = |step| plan::line(step, &self.input.domain, &self.input.problem);
                let steps: Vec<String> = plan.steps.iter().map(line).collect();
                json!({ "status": "solvable", "plan": steps })
            }
            Outcome::Excuses { missing, list, proven, complete } => {
                let excuses: Vec<Value> = list
                    .iter()
                    .enumerate()
                    .map(|(number, excuse)| self.excuse(number, missing, excuse))
                    .collect();
                json!({
                    "status": "excuse",
                    "proven": proven,
                    "complete": complete,
                    "cost": list.first().map_or(0, |excuse| excuse.cost),
                    "excuses": excuses,
                })
            }
            Outcome::None { presumed } => {
                json!({ "status": "none", "proven": true, "presumed": presumed })
            }
            Outcome::Unknown { bound, reason } => {
                let reason = match reason {
                    Unfinished::Stopped(_) => "limit",
                    Unfinished::Large => "too many facts",
                };
                json!({
                    "status": "unknown", "unsolvable": true, "at_least": bound, "reason": reason
                })
            }
            Outcome::Undecided(_) => {
                json!({ "status": "unknown", "unsolvable": null, "reason": "limit" })
            }
        };
        document["statistics"] = statistics;
        document
    }

    fn excuse(&self, number: usize, missing: &[Fact], excuse: &Excuse) -> Value {
        let words = self.words(excuse);
        let edits: Vec<Value> = excuse
            .changes
            .iter()
            .map(|change| {
                let mut edit = json!({
                    "from": change.from.as_ref().map(|fact| words.atom(fact)),
                    "to": change.to.as_ref().map(|fact| words.atom(fact)),
                    "cost": change.cost,
                    "group": origin(change.origin),
                });
                if let Some((object, of)) = change.object {
                    edit["object"] = json!(words.object(object));
                    edit["type"] = json!(self.input.domain.types[of.index()].name.text);
                }
                edit
            })
            .collect();
        json!({
            "rank": number + 1,
            "level": excuse.level,
            "deeper": excuse.follows_from.iter().map(|one| one + 1).collect::<Vec<_>>(),
            "cost": excuse.cost,
            "edits": edits,
            "plan": self.steps(excuse),
            "sentence": self.sentence(missing, excuse),
        })
    }
}

/// `1 step`, `3 steps`.
fn steps(count: usize) -> String {
    if count == 1 { "1 step".to_owned() } else { format!("{count} steps") }
}

/// From where it is known what excludes what.
pub fn origin(origin: Origin) -> &'static str {
    match origin {
        Origin::Declared => "declared",
        Origin::Actions => "actions",
        Origin::Presumed => "presumed",
        Origin::Bare => "none",
    }
}

/// A change as PDDL, with what it rests on where that is weak.
fn formal(words: Words<'_>, change: &planner::excuse::Change) -> String {
    let atom =
        |fact: &Option<Fact>| fact.as_ref().map_or("nothing".to_owned(), |fact| words.atom(fact));
    if let Some((object, of)) = change.object {
        let of = &words.domain.types[of.index()].name.text;
        return format!("+ {} - {of}", words.object(object));
    }
    let note = match change.origin {
        Origin::Declared | Origin::Actions => "",
        Origin::Presumed => "   ; presumed: in one place or state, as now",
        Origin::Bare => "   ; a bare atom: what excludes it is not known",
    };
    match (&change.from, &change.to) {
        (None, Some(to)) => format!("+ {}{note}", words.atom(to)),
        (Some(from), None) => format!("- {}{note}", words.atom(from)),
        (from, to) => format!("{} -> {}{note}", atom(from), atom(to)),
    }
}
