//! The parts of a joint step go in; which of them hands carry out at once, and in which order, comes out.

use learner::log::ObjectId;
use learner::waypoints::{Anchor, Routine};
use nalgebra::{Isometry3, Vector3};

use super::{PlanStep, Run};

/// Hands whose ways come nearer to each other than this take turns, in metres.
const ROOM: f64 = 0.15;

/// Steps of a joint step that are done at once.
struct Turn<'plan> {
    /// They follow somebody.
    follows: bool,
    steps: Vec<&'plan PlanStep>,
    /// Where their hands will be.
    way: Vec<Vector3<f64>>,
}

impl Run {
    /// Which steps are done at once, and in which order.
    pub(super) fn turns<'s>(
        &self,
        steps: &'s [PlanStep],
        routines: &[Routine],
    ) -> Vec<Vec<&'s PlanStep>> {
        let found = |step: &PlanStep| Routine::nearest(routines, &step.name, &step.arguments);
        let mut groups: Vec<(bool, Vec<&PlanStep>)> = Vec::new();
        for step in steps {
            let with = |other: &PlanStep| {
                let names = |one: &PlanStep, two: &PlanStep| {
                    found(one).is_some_and(|routine| {
                        routine.with.iter().any(|name| name.eq_ignore_ascii_case(&two.name))
                    })
                };
                names(step, other) || names(other, step)
            };
            let follows = found(step).is_some_and(|routine| routine.follows);
            match groups.iter_mut().find(|(_, group)| group.iter().any(|other| with(other))) {
                Some((_, group)) => group.push(step),
                None => groups.push((follows, vec![step])),
            }
        }
        groups.sort_by_key(|(follows, _)| *follows);
        let mut turns: Vec<Turn<'s>> = Vec::new();
        for (follows, group) in groups {
            let way: Vec<Vector3<f64>> =
                group.iter().flat_map(|step| self.outline(step, found(step))).collect();
            let clear = |other: &[Vector3<f64>]| {
                way.iter().all(|one| other.iter().all(|two| (one - two).norm() >= ROOM))
            };
            match turns.last_mut() {
                Some(last) if last.follows == follows && clear(&last.way) => {
                    last.steps.extend(group);
                    last.way.extend(way);
                }
                _ => turns.push(Turn { follows, steps: group, way }),
            }
        }
        turns.into_iter().map(|turn| turn.steps).collect()
    }

    /// Roughly where the hands of a step will be: points of their ways, not far from one another.
    fn outline(&self, step: &PlanStep, routine: Option<&Routine>) -> Vec<Vector3<f64>> {
        let Some(routine) = routine else { return Vec::new() };
        let arguments: Vec<Option<ObjectId>> =
            step.arguments.iter().map(|name| self.stage.named(name)).collect();
        let mut outline = Vec::new();
        for (role, doer) in routine.hands.iter().enumerate() {
            let Some(hand) = self.choose(doer, role as u32, step, routine, &arguments, &[]) else {
                continue;
            };
            let mut at = self.stage.hand(hand).translation.vector;
            outline.push(at);
            for point in routine.points.iter().filter(|point| point.hand as usize == role) {
                let anchor = match point.anchor {
                    Anchor::World => Isometry3::identity(),
                    Anchor::Hand(_) => self.stage.hand(hand),
                    Anchor::Middle(index) | Anchor::Top(index) | Anchor::Free(index) => {
                        let object = arguments.get(index as usize).copied().flatten();
                        object.map_or_else(Isometry3::identity, |object| self.stage.pose(object))
                    }
                };
                let next = (anchor * point.offset).translation.vector;
                let pieces = ((next - at).norm() / 0.03).ceil().max(1.0);
                outline.extend(
                    (1..=pieces as u32).map(|piece| at + (next - at) * (f64::from(piece) / pieces)),
                );
                at = next;
            }
        }
        outline
    }
}
