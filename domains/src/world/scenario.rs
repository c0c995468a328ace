//! The name of a world and a seed go in; its furniture, its hands, its goals and what its demonstrators do come out.

use super::person::Person;
use super::skill::Skill;
use super::stage::Stage;
use super::thing::{Part, Thing};
use super::{bottle, cubes, hanoi, kitchen};
use crate::chance::Chance;
use learner::log::{Fact, Hand, Header, ObjectId, Type};
use nalgebra::Isometry3;

/// A world in which something can be shown and done.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Scenario {
    /// A table with four or five cubes.
    Cubes,
    /// Tables with plates, and a pink drawer that is closed: kitchen I.
    KitchenClosed,
    /// The same with a chair before the pink drawer: kitchen II.
    KitchenBlocked,
    /// A bottle that is closed.
    BottleClosed,
    /// A bottle whose lid lies beside it.
    BottleOpen,
    /// Two cubes on the left of three spots, and two arms that both reach only the one in the middle, a tray.
    Hanoi,
    /// The same with three cubes instead of two.
    HanoiThree,
}

/// What a demonstrator is asked to show.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Task {
    /// Everything that the scenario is about.
    Full,
    /// Only what the robot cannot do: the guided demonstration.
    Guided,
    /// Put one cube on another.
    StackOne,
    /// Build a tower of three cubes.
    StackTwo,
    /// Stand still for two seconds.
    Nothing,
}

/// What is to be reached in a scenario.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Goal {
    /// What it is called, such as `two-towers`.
    pub name: &'static str,
    /// What shall hold.
    pub facts: Vec<Fact>,
}

/// A furnished world before it runs.
pub(crate) struct Layout {
    pub(crate) things: Vec<Thing>,
    pub(crate) scenery: Vec<Part>,
    pub(crate) types: Vec<Type>,
    pub(crate) agents: Vec<String>,
    pub(crate) hands: Vec<(Hand, Isometry3<f64>)>,
    /// The lid and the bottle of a thread.
    pub(crate) screw: Option<(ObjectId, ObjectId)>,
}

/// What each hand does, in turn, and what the demonstrator means to reach.
pub(crate) struct Script {
    pub(crate) hands: Vec<Vec<Skill>>,
    pub(crate) goal: Vec<Fact>,
}

impl Task {
    /// All tasks.
    pub const ALL: [Self; 5] =
        [Self::Full, Self::Guided, Self::StackOne, Self::StackTwo, Self::Nothing];

    /// The name on a command line.
    pub fn name(self) -> &'static str {
        match self {
            Self::Full => "full",
            Self::Guided => "guided",
            Self::StackOne => "stack-one",
            Self::StackTwo => "stack-two",
            Self::Nothing => "nothing",
        }
    }

    /// The task of a name.
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|task| task.name() == name)
    }
}

impl Scenario {
    /// All scenarios.
    pub const ALL: [Self; 7] = [
        Self::Cubes,
        Self::KitchenClosed,
        Self::KitchenBlocked,
        Self::BottleClosed,
        Self::BottleOpen,
        Self::Hanoi,
        Self::HanoiThree,
    ];

    /// The name on a command line.
    pub fn name(self) -> &'static str {
        match self {
            Self::Cubes => "cubes",
            Self::KitchenClosed => "kitchen",
            Self::KitchenBlocked => "kitchen-blocked",
            Self::BottleClosed => "bottle",
            Self::BottleOpen => "bottle-open",
            Self::Hanoi => "hanoi",
            Self::HanoiThree => "hanoi-three",
        }
    }

    /// The scenario of a name.
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|scenario| scenario.name() == name)
    }

    /// What can be shown in it, the usual first.
    pub fn tasks(self) -> &'static [Task] {
        match self {
            Self::Cubes => &[Task::StackTwo, Task::StackOne, Task::Nothing],
            Self::KitchenClosed | Self::KitchenBlocked => {
                &[Task::Full, Task::Guided, Task::Nothing]
            }
            Self::BottleClosed | Self::BottleOpen | Self::Hanoi | Self::HanoiThree => {
                &[Task::Full, Task::Nothing]
            }
        }
    }

    /// What can be asked for in it; of the cubes' four goals only the first two are ever shown.
    pub fn goals(self) -> Vec<Goal> {
        match self {
            Self::Cubes => cubes::goals(),
            Self::KitchenClosed | Self::KitchenBlocked => kitchen::goals(),
            Self::BottleClosed => bottle::goals(false),
            Self::BottleOpen => bottle::goals(true),
            Self::Hanoi => hanoi::goals(2),
            Self::HanoiThree => hanoi::goals(3),
        }
    }

    /// What a log of this scenario has as its header; the seed decides where things are, and how many.
    pub fn header(self, seed: u64) -> Header {
        header(&self.layout(seed))
    }

    pub(crate) fn layout(self, seed: u64) -> Layout {
        let mut chance = Chance::new(self.name(), &[seed]);
        match self {
            Self::Cubes => cubes::layout(&mut chance),
            Self::KitchenClosed => kitchen::layout(&mut chance, false),
            Self::KitchenBlocked => kitchen::layout(&mut chance, true),
            Self::BottleClosed => bottle::layout(&mut chance, false),
            Self::BottleOpen => bottle::layout(&mut chance, true),
            Self::Hanoi => hanoi::layout(&mut chance, 2),
            Self::HanoiThree => hanoi::layout(&mut chance, 3),
        }
    }

    pub(crate) fn script(
        self,
        task: Task,
        person: &Person,
        chance: &mut Chance,
        stage: &Stage,
    ) -> Script {
        if task == Task::Nothing {
            let rest = stage.hands().map(|_| vec![Skill::Pause(2.0)]).collect();
            return Script { hands: rest, goal: Vec::new() };
        }
        match self {
            Self::Cubes => cubes::script(task, person, chance, stage),
            Self::KitchenClosed => kitchen::script(task, person, chance, stage, false),
            Self::KitchenBlocked => kitchen::script(task, person, chance, stage, true),
            Self::BottleClosed => bottle::script(person, chance, stage, false),
            Self::BottleOpen => bottle::script(person, chance, stage, true),
            Self::Hanoi => hanoi::script(person, chance, stage, 2),
            Self::HanoiThree => hanoi::script(person, chance, stage, 3),
        }
    }
}

impl Layout {
    /// The world, at rest.
    pub(crate) fn stage(self) -> Stage {
        let hands: Vec<Isometry3<f64>> = self.hands.iter().map(|(_, pose)| *pose).collect();
        let mut stage = Stage::new(self.things, &self.scenery, &hands, self.screw);
        // Things settle by fractions of a millimetre before anybody looks.
        for _ in 0..60 {
            stage.step(&hands);
        }
        stage
    }
}

/// The header of a log of a layout.
pub(crate) fn header(layout: &Layout) -> Header {
    Header {
        frame: "world".to_owned(),
        rate: super::tracker::RATE,
        types: layout.types.clone(),
        agents: layout.agents.clone(),
        hands: layout.hands.iter().map(|(hand, _)| hand.clone()).collect(),
        objects: layout.things.iter().map(|thing| thing.object.clone()).collect(),
    }
}

/// A fact by words.
pub(crate) fn fact(predicate: &str, arguments: &[&str]) -> Fact {
    Fact {
        predicate: predicate.to_owned(),
        arguments: arguments.iter().map(|argument| (*argument).to_owned()).collect(),
    }
}

/// A type below `object`, or below another.
pub(crate) fn kind(name: &str, parent: Option<&str>) -> Type {
    Type { name: name.to_owned(), parent: parent.map(str::to_owned) }
}

/// The two hands of a person at rest, by the middle between them and half their distance.
pub(crate) fn two_hands(middle: nalgebra::Vector3<f64>, apart: f64) -> Vec<(Hand, Isometry3<f64>)> {
    [("left-hand", -apart), ("right-hand", apart)]
        .into_iter()
        .map(|(name, off)| {
            let hand = Hand { name: name.to_owned(), agent: 0, reach: None };
            (hand, super::space::at(middle.x + off, middle.y, middle.z))
        })
        .collect()
}
