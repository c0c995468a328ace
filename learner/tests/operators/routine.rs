//! A script and the ways of hands and things go in; the way points of each action come out, seen from the thing that the action is about.

use learner::log::{Frame, HandSample, Header, ObjectSample};
use learner::operators::record::Record;
use learner::operators::routine::{Shown, routines};
use learner::operators::track::Tracks;
use learner::waypoints::{Anchor, Doer, Routine};
use nalgebra::{Isometry3, Vector3};

use super::words::{options, taught};

const STACK: &str = "things red blue - cube table - table
    holds (on-top red table) (on-top blue table) (clear red) (clear blue) (hand-empty left) (hand-empty right)
    2.0 left takes red
    2.2 - (on-top red table) left holding
    4.0 + (on-top red blue) left holding
    4.0 - (clear blue) left holding
    4.0 left lets go";

/// Where the cubes stand in the beginning, and where the hand goes at which times.
const RED: Vector3<f64> = Vector3::new(0.2, 0.0, 0.025);
const BLUE: Vector3<f64> = Vector3::new(-0.2, 0.1, 0.025);

/// The place of the left hand: down to the red cube, up, over to the blue one, down, and up again.
fn hand(time: f64) -> Vector3<f64> {
    let high = Vector3::new(0.0, 0.0, 0.3);
    let stacked = BLUE + Vector3::new(0.0, 0.0, 0.05);
    let stops = [
        (0.0, Vector3::new(0.5, 0.5, 0.4)),
        (1.0, RED + high),
        (2.0, RED),
        (2.8, RED + high),
        (3.4, BLUE + high),
        (4.0, stacked),
        (4.8, stacked + high),
        (9.0, stacked + high),
    ];
    let next = stops.iter().position(|(at, _)| *at > time).expect("the script ends before");
    let ((from, one), (to, other)) = (stops[next - 1], stops[next]);
    one + (other - one) * ((time - from) / (to - from))
}

/// Where everything was.
fn tracks(header: &Header) -> Tracks {
    let mut tracks = Tracks::new(header);
    for step in 0..540 {
        let time = f64::from(step) / 90.0;
        let at = |place: Vector3<f64>| {
            Isometry3::from_parts(place.into(), nalgebra::UnitQuaternion::identity())
        };
        let red = match time {
            _ if time < 2.0 => RED,
            _ if time < 4.0 => hand(time),
            _ => hand(4.0),
        };
        let hand =
            |place| Some(HandSample { pose: at(place), grip: None, teach: false, given: None });
        let thing = |place| Some(ObjectSample { pose: at(place), joints: Vec::new(), seen: 1.0 });
        tracks.push(&Frame {
            time,
            hands: vec![hand(self::hand(time)), hand(Vector3::new(1.0, 1.0, 1.0))],
            objects: vec![thing(red), thing(BLUE), thing(Vector3::new(0.0, 0.0, -0.025))],
            facts: None,
        });
    }
    tracks
}

/// The routines of the script.
fn shown() -> Vec<Routine> {
    let taught = taught(&[STACK], &options());
    let (record, _): &(Record, _) = &super::words::records(&[STACK])[0];
    let tracks = tracks(&record.header);
    let (deeds, line) = &taught.lines[0];
    let shown = Shown { header: &record.header, tracks: &tracks, deeds, line, names_hands: true };
    routines(&[shown], &taught.learned)
}

#[test]
fn a_cube_is_taken_from_where_it_is_and_put_on_what_is_named() {
    let routines = shown();
    let [take, put] = &routines[..] else { panic!("{routines:#?}") };
    assert_eq!(
        (take.action.as_str(), put.action.as_str()),
        ("take-cube-from-table", "put-cube-on-cube")
    );
    assert_eq!(take.shown, ["left", "red", "table"]);
    assert_eq!(put.shown, ["left", "red", "blue"]);
    assert_eq!(take.hands, [Doer::Argument(0)]);
    // The hand comes from above, closes at the middle of the cube, and lifts it.
    assert!(take.points.iter().all(|point| point.anchor == Anchor::Middle(1)), "{take:#?}");
    let closed = take.points.iter().position(|point| point.grip).expect("the hand closes");
    assert!(closed > 0, "{take:#?}");
    assert!(take.points[closed].offset.translation.vector.norm() < 0.02, "{take:#?}");
    assert!(take.points[0].offset.translation.vector.norm() >= 0.13, "{take:#?}");
    // The foot of the cube comes to the middle of the upper face of the other.
    let last = put.points.iter().rev().find(|point| point.carried == Some(1));
    let last = last.expect("the cube is carried");
    assert_eq!(last.anchor, Anchor::Top(2));
    assert!(last.offset.translation.vector.norm() < 0.01, "{put:#?}");
    let end = put.points.last().expect("there are way points");
    assert!(!end.grip && end.offset.translation.z > 0.1, "{put:#?}");
}

#[test]
fn a_straight_way_needs_few_way_points_in_the_order_of_time() {
    for routine in shown() {
        assert!(routine.points.len() <= 8, "{routine:#?}");
        let times: Vec<f64> = routine.points.iter().map(|point| point.time).collect();
        assert!(times.is_sorted(), "{times:?}");
    }
}

#[test]
fn routines_are_the_same_after_a_way_through_text() {
    let routines = shown();
    let text = serde_json::to_string(&routines).expect("they are plain data");
    let back: Vec<Routine> = serde_json::from_str(&text).expect("what was written can be read");
    assert_eq!(back.len(), routines.len());
    for (one, other) in routines.iter().zip(&back) {
        assert_eq!(
            (&one.action, &one.shown, &one.hands),
            (&other.action, &other.shown, &other.hands)
        );
        for (one, other) in one.points.iter().zip(&other.points) {
            let off = one.offset.inverse() * other.offset;
            assert!(off.translation.vector.norm() < 1e-9, "{one:?} {other:?}");
            assert_eq!(
                (one.anchor, one.carried, one.grip),
                (other.anchor, other.carried, other.grip)
            );
        }
    }
}

#[test]
fn of_several_routines_the_one_shown_with_the_most_alike_is_taken() {
    let mut routines = shown();
    let other = Routine {
        shown: ["right", "green", "table"].map(str::to_owned).to_vec(),
        ..routines[0].clone()
    };
    routines.push(other);
    let nearest = |arguments: [&str; 3]| {
        let arguments = arguments.map(str::to_owned);
        let found = Routine::nearest(&routines, "Take-Cube-From-Table", &arguments);
        found.map(|routine| routine.shown[1].as_str())
    };
    assert_eq!(nearest(["left", "red", "bench"]), Some("red"));
    assert_eq!(nearest(["right", "yellow", "bench"]), Some("green"));
    assert_eq!(nearest(["x", "y", "z"]), Some("red"), "the first of those that are equally alike");
    assert!(Routine::nearest(&routines, "fly", &[]).is_none());
}
