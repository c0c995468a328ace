//! Nothing goes in; every threshold of observation comes out, with the published defaults where there are any.

use serde::{Deserialize, Serialize};

use super::vocabulary::{Relation, Vocabulary};

/// All thresholds of an [`Observer`](super::Observer).
///
/// Lengths are metres, times seconds, speeds metres per second.
/// Two thresholds of one thing are a [`Band`]: what is between them leaves everything as it was, so that noise at a threshold does not make it flicker.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields, rename_all = "kebab-case")]
pub struct Config {
    /// A hand moves from the upper speed on and rests from the lower speed on; published is one threshold of 0.04.
    pub speed: Band,
    /// An object is acted on within this distance; published are 0.15 to begin.
    pub reach: Band,
    /// From where distances of hands to objects are measured.
    pub measure: Measure,
    /// A hand approaches something when the distance shrinks at least so fast.
    pub approach: f64,
    /// A hand that stops near what it approached still acts on it, until it holds something else or leaves; the published program has it act on nothing.
    pub keep: bool,
    /// What is held acts on no object of its own type, as in the published program; stacking cubes needs it off.
    pub same_class: bool,
    /// Types of objects on which hands never act, such as tables; those that are fixed and have no joints count as such anyway.
    pub never_acted_on: Vec<String>,
    /// How closed a hand is that holds something, and how closed one that surely holds nothing; between them common motion decides.
    pub grip: Band,
    /// A hand can take what is so near to its surface, and has lost what is further away than the upper distance.
    pub hold: Band,
    /// Surfaces touch that are so near, and no longer when they are further apart than the upper distance.
    pub touch: Band,
    /// Something in a hand stays within so much of its place in the frame of the hand.
    pub rigid: f64,
    /// Without a measured grip something is in a hand only after it was moved so far.
    pub carried: f64,
    /// Without a measured grip a hand that rests at something for so long holds it.
    pub settled: f64,
    /// What a thing in a hand rests on counts: it may be on top of, inside or at something. If false it rests only on what is in a hand itself.
    pub held_things_rest: bool,
    /// A hand state or relation lasts at least so long; published are 0.05.
    pub minimum: f64,
    /// Hands and objects that are lost for at most so long are thought to move straight on to where they are found.
    pub bridge: f64,
    /// Half of the window over which velocity is estimated, at most; it is narrower where tracking is less noisy.
    pub window: f64,
    /// Half of the window over which poses are averaged.
    pub smooth: f64,
    /// How far observation looks ahead before it says what a hand does: it then knows what the hand came to. 0 decides on line, as the published program does.
    pub ahead: f64,
    /// An object that is seen less surely than this, from 0 to 1, is lost.
    pub seen: f64,
    /// The gap between a thing and what it is on top of.
    pub gap: Band,
    /// How far boxes may reach into each other, because sizes and poses are not exact.
    pub depth: f64,
    /// How far the middle of a thing may be out of what it is inside of or on top of.
    pub margin: Band,
    /// How far a joint is on its way from closed to open, from 0 to 1, when it begins to count as open, and as closed again.
    pub open: Band,
    /// How far an obstacle reaches into the way of a joint.
    pub obstacle: Band,
    /// How high above a place things and hands are still at the place.
    pub column: f64,
    /// A hand gets the credit for a change if it was at the object so shortly before or after.
    pub credit: f64,
    /// The relations that are observed.
    pub relations: Vec<Relation>,
    /// How relations are written as facts.
    pub vocabulary: Vocabulary,
}

/// Two thresholds of one thing, of which the lower is not above the upper.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Band {
    /// The lower threshold.
    pub low: f64,
    /// The upper threshold.
    pub high: f64,
}

/// How the distance of a hand to an object is measured.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Measure {
    /// To the surface of its box; 0 inside.
    Surface,
    /// To its middle, as in the published program; only sensible where all objects are small.
    Centre,
}

impl Band {
    /// Whether something is on that was so before and now has a value that switches it on when high.
    pub fn rising(self, before: bool, value: f64) -> bool {
        if before { value > self.low } else { value >= self.high }
    }

    /// Whether something is on that was so before and now has a value that switches it on when low.
    pub fn falling(self, before: bool, value: f64) -> bool {
        if before { value < self.high } else { value <= self.low }
    }
}

/// Why a [`Config`] cannot be used.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum BadConfig {
    /// A number is not one that can be used.
    #[error("`{name}` is {value}, which must be a number from {least} on")]
    Number {
        /// The name of the threshold.
        name: &'static str,
        /// Its value.
        value: f64,
        /// The least sensible value.
        least: f64,
    },
    /// The lower threshold is above the upper one.
    #[error("the lower threshold of `{name}` is {low}, above the upper one, {high}")]
    Band {
        /// The name of the band.
        name: &'static str,
        /// Its lower threshold.
        low: f64,
        /// Its upper threshold.
        high: f64,
    },
}

impl Config {
    /// The thresholds and rules of the published program, which decides on line and measures to the middles of objects.
    pub fn published() -> Self {
        let alike = |value| Band { low: value, high: value };
        Self {
            speed: alike(0.04),
            reach: alike(0.15),
            measure: Measure::Centre,
            approach: 0.0,
            keep: false,
            same_class: true,
            minimum: 0.05,
            ahead: 0.0,
            ..Self::default()
        }
    }

    /// Says what is wrong with the thresholds.
    pub fn check(&self) -> Result<(), BadConfig> {
        let bands = [
            ("speed", self.speed, 0.0),
            ("reach", self.reach, 0.0),
            ("grip", self.grip, 0.0),
            ("hold", self.hold, 0.0),
            ("touch", self.touch, 0.0),
            ("gap", self.gap, 0.0),
            ("margin", self.margin, 0.0),
            ("open", self.open, 0.0),
            ("obstacle", self.obstacle, 0.0),
        ];
        for (name, Band { low, high }, least) in bands {
            for value in [low, high] {
                if !value.is_finite() || value < least {
                    return Err(BadConfig::Number { name, value, least });
                }
            }
            if low > high {
                return Err(BadConfig::Band { name, low, high });
            }
        }
        let numbers = [
            ("approach", self.approach),
            ("rigid", self.rigid),
            ("carried", self.carried),
            ("settled", self.settled),
            ("minimum", self.minimum),
            ("bridge", self.bridge),
            ("window", self.window),
            ("smooth", self.smooth),
            ("ahead", self.ahead),
            ("seen", self.seen),
            ("depth", self.depth),
            ("column", self.column),
            ("credit", self.credit),
        ];
        for (name, value) in numbers {
            if !value.is_finite() || value < 0.0 {
                return Err(BadConfig::Number { name, value, least: 0.0 });
            }
        }
        Ok(())
    }
}

impl Default for Config {
    fn default() -> Self {
        Self {
            speed: Band { low: 0.04, high: 0.05 },
            reach: Band { low: 0.15, high: 0.16 },
            measure: Measure::Surface,
            approach: 0.02,
            keep: true,
            same_class: false,
            never_acted_on: Vec::new(),
            grip: Band { low: 0.3, high: 0.6 },
            hold: Band { low: 0.04, high: 0.10 },
            touch: Band { low: 0.01, high: 0.02 },
            rigid: 0.015,
            carried: 0.02,
            settled: 0.8,
            held_things_rest: false,
            minimum: 0.05,
            bridge: 0.5,
            window: 0.17,
            smooth: 0.06,
            ahead: 1.5,
            seen: 0.3,
            gap: Band { low: 0.012, high: 0.02 },
            depth: 0.02,
            margin: Band { low: 0.005, high: 0.015 },
            open: Band { low: 0.15, high: 0.5 },
            obstacle: Band { low: 0.01, high: 0.03 },
            column: 0.3,
            credit: 0.3,
            relations: Relation::DEFAULT.to_vec(),
            vocabulary: Vocabulary::default(),
        }
    }
}
