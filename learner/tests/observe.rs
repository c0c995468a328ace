//! Scripted logs go in; which facts begin and end, when, and by which hand comes out.

#[path = "segment/scene.rs"]
mod scene;

use learner::log::{Frame, Hand, HandId, Joint, Motion, Object, Reach};
use learner::observe::{Band, Change, Config, Observation, Observer, Relation, observe};
use nalgebra::Vector3;

use scene::{EDGE, RATE, Scene, cube};

const LEFT: HandId = HandId(0);
const RIGHT: HandId = HandId(1);

/// A drawer that opens along x.
fn drawer() -> Object {
    let joint = Joint {
        name: "slide".into(),
        motion: Motion::Slides,
        axis: Vector3::x(),
        lower: 0.0,
        upper: 0.3,
    };
    Object {
        name: "drawer".into(),
        kind: "drawer".into(),
        size: Vector3::new(0.4, 0.4, 0.15),
        hollow: true,
        joints: vec![joint],
        ..cube("")
    }
}

/// What happens in a log after its first frame, with the hand that gets the first credit if it held or touched something: `+(on-top red blue) right-hand holds`.
fn story(scene: &Scene, config: &Config) -> Vec<String> {
    let tell = |change: &Change| {
        let sign = if change.holds { '+' } else { '-' };
        let words: Vec<&str> = std::iter::once(&change.fact.predicate)
            .chain(&change.fact.arguments)
            .map(String::as_str)
            .collect();
        let credit = change.credits.first().filter(|credit| credit.touches).map_or(
            String::new(),
            |credit| {
                let hand = &scene.header.hands[credit.hand.index()].name;
                format!(" {hand} {}", if credit.holds { "holds" } else { "touches" })
            },
        );
        format!("{sign}({}){credit}", words.join(" "))
    };
    let observations = observe(&scene.header, config, &scene.frames);
    observations
        .iter()
        .skip(1)
        .flat_map(|observation| observation.changes.iter().map(tell))
        .collect()
}

/// What holds in the first frame.
fn beginning(scene: &Scene, config: &Config) -> Vec<String> {
    let observations = observe(&scene.header, config, &scene.frames);
    let first = &observations[0];
    assert!(first.changes.iter().all(|change| change.holds && change.fresh));
    first
        .changes
        .iter()
        .map(|change| format!("({} {})", change.fact.predicate, change.fact.arguments.join(" ")))
        .collect()
}

/// The right hand stacks the red cube on the blue one.
fn stacking(noise: f64) -> Scene {
    let objects = vec![
        (cube("red"), Vector3::new(0.3, -0.3, EDGE / 2.0)),
        (cube("blue"), Vector3::new(0.3, 0.1, EDGE / 2.0)),
    ];
    let mut scene = Scene::new(objects, noise);
    let [red, blue] = ["red", "blue"].map(|name| scene.id(name));
    scene.rest(0.5);
    scene.take(RIGHT, red);
    scene.go(RIGHT, Vector3::new(0.3, -0.1, 0.25), 0.8, None);
    scene.go(RIGHT, scene.place(blue) + Vector3::new(0.0, 0.0, EDGE), 0.8, Some(blue));
    scene.release(RIGHT);
    scene.rest(0.3);
    scene
}

#[test]
fn a_cube_is_taken_and_stacked_by_one_hand_at_any_noise() {
    for noise in [0.0, 0.001, 0.003] {
        let scene = stacking(noise);
        let expected = [
            "(clear blue)",
            "(clear red)",
            "(hand-empty left-hand)",
            "(hand-empty right-hand)",
            "(on-top blue table)",
            "(on-top red table)",
        ];
        assert_eq!(beginning(&scene, &Config::default()), expected, "noise {noise}");
        let expected = [
            "-(hand-empty right-hand)",
            "-(on-top red table) right-hand holds",
            "+(in-hand red right-hand) right-hand holds",
            "-(clear blue) right-hand holds",
            "-(in-hand red right-hand) right-hand holds",
            "+(hand-empty right-hand)",
            "+(on-top red blue) right-hand holds",
        ];
        assert_eq!(story(&scene, &Config::default()), expected, "noise {noise}");
    }
}

#[test]
fn what_is_held_may_rest_as_well() {
    let config = Config { held_things_rest: true, ..Config::default() };
    let expected = [
        "-(hand-empty right-hand)",
        "+(in-hand red right-hand) right-hand holds",
        "-(on-top red table) right-hand holds",
        "-(clear blue) right-hand holds",
        "+(on-top red blue) right-hand holds",
        "-(in-hand red right-hand) right-hand holds",
        "+(hand-empty right-hand)",
    ];
    assert_eq!(story(&stacking(0.002), &config), expected);
}

#[test]
fn facts_are_told_in_the_words_of_another_domain() {
    let mut config = Config::default();
    config.vocabulary.in_hand = "(holding ?object)".parse().expect("it is an atom");
    config.vocabulary.hand_empty = "(hand-clear)".parse().expect("it is an atom");
    config.vocabulary.on_top = "(on ?above ?below)".parse().expect("it is an atom");
    let config: Config =
        serde_json::from_str(&serde_json::to_string(&config).expect("it can be written"))
            .expect("it can be read");
    let story = story(&stacking(0.001), &config);
    // The other hand stays empty all the time, so a predicate that does not tell hands apart never changes.
    assert!(!story.iter().any(|line| line.contains("hand-clear")), "{story:?}");
    assert!(story.contains(&"+(holding red) right-hand holds".to_string()), "{story:?}");
    assert!(story.contains(&"+(on red blue) right-hand holds".to_string()), "{story:?}");
}

/// The left hand opens a drawer that a box in front of it blocks until the right hand takes the box away; then it puts a cube inside.
fn kitchen(noise: f64) -> Scene {
    let box_ = Object {
        name: "box".into(),
        kind: "box".into(),
        size: Vector3::new(0.1, 0.1, 0.2),
        ..cube("")
    };
    let objects = vec![
        (drawer(), Vector3::new(0.0, 0.0, 0.085)),
        (box_, Vector3::new(0.3, 0.0, 0.1)),
        (cube("red"), Vector3::new(0.3, 0.6, EDGE / 2.0)),
    ];
    let mut scene = Scene::new(objects, noise);
    let [drawer, obstacle, red] = ["drawer", "box", "red"].map(|name| scene.id(name));
    scene.rest(0.4);
    scene.take(RIGHT, obstacle);
    scene.go(RIGHT, Vector3::new(0.3, -0.6, 0.1), 1.2, None);
    scene.release(RIGHT);
    scene.take(LEFT, drawer);
    scene.go(LEFT, scene.place(drawer) + Vector3::new(0.25, 0.0, 0.0), 1.2, None);
    scene.release(LEFT);
    scene.take(LEFT, red);
    let over = scene.place(drawer) + Vector3::new(0.1, 0.0, 0.3);
    scene.go(LEFT, over, 1.0, None);
    scene.go(LEFT, over - Vector3::new(0.0, 0.0, 0.34), 0.8, Some(drawer));
    scene.release(LEFT);
    scene.rest(0.3);
    scene
}

#[test]
fn drawers_are_unblocked_opened_and_filled_by_the_hands_that_do_it() {
    for noise in [0.0, 0.002] {
        let story = story(&kitchen(noise), &Config::default());
        let of = |predicate: &str| -> Vec<&str> {
            story
                .iter()
                .filter(|line| line.contains(&format!("({predicate}")))
                .map(String::as_str)
                .collect()
        };
        assert_eq!(of("blocks"), ["-(blocks box drawer) right-hand holds"], "noise {noise}");
        assert_eq!(of("unblocked"), ["+(unblocked drawer) right-hand holds"], "noise {noise}");
        assert_eq!(of("open"), ["+(open drawer) left-hand holds"], "noise {noise}");
        assert_eq!(of("closed"), ["-(closed drawer) left-hand holds"], "noise {noise}");
        assert_eq!(of("inside"), ["+(inside red drawer) left-hand holds"], "noise {noise}");
        assert_eq!(of("on-top red"), ["-(on-top red table) left-hand holds"], "noise {noise}");
    }
}

#[test]
fn places_and_reaches_are_observed_where_a_log_has_them() {
    let spot = Object {
        name: "spot".into(),
        kind: "spot".into(),
        size: Vector3::new(0.2, 0.2, 0.02),
        region: true,
        fixed: true,
        ..cube("")
    };
    let objects = vec![
        (spot, Vector3::new(0.3, 0.3, 0.0)),
        (cube("red"), Vector3::new(0.3, -0.3, EDGE / 2.0)),
    ];
    let mut scene = Scene::new(objects, 0.001);
    scene.header.hands[1] = Hand {
        reach: Some(Reach { centre: Vector3::new(0.3, -0.3, 0.2), radius: 0.5 }),
        ..scene.header.hands[1].clone()
    };
    let red = scene.id("red");
    scene.rest(0.4);
    scene.take(RIGHT, red);
    scene.go(RIGHT, Vector3::new(0.3, 0.0, 0.2), 0.8, None);
    scene.go(RIGHT, Vector3::new(0.3, 0.3, EDGE / 2.0), 0.8, None);
    scene.release(RIGHT);
    let first = beginning(&scene, &Config::default());
    assert!(first.contains(&"(clear spot)".to_string()), "{first:?}");
    assert!(first.contains(&"(reachable red right-hand)".to_string()), "{first:?}");
    assert!(!first.contains(&"(reachable spot right-hand)".to_string()), "{first:?}");
    let story = story(&scene, &Config::default());
    for line in [
        "+(at right-hand spot)",
        "-(reachable red right-hand) right-hand holds",
        "+(at red spot) right-hand holds",
        "-(clear spot) right-hand holds",
    ] {
        assert!(story.contains(&line.to_string()), "{line}: {story:?}");
    }
}

#[test]
fn what_is_lost_stays_as_it_was() {
    let mut scene = stacking(0.001);
    let whole = story(&scene, &Config::default());
    let red = scene.id("red");
    let lose = |frames: &mut [Frame], from: f64, to: f64, what: &dyn Fn(&mut Frame)| {
        for frame in &mut frames[(from * RATE) as usize..(to * RATE) as usize] {
            what(frame);
        }
    };
    // The hand is lost while it reaches, the cube while it is carried, and the other cube for good once all is done.
    lose(&mut scene.frames, 0.8, 1.1, &|frame| frame.hands[1] = None);
    lose(&mut scene.frames, 2.2, 2.6, &|frame| frame.objects[red.index()] = None);
    let end = scene.frames.len() as f64 / RATE;
    let blue = scene.id("blue");
    lose(&mut scene.frames, end - 0.3, end, &|frame| frame.objects[blue.index()] = None);
    assert_eq!(story(&scene, &Config::default()), whole);
}

#[test]
fn a_hand_that_nobody_sees_gets_no_credit() {
    let mut scene = stacking(0.001);
    for frame in &mut scene.frames {
        frame.hands[1] = None;
    }
    let observations = observe(&scene.header, &Config::default(), &scene.frames);
    let changes = || observations.iter().skip(1).flat_map(|one| &one.changes);
    let moved = changes().filter(|change| change.fact.predicate == "on-top").count();
    assert_eq!(moved, 2, "the cube leaves the table and comes to rest on the other one");
    assert!(changes().all(|change| change.credits.iter().all(|credit| credit.hand == LEFT)));
}

#[test]
fn every_frame_gets_one_observation_and_they_come_soon() {
    let scene = stacking(0.002);
    let config = Config::default();
    let mut observer = Observer::new(&scene.header, config.clone());
    let mut seen: Vec<Observation> = Vec::new();
    for frame in &scene.frames {
        seen.extend(observer.push(frame));
        let last = seen.last().map_or(0.0, |last| last.time);
        let lag = config.ahead + config.bridge + 2.0 / RATE;
        assert!(frame.time - last <= lag, "{} s behind", frame.time - last);
    }
    seen.extend(observer.finish());
    assert!(
        seen.iter()
            .zip(&scene.frames)
            .all(|(one, frame)| one.time.to_bits() == frame.time.to_bits())
    );
    assert_eq!(seen.len(), scene.frames.len());
}

#[test]
fn an_empty_log_and_one_of_a_single_frame_are_no_trouble() {
    let mut scene = stacking(0.0);
    assert_eq!(observe(&scene.header, &Config::default(), &[]), []);
    scene.frames.truncate(1);
    let observations = observe(&scene.header, &Config::default(), &scene.frames);
    assert_eq!(observations.len(), 1);
    assert!(!observations[0].changes.is_empty());
}

#[test]
fn the_published_rule_decides_on_line() {
    let scene = stacking(0.0);
    let observations = observe(&scene.header, &Config::published(), &scene.frames);
    let blue = scene.id("blue");
    // It takes no cube for acted on while another cube is in the hand.
    assert!(observations.iter().all(|observation| observation.hands[1].acted_on != Some(blue)));
    let config = Config { same_class: false, ..Config::published() };
    let observations = observe(&scene.header, &config, &scene.frames);
    assert!(observations.iter().any(|observation| observation.hands[1].acted_on == Some(blue)));
}

#[test]
fn touching_is_symmetric_and_observed_when_asked_for() {
    let config =
        Config { relations: vec![Relation::Touching], held_things_rest: true, ..Config::default() };
    let story = story(&stacking(0.0), &config);
    for line in [
        "-(touching red table)",
        "-(touching table red)",
        "+(touching red blue)",
        "+(touching blue red)",
    ] {
        assert!(story.iter().any(|other| other.starts_with(line)), "{line}: {story:?}");
    }
}

#[test]
fn senseless_thresholds_are_refused() {
    let bad = Config { speed: Band { low: 0.5, high: 0.1 }, ..Config::default() };
    assert_eq!(
        bad.check().expect_err("it is senseless").to_string(),
        "the lower threshold of `speed` is 0.5, above the upper one, 0.1"
    );
    let bad = Config { ahead: f64::NAN, ..Config::default() };
    assert!(bad.check().is_err());
    assert_eq!(Config::default().check(), Ok(()));
    assert_eq!(Config::published().check(), Ok(()));
}
