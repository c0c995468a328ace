//! FF (Hoffmann and Nebel 2001): the cost of a plan without deletes, read off from the cheapest supporters under hadd (Keyder and Geffner 2008).
//!
//! Preferred are the operators of that plan that are applicable now.

use super::relaxed::{AXIOM, Combine, Exploration, NO_RULE, UNREACHED};
use super::{Costs, DEAD_END, Heuristic, Profile};
use crate::task::{Fact, OperatorId, Task};

/// What may be relied on.
pub fn profile() -> Profile {
    Profile {
        name: "ff",
        summary: "the cost of a plan without deletes; its applicable operators are preferred",
        source: "Hoffmann and Nebel, The FF planning system, JAIR 2001; Keyder and Geffner, ECAI 2008",
        admissible: false,
        consistent: false,
        safe: true,
        conditional_effects: true,
        axioms: true,
        preferred: true,
    }
}

/// See the module.
#[derive(Debug, Clone)]
pub struct Ff {
    exploration: Exploration,
    costs: Vec<u32>,
    /// The evaluation in which a fact or an operator was last marked.
    fact_marks: Vec<u32>,
    operator_marks: Vec<u32>,
    now: u32,
    stack: Vec<u32>,
    preferred: Vec<OperatorId>,
}

impl Ff {
    /// For `task`.
    pub fn new(task: &Task, costs: Costs) -> Self {
        let exploration = Exploration::new(task, costs);
        Self {
            costs: task.operator_ids().map(|operator| costs.of(task, operator)).collect(),
            fact_marks: vec![0; exploration.facts.len()],
            operator_marks: vec![0; task.operators.len()],
            now: 0,
            stack: Vec::new(),
            preferred: Vec::new(),
            exploration,
        }
    }

    /// Those of `facts` that the last relaxed plan makes true.
    pub fn achieves(&self, facts: &[Fact]) -> Vec<Fact> {
        let made = |fact: &Fact| {
            let number = self.exploration.number(*fact) as usize;
            self.fact_marks[number] == self.now
                && self.exploration.facts[number].supporter != NO_RULE
        };
        facts.iter().copied().filter(made).collect()
    }

    fn tick(&mut self) {
        if self.now == u32::MAX {
            self.fact_marks.fill(0);
            self.operator_marks.fill(0);
            self.now = 0;
        }
        self.now += 1;
    }

    /// Marks the facts from which a supporter is still to be followed.
    fn demand(marks: &mut [u32], stack: &mut Vec<u32>, now: u32, facts: &[u32]) {
        for &fact in facts {
            let mark = &mut marks[fact as usize];
            if *mark != now {
                *mark = now;
                stack.push(fact);
            }
        }
    }

    fn relaxed_plan(&mut self) -> u32 {
        self.tick();
        let mut cost: u32 = 0;
        Self::demand(&mut self.fact_marks, &mut self.stack, self.now, self.exploration.goal());
        while let Some(fact) = self.stack.pop() {
            let supporter = self.exploration.facts[fact as usize].supporter;
            if supporter == NO_RULE {
                continue;
            }
            let needs = self.exploration.needs(supporter);
            Self::demand(&mut self.fact_marks, &mut self.stack, self.now, needs);
            let origin = self.exploration.origins[supporter as usize];
            if origin == AXIOM {
                continue;
            }
            let mark = &mut self.operator_marks[origin as usize];
            if *mark != self.now {
                *mark = self.now;
                cost = cost.saturating_add(self.costs[origin as usize]);
            }
            if needs.iter().all(|&need| self.exploration.facts[need as usize].supporter == NO_RULE)
            {
                self.preferred.push(OperatorId(origin));
            }
        }
        self.preferred.sort_unstable();
        self.preferred.dedup();
        cost.min(UNREACHED - 1)
    }
}

impl Heuristic for Ff {
    fn evaluate(&mut self, values: &[u32]) -> u32 {
        self.preferred.clear();
        if self.exploration.explore(values, Combine::Sum) == UNREACHED {
            return DEAD_END;
        }
        self.relaxed_plan()
    }

    fn preferred(&self) -> &[OperatorId] {
        &self.preferred
    }
}
