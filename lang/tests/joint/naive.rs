//! A ground world goes in; what joint actions mean in it comes out, straight from the definition: sets of lines, recursion, nothing clever.

use std::borrow::Cow;
use std::collections::{BTreeMap, BTreeSet};

/// Facts such as `(on a b)`; what is not in it is false.
pub type Facts = BTreeSet<String>;

/// The ground actions that are taken at the same time, such as `(lift a1 left)`.
pub type Joint = BTreeSet<String>;

/// A domain and a problem.
#[derive(Debug)]
pub struct World {
    pub initial: Facts,
    pub goal: Formula,
    /// The ground actions by their lines.
    pub actions: BTreeMap<String, Action>,
    /// What is derived, predicate by predicate.
    pub axioms: Vec<Vec<(String, Formula)>>,
    /// Whether there is a metric.
    pub counts_cost: bool,
    /// Whether the domain wants that parts do not interfere.
    pub safe: bool,
}

#[derive(Debug)]
pub struct Action {
    /// Nobody is one more agent.
    pub agent: Option<String>,
    pub precondition: Formula,
    pub effects: Vec<Effect>,
}

#[derive(Debug)]
pub struct Effect {
    pub condition: Formula,
    pub outcome: Outcome,
}

#[derive(Debug)]
pub enum Outcome {
    Add(String),
    Delete(String),
    Cost(i64),
}

#[derive(Debug, Clone)]
pub enum Formula {
    Fact(String),
    /// The ground action stands in the joint action.
    Acts(String),
    Not(Box<Formula>),
    All(Vec<Formula>),
    Any(Vec<Formula>),
}

/// What a formula is asked about.
#[derive(Clone, Copy)]
struct View<'a> {
    facts: &'a Facts,
    joint: &'a Joint,
    /// The action whose precondition it is.
    own: Option<&'a str>,
}

/// What a valid joint plan amounts to.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Tally {
    pub steps: i64,
    pub actions: i64,
    pub cost: i64,
}

impl Formula {
    /// `demanded` is whether the whole precondition wants this part to be true: under an odd number of negations it wants it to be false.
    fn holds(&self, view: View<'_>, demanded: bool) -> bool {
        match self {
            Self::Fact(fact) => view.facts.contains(fact),
            Self::Acts(line) => {
                view.joint.contains(line) && (demanded || view.own != Some(line.as_str()))
            }
            Self::Not(part) => !part.holds(view, !demanded),
            Self::All(parts) => parts.iter().all(|part| part.holds(view, demanded)),
            Self::Any(parts) => parts.iter().any(|part| part.holds(view, demanded)),
        }
    }

    /// What is known of it whatever the joint action is.
    pub fn known(&self, facts: &Facts) -> Option<bool> {
        let among = |parts: &[Self], decisive: bool| {
            let known: Vec<_> = parts.iter().map(|part| part.known(facts)).collect();
            if known.contains(&Some(decisive)) {
                Some(decisive)
            } else {
                known.iter().all(Option::is_some).then_some(!decisive)
            }
        };
        match self {
            Self::Fact(fact) => Some(facts.contains(fact)),
            Self::Acts(_) => None,
            Self::Not(part) => part.known(facts).map(|holds| !holds),
            Self::All(parts) => among(parts, false),
            Self::Any(parts) => among(parts, true),
        }
    }
}

impl World {
    /// The facts and all that follows from them.
    pub fn derived<'f>(&self, facts: &'f Facts) -> Cow<'f, Facts> {
        if self.axioms.is_empty() {
            return Cow::Borrowed(facts);
        }
        let mut facts = facts.clone();
        for rules in &self.axioms {
            let mut before = None;
            while before != Some(facts.len()) {
                before = Some(facts.len());
                for (head, body) in rules {
                    let view = View { facts: &facts, joint: &Joint::new(), own: None };
                    if body.holds(view, true) {
                        facts.insert(head.clone());
                    }
                }
            }
        }
        Cow::Owned(facts)
    }

    pub fn goal(&self, facts: &Facts) -> bool {
        let facts = self.derived(facts);
        self.goal.holds(View { facts: &facts, joint: &Joint::new(), own: None }, true)
    }

    /// Whether the precondition of one part of a joint action holds.
    fn permits(&self, facts: &Facts, joint: &Joint, line: &str) -> bool {
        let facts = self.derived(facts);
        let view = View { facts: &facts, joint, own: Some(line) };
        self.actions[line].precondition.holds(view, true)
    }

    /// What one part of a joint action adds, deletes and costs.
    fn outcome(&self, facts: &Facts, joint: &Joint, line: &str) -> (Facts, Facts, i64) {
        let facts = self.derived(facts);
        let view = View { facts: &facts, joint, own: None };
        let (mut adds, mut deletes, mut cost) = (Facts::new(), Facts::new(), 0);
        for effect in
            self.actions[line].effects.iter().filter(|effect| effect.condition.holds(view, true))
        {
            match &effect.outcome {
                Outcome::Add(fact) => drop(adds.insert(fact.clone())),
                Outcome::Delete(fact) => drop(deletes.insert(fact.clone())),
                Outcome::Cost(number) => cost += number,
            }
        }
        (adds, deletes, cost)
    }

    /// The state after some parts of a joint action.
    fn after_some(&self, facts: &Facts, joint: &Joint, chosen: &[&String]) -> Facts {
        let outcomes: Vec<_> = chosen.iter().map(|line| self.outcome(facts, joint, line)).collect();
        let deletes: Facts = outcomes.iter().flat_map(|(_, deletes, _)| deletes.clone()).collect();
        let adds = outcomes.iter().flat_map(|(adds, _, _)| adds.clone());
        facts.difference(&deletes).cloned().chain(adds).collect()
    }

    /// The state after a joint action.
    pub fn after(&self, facts: &Facts, joint: &Joint) -> Facts {
        self.after_some(facts, joint, &joint.iter().collect::<Vec<_>>())
    }

    /// What a joint action costs: without a metric 1.
    pub fn cost(&self, facts: &Facts, joint: &Joint) -> i64 {
        let costs = joint.iter().map(|line| self.outcome(facts, joint, line).2);
        if self.counts_cost { costs.sum() } else { 1 }
    }

    /// Whether a joint action can be taken.
    pub fn joins(&self, facts: &Facts, joint: &Joint, safe: bool) -> bool {
        if joint.is_empty() || joint.iter().any(|line| !self.actions.contains_key(line)) {
            return false;
        }
        let agents: BTreeSet<_> = joint.iter().map(|line| &self.actions[line].agent).collect();
        agents.len() == joint.len()
            && joint.iter().all(|line| self.permits(facts, joint, line))
            && !self.conflicts(facts, joint)
            && (!safe || joint.iter().all(|line| self.survives(facts, joint, line)))
    }

    /// Whether one part adds what another deletes.
    fn conflicts(&self, facts: &Facts, joint: &Joint) -> bool {
        let outcomes: Vec<_> =
            joint.iter().map(|line| (line, self.outcome(facts, joint, line))).collect();
        outcomes.iter().any(|(one, (adds, _, _))| {
            outcomes
                .iter()
                .any(|(other, (_, deletes, _))| one != other && !adds.is_disjoint(deletes))
        })
    }

    /// Whether the precondition of a part still holds after all the others.
    fn survives(&self, facts: &Facts, joint: &Joint, line: &String) -> bool {
        let others: Vec<&String> = joint.iter().filter(|other| *other != line).collect();
        self.permits(&self.after_some(facts, joint, &others), joint, line)
    }

    /// What a joint plan of joint actions amounts to, or what is wrong with it.
    pub fn judge(&self, plan: &[Joint], safe: bool) -> Result<Tally, String> {
        let mut tally = Tally { steps: 0, actions: 0, cost: 0 };
        let mut facts = self.initial.clone();
        for joint in plan {
            if !self.joins(&facts, joint, safe) {
                return Err(format!("joint step {} cannot be taken: {joint:?}", tally.steps + 1));
            }
            tally.steps += 1;
            tally.actions += joint.len() as i64;
            tally.cost += self.cost(&facts, joint);
            facts = self.after(&facts, joint);
        }
        if self.goal(&facts) { Ok(tally) } else { Err("the goal does not hold".to_owned()) }
    }
}

/// The joint actions of a plan file, of which the lines `0: (lift a1 left)` with one number stand together; nothing if a line is of another form, or stands there twice.
pub fn plan(text: &str) -> Option<Vec<Joint>> {
    let mut plan: Vec<(&str, Joint)> = Vec::new();
    let lines = text.lines().filter_map(|line| line.split(';').next());
    for line in lines.filter(|line| !line.trim().is_empty()) {
        let (moment, action) = line.split_once(':')?;
        if plan.last().is_none_or(|(last, _)| *last != moment) {
            plan.push((moment, Joint::new()));
        }
        let is_new = plan.last_mut()?.1.insert(action.trim().to_owned());
        is_new.then_some(())?;
    }
    Some(plan.into_iter().map(|(_, joint)| joint).collect())
}
