//! Nothing goes in; random headers with logs and truths that fit them come out.

use learner::log::{
    Fact, Frame, Hand, HandSample, HandState, Header, Joint, Motion, Object, ObjectId,
    ObjectSample, Reach, Type,
};
use learner::truth::{Activity, Truth};
use nalgebra::{Isometry3, UnitQuaternion, Vector3};
use proptest::prelude::*;

/// A number that JSON of the format keeps exactly: so many millionths.
fn exact(from: f64, to: f64) -> impl Strategy<Value = f64> {
    ((from * 1e6) as i64..=(to * 1e6) as i64).prop_map(|millionths| millionths as f64 / 1e6)
}

fn vector(from: f64, to: f64) -> impl Strategy<Value = Vector3<f64>> {
    [exact(from, to), exact(from, to), exact(from, to)].prop_map(Vector3::from)
}

fn pose() -> impl Strategy<Value = Isometry3<f64>> {
    (vector(-3.0, 3.0), vector(-3.0, 3.0))
        .prop_map(|(place, turn)| Isometry3::from_parts(place.into(), UnitQuaternion::new(turn)))
}

/// Headers with up to three hands of two agents and up to four objects.
fn headers() -> impl Strategy<Value = Header> {
    let reach = proptest::option::of((vector(-1.0, 1.0), exact(0.1, 2.0)));
    let joint = (any::<bool>(), 0..3usize, exact(-1.0, 0.0), exact(0.1, 2.0));
    let object = (vector(0.01, 2.0), any::<[bool; 3]>(), prop::collection::vec(joint, 0..3));
    (prop::collection::vec(reach, 1..4), prop::collection::vec(object, 0..5), exact(1.0, 200.0))
        .prop_map(|(hands, objects, rate)| Header {
            frame: "wörld \"1\"".into(),
            rate,
            types: vec![
                Type { name: "cube".into(), parent: Some("item".into()) },
                Type { name: "item".into(), parent: None },
            ],
            agents: vec!["person".into(), "robot".into()],
            hands: hands
                .into_iter()
                .enumerate()
                .map(|(place, reach)| Hand {
                    name: format!("händ.{place}"),
                    agent: u32::from(place == 2),
                    reach: reach.map(|(centre, radius)| Reach { centre, radius }),
                })
                .collect(),
            objects: objects
                .into_iter()
                .enumerate()
                .map(|(place, (size, [fixed, hollow, region], joints))| Object {
                    name: format!("object\\{place}"),
                    kind: "cube".into(),
                    size,
                    fixed,
                    hollow,
                    region,
                    joints: joints
                        .into_iter()
                        .enumerate()
                        .map(|(place, (slides, axis, lower, upper))| Joint {
                            name: format!("joint-{place}"),
                            motion: if slides { Motion::Slides } else { Motion::Turns },
                            axis: Vector3::ith(axis, 1.0),
                            lower,
                            upper,
                        })
                        .collect(),
                })
                .collect(),
        })
}

/// What a hand may do in a log with so many objects.
fn state(objects: usize) -> impl Strategy<Value = HandState> {
    let object = move || {
        proptest::option::of(0..objects.max(1) as u32)
            .prop_map(move |place| place.filter(|_| objects > 0).map(ObjectId))
    };
    (any::<bool>(), object(), object()).prop_map(|(moves, acted_on, in_hand)| HandState {
        moves,
        acted_on,
        in_hand,
    })
}

fn facts() -> impl Strategy<Value = Vec<Fact>> {
    let fact = ("[a-z-]{1,8}", prop::collection::vec("[a-z0-9-]{1,6}", 0..3))
        .prop_map(|(predicate, arguments)| Fact { predicate, arguments });
    prop::collection::vec(fact, 0..3)
}

/// Logs of up to five frames.
pub fn logs() -> impl Strategy<Value = (Header, Vec<Frame>)> {
    headers().prop_flat_map(|header| {
        let count = header.objects.len();
        let hand = (
            pose(),
            proptest::option::of(exact(0.0, 1.0)),
            any::<bool>(),
            proptest::option::of(state(count)),
        )
            .prop_map(|(pose, grip, teach, given)| HandSample { pose, grip, teach, given });
        let hands = prop::collection::vec(proptest::option::of(hand), header.hands.len());
        let joints: Vec<usize> = header.objects.iter().map(|object| object.joints.len()).collect();
        let objects: Vec<_> = joints
            .into_iter()
            .map(|count| {
                let values =
                    prop_oneof![Just(Vec::new()), prop::collection::vec(exact(-2.0, 2.0), count)];
                let sample = (pose(), values, exact(0.0, 1.0))
                    .prop_map(|(pose, joints, seen)| ObjectSample { pose, joints, seen });
                proptest::option::of(sample)
            })
            .collect();
        let frame = (exact(0.001, 1.0), hands, objects, proptest::option::of(facts()))
            .prop_map(|(time, hands, objects, facts)| Frame { time, hands, objects, facts });
        prop::collection::vec(frame, 0..5).prop_map(move |mut frames| {
            let mut millionths = 0;
            for frame in &mut frames {
                millionths += (frame.time * 1e6).round() as i64;
                frame.time = millionths as f64 / 1e6;
            }
            (header.clone(), frames)
        })
    })
}

/// Truths of up to five frames.
pub fn truths() -> impl Strategy<Value = (Header, Vec<Truth>)> {
    headers().prop_flat_map(|header| {
        let activity = (0..5usize).prop_map(|place| Activity::ALL[place]);
        let hands =
            prop::collection::vec((state(header.objects.len()), activity), header.hands.len());
        let truth = (hands, facts()).prop_map(|(hands, facts)| Truth { time: 0.0, hands, facts });
        prop::collection::vec(truth, 0..5).prop_map(move |mut truths| {
            for (place, truth) in truths.iter_mut().enumerate() {
                truth.time = place as f64 / 8.0;
            }
            (header.clone(), truths)
        })
    })
}

/// Whether two frames are the same but for rotations, which are alike to a few millionths.
pub fn alike(one: &Frame, other: &Frame) -> bool {
    let poses = |one: &Isometry3<f64>, other: &Isometry3<f64>| {
        (one.translation.vector - other.translation.vector).norm() < 1e-9
            && one.rotation.angle_to(&other.rotation) < 1e-5
    };
    let hands = |one: &Option<HandSample>, other: &Option<HandSample>| match (one, other) {
        (Some(one), Some(other)) => {
            poses(&one.pose, &other.pose)
                && (one.grip, one.teach, one.given) == (other.grip, other.teach, other.given)
        }
        (None, None) => true,
        _ => false,
    };
    let objects = |one: &Option<ObjectSample>, other: &Option<ObjectSample>| match (one, other) {
        (Some(one), Some(other)) => {
            poses(&one.pose, &other.pose)
                && one.joints == other.joints
                && one.seen.to_bits() == other.seen.to_bits()
        }
        (None, None) => true,
        _ => false,
    };
    one.time.to_bits() == other.time.to_bits()
        && one.facts == other.facts
        && one.hands.len() == other.hands.len()
        && one.hands.iter().zip(&other.hands).all(|(one, other)| hands(one, other))
        && one.objects.iter().zip(&other.objects).all(|(one, other)| objects(one, other))
}
