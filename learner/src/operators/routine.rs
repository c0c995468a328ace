//! Deeds with the tracks of hands and objects go in; routines come out, by which a robot or a world can do the same with other objects.
//!
//! A way is kept as few way points: those from which it departs by little (Ramer 1972, Douglas and Peucker 1973), seen from the thing that it is about.

use nalgebra::{Isometry3, Translation3, Vector3};

use crate::log::{HandId, Header, ObjectId};
use crate::observe::{Relation, Thing};
use crate::rule::Learned;
use crate::waypoints::{Anchor, Doer, Routine, WayPoint};

use super::deed::{Deed, Deeds, Verb};
use super::line::{Instance, Line};
use super::record::Grip;
use super::track::Tracks;

/// How far a way may depart from its way points, in metres; a radian counts as 15 cm.
const TOLERANCE: f64 = 0.012;
/// What a turn of a radian counts as, in metres.
const RADIAN: f64 = 0.15;
/// The way of a hand is looked at in steps of so much, in seconds.
const STEP: f64 = 1.0 / 30.0;
/// The way to a thing belongs to the routine from where the hand is so far from where it gets, in metres, and at most so long before, in seconds;
/// and likewise the way away from it.
const CLEAR: f64 = 0.14;
const LONGEST: f64 = 3.0;

/// So many routines of one action are kept.
const MOST: usize = 32;
/// Who leaves a place goes on until so far from it, in metres, for at most so long, in seconds.
const GONE: (f64, f64) = (0.3, 1.5);

/// One demonstration, with where everything was.
#[derive(Debug, Clone, Copy)]
pub struct Shown<'a> {
    /// What was tracked.
    pub header: &'a Header,
    /// Where it was.
    pub tracks: &'a Tracks,
    /// What was done.
    pub deeds: &'a Deeds,
    /// The same in the words of the domain.
    pub line: &'a Line,
    /// The argument of each action is a hand, or the words do not say which hand acts.
    pub names_hands: bool,
}

/// Routines for each action that was learned: one for each choice of arguments with which its whole way was seen, up to [`MOST`].
pub fn routines(shown: &[Shown<'_>], learned: &Learned) -> Vec<Routine> {
    let mut routines: Vec<Routine> = Vec::new();
    for action in &learned.actions {
        let first = routines.len();
        for one in shown {
            for instance in one.line.instances.iter().filter(|one| one.action == action.action) {
                let Some(routine) = routine(one, learned, instance) else { continue };
                let known = routines[first..].iter().any(|other| other.shown == routine.shown);
                if !known && routines.len() - first < MOST {
                    routines.push(routine);
                }
            }
        }
    }
    routines
}

/// How one deed was done.
fn routine(shown: &Shown<'_>, learned: &Learned, instance: &Instance) -> Option<Routine> {
    let deed = &shown.deeds.deeds[instance.deed];
    let action = &learned.domain.actions[instance.action.index()];
    let parameters = action.scope.variables.iter().map(|one| one.name.text.clone()).collect();
    let of = |object: ObjectId| {
        let name = &shown.header.objects[object.index()].name;
        let named = |id: &lang::model::ObjectId| {
            shown.line.trace.objects[id.index()].name.text.eq_ignore_ascii_case(name)
        };
        instance.arguments.iter().position(named).map(|place| place as u32)
    };
    let doer = if shown.names_hands || action.agent { Doer::Argument(0) } else { Doer::Any };
    let mut scribe = Scribe { shown, hand: deed.hand, begin: deed.from, points: Vec::new() };
    match deed.verb {
        Verb::Take => {
            let object = deed.object?;
            let anchor = Anchor::Middle(of(object)?);
            let grip = shown.grip(deed.hand, object, deed)?;
            let (from, _) = shown.closed(&grip);
            let base = shown.tracks.object(object, from)?;
            let start = scribe.begin_near(from)?;
            scribe.way(start, from, base, anchor, false)?;
            scribe.way(from, shown.lifted(&grip, deed.to), base, anchor, true)?;
        }
        Verb::Put => {
            let object = deed.object?;
            let (_, to) = shown.closed(&shown.grip(deed.hand, object, deed)?);
            if let Some((support, anchor)) = support(shown, deed, &of) {
                let size = shown.header.objects[support.index()].size;
                // The support may have been brought there meanwhile, by another hand.
                let base = shown.tracks.object(support, to)? * raised(size.z / 2.0);
                let start = scribe.begin_high(deed.from, to)?;
                scribe.carried(start, to, object, of(object)?, base, anchor)?;
                scribe.away(to, base, anchor)?;
            } else {
                // It is let go where it is.
                scribe.begin = to;
                scribe.away(to, shown.tracks.object(object, to)?, Anchor::Middle(of(object)?))?;
            }
        }
        Verb::Handle | Verb::Use | Verb::Push => {
            let object = deed.object?;
            let anchor = Anchor::Middle(of(object)?);
            let grip = shown.grip(deed.hand, object, deed);
            let grip = grip.map(|grip| shown.closed(&grip));
            let base = shown.tracks.object(object, grip.map_or(deed.from, |(from, _)| from))?;
            if let Some((from, to)) = grip {
                let start = scribe.begin_near(from)?;
                scribe.way(start, from, base, anchor, false)?;
                scribe.way(from, to, base, anchor, true)?;
                scribe.away(to, base, anchor)?;
            } else {
                scribe.way(
                    deed.from,
                    deed.to.max(deed.from + STEP),
                    base,
                    anchor,
                    deed.verb == Verb::Use,
                )?;
            }
        }
        Verb::Go => {
            let place =
                deed.changes.iter().rev().find_map(|(told, _)| match told.ground.things[1] {
                    Thing::Object(object) => Some(object),
                    Thing::Hand(_) => None,
                })?;
            let base = shown.tracks.object(place, deed.at)?;
            let leaves = deed.changes.last().is_some_and(|(_, holds)| !holds);
            let end = if leaves { scribe.gone(deed.to, base) } else { deed.to };
            let pose = shown.tracks.hand(deed.hand, end)?;
            scribe.begin = deed.from.min(end - STEP);
            scribe.point(end, base, pose, Anchor::Middle(of(place)?), None, None);
        }
        Verb::Hold => {
            scribe.points.push(WayPoint {
                hand: 0,
                carried: None,
                anchor: Anchor::Hand(0),
                offset: Isometry3::identity(),
                grip: true,
                time: (deed.to - deed.from).max(0.0),
            });
        }
    }
    let points = scribe.points;
    let partners = learned.actions.iter().filter(|one| one.action == instance.action);
    let with = partners
        .flat_map(|one| &one.partners)
        .map(|partner| learned.domain.actions[partner.action.index()].name.text.clone());
    let name = |id: &lang::model::ObjectId| shown.line.trace.objects[id.index()].name.text.clone();
    Some(Routine {
        action: action.name.text.clone(),
        parameters,
        shown: instance.arguments.iter().map(name).collect(),
        with: with.collect(),
        follows: false,
        hands: vec![doer],
        points,
    })
}

/// What a thing was put on or in, and from where its place is seen: a place, or else a thing; on a table anywhere that is free.
fn support(
    shown: &Shown<'_>,
    deed: &Deed,
    of: &dyn Fn(ObjectId) -> Option<u32>,
) -> Option<(ObjectId, Anchor)> {
    let main = Thing::Object(deed.object?);
    let mut found: Vec<(bool, Relation, ObjectId)> = deed
        .changes
        .iter()
        .filter(|(told, holds)| *holds && told.ground.things[0] == main)
        .filter_map(|(told, _)| match (told.ground.relation, told.ground.things.get(1)) {
            (
                relation @ (Relation::OnTop | Relation::Inside | Relation::At),
                Some(Thing::Object(on)),
            ) => {
                let what = &shown.header.objects[on.index()];
                Some((what.fixed && !what.region, relation, *on))
            }
            _ => None,
        })
        .filter(|(_, _, on)| of(*on).is_some())
        .collect();
    found.sort_unstable();
    let (furniture, relation, on) = *found.first()?;
    let place = of(on)?;
    let anchor = if furniture && relation == Relation::OnTop {
        Anchor::Free(place)
    } else {
        Anchor::Top(place)
    };
    Some((on, anchor))
}

fn raised(height: f64) -> Translation3<f64> {
    Translation3::new(0.0, 0.0, height)
}

/// A thing that stays within so much of its place in the hand is held: metres, and radians.
const RIGID: (f64, f64) = (0.015, 0.2);
/// It was taken when it was so near to that place for the first time, or when the hand stopped before that.
const TIGHT: (f64, f64) = (0.005, 0.08);
/// A hand that is slower stands still, in metres per second.
const STOPPED: f64 = 0.025;
/// The grip of a hand may have been seen so much too late, and letting go too, in seconds.
const UNSEEN: f64 = 2.0;
/// What was taken is in the air when it is so far from where it was, in metres; that takes so long at most, in seconds.
const LIFTED: (f64, f64) = (0.06, 4.0);

impl Shown<'_> {
    /// What a hand held during a deed.
    fn grip(&self, hand: HandId, object: ObjectId, deed: &Deed) -> Option<Grip> {
        let grips = self.deeds.grips.iter();
        grips
            .filter(|grip| grip.hand == hand && grip.object == object)
            .find(|grip| grip.from <= deed.to && grip.to >= deed.from)
            .copied()
    }

    /// Where the thing is, seen from the hand.
    fn within(&self, grip: &Grip, time: f64) -> Option<Isometry3<f64>> {
        let hand = self.tracks.hand(grip.hand, time)?;
        Some(hand.inverse() * self.tracks.object(grip.object, time)?)
    }

    /// When the hand closed and opened. Where grips are not measured, a grip is seen only when the thing moves along, and letting go only when the hand
    /// is away; but the thing has its place in the hand from the one to the other.
    fn closed(&self, grip: &Grip) -> (f64, f64) {
        let alike = |one: &Isometry3<f64>, time: f64, (far, turned): (f64, f64)| {
            self.within(grip, time).is_none_or(|other| {
                (one.translation.vector - other.translation.vector).norm() <= far
                    && one.rotation.angle_to(&other.rotation) <= turned
            })
        };
        let same = |one: &Isometry3<f64>, time: f64| alike(one, time, RIGID);
        let early = (grip.from + 0.15).min(f64::midpoint(grip.from, grip.to));
        let late = (grip.to - 0.6).max(f64::midpoint(grip.from, grip.to));
        let (mut from, mut to) = (grip.from, grip.to);
        if let Some(place) = self.within(grip, early) {
            while from - STEP >= (grip.from - UNSEEN).max(0.0) && same(&place, from - STEP) {
                from -= STEP;
            }
            while from < grip.from && !alike(&place, from, TIGHT) && !self.rests(grip.hand, from) {
                from += STEP;
            }
        }
        if let Some(place) = self.within(grip, late) {
            while to - STEP > late && !same(&place, to) {
                to -= STEP;
            }
        }
        (from, to)
    }

    /// Whether a hand stands still.
    fn rests(&self, hand: HandId, time: f64) -> bool {
        let place = |time| Some(self.tracks.hand(hand, time)?.translation.vector);
        let (Some(before), Some(after)) = (place(time - STEP), place(time + STEP)) else {
            return false;
        };
        (after - before).norm() < 2.0 * STEP * STOPPED
    }

    /// When what was taken is in the air, and not yet on its way down again.
    fn lifted(&self, grip: &Grip, least: f64) -> f64 {
        let (far, longest) = LIFTED;
        let begin = grip.from;
        let Some(there) = self.tracks.object(grip.object, begin) else { return least };
        let end = (begin + longest).min(grip.to);
        let mut time = begin + STEP;
        while time < end {
            let gone = self.tracks.object(grip.object, time).is_some_and(|here| {
                (here.translation.vector - there.translation.vector).norm() >= far
            });
            if gone {
                return time;
            }
            time += STEP;
        }
        least.max(begin + STEP)
    }
}

/// Writes way points down.
struct Scribe<'a> {
    shown: &'a Shown<'a>,
    hand: HandId,
    begin: f64,
    points: Vec<WayPoint>,
}

impl Scribe<'_> {
    /// Keeps where the hand, or what it carries, is at a time.
    fn point(
        &mut self,
        time: f64,
        base: Isometry3<f64>,
        pose: Isometry3<f64>,
        anchor: Anchor,
        carried: Option<u32>,
        grip: Option<bool>,
    ) {
        let grip = grip.unwrap_or_else(|| {
            let grips = self.shown.deeds.grips.iter();
            grips
                .filter(|grip| grip.hand == self.hand)
                .any(|grip| grip.from <= time && time < grip.to)
        });
        self.points.push(WayPoint {
            hand: 0,
            carried,
            anchor,
            offset: base.inverse() * pose,
            grip,
            time: (time - self.begin).max(0.0),
        });
    }

    /// The way of the hand between two times.
    fn way(
        &mut self,
        from: f64,
        to: f64,
        base: Isometry3<f64>,
        anchor: Anchor,
        grip: bool,
    ) -> Option<()> {
        let poses = samples(from, to, |time| self.shown.tracks.hand(self.hand, time))?;
        for (time, pose) in simplified(&poses) {
            self.point(time, base, pose, anchor, None, Some(grip));
        }
        Some(())
    }

    /// The way of the foot of what the hand carries, until it lets go.
    fn carried(
        &mut self,
        from: f64,
        to: f64,
        object: ObjectId,
        argument: u32,
        base: Isometry3<f64>,
        anchor: Anchor,
    ) -> Option<()> {
        let tracks = self.shown.tracks;
        let foot = -self.shown.header.objects[object.index()].size.z / 2.0;
        // What is in the hand moves with it, and hands are tracked more densely.
        let grip = Grip { hand: self.hand, object, from, to, open: false };
        let held = self.shown.within(&grip, to - 2.0 * STEP)?;
        let poses =
            samples(from, to, |time| Some(tracks.hand(self.hand, time)? * held * raised(foot)))?;
        for (time, pose) in simplified(&poses) {
            self.point(time, base, pose, anchor, Some(argument), Some(true));
        }
        Some(())
    }

    /// When the hand is well away from a place that it leaves.
    fn gone(&self, from: f64, place: Isometry3<f64>) -> f64 {
        let (far, longest) = GONE;
        let away = |time: f64| {
            let hand = self.shown.tracks.hand(self.hand, time)?.translation.vector;
            Some((hand - place.translation.vector).xy().norm())
        };
        let steps = (0..).map(|step| from + f64::from(step) * STEP);
        let mut last = from;
        for time in steps.take_while(|time| *time <= from + longest) {
            let Some(distance) = away(time) else { break };
            last = time;
            if distance >= far {
                break;
            }
        }
        last
    }

    /// When the hand last was clear of where it is at `time`; the routine begins there.
    fn begin_near(&mut self, time: f64) -> Option<f64> {
        let there = self.shown.tracks.hand(self.hand, time)?.translation.vector;
        let back = (1..).map(|step| time - f64::from(step) * STEP);
        let begin = back.take_while(|at| *at >= time - LONGEST).find(|at| {
            let hand = self.shown.tracks.hand(self.hand, *at);
            hand.is_some_and(|hand| (hand.translation.vector - there).norm() >= CLEAR)
        });
        self.begin = begin.unwrap_or((time - LONGEST).max(0.0));
        Some(self.begin)
    }

    /// When the hand last was clear of where it is at `time` and as high as it gets on its way there; the routine begins there.
    fn begin_high(&mut self, from: f64, time: f64) -> Option<f64> {
        let there = self.shown.tracks.hand(self.hand, time)?.translation.vector;
        let steps = ((time - from).clamp(STEP, LONGEST) / STEP).ceil() as u32;
        let way: Vec<(f64, Vector3<f64>)> = (1..=steps)
            .map(|step| time - f64::from(step) * STEP)
            .filter_map(|at| Some((at, self.shown.tracks.hand(self.hand, at)?.translation.vector)))
            .collect();
        let peak = way.iter().map(|(_, place)| place.z).reduce(f64::max)?;
        let high = |place: &Vector3<f64>| place.z - there.z >= 0.8 * (peak - there.z);
        let begin = way
            .iter()
            .find(|(_, place)| high(place) && (place - there).norm() >= CLEAR.min(peak - there.z));
        self.begin = begin.or(way.last()).map(|(at, _)| *at)?;
        Some(self.begin)
    }

    /// Lets go, and the way of the hand until it is clear.
    fn away(&mut self, from: f64, base: Isometry3<f64>, anchor: Anchor) -> Option<()> {
        let there = self.shown.tracks.hand(self.hand, from)?.translation.vector;
        let steps = (1..).map(|step| from + f64::from(step) * STEP);
        let end = steps.take_while(|at| *at <= from + LONGEST).find(|at| {
            let hand = self.shown.tracks.hand(self.hand, *at);
            hand.is_some_and(|hand| (hand.translation.vector - there).norm() >= CLEAR)
        });
        let end = end.unwrap_or(from + 10.0 * STEP);
        let poses = samples(from, end, |time| self.shown.tracks.hand(self.hand, time))?;
        for (time, pose) in simplified(&poses) {
            self.point(time, base, pose, anchor, None, Some(false));
        }
        Some(())
    }
}

/// A way in steps of equal time, with both ends.
fn samples(
    from: f64,
    to: f64,
    at: impl Fn(f64) -> Option<Isometry3<f64>>,
) -> Option<Vec<(f64, Isometry3<f64>)>> {
    let steps = ((to - from) / STEP).ceil().max(1.0) as u32;
    let poses = (0..=steps).filter_map(|step| {
        let time = from + (to - from) * f64::from(step) / f64::from(steps);
        Some((time, at(time)?))
    });
    let poses: Vec<_> = poses.collect();
    (poses.len() > 1).then_some(poses)
}

/// The few poses from which a way departs by little.
fn simplified(poses: &[(f64, Isometry3<f64>)]) -> Vec<(f64, Isometry3<f64>)> {
    let mut keep = vec![false; poses.len()];
    keep[0] = true;
    keep[poses.len() - 1] = true;
    let mut spans = vec![(0, poses.len() - 1)];
    while let Some((from, to)) = spans.pop() {
        let worst = (from + 1..to)
            .map(|place| (away(&poses[place].1, &poses[from].1, &poses[to].1), place))
            .max_by(|one, other| one.0.total_cmp(&other.0));
        if let Some((distance, place)) = worst
            && distance > TOLERANCE
        {
            keep[place] = true;
            spans.extend([(from, place), (place, to)]);
        }
    }
    poses.iter().zip(keep).filter(|(_, keep)| *keep).map(|(pose, _)| *pose).collect()
}

/// How far a pose is from the straight way between two others.
fn away(pose: &Isometry3<f64>, from: &Isometry3<f64>, to: &Isometry3<f64>) -> f64 {
    let line: Vector3<f64> = to.translation.vector - from.translation.vector;
    let offset = pose.translation.vector - from.translation.vector;
    let turn = from.rotation.angle_to(&to.rotation);
    let length = line.norm_squared() + (turn * RADIAN).powi(2);
    let along = offset.dot(&line) + from.rotation.angle_to(&pose.rotation) * turn * RADIAN * RADIAN;
    let share = if length > 0.0 { (along / length).clamp(0.0, 1.0) } else { 0.0 };
    let between = from.lerp_slerp(to, share);
    let place = (pose.translation.vector - between.translation.vector).norm();
    place.hypot(between.rotation.angle_to(&pose.rotation) * RADIAN)
}
