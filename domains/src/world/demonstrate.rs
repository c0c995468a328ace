//! A scenario, a task, a person and a seed go in; the log of a demonstration comes out, with what really happened beside it.

use super::actor::Actor;
use super::facts;
use super::person::Person;
use super::scenario::{Scenario, Script, Task, header};
use super::skill::{Planner, Skill, done};
use super::stage::Stage;
use super::tracker::Tracker;
use super::witness::truth;
use crate::chance::Chance;
use learner::log::{Fact, Frame, HandId, Header};
use learner::truth::Truth;

/// Steps of the world in a frame of the log.
const STEPS: u32 = 2;
/// How often somebody tries again what did not work.
const TRIES: u32 = 4;
/// When a demonstration is given up, in seconds.
const LONGEST: f64 = 300.0;
/// For how long the tracker goes on after the last movement, in seconds.
const AFTER: f64 = 0.6;

/// A demonstration as it was logged, and as it was.
#[derive(Debug, Clone, PartialEq)]
pub struct Demonstration {
    /// What is tracked.
    pub header: Header,
    /// What the tracker saw, at 90 Hz.
    pub frames: Vec<Frame>,
    /// What really happened, for each frame.
    pub truths: Vec<Truth>,
    /// What the demonstrator meant to reach.
    pub goal: Vec<Fact>,
    /// Whether that was reached.
    pub reached: bool,
}

/// Somebody shows something.
///
/// The seed decides where things stand and what this person does this time; the same arguments give the same log, bit by bit.
pub fn demonstrate(scenario: Scenario, task: Task, person: &Person, seed: u64) -> Demonstration {
    let layout = scenario.layout(seed);
    let header = header(&layout);
    let mut stage = layout.stage();
    let mut chance = Chance::new("script", &[u64::from(person.number), seed]);
    let Script { hands, goal } = scenario.script(task, person, &mut chance, &stage);
    let mut roles: Vec<Role> =
        stage.hands().zip(hands).map(|(hand, skills)| Role::new(&stage, hand, skills)).collect();
    let mut tracker = Tracker::new(&stage, person, seed);
    let (mut frames, mut truths) = (Vec::new(), Vec::new());
    let mut after = 0.0;
    while after < AFTER && (frames.len() as f64) < LONGEST * super::tracker::RATE {
        let time = frames.len() as f64 / super::tracker::RATE;
        let teach: Vec<bool> =
            roles.iter().map(|role| header.agents.len() > 1 && role.busy()).collect();
        frames.push(tracker.see(&stage, person, &teach));
        let actors = roles.iter().map(|role| &role.actor);
        truths.push(truth(&stage, actors, &header, time));
        for _ in 0..STEPS {
            for at in 0..roles.len() {
                let finished: Vec<usize> = roles.iter().map(|role| role.at).collect();
                roles[at].decide(&stage, person, &mut chance, &finished);
                roles[at].actor.step(&mut stage);
            }
            let poses: Vec<_> = roles.iter().map(|role| role.actor.pose()).collect();
            stage.step(&poses);
        }
        if roles.iter().all(Role::finished) {
            after += 1.0 / super::tracker::RATE;
        }
    }
    let held = facts::facts(&stage, &header);
    let reached =
        roles.iter().all(|role| !role.failed) && goal.iter().all(|fact| held.contains(fact));
    Demonstration { header, frames, truths, goal, reached }
}

/// What one hand does in a demonstration.
struct Role {
    hand: HandId,
    actor: Actor,
    skills: Vec<Skill>,
    /// How many skills are done.
    at: usize,
    /// The skill under way was begun.
    begun: bool,
    /// How many skills were done at most, before something had to be done again.
    furthest: usize,
    tries: u32,
    failed: bool,
}

impl Role {
    fn new(stage: &Stage, hand: HandId, skills: Vec<Skill>) -> Self {
        let actor = Actor::new(stage, hand);
        Self { hand, actor, skills, at: 0, begun: false, furthest: 0, tries: 0, failed: false }
    }

    fn finished(&self) -> bool {
        self.at == self.skills.len() && self.actor.idle()
    }

    /// It moves or is about to, and does not wait for another hand.
    fn busy(&self) -> bool {
        match self.skills.get(self.at) {
            None => !self.actor.idle(),
            Some(Skill::Await { .. } | Skill::Pause(_)) => false,
            Some(_) => true,
        }
    }

    /// Sees what was done and begins what comes next.
    fn decide(&mut self, stage: &Stage, person: &Person, chance: &mut Chance, finished: &[usize]) {
        while self.actor.idle() {
            let Some(skill) = self.skills.get(self.at).copied() else { return };
            if let Skill::Await { hand, skills } = skill {
                if finished[hand.index()] < skills {
                    return;
                }
                self.at += 1;
                continue;
            }
            if self.begun {
                self.begun = false;
                if done(&skill, stage, self.hand) {
                    self.at += 1;
                    if self.at > self.furthest {
                        self.furthest = self.at;
                        self.tries = 0;
                    }
                    continue;
                }
                self.tries += 1;
                if self.tries > TRIES {
                    // Somebody whom nothing helps gives up, and nobody waits for them.
                    self.failed = true;
                    self.at = self.skills.len();
                    return;
                }
                // What fell before it was where it should be is taken again first.
                let taken =
                    matches!(skill, Skill::Put { .. } | Skill::Insert { .. } | Skill::Turn { .. });
                let before = self.at.checked_sub(1).map(|before| self.skills[before]);
                if taken
                    && stage.held(self.hand).is_none()
                    && matches!(before, Some(Skill::Take { .. }))
                {
                    self.at -= 1;
                }
                continue;
            }
            self.begun = true;
            let acts = Planner::new(stage, person, chance, self.hand).acts(&skill);
            self.actor.add(acts);
        }
    }
}
