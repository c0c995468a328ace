//! Scripted logs go in; segments, as a person reads them, and how well frames are recognised come out.

#[path = "segment/scene.rs"]
mod scene;

use learner::log::HandId;
use learner::observe::{self, observe};
use learner::segment::{self, Tree, score, segments, timeline};
use learner::truth::Activity;
use nalgebra::Vector3;

use scene::{EDGE, Scene, cube};

const LEFT: HandId = HandId(0);
const RIGHT: HandId = HandId(1);

/// The right hand stacks one cube on another, past a third one, and the left hand moves the third one away.
fn stacking(noise: f64, grip: bool) -> Scene {
    let flat = |x: f64, y: f64| Vector3::new(x, y, EDGE / 2.0);
    let objects = vec![
        (cube("red"), flat(0.3, -0.3)),
        (cube("blue"), flat(0.3, 0.1)),
        (cube("green"), flat(0.3, 0.4)),
    ];
    let mut scene = Scene::new(objects, noise);
    scene.grip = grip;
    let [red, blue, green] = ["red", "blue", "green"].map(|name| scene.id(name));
    scene.rest(0.5);
    scene.take(RIGHT, red);
    scene.go(RIGHT, Vector3::new(0.3, -0.2, 0.25), 0.7, None);
    scene.go(RIGHT, Vector3::new(0.3, 0.1, 0.30), 0.7, None);
    let top = scene.place(blue) + Vector3::new(0.0, 0.0, EDGE);
    scene.go(RIGHT, top, 0.9, Some(blue));
    scene.release(RIGHT);
    scene.take(LEFT, green);
    scene.go(LEFT, Vector3::new(0.3, 0.6, 0.2), 0.8, None);
    scene.go(LEFT, Vector3::new(0.3, 0.7, EDGE / 2.0), 0.7, None);
    scene.release(LEFT);
    scene.rest(0.5);
    scene
}

/// The segments of a scene as names.
fn names(scene: &Scene, hand: HandId) -> Vec<String> {
    let observations = observe(&scene.header, &observe::Config::default(), &scene.frames);
    segments(&Tree::published(), &segment::Config::default(), &observations)
        .into_iter()
        .filter(|segment| segment.hand == hand)
        .map(|segment| {
            let name =
                |object: learner::log::ObjectId| scene.header.objects[object.index()].name.clone();
            let mut text = segment.activity.to_string();
            for object in [segment.in_hand, segment.acted_on].into_iter().flatten() {
                text += " ";
                text += &name(object);
            }
            text
        })
        .collect()
}

const STACKING: [&str; 6] =
    ["Idle", "Reach red", "Take red", "Put red", "Granular red blue", "Idle"];

#[test]
fn stacking_is_seen_as_it_is_whatever_the_noise_and_the_grip() {
    for grip in [true, false] {
        for noise in [0.0, 0.001, 0.002, 0.003] {
            let scene = stacking(noise, grip);
            assert_eq!(names(&scene, RIGHT), STACKING, "grip {grip}, noise {noise}");
            let left = ["Idle", "Reach green", "Take green", "Put green", "Take green", "Idle"];
            assert_eq!(names(&scene, LEFT), left, "grip {grip}, noise {noise}");
        }
    }
}

#[test]
fn frames_are_recognised_rightly() {
    let tree = Tree::published();
    for (grip, noise, least) in
        [(true, 0.0, 0.98), (true, 0.003, 0.97), (false, 0.0, 0.96), (false, 0.003, 0.95)]
    {
        let scene = stacking(noise, grip);
        let observations = observe(&scene.header, &observe::Config::default(), &scene.frames);
        assert_eq!(observations.len(), scene.frames.len());
        let score = score(&tree, &segment::Config::default(), &observations, &scene.truths);
        assert_eq!(score.frames(), 2 * scene.frames.len() as u64);
        println!("grip {grip}, noise {noise}\n{score}");
        assert!(score.accuracy() >= least, "grip {grip}, noise {noise}\n{score}");
        for activity in Activity::ALL {
            let f1 = score.f1(activity).expect("every activity occurs");
            assert!(f1 >= 0.85, "{activity}, grip {grip}, noise {noise}\n{score}");
        }
    }
}

#[test]
fn a_pause_on_the_way_does_not_split_unless_asked_for() {
    let objects = vec![(cube("red"), Vector3::new(0.3, -0.3, EDGE / 2.0))];
    let mut scene = Scene::new(objects, 0.002);
    let red = scene.id("red");
    scene.rest(0.4);
    scene.take(RIGHT, red);
    scene.go(RIGHT, Vector3::new(0.3, 0.0, 0.3), 0.8, None);
    scene.rest(0.5);
    scene.go(RIGHT, Vector3::new(0.3, 0.3, EDGE / 2.0), 0.8, None);
    scene.release(RIGHT);
    let expected = ["Idle", "Reach red", "Take red", "Put red", "Take red", "Idle"];
    assert_eq!(names(&scene, RIGHT), expected);
    let observations = observe(&scene.header, &observe::Config::default(), &scene.frames);
    let config = segment::Config { pause: 0.0, ..segment::Config::default() };
    let strict = segments(&Tree::published(), &config, &observations);
    let puts = strict.iter().filter(|segment| segment.activity == Activity::Put).count();
    assert_eq!(puts, 2);
    let pausing = segments(&Tree::published(), &segment::Config::default(), &observations);
    let put = pausing.iter().find(|segment| segment.activity == Activity::Put).unwrap();
    assert_eq!(put.pauses.len(), 1);
}

#[test]
fn a_time_line_fits_a_terminal() {
    let scene = stacking(0.002, true);
    let observations = observe(&scene.header, &observe::Config::default(), &scene.frames);
    let segments = segments(&Tree::published(), &segment::Config::default(), &observations);
    let text = timeline(&scene.header, &segments);
    assert!(text.lines().all(|line| line.chars().count() <= 100));
    insta::assert_snapshot!(text);
    insta::assert_snapshot!("picture", segment::picture(&scene.header, &segments));
}
