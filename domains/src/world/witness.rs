//! A physical world and what its hands are about go in; what really happened in a frame comes out.

use super::actor::Actor;
use super::facts;
use super::stage::Stage;
use learner::log::{HandState, Header};
use learner::truth::{Activity, Truth};

/// A hand moves if it is faster than this, in m/s: the published threshold.
const MOVES: f64 = 0.04;
/// How near a hand must be to act on something, in metres: the published threshold.
const ACTS: f64 = 0.15;

/// What happens now.
///
/// A hand acts on what its movement approaches or works on while it is within 0.15 m of its surface and comes nearer,
/// or has come to rest there; from when it has closed around it or let go at it, it does not.
pub(crate) fn truth<'a>(
    stage: &Stage,
    actors: impl Iterator<Item = &'a Actor>,
    header: &Header,
    time: f64,
) -> Truth {
    let hands = stage
        .hands()
        .zip(actors)
        .map(|(hand, actor)| {
            let (velocity, place) = (stage.velocity(hand), stage.hand(hand).translation.vector);
            let moves = velocity.norm() > MOVES;
            let in_hand = stage.held(hand);
            let acted_on =
                actor.about().filter(|object| Some(*object) != in_hand).filter(|object| {
                    let distance = stage.distance(*object, place);
                    let ahead = stage.distance(*object, place + velocity * 0.02);
                    let inside = distance < 0.005
                        && stage.pose(*object).translation.vector.z < place.z + 0.1;
                    distance < ACTS && (!moves || ahead < distance || inside)
                });
            let state = HandState { moves, acted_on, in_hand };
            (state, activity(state))
        })
        .collect();
    Truth { time, hands, facts: facts::facts(stage, header) }
}

/// Table 3.1 of the thesis, and for what it leaves out what the hand is about: it reaches for the thing, or works on it with another.
fn activity(state: HandState) -> Activity {
    match (state.moves, state.acted_on.is_some(), state.in_hand.is_some()) {
        (_, true, false) => Activity::Reach,
        (_, true, true) => Activity::Granular,
        (true, false, true) => Activity::Put,
        (false, false, true) => Activity::Take,
        (_, false, false) => Activity::Idle,
    }
}
