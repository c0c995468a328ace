//! A physical world goes in; what holds in it comes out: from contacts, grips and the values of joints, without noise and without any learner's geometry.

use super::stage::Stage;
use super::thing::Mount;
use learner::log::{Fact, HandId, Header, ObjectId};
use nalgebra::{Translation3, Vector3};

/// Below this share of its way something is closed.
const CLOSED: f64 = 0.1;
/// From this share of its way on it is open.
const OPEN: f64 = 0.5;

/// All that holds, in the vocabulary of the learner: `on-top`, `inside`, `clear`, `open`, `closed`, `blocks`, `unblocked`, `at`, `reachable`, `in-hand` and `hand-empty`.
pub(crate) fn facts(stage: &Stage, header: &Header) -> Vec<Fact> {
    let name = |object: ObjectId| header.objects[object.index()].name.clone();
    let hand_name = |hand: HandId| header.hands[hand.index()].name.clone();
    let mut facts = Vec::new();
    let mut say = |predicate: &str, arguments: Vec<String>| {
        facts.push(Fact { predicate: predicate.to_owned(), arguments });
    };
    let resting = resting(stage);
    let contained = contained(stage, &resting);
    for &(above, below) in &resting {
        if !contained.iter().any(|(thing, _)| *thing == above) {
            say("on-top", vec![name(above), name(below)]);
        }
    }
    for &(thing, container) in &contained {
        say("inside", vec![name(thing), name(container)]);
    }
    for object in stage.objects() {
        let thing = stage.thing(object);
        if thing.mount == Mount::Free && !resting.iter().any(|(_, below)| *below == object) {
            say("clear", vec![name(object)]);
        }
        if let Some(opening) = stage.opening(object) {
            if opening <= CLOSED {
                say("closed", vec![name(object)]);
            } else if opening >= OPEN {
                say("open", vec![name(object)]);
            }
        }
        if matches!(thing.mount, Mount::Slides(_)) {
            let blocking: Vec<ObjectId> = stage
                .objects()
                .filter(|other| *other != object && blocks(stage, *other, object))
                .collect();
            for other in &blocking {
                say("blocks", vec![name(*other), name(object)]);
            }
            if blocking.is_empty() {
                say("unblocked", vec![name(object)]);
            }
        }
        if thing.mount == Mount::Nowhere {
            for other in stage.objects().filter(|other| stage.thing(*other).mount == Mount::Free) {
                let held = stage.hands().any(|hand| stage.held(hand) == Some(other));
                if !held && over(stage, object, stage.pose(other).translation.vector) {
                    say("at", vec![name(other), name(object)]);
                }
            }
            for hand in stage.hands() {
                if over(stage, object, stage.hand(hand).translation.vector) {
                    say("at", vec![hand_name(hand), name(object)]);
                }
            }
        }
    }
    for hand in stage.hands() {
        match stage.held(hand) {
            Some(object) => say("in-hand", vec![name(object), hand_name(hand)]),
            None => say("hand-empty", vec![hand_name(hand)]),
        }
        if let Some(reach) = header.hands[hand.index()].reach {
            for object in stage.objects().filter(|object| {
                !stage.thing(*object).object.fixed || stage.thing(*object).object.region
            }) {
                let off = stage.pose(object).translation.vector - reach.centre;
                if off.norm() <= reach.radius {
                    say("reachable", vec![name(object), hand_name(hand)]);
                }
            }
        }
    }
    facts.sort();
    facts
}

/// What rests on what: pairs that press on each other from above and below, and a lid on its bottle.
fn resting(stage: &Stage) -> Vec<(ObjectId, ObjectId)> {
    let mut pairs: Vec<(ObjectId, ObjectId)> = stage
        .contacts()
        .into_iter()
        .filter_map(|(first, second, towards)| {
            if towards.z < -0.7 {
                Some((first, second))
            } else if towards.z > 0.7 {
                Some((second, first))
            } else {
                None
            }
        })
        .chain(stage.objects().filter_map(|lid| stage.screwed(lid).map(|bottle| (lid, bottle))))
        .filter(|(above, _)| stage.thing(*above).mount == Mount::Free)
        .collect();
    pairs.sort();
    pairs.dedup();
    pairs
}

/// What lies in something hollow: its middle is within, and it rests on that or on something that does.
fn contained(stage: &Stage, resting: &[(ObjectId, ObjectId)]) -> Vec<(ObjectId, ObjectId)> {
    let within = |thing: ObjectId, container: ObjectId| {
        let middle = stage.pose(container).inverse() * stage.pose(thing);
        let half = stage.thing(container).object.size / 2.0;
        let middle = middle.translation.vector;
        (0..3).all(|axis| middle[axis].abs() < half[axis])
    };
    let mut found = Vec::new();
    for container in stage.objects().filter(|object| stage.thing(*object).object.hollow) {
        for &(above, below) in resting {
            let supported = below == container
                || resting.contains(&(below, container)) && within(below, container);
            if supported && within(above, container) {
                found.push((above, container));
            }
        }
    }
    found
}

/// Whether something stands where a drawer moves when it is opened.
fn blocks(stage: &Stage, obstacle: ObjectId, drawer: ObjectId) -> bool {
    let thing = stage.thing(drawer);
    if !matches!(stage.thing(obstacle).mount, Mount::Free) {
        return false;
    }
    let joint = &thing.object.joints[0];
    let rest = joint.upper - stage.joints(drawer)[0];
    if rest < 0.02 {
        return false;
    }
    // The space before the front, as far as the drawer still goes; what lies in the drawer moves with it.
    let half = thing.object.size / 2.0;
    let reach = half.dot(&joint.axis.abs()) + rest / 2.0;
    let middle = stage.pose(drawer) * Translation3::from(joint.axis * reach);
    let mut space = half;
    for axis in 0..3 {
        if joint.axis[axis].abs() > 0.5 {
            space[axis] = rest / 2.0;
        }
    }
    stage.overlaps(obstacle, &middle, space)
}

/// Whether a point is over a place, no higher than half a metre.
fn over(stage: &Stage, spot: ObjectId, point: Vector3<f64>) -> bool {
    let half = stage.thing(spot).object.size / 2.0;
    let off = stage.pose(spot).inverse() * nalgebra::Point3::from(point);
    off.x.abs() < half.x && off.y.abs() < half.y && (-0.01..0.5).contains(&off.z)
}
