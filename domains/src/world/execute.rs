//! A plan and the way points of its actions go in; hands carry it out in a world, and whether the goal was reached comes out, with what happened.
//!
//! Hands go from way point to way point, seen from where the arguments of the action are now. Nothing checks preconditions:
//! a plan that leaves out what it needs fails by physics, because a hand closes on nothing, slips off or pushes things over.

mod turns;

use super::actor::Actor;
use super::facts;
use super::motion::Way;
use super::person::Person;
use super::scenario::{Scenario, header};
use super::skill::Act;
use super::stage::Stage;
use super::thing::Mount;
use super::tracker::{RATE, Tracker};
use crate::chance::Chance;
use learner::log::{Fact, Frame, HandId, Header, ObjectId};
use learner::waypoints::{Anchor, Doer, Routine, WayPoint};
use nalgebra::{Isometry3, Translation3, Vector3};

/// Two hands nearer than this have run into each other, in metres.
const CLEARANCE: f64 = 0.06;
/// How long hands rest before and after they close or open, in seconds.
const REST: f64 = 0.12;
/// How long the world is watched after the last step, in seconds.
const AFTER: f64 = 0.8;
/// When a joint step is given up, in seconds.
const LONGEST: f64 = 60.0;
/// How fast hands go when their way points are far apart and near in time, in m/s.
const SPEED: f64 = 0.8;

/// A step of a plan: an action and its arguments by name; of a multi-agent action the agent is the first.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct PlanStep {
    /// The name of the action.
    pub name: String,
    /// The names of its arguments.
    pub arguments: Vec<String>,
}

/// How an execution went.
#[derive(Debug, Clone, PartialEq)]
pub struct Outcome {
    /// What there was, without noise, at 90 Hz.
    pub frames: Vec<Frame>,
    /// What held in the end.
    pub facts: Vec<Fact>,
    /// The goal holds in the end, and nothing forbidden happened on the way.
    pub reached: bool,
    /// What happened, in sentences.
    pub story: Vec<String>,
}

/// Carries out a plan in a scenario as the seed furnishes it, joint step by joint step; all steps of a joint step run at once.
pub fn execute(
    scenario: Scenario,
    seed: u64,
    plan: &[Vec<PlanStep>],
    routines: &[Routine],
    goal: &[Fact],
) -> Outcome {
    let layout = scenario.layout(seed);
    let header = header(&layout);
    let stage = layout.stage();
    let person = Person::ideal();
    let tracker = Tracker::new(&stage, &person, seed);
    let actors = stage.hands().map(|hand| Actor::new(&stage, hand)).collect();
    let homes = stage.hands().map(|hand| stage.hand(hand)).collect();
    let chance = Chance::new("execution", &[seed]);
    let mut run = Run {
        stage,
        header,
        actors,
        homes,
        tracker,
        person,
        chance,
        frames: Vec::new(),
        story: Vec::new(),
        forbidden: false,
        odd: false,
    };
    for steps in plan {
        if run.forbidden || !run.joint_step(steps, routines) {
            run.forbidden = true;
            break;
        }
    }
    for _ in 0..(AFTER * RATE) as u32 {
        run.frame(&mut []);
    }
    let facts = facts::facts(&run.stage, &run.header);
    let reached = !run.forbidden && goal.iter().all(|fact| facts.contains(fact));
    for fact in goal.iter().filter(|fact| !facts.contains(fact)) {
        run.story.push(format!(
            "In the end ({} {}) does not hold.",
            fact.predicate,
            fact.arguments.join(" ")
        ));
    }
    Outcome { frames: run.frames, facts, reached, story: run.story }
}

/// A world in which a plan is being carried out.
struct Run {
    stage: Stage,
    header: Header,
    actors: Vec<Actor>,
    /// Where hands rest.
    homes: Vec<Isometry3<f64>>,
    tracker: Tracker,
    person: Person,
    chance: Chance,
    frames: Vec<Frame>,
    story: Vec<String>,
    /// Something happened after which no goal counts.
    forbidden: bool,
    /// The frame under way has had its first step of the world.
    odd: bool,
}

/// The part of one hand in a joint step.
struct Part<'plan> {
    hand: HandId,
    step: &'plan PlanStep,
    points: Vec<&'plan WayPoint>,
    /// How many way points were begun.
    begun: usize,
    arguments: Vec<Option<ObjectId>>,
    /// Where arguments and hands were when the step began.
    poses: Vec<Isometry3<f64>>,
    hands: Vec<Isometry3<f64>>,
    /// What the hand was told to hold, so that a slip is noticed.
    holds: Option<ObjectId>,
}

impl Run {
    /// One joint step; false if it cannot be done.
    ///
    /// What demands each other is done at once, and so is what has room to be. Other parts take turns, those that follow somebody last.
    fn joint_step(&mut self, steps: &[PlanStep], routines: &[Routine]) -> bool {
        for turn in self.turns(steps, routines) {
            let steps: Vec<PlanStep> = turn.into_iter().cloned().collect();
            if !self.together(&steps, routines) {
                return false;
            }
        }
        true
    }

    /// Steps that are done at once; false if they cannot even begin.
    fn together(&mut self, steps: &[PlanStep], routines: &[Routine]) -> bool {
        let mut parts = Vec::new();
        let mut taken = Vec::new();
        for step in steps {
            let found = Routine::nearest(routines, &step.name, &step.arguments);
            let Some(routine) = found else {
                self.story.push(format!("There are no way points for {}.", step.name));
                return false;
            };
            let arguments: Vec<Option<ObjectId>> =
                step.arguments.iter().map(|name| self.stage.named(name)).collect();
            let mut hands = Vec::new();
            for (role, doer) in routine.hands.iter().enumerate() {
                let Some(hand) = self.choose(doer, role as u32, step, routine, &arguments, &taken)
                else {
                    self.story.push(format!("There is no hand for {}.", told(step)));
                    return false;
                };
                taken.push(hand);
                hands.push(hand);
            }
            let poses = arguments
                .iter()
                .map(|object| {
                    object.map_or_else(Isometry3::identity, |object| self.stage.pose(object))
                })
                .collect::<Vec<_>>();
            let places: Vec<_> = hands.iter().map(|hand| self.stage.hand(*hand)).collect();
            for (role, &hand) in hands.iter().enumerate() {
                let points =
                    routine.points.iter().filter(|point| point.hand as usize == role).collect();
                parts.push(Part {
                    hand,
                    step,
                    points,
                    begun: 0,
                    arguments: arguments.clone(),
                    poses: poses.clone(),
                    hands: places.clone(),
                    holds: self.stage.held(hand),
                });
            }
        }
        self.make_room(&taken);
        let mut clock = 0.0;
        let begin = self.frames.len();
        loop {
            let mut late = false;
            let mut over = true;
            for part in &mut parts {
                if !self.actors[part.hand.index()].idle() {
                    over = false;
                    // Where a hand is not yet where it should be, all others wait for it.
                    late |= part.begun > 0 && part.points[part.begun - 1].time <= clock;
                    continue;
                }
                let due = part.begun == 0 || part.points[part.begun - 1].time <= clock;
                if part.begun < part.points.len() {
                    over = false;
                    if due && !self.begin(part) {
                        return false;
                    }
                } else {
                    over &= due;
                }
            }
            if over {
                return true;
            }
            if !late {
                clock += super::stage::STEP;
            }
            self.step(&mut parts);
            if self.forbidden {
                return false;
            }
            if (self.frames.len() - begin) as f64 > LONGEST * RATE {
                self.story.push("A step takes too long and is given up.".to_owned());
                return false;
            }
        }
    }

    /// The empty hands that somebody with several hands does not need go out of the way of the others.
    ///
    /// The hands of different agents do not: that is for the plan.
    fn make_room(&mut self, needed: &[HandId]) {
        let agent = |hand: HandId| self.header.hands[hand.index()].agent;
        let idle: Vec<HandId> = self
            .stage
            .hands()
            .filter(|hand| !needed.contains(hand) && self.stage.held(*hand).is_none())
            .filter(|hand| needed.iter().any(|other| agent(*other) == agent(*hand)))
            .collect();
        for hand in idle {
            let (from, to) = (self.stage.hand(hand), self.homes[hand.index()]);
            if (from.translation.vector - to.translation.vector).norm() > 0.01
                && self.actors[hand.index()].idle()
            {
                let rise = Vector3::z() * 0.1;
                let way = Way::new(&from, &to, rise, rise, SPEED, 0.0);
                self.actors[hand.index()]
                    .add(vec![Act::Grip(false), Act::Go { way: Box::new(way), about: None }]);
            }
        }
    }

    /// Which hand does a part.
    fn choose(
        &self,
        doer: &Doer,
        role: u32,
        step: &PlanStep,
        routine: &Routine,
        arguments: &[Option<ObjectId>],
        taken: &[HandId],
    ) -> Option<HandId> {
        let name = match doer {
            Doer::Named(name) => Some(name),
            Doer::Argument(argument) => Some(step.arguments.get(*argument as usize)?),
            Doer::Any => None,
        };
        // A name is that of a hand, or of an agent that may use any of its hands.
        let may = |hand: HandId| {
            let entry = &self.header.hands[hand.index()];
            let agent = &self.header.agents[entry.agent as usize];
            name.is_none_or(|name| {
                entry.name.eq_ignore_ascii_case(name) || agent.eq_ignore_ascii_case(name)
            })
        };
        let mine = || routine.points.iter().filter(|point| point.hand == role);
        let carries = mine().any(|point| point.carried.is_some());
        let aims: Vec<Vector3<f64>> = mine()
            .filter_map(|point| match point.anchor {
                Anchor::Middle(index) | Anchor::Top(index) | Anchor::Free(index) => {
                    arguments.get(index as usize).copied().flatten()
                }
                Anchor::World | Anchor::Hand(_) => None,
            })
            .map(|object| self.stage.pose(object).translation.vector)
            .collect();
        let cost = |hand: HandId| {
            // Who puts something down takes the hand that has it, and who takes something a free one.
            let unfit = match self.stage.held(hand) {
                Some(held) if arguments.contains(&Some(held)) => 0.0,
                None if !carries => 0.0,
                None => 1.0,
                Some(_) => 2.0,
            };
            let out = aims.iter().any(|aim| !self.reaches(hand, *aim));
            let place = self.stage.hand(hand).translation.vector;
            let far = aims.first().map_or(0.0, |aim| (aim - place).norm());
            (unfit + f64::from(u8::from(out))) * 100.0 + far
        };
        self.stage
            .hands()
            .filter(|hand| !taken.contains(hand) && may(*hand))
            .min_by(|first, second| cost(*first).total_cmp(&cost(*second)))
    }

    fn reaches(&self, hand: HandId, place: Vector3<f64>) -> bool {
        self.header.hands[hand.index()]
            .reach
            .is_none_or(|reach| (place - reach.centre).norm() <= reach.radius)
    }

    /// Sets out for the next way point of a part; false if that is impossible.
    fn begin(&mut self, part: &mut Part<'_>) -> bool {
        let point = part.points[part.begun];
        part.begun += 1;
        let anchor = match point.anchor {
            Anchor::World => Isometry3::identity(),
            Anchor::Hand(role) => {
                part.hands.get(role as usize).copied().unwrap_or_else(Isometry3::identity)
            }
            Anchor::Middle(index) | Anchor::Top(index) | Anchor::Free(index) => {
                let Some(object) = part.arguments.get(index as usize).copied().flatten() else {
                    self.story
                        .push(format!("{} is about something that is not here.", told(part.step)));
                    return false;
                };
                let middle = part.poses[index as usize];
                let height = self.stage.thing(object).object.size.z / 2.0;
                match point.anchor {
                    Anchor::Middle(_) => middle,
                    _ => middle * Translation3::new(0.0, 0.0, height),
                }
            }
        };
        let mut aim = anchor * point.offset;
        aim.translation.vector += self.chance.normals() * 0.0007;
        if let Anchor::Free(index) = point.anchor
            && let Some(on) = part.arguments[index as usize]
        {
            let carried = point.carried.and_then(|index| part.arguments[index as usize]);
            aim = self.free(aim, on, carried.or(self.stage.held(part.hand)));
        }
        if let Some(index) = point.carried
            && let Some(object) = part.arguments.get(index as usize).copied().flatten()
        {
            let height = self.stage.thing(object).object.size.z / 2.0;
            let relative = self.stage.hand(part.hand).inverse() * self.stage.pose(object);
            if self.stage.held(part.hand) == Some(object) {
                aim = aim * Translation3::new(0.0, 0.0, height) * relative.inverse();
            } else {
                let (hand, object) = (self.hand_name(part.hand), self.name(object));
                self.story.push(format!("The {hand} shall carry {object} and does not hold it."));
                // It goes where it would have brought it, above that.
                aim *= Translation3::new(0.0, 0.0, 2.0 * height);
            }
        }
        let hand = self.stage.hand(part.hand);
        if !self.reaches(part.hand, aim.translation.vector) {
            self.story.push(format!(
                "The {} does not reach where {} leads it.",
                self.hand_name(part.hand),
                told(part.step)
            ));
            return false;
        }
        let before = if part.begun > 1 { part.points[part.begun - 2].time } else { 0.0 };
        let bend = Vector3::z() * self.rise(part.hand, &hand, &aim);
        let way = Way::new(&hand, &aim, bend, bend, SPEED, point.time - before);
        let actor = &mut self.actors[part.hand.index()];
        actor.add(vec![Act::Go { way: Box::new(way), about: None }]);
        if point.grip != self.stage.closed(part.hand) {
            actor.add(vec![Act::Rest(REST), Act::Grip(point.grip), Act::Rest(REST)]);
        }
        true
    }

    /// How far a way bends upwards to pass over what stands between its ends, in metres.
    fn rise(&self, hand: HandId, from: &Isometry3<f64>, to: &Isometry3<f64>) -> f64 {
        let (from, to) = (from.translation.vector, to.translation.vector);
        let along = to.xy() - from.xy();
        // Short ways are part of the work, such as a pull or a turn, and what a drawer needs is no lift.
        let held = self.stage.held(hand);
        let works = held.is_some_and(|held| {
            let thing = self.stage.thing(held);
            !matches!(thing.mount, Mount::Free) || thing.mass > 1.0
        });
        if along.norm() < 0.08 || works {
            return 0.0;
        }
        let hang = held.map_or(0.0, |held| self.stage.thing(held).object.size.z);
        let reach = held.map_or(0.0, |held| self.stage.thing(held).object.size.x / 2.0);
        // Steep enough at the end, as demonstrators do it.
        let mut needed = if held.is_some() { 0.26 * along.norm().sqrt() } else { 0.0_f64 };
        for object in self.stage.objects() {
            let thing = self.stage.thing(object);
            let around = held.is_none() && thing.mass > 1.0;
            if Some(object) == held || thing.mount != Mount::Free || around {
                continue;
            }
            let place = self.stage.pose(object).translation.vector;
            let share =
                ((place.xy() - from.xy()).dot(&along) / along.norm_squared()).clamp(0.0, 1.0);
            if (from.xy() + along * share - place.xy()).norm()
                < 0.11 + thing.object.size.x / 2.0 + reach
            {
                let top = place.z + thing.object.size.z / 2.0;
                needed = needed.max((top + hang + 0.04 - from.z.min(to.z)) / 0.75);
            }
        }
        needed.min(0.6)
    }

    /// A free place on something, as near as possible to an aim.
    fn free(&self, aim: Isometry3<f64>, on: ObjectId, carried: Option<ObjectId>) -> Isometry3<f64> {
        let radius = |object: ObjectId| self.stage.thing(object).object.size.xy().norm() / 2.0;
        let mine = carried.map_or(0.03, radius);
        let (pose, half) = (self.stage.pose(on), self.stage.thing(on).object.size / 2.0);
        let fits = |place: Vector3<f64>| {
            let inside = pose.inverse() * nalgebra::Point3::from(place);
            inside.x.abs() + mine < half.x
                && inside.y.abs() + mine < half.y
                && self.stage.objects().all(|other| {
                    let thing = self.stage.thing(other);
                    let there = self.stage.pose(other).translation.vector;
                    Some(other) == carried
                        || thing.mount != Mount::Free
                        || there.z - thing.object.size.z / 2.0 > place.z + 0.3
                        || (there.xy() - place.xy()).norm() > mine + radius(other) + 0.015
                })
        };
        // Rings around the aim, the nearest first.
        for ring in 0..60 {
            for part in 0..24 {
                let angle = f64::from(part) * std::f64::consts::TAU / 24.0;
                let away = Vector3::new(angle.cos(), angle.sin(), 0.0) * (0.02 * f64::from(ring));
                let place = aim.translation.vector + away;
                if fits(place) {
                    return Isometry3::from_parts(place.into(), aim.rotation);
                }
            }
        }
        aim
    }

    /// A step of the world, and every second one a frame.
    fn step(&mut self, parts: &mut [Part<'_>]) {
        if !self.odd {
            let teach = vec![false; self.header.hands.len()];
            let frame = self.tracker.see(&self.stage, &self.person, &teach);
            self.frames.push(frame);
        }
        self.odd = !self.odd;
        let closed: Vec<bool> = self.stage.hands().map(|hand| self.stage.closed(hand)).collect();
        for actor in &mut self.actors {
            actor.step(&mut self.stage);
        }
        for part in parts.iter_mut() {
            let before = closed[part.hand.index()];
            let (closed, held) = (self.stage.closed(part.hand), self.stage.held(part.hand));
            if closed && !before && held.is_none() {
                let sentence = format!("The {} closes on nothing.", self.hand_name(part.hand));
                self.story.push(sentence);
            }
            if closed && !before {
                part.holds = held;
            } else if !closed {
                part.holds = None;
            }
        }
        let poses: Vec<_> = self.actors.iter().map(Actor::pose).collect();
        self.stage.step(&poses);
        for part in parts {
            if let Some(object) = part.holds
                && self.stage.held(part.hand) != Some(object)
            {
                let (hand, object) = (self.hand_name(part.hand), self.name(object));
                self.story.push(format!("The {object} slips out of the {hand}."));
                part.holds = None;
            }
        }
        if self.stage.clearance() < CLEARANCE && !self.forbidden {
            self.story.push("Two hands run into each other.".to_owned());
            self.forbidden = true;
        }
        self.keep_rules();
    }

    /// No larger cube ever lies on a smaller one.
    fn keep_rules(&mut self) {
        let regions = self.header.objects.iter().any(|object| object.region);
        if !regions || self.odd {
            return;
        }
        for (first, second, towards) in self.stage.contacts() {
            let (above, below) = if towards.z < -0.7 { (first, second) } else { (second, first) };
            let edge = |object: ObjectId| self.stage.thing(object).object.size.x;
            let loose = self.stage.thing(below).mount == Mount::Free
                && self.stage.thing(above).mount == Mount::Free;
            if loose && towards.z.abs() > 0.7 && edge(above) > edge(below) + 0.001 {
                self.story.push(format!(
                    "The {} lies on the smaller {}.",
                    self.name(above),
                    self.name(below)
                ));
                self.forbidden = true;
                return;
            }
        }
    }

    fn frame(&mut self, parts: &mut [Part<'_>]) {
        self.step(parts);
        self.step(parts);
    }

    fn name(&self, object: ObjectId) -> String {
        self.header.objects[object.index()].name.clone()
    }

    fn hand_name(&self, hand: HandId) -> String {
        self.header.hands[hand.index()].name.clone()
    }
}

/// A step of a plan as it stands in a plan file.
fn told(step: &PlanStep) -> String {
    let mut text = format!("({}", step.name);
    for argument in &step.arguments {
        text.push(' ');
        text.push_str(argument);
    }
    text.push(')');
    text
}

/// Whether facts hold at the start of a scenario.
pub fn holds_at_start(scenario: Scenario, seed: u64, wanted: &[Fact]) -> bool {
    let layout = scenario.layout(seed);
    let header = header(&layout);
    let held = facts::facts(&layout.stage(), &header);
    wanted.iter().all(|fact| held.contains(fact))
}
