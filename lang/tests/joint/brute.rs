//! A ground world goes in; every joint action of a state and the least plan come out, by trying everything; and worlds with a goal far away.

use std::collections::{BTreeMap, BTreeSet};

use super::ground;
use super::naive::{Facts, Joint, World};
use super::random::Texts;
use super::tape::Tape;

/// What a plan is to have little of.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Measure {
    Steps,
    Actions,
    Cost,
}

/// What is known of the least plan.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Least {
    Is(i64),
    Unsolvable,
    /// There was too much to try.
    Unknown,
}

/// All joint actions of a state; nothing if more than `left` would have to be tried, from which those that are tried go off.
pub fn joint_actions(world: &World, facts: &Facts, left: &mut usize) -> Option<Vec<Joint>> {
    // An action is left out only where no joint action whatever would permit it.
    let derived = world.derived(facts);
    let mut of_agents: BTreeMap<&Option<String>, Vec<&String>> = BTreeMap::new();
    for (line, action) in &world.actions {
        if action.precondition.known(&derived) != Some(false) {
            of_agents.entry(&action.agent).or_default().push(line);
        }
    }
    let count = of_agents.values().try_fold(1_usize, |sum, lines| sum.checked_mul(1 + lines.len()));
    *left = left.checked_sub(count?)?;
    let mut tried = vec![Joint::new()];
    for lines in of_agents.values() {
        let with = |joint: &Joint| {
            let more = |line: &&String| joint.iter().chain([*line]).cloned().collect();
            lines.iter().map(more).collect::<Vec<Joint>>()
        };
        let longer: Vec<Joint> = tried.iter().flat_map(with).collect();
        tried.extend(longer);
    }
    tried.retain(|joint| world.joins(facts, joint, world.safe));
    Some(tried)
}

/// The least plan, if that takes no more than `left` tries of a joint action in a state.
pub fn least(world: &World, measure: Measure, mut left: usize) -> Least {
    let mut open = BTreeSet::from([(0, world.initial.clone())]);
    let mut best = BTreeMap::from([(world.initial.clone(), 0)]);
    while let Some((so_far, facts)) = open.pop_first() {
        if so_far > best[&facts] {
            continue;
        }
        if world.goal(&facts) {
            return Least::Is(so_far);
        }
        let Some(joint_actions) = joint_actions(world, &facts, &mut left) else {
            return Least::Unknown;
        };
        for joint in joint_actions {
            let price = match measure {
                Measure::Steps => 1,
                Measure::Actions => joint.len() as i64,
                Measure::Cost => world.cost(&facts, &joint),
            };
            let (after, sum) = (world.after(&facts, &joint), so_far + price);
            if best.get(&after).is_none_or(|known| sum < *known) {
                best.insert(after.clone(), sum);
                open.insert((sum, after));
            }
        }
    }
    Least::Unsolvable
}

/// Texts of which every second has a goal that can be reached, mostly far from the initial state; left to chance, few could be.
pub fn texts(tape: &mut Tape) -> Texts {
    let texts = Texts::new(tape);
    if tape.below(2) == 0 {
        return texts;
    }
    let states = reachable(&ground::world(&texts.domain, &texts.problem), 1_000);
    let back = tape.below(states.len().min(4));
    texts.towards(&states[0], &states[states.len() - 1 - back], tape)
}

/// Reachable states, nearest first, as far as so many tries of a joint action in a state lead.
fn reachable(world: &World, mut left: usize) -> Vec<Facts> {
    let mut states = vec![world.initial.clone()];
    let mut seen = BTreeSet::from([world.initial.clone()]);
    let mut at = 0;
    while at < states.len()
        && let Some(joint_actions) = joint_actions(world, &states[at], &mut left)
    {
        for joint in joint_actions {
            let after = world.after(&states[at], &joint);
            if seen.insert(after.clone()) {
                states.push(after);
            }
        }
        at += 1;
    }
    states
}
