//! The number of a person and a seed go in; how this person moves and how well they are tracked comes out.
//!
//! Persons below [`HELD_OUT`] are for building and tuning. Those from it on are drawn from wider ranges, a part of which no other person ever shows,
//! and stay unused until the final numbers are taken.

use crate::chance::Chance;

/// The first number of the persons that nothing is tuned on.
pub const HELD_OUT: u32 = 1000;

/// Which hand somebody prefers.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Side {
    /// The left hand.
    Left,
    /// The right hand.
    Right,
}

/// Somebody who demonstrates, and the tracker that watches.
#[derive(Debug, Clone, PartialEq)]
pub struct Person {
    /// The number, which with the seed determines all else.
    pub number: u32,
    /// The greatest speed of a free hand, in m/s.
    pub speed: f64,
    /// The hand that does what either could do.
    pub hand: Side,
    /// How likely they pause before a movement, from 0 to 1.
    pub hesitation: f64,
    /// How long such a pause is at most, in seconds.
    pub pause: f64,
    /// How likely a movement is a detour or starts towards something else, from 0 to 1.
    pub detour: f64,
    /// How likely something just taken falls out of the hand and is taken again, from 0 to 1.
    pub drop: f64,
    /// How far hands rise above what they approach and leave, in metres.
    pub height: f64,
    /// How long a hand rests before and after it closes or opens, in seconds.
    pub delay: f64,
    /// The standard deviation of tracked places, in metres.
    pub noise: f64,
    /// The standard deviation of tracked turns, in radians.
    pub turn_noise: f64,
    /// How often a hand or a thing is lost by the tracker, per second.
    pub lost: f64,
    /// How long it is lost, in seconds: from 0.1 to this.
    pub lost_for: f64,
    /// Whether the log has how far the hands are closed.
    pub measures_grip: bool,
}

/// The ranges that persons are drawn from.
struct Ranges {
    speed: (f64, f64),
    hesitation: (f64, f64),
    pause: (f64, f64),
    detour: (f64, f64),
    drop: (f64, f64),
    height: (f64, f64),
    delay: (f64, f64),
    noise: (f64, f64),
    turn_noise: (f64, f64),
    lost: (f64, f64),
    lost_for: (f64, f64),
}

const SHOWN: Ranges = Ranges {
    speed: (0.45, 0.85),
    hesitation: (0.0, 0.25),
    pause: (0.3, 0.9),
    detour: (0.0, 0.12),
    drop: (0.0, 0.08),
    height: (0.10, 0.18),
    delay: (0.10, 0.25),
    noise: (0.001, 0.0025),
    turn_noise: (0.005, 0.02),
    lost: (0.0, 0.04),
    lost_for: (0.15, 0.4),
};

const WIDER: Ranges = Ranges {
    speed: (0.35, 1.0),
    hesitation: (0.0, 0.35),
    pause: (0.25, 1.2),
    detour: (0.0, 0.18),
    drop: (0.0, 0.12),
    height: (0.08, 0.22),
    delay: (0.08, 0.30),
    noise: (0.001, 0.003),
    turn_noise: (0.005, 0.03),
    lost: (0.0, 0.06),
    lost_for: (0.15, 0.5),
};

impl Person {
    /// The person of a number, the same for each seed.
    pub fn draw(number: u32, seed: u64) -> Self {
        let mut chance = Chance::new("person", &[u64::from(number), seed]);
        let ranges = if number < HELD_OUT { &SHOWN } else { &WIDER };
        Self {
            number,
            speed: chance.within(ranges.speed),
            hand: if chance.happens(0.2) { Side::Left } else { Side::Right },
            hesitation: chance.within(ranges.hesitation),
            pause: chance.within(ranges.pause),
            detour: chance.within(ranges.detour),
            drop: chance.within(ranges.drop),
            height: chance.within(ranges.height),
            delay: chance.within(ranges.delay),
            noise: chance.within(ranges.noise),
            turn_noise: chance.within(ranges.turn_noise),
            lost: chance.within(ranges.lost),
            lost_for: chance.within(ranges.lost_for),
            measures_grip: chance.happens(0.7),
        }
    }

    /// Somebody steady, perfectly tracked, who makes no mistakes.
    pub fn ideal() -> Self {
        Self {
            number: 0,
            speed: 0.6,
            hand: Side::Right,
            hesitation: 0.0,
            pause: 0.0,
            detour: 0.0,
            drop: 0.0,
            height: 0.14,
            delay: 0.15,
            noise: 0.0,
            turn_noise: 0.0,
            lost: 0.0,
            lost_for: 0.0,
            measures_grip: true,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{HELD_OUT, Person};

    #[test]
    fn a_person_is_the_same_each_time_and_unlike_others() {
        assert_eq!(Person::draw(7, 1), Person::draw(7, 1));
        assert_ne!(Person::draw(7, 1).speed.to_bits(), Person::draw(8, 1).speed.to_bits());
    }

    #[test]
    fn the_held_out_persons_go_beyond_the_others() {
        let extreme = |from: u32, of: fn(&Person) -> f64| {
            (from..from + 500).map(|number| of(&Person::draw(number, 3))).fold(0.0, f64::max)
        };
        assert!(extreme(0, |person| person.noise) <= 0.0025);
        assert!(extreme(HELD_OUT, |person| person.noise) > 0.0025);
        assert!(extreme(0, |person| person.speed) <= 0.85);
        assert!(extreme(HELD_OUT, |person| person.speed) > 0.85);
    }
}
