//! Plans and way points written by hand go in; sound plans must reach their goals in the worlds, and sabotaged ones must fail by physics.

use domains::world::{Outcome, PlanStep, Scenario, execute};
use learner::log::Fact;
use learner::waypoints::{Anchor, Doer, Routine, WayPoint};
use nalgebra::{Isometry3, Translation3, UnitQuaternion, Vector3};
use std::f64::consts::FRAC_PI_2;

fn fact(predicate: &str, arguments: &[&str]) -> Fact {
    Fact {
        predicate: predicate.to_owned(),
        arguments: arguments.iter().map(|argument| (*argument).to_owned()).collect(),
    }
}

/// Steps such as `take red-cube`; those of one line, with `+` between them, run at once.
fn plan(lines: &[&str]) -> Vec<Vec<PlanStep>> {
    let step = |text: &str| {
        let mut words = text.split(' ').map(str::to_owned);
        let name = words.next().expect("a step has a name");
        PlanStep { name, arguments: words.collect() }
    };
    lines.iter().map(|line| line.split(" + ").map(step).collect()).collect()
}

fn routine(action: &str, parameters: &[&str], doer: Doer, points: Vec<WayPoint>) -> Routine {
    let parameters = parameters.iter().map(|name| (*name).to_owned()).collect();
    Routine {
        action: action.to_owned(),
        parameters,
        shown: Vec::new(),
        with: Vec::new(),
        follows: false,
        hands: vec![doer],
        points,
    }
}

fn point(anchor: Anchor, offset: Isometry3<f64>, grip: bool, time: f64) -> WayPoint {
    WayPoint { hand: 0, carried: None, anchor, offset, grip, time }
}

/// The foot of an argument in the hand comes so far above something.
fn bring(argument: u32, anchor: Anchor, height: f64, grip: bool, time: f64) -> WayPoint {
    WayPoint { hand: 0, carried: Some(argument), anchor, offset: up(height), grip, time }
}

fn up(height: f64) -> Isometry3<f64> {
    Isometry3::translation(0.0, 0.0, height)
}

/// Way points for cubes: from above, a little below the upper face.
fn cubes() -> Vec<Routine> {
    let (top, below) = (Anchor::Top(0), Anchor::Top(1));
    vec![
        routine(
            "take",
            &["?cube"],
            Doer::Any,
            vec![
                point(top, up(0.1), false, 1.0),
                point(top, up(-0.01), true, 1.5),
                point(top, up(0.1), true, 2.0),
            ],
        ),
        routine(
            "put",
            &["?above", "?below"],
            Doer::Any,
            vec![
                bring(0, below, 0.1, true, 1.0),
                bring(0, below, 0.002, false, 1.6),
                point(below, up(0.2), false, 2.2),
            ],
        ),
    ]
}

fn in_cubes(seed: u64, steps: &[&str], goal: usize) -> Outcome {
    let goal = &Scenario::Cubes.goals()[goal].facts;
    execute(Scenario::Cubes, seed, &plan(steps), &cubes(), goal)
}

const TWO_TOWERS: [&str; 4] =
    ["take red-cube", "put red-cube green-cube", "take blue-cube", "put blue-cube yellow-cube"];

const TOWER_OF_THREE: [&str; 4] =
    ["take green-cube", "put green-cube blue-cube", "take red-cube", "put red-cube green-cube"];

const TOWER_OF_FOUR: [&str; 6] = [
    "take blue-cube",
    "put blue-cube yellow-cube",
    "take green-cube",
    "put green-cube blue-cube",
    "take red-cube",
    "put red-cube green-cube",
];

#[test]
fn plans_for_all_four_goals_work_in_any_layout() {
    for seed in 0..6 {
        let plans = [&TWO_TOWERS[..2], &TOWER_OF_THREE, &TWO_TOWERS, &TOWER_OF_FOUR];
        for (goal, steps) in plans.into_iter().enumerate() {
            let outcome = in_cubes(seed, steps, goal);
            assert!(outcome.reached, "seed {seed}, goal {goal}: {:?}", outcome.story);
            assert!(outcome.story.is_empty(), "{:?}", outcome.story);
        }
    }
}

#[test]
fn a_plan_without_one_of_its_steps_fails() {
    for missing in 0..TOWER_OF_FOUR.len() {
        let mut steps = TOWER_OF_FOUR.to_vec();
        steps.remove(missing);
        let outcome = in_cubes(3, &steps, 3);
        assert!(!outcome.reached, "without step {missing}");
        assert!(!outcome.story.is_empty());
    }
}

#[test]
fn a_plan_in_the_wrong_order_fails() {
    assert!(!in_cubes(3, &["put red-cube green-cube", "take red-cube"], 0).reached);
    let both = ["take red-cube", "take green-cube", "put red-cube green-cube"];
    assert!(!in_cubes(3, &both, 0).reached, "a cube on one in a hand does not stay there");
    // A tower from the top: the middle is put where it is already covered.
    let mut wrong = TOWER_OF_FOUR.to_vec();
    wrong.swap(1, 3);
    assert!(!in_cubes(3, &wrong, 3).reached);
}

/// Way points for drawers, chairs and plates.
fn kitchen() -> Vec<Routine> {
    let handle = |away: f64| {
        Isometry3::new(Vector3::new(0.0, -0.225 - away, 0.045), Vector3::x() * FRAC_PI_2)
    };
    let backrest = |y: f64, z: f64| Isometry3::translation(0.0, 0.195 + y, 0.42 + z);
    let rim = |z: f64| Isometry3::translation(0.0, -0.085, z);
    let inside = |z: f64, grip: bool, time: f64| WayPoint {
        offset: Isometry3::translation(0.0, -0.09, z),
        ..bring(0, Anchor::Middle(1), 0.0, grip, time)
    };
    let middle = Anchor::Middle(0);
    vec![
        routine(
            "open",
            &["?drawer"],
            Doer::Any,
            vec![
                point(middle, handle(0.12), false, 2.0),
                point(middle, handle(0.0), true, 2.5),
                point(middle, handle(0.28), false, 4.0),
                point(middle, handle(0.4), false, 4.5),
            ],
        ),
        routine(
            "clear",
            &["?chair", "?drawer"],
            Doer::Any,
            vec![
                point(middle, backrest(0.0, 0.1), false, 2.0),
                point(middle, backrest(0.0, 0.0), true, 2.5),
                point(middle, backrest(-0.5, 0.0), false, 4.5),
                point(middle, backrest(-0.5, 0.1), false, 5.0),
            ],
        ),
        routine(
            "take",
            &["?plate"],
            Doer::Any,
            vec![
                point(middle, rim(0.1), false, 3.0),
                point(middle, rim(0.005), true, 3.5),
                point(middle, rim(0.15), true, 4.2),
            ],
        ),
        routine(
            "put-in",
            &["?plate", "?drawer"],
            Doer::Any,
            vec![
                inside(0.2, true, 4.0),
                inside(-0.055, false, 5.0),
                point(Anchor::Middle(1), up(0.4), false, 6.0),
            ],
        ),
    ]
}

#[test]
fn a_drawer_opens_unless_a_chair_stands_before_it() {
    let goal = [fact("open", &["pink-drawer"])];
    let run = |scenario, lines: &[&str]| execute(scenario, 6, &plan(lines), &kitchen(), &goal);
    let free = run(Scenario::KitchenClosed, &["open pink-drawer"]);
    assert!(free.reached, "{:?}", free.story);
    let blocked = run(Scenario::KitchenBlocked, &["open pink-drawer"]);
    assert!(!blocked.reached);
    let slips = blocked.story.iter().any(|line| line.contains("slips out of"));
    assert!(slips, "{:?}", blocked.story);
    let both = ["clear chair1 pink-drawer", "open pink-drawer"];
    let cleared = run(Scenario::KitchenBlocked, &both);
    assert!(cleared.reached, "{:?}", cleared.story);
    let late = run(Scenario::KitchenBlocked, &[both[1], both[0]]);
    assert!(!late.reached);
}

#[test]
fn a_plate_comes_into_an_open_drawer_only() {
    let goal = &Scenario::KitchenClosed.goals()[0].facts;
    let steps = ["open pink-drawer", "take red-plate", "put-in red-plate pink-drawer"];
    let run = |seed, lines: &[&str]| {
        execute(Scenario::KitchenClosed, seed, &plan(lines), &kitchen(), goal)
    };
    for seed in 0..4 {
        let done = run(seed, &steps);
        assert!(done.reached, "seed {seed}: {:?}", done.story);
        assert!(!run(seed, &steps[1..]).reached, "seed {seed}: the drawer is closed");
        assert!(!run(seed, &steps[..2]).reached, "seed {seed}: the plate is in a hand");
    }
}

/// Way points for a bottle: one action holds it, another unscrews the lid and lays it down.
fn bottle() -> Vec<Routine> {
    let around = |away: f64| {
        Isometry3::new(Vector3::new(-0.035 - away, 0.0, -0.02), -Vector3::y() * FRAC_PI_2)
    };
    let rim = |turn: f64, z: f64| {
        let turn = UnitQuaternion::from_axis_angle(&Vector3::z_axis(), turn);
        Isometry3::from_parts(Translation3::identity(), turn)
            * Isometry3::translation(0.0, -0.03, z)
    };
    let middle = Anchor::Middle(0);
    let mut unscrew =
        vec![point(middle, rim(0.0, 0.1), false, 2.0), point(middle, rim(0.0, 0.004), true, 2.6)];
    for step in 1..=16 {
        let turn = f64::from(step) / 16.0 * 2.75;
        unscrew.push(point(middle, rim(turn, 0.004), true, 2.9 + 0.15 * f64::from(step)));
    }
    unscrew.push(point(middle, rim(2.75, 0.1), true, 6.0));
    unscrew.push(WayPoint {
        offset: Isometry3::translation(0.0, -0.1, 0.002),
        ..bring(0, Anchor::Free(2), 0.0, false, 7.5)
    });
    unscrew.push(point(Anchor::Hand(0), up(0.0), false, 8.5));
    let holder = Doer::Named("left-hand".to_owned());
    let turner = Doer::Named("right-hand".to_owned());
    let hold = vec![
        point(middle, around(0.1), false, 1.4),
        point(middle, around(0.0), true, 2.0),
        point(middle, around(0.0), false, 8.0),
        point(middle, around(0.1), false, 8.5),
    ];
    vec![
        routine("hold", &["?bottle"], holder, hold),
        Routine {
            with: vec!["hold".to_owned()],
            ..routine("unscrew", &["?lid", "?bottle", "?table"], turner, unscrew)
        },
    ]
}

#[test]
fn a_bottle_opens_while_it_is_held_and_turns_with_its_lid_otherwise() {
    let goal = &Scenario::BottleClosed.goals()[0].facts;
    for seed in 0..4 {
        let run =
            |lines: &[&str]| execute(Scenario::BottleClosed, seed, &plan(lines), &bottle(), goal);
        let both = run(&["hold bottle + unscrew lid bottle table"]);
        assert!(both.reached, "seed {seed}: {:?}", both.story);
        let alone = run(&["unscrew lid bottle table"]);
        assert!(!alone.reached, "seed {seed}");
        let closed = alone.facts.contains(&fact("closed", &["lid"]));
        assert!(closed, "seed {seed}: {:?}", alone.facts);
        let after = run(&["hold bottle", "unscrew lid bottle table"]);
        assert!(!after.reached, "seed {seed}: having held it before is not enough");
    }
}

/// Way points for the arms of the towers of Hanoi.
fn arms() -> Vec<Routine> {
    let (top, on) = (Anchor::Top(1), Anchor::Top(2));
    vec![
        routine(
            "take",
            &["?arm", "?cube"],
            Doer::Argument(0),
            vec![
                point(top, up(0.12), false, 1.0),
                point(top, up(-0.01), true, 1.5),
                point(top, up(0.12), true, 2.0),
            ],
        ),
        routine(
            "put",
            &["?arm", "?cube", "?on"],
            Doer::Argument(0),
            vec![
                bring(1, on, 0.12, true, 1.0),
                bring(1, on, 0.002, false, 1.6),
                point(on, up(0.2), false, 2.2),
            ],
        ),
        routine(
            "away",
            &["?arm", "?spot"],
            Doer::Argument(0),
            vec![point(top, Isometry3::translation(0.0, -0.24, 0.25), false, 1.0)],
        ),
    ]
}

const HANOI: [&str; 19] = [
    "take left-arm small-cube",
    "put left-arm small-cube tray",
    "away left-arm left-spot",
    "take right-arm small-cube",
    "put right-arm small-cube right-spot",
    "take left-arm large-cube",
    "put left-arm large-cube tray",
    "away left-arm left-spot + take right-arm small-cube",
    "put right-arm small-cube large-cube",
    "away right-arm right-spot",
    "take left-arm small-cube",
    "put left-arm small-cube left-spot",
    "take right-arm large-cube",
    "put right-arm large-cube right-spot",
    "away right-arm right-spot + take left-arm small-cube",
    "put left-arm small-cube tray",
    "away left-arm left-spot",
    "take right-arm small-cube",
    "put right-arm small-cube large-cube",
];

fn in_hanoi(lines: &[&str]) -> Outcome {
    let goal = &Scenario::Hanoi.goals()[0].facts;
    execute(Scenario::Hanoi, 2, &plan(lines), &arms(), goal)
}

#[test]
fn two_arms_solve_the_towers_of_hanoi_if_they_keep_out_of_each_others_way() {
    let steps = HANOI;
    let done = in_hanoi(&steps);
    assert!(done.reached, "{:?}", done.story);
    let mut crowded = steps.to_vec();
    crowded.remove(2);
    let crash = in_hanoi(&crowded);
    assert!(!crash.reached);
    let said = crash.story.iter().any(|line| line.contains("run into each other"));
    assert!(said, "{:?}", crash.story);
}

#[test]
fn an_arm_goes_no_farther_than_it_reaches_and_no_large_cube_on_a_small_one() {
    let far = in_hanoi(&["take right-arm small-cube"]);
    assert!(far.story.iter().any(|line| line.contains("does not reach")), "{:?}", far.story);
    let upside = in_hanoi(&[
        "take left-arm small-cube",
        "put left-arm small-cube tray",
        "take left-arm large-cube",
        "put left-arm large-cube small-cube",
    ]);
    let said = upside.story.iter().any(|line| line.contains("lies on the smaller"));
    assert!(said, "{:?}", upside.story);
    assert!(!upside.reached);
}

#[test]
fn what_is_not_there_is_said() {
    let unknown = in_cubes(1, &["fly red-cube"], 0);
    assert_eq!(unknown.story[0], "There are no way points for fly.");
    let nothing = in_cubes(1, &["take pink-cube"], 0);
    assert_eq!(nothing.story[0], "(take pink-cube) is about something that is not here.");
}

/// The same way points as a tracker with noise would have seen them: off by some millimetres and degrees.
fn shaken(mut routines: Vec<Routine>, seed: u64) -> Vec<Routine> {
    let mut random = fastrand::Rng::with_seed(seed);
    // The sum of four even numbers is nearly normal; its deviation is 1/√3.
    let mut noise = |deviation: f64| {
        let sum: f64 = (0..4).map(|_| random.f64() - 0.5).sum();
        sum * deviation * 3.0_f64.sqrt()
    };
    for point in routines.iter_mut().flat_map(|routine| &mut routine.points) {
        let off = Translation3::new(noise(0.003), noise(0.003), noise(0.003));
        let turn = Vector3::new(noise(0.03), noise(0.03), noise(0.03));
        point.offset = off * point.offset * UnitQuaternion::from_scaled_axis(turn);
    }
    routines
}

#[test]
fn way_points_may_be_as_inexact_as_they_are_tracked() {
    let in_drawer = [
        "clear chair1 pink-drawer",
        "open pink-drawer",
        "take red-plate",
        "put-in red-plate pink-drawer",
    ];
    let opened = ["hold bottle + unscrew lid bottle table"];
    for seed in 0..3 {
        let cases: [(Scenario, usize, &[&str], Vec<Routine>); 5] = [
            (Scenario::Cubes, 3, &TOWER_OF_FOUR, cubes()),
            (Scenario::KitchenClosed, 0, &in_drawer[1..], kitchen()),
            (Scenario::KitchenBlocked, 0, &in_drawer, kitchen()),
            (Scenario::BottleClosed, 0, &opened, bottle()),
            (Scenario::Hanoi, 0, &HANOI, arms()),
        ];
        for (scenario, goal, steps, routines) in cases {
            let goal = &scenario.goals()[goal].facts;
            let outcome = execute(scenario, seed, &plan(steps), &shaken(routines, seed), goal);
            let name = scenario.name();
            assert!(outcome.reached, "{name}, seed {seed}: {:?}", outcome.story);
        }
    }
}
