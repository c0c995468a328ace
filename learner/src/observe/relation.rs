//! Boxes at their places, frame by frame, go in; the frames in which relations between them begin and end come out.

use nalgebra::{Isometry3, Vector3};

use super::config::Config;
use super::shape::Shape;
use super::vocabulary::{Relation, Thing};
use crate::log::{HandId, Header, Motion, ObjectId};

/// A relation of one or two things began or ended, as far as geometry says.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Flip {
    /// One of those that geometry shows: on top, inside, at, touching, blocks, open, reachable.
    pub relation: Relation,
    /// The first thing.
    pub first: Thing,
    /// The second thing; the first once more for a relation of one thing.
    pub second: Thing,
    /// Whether it holds from now on.
    pub holds: bool,
    /// It was never looked at before, so nothing need have happened.
    pub fresh: bool,
}

/// What is known of one relation of certain things.
#[derive(Debug, Clone, Copy, Default)]
struct Cell {
    known: bool,
    holds: bool,
    /// The frame and time since which it seems to be the other way.
    since: Option<(u64, f64)>,
}

/// An object, as far as it is known at a frame.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Body {
    /// Where it is, or was when it was last seen.
    pub shape: Option<Shape>,
    /// How far its joints are open, from 0 to 1; not a number where there are none.
    pub open: f64,
    /// It is not seen now, so that nothing new can be said of it.
    pub lost: bool,
    /// It is in a hand.
    pub held: bool,
}

/// All relations of all objects.
#[derive(Debug)]
pub(super) struct Geometry {
    on_top: Vec<Cell>,
    inside: Vec<Cell>,
    touching: Vec<Cell>,
    blocks: Vec<Cell>,
    at: Vec<Cell>,
    /// No relation of the pair holds or is about to; the second object counts most in the number of a pair.
    quiet: Vec<bool>,
    open: Vec<Cell>,
    hand_at: Vec<Cell>,
    reachable: Vec<Cell>,
    count: usize,
    hands: usize,
}

/// Further apart than this, in metres, no two boxes are in any relation but that of a place.
const FAR: f64 = 0.1;

impl Geometry {
    /// Nothing is known yet.
    pub fn new(header: &Header) -> Self {
        let count = header.objects.len();
        let hands = header.hands.len();
        let pairs = || vec![Cell::default(); count * count];
        let by_hand = || vec![Cell::default(); hands * count];
        Self {
            on_top: pairs(),
            inside: pairs(),
            touching: pairs(),
            blocks: pairs(),
            at: pairs(),
            quiet: vec![false; count * count],
            open: vec![Cell::default(); count],
            hand_at: by_hand(),
            reachable: by_hand(),
            count,
            hands,
        }
    }

    /// Takes the next frame; hands over each flip with the number of the frame in which it happened, which may be earlier.
    pub fn step(
        &mut self,
        now: (u64, f64),
        bodies: &[Body],
        hands: &[Option<Vector3<f64>>],
        header: &Header,
        config: &Config,
        mut flip: impl FnMut(u64, Flip),
    ) {
        let judge = |cell: &mut Cell, holds: bool| cell.judge(holds, now, config.minimum);
        let touching = config.relations.contains(&Relation::Touching);
        for second in 0..self.count {
            let Some(below) = bodies[second].shape else { continue };
            let lower = &header.objects[second];
            if bodies[second].lost {
                continue;
            }
            let to = Thing::Object(ObjectId(second as u32));
            let way = way(second, bodies, header);
            let middle = below.middle();
            let range =
                way.map_or(below.radius, |way| way.radius + (way.middle() - middle).norm()) + FAR;
            for (first, body) in bodies.iter().enumerate() {
                let (Some(above), false) = (&body.shape, first == second || body.lost) else {
                    continue;
                };
                let pair = second * self.count + first;
                // Nearly all pairs are far apart and were so before: nothing can change.
                let apart = (above.middle() - middle).norm_squared();
                if self.quiet[pair] && apart > (range + above.radius).powi(2) {
                    continue;
                }
                let upper = &header.objects[first];
                if upper.region || upper.fixed {
                    continue;
                }
                let from = Thing::Object(ObjectId(first as u32));
                let mut tell = |relation, change: Option<(u64, bool)>, holds| {
                    if let Some((frame, fresh)) = change {
                        flip(frame, Flip { relation, first: from, second: to, holds, fresh });
                    }
                };
                if lower.region {
                    let holds = at(&below, above, self.at[pair].holds, config);
                    tell(Relation::At, judge(&mut self.at[pair], holds), holds);
                    continue;
                }
                let near = apart < (above.radius + below.radius + FAR).powi(2);
                let holds =
                    near && lower.hollow && inside(&below, above, self.inside[pair].holds, config);
                tell(Relation::Inside, judge(&mut self.inside[pair], holds), holds);
                let enclosed = holds || self.inside[pair].holds;
                let holds = near
                    && !enclosed
                    && on_top(&below, above, lower.hollow, self.on_top[pair].holds, config);
                tell(Relation::OnTop, judge(&mut self.on_top[pair], holds), holds);
                if touching && (first < second || lower.fixed) {
                    let holds = near
                        && config
                            .touch
                            .falling(self.touching[pair].holds, above.separation(&below));
                    tell(Relation::Touching, judge(&mut self.touching[pair], holds), holds);
                }
                if let Some(way) = &way {
                    let before = self.blocks[pair].holds;
                    let free = enclosed || self.on_top[pair].holds || body.held && !before;
                    let holds = !free
                        && (above.middle() - way.middle()).norm() < above.radius + way.radius
                        && config.obstacle.rising(before, -way.separation(above));
                    tell(Relation::Blocks, judge(&mut self.blocks[pair], holds), holds);
                }
                let calm = |cell: &Cell| !cell.holds && cell.since.is_none();
                self.quiet[pair] = [&self.on_top, &self.inside, &self.touching, &self.blocks]
                    .into_iter()
                    .all(|cells| calm(&cells[pair]));
            }
            if !lower.joints.is_empty() && !bodies[second].open.is_nan() {
                let fresh = !self.open[second].known;
                let middle = f64::midpoint(config.open.low, config.open.high);
                let before =
                    if fresh { bodies[second].open >= middle } else { self.open[second].holds };
                let holds = config.open.rising(before, bodies[second].open);
                if let Some((frame, fresh)) = judge(&mut self.open[second], holds) {
                    flip(
                        frame,
                        Flip { relation: Relation::Open, first: to, second: to, holds, fresh },
                    );
                }
            }
            for (hand, place) in hands.iter().enumerate() {
                let from = Thing::Hand(HandId(hand as u32));
                let cell = hand * self.count + second;
                if let (true, Some(place)) = (lower.region, place) {
                    let point = Shape::new(
                        Isometry3::translation(place.x, place.y, place.z),
                        &Vector3::zeros(),
                    );
                    let holds = at(&below, &point, self.hand_at[cell].holds, config);
                    if let Some((frame, fresh)) = judge(&mut self.hand_at[cell], holds) {
                        flip(
                            frame,
                            Flip { relation: Relation::At, first: from, second: to, holds, fresh },
                        );
                    }
                }
                if let Some(reach) = header.hands[hand].reach
                    && !(lower.fixed && lower.joints.is_empty() && !lower.region)
                {
                    let beyond = (below.middle() - reach.centre).norm() - reach.radius;
                    let holds = if self.reachable[cell].holds {
                        beyond < config.gap.high
                    } else {
                        beyond <= 0.0
                    };
                    if let Some((frame, fresh)) = judge(&mut self.reachable[cell], holds) {
                        flip(
                            frame,
                            Flip {
                                relation: Relation::Reachable,
                                first: to,
                                second: from,
                                holds,
                                fresh,
                            },
                        );
                    }
                }
            }
        }
        debug_assert_eq!(hands.len(), self.hands);
    }
}

impl Cell {
    /// Takes what a frame shows; says the frame since when it is so, and whether it is the first time that anything is known, once it has been so for long enough.
    fn judge(&mut self, holds: bool, now: (u64, f64), minimum: f64) -> Option<(u64, bool)> {
        if !self.known {
            *self = Self { known: true, holds, since: None };
            return holds.then_some((now.0, true));
        }
        if holds == self.holds {
            self.since = None;
            return None;
        }
        let since = *self.since.get_or_insert(now);
        (now.1 - since.1 >= minimum).then(|| {
            *self = Self { known: true, holds, since: None };
            (since.0, false)
        })
    }
}

/// The space through which a sliding part passes between closed and open; none where nothing slides.
fn way(object: usize, bodies: &[Body], header: &Header) -> Option<Shape> {
    let joint =
        header.objects[object].joints.iter().find(|joint| joint.motion == Motion::Slides)?;
    let (shape, open) = (bodies[object].shape?, bodies[object].open);
    let range = joint.upper - joint.lower;
    (!open.is_nan()).then(|| shape.swept(&joint.axis, -open * range, (1.0 - open) * range))
}

/// Whether a thing rests on something: its lowest side is at the other's upper side, and its middle is over it.
fn on_top(below: &Shape, above: &Shape, hollow: bool, before: bool, config: &Config) -> bool {
    let gap = below.above(above);
    let least = if hollow { -sink(below, config) } else { -config.depth };
    let slack = if before { config.gap.high - config.gap.low } else { 0.0 };
    config.gap.falling(before, gap)
        && gap > least - slack
        && config.margin.falling(before, below.beyond(above))
}

/// Whether a thing is in the hollow of something: its middle is over it, and its lowest side is clearly below the rim.
fn inside(around: &Shape, thing: &Shape, before: bool, config: &Config) -> bool {
    let gap = around.above(thing);
    let rim = -sink(around, config) * if before { 0.5 } else { 1.0 };
    gap <= rim
        && gap >= -2.0 * around.half[around.upright()] - config.depth
        && config.margin.falling(before, around.beyond(thing))
}

/// How far below the rim of a hollow thing something must be to be inside of it.
fn sink(around: &Shape, config: &Config) -> f64 {
    config.depth.min(around.half[around.upright()])
}

/// Whether a thing is at a place: in the column over it.
fn at(place: &Shape, thing: &Shape, before: bool, config: &Config) -> bool {
    let gap = place.above(thing);
    gap <= config.column
        && gap >= -2.0 * place.half[place.upright()] - config.depth
        && config.margin.falling(before, place.beyond(thing))
}
