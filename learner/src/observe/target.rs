//! What a hand does now and in the next second goes in; the object that it approaches or works on comes out.

use std::collections::VecDeque;

use super::config::Config;
use super::moment::{HandMoment, Moment};
use crate::log::{HandId, Header, ObjectId};

/// What `hand` acts on in the moment at `now`, where `before` is what it acted on the moment before.
///
/// What a hand approaches is known better from what it comes to than from where it heads:
/// if it takes something within the time that observation looks ahead, it was on its way to that; if it passes by and goes on, it was not;
/// and what it holds acts on what it comes to touch.
/// Where [`Config::ahead`] is 0, the published rule is left: the nearest object in reach that comes nearer.
pub(super) fn acted_on(
    moments: &VecDeque<Moment>,
    now: usize,
    hand: HandId,
    before: Option<ObjectId>,
    header: &Header,
    config: &Config,
) -> Option<ObjectId> {
    let at = |index: usize| &moments[index].hands[hand.index()];
    let here = at(now);
    let held = here.in_hand;
    let changed = now > 0 && at(now - 1).in_hand != held;
    let kept = before.filter(|object| {
        config.keep
            && !changed
            && Some(*object) != held
            && here.bare(object.index()) <= config.reach.high
    });
    if here.place.is_none() || !here.moves {
        return kept;
    }
    let last = (now..moments.len())
        .take_while(|&index| moments[index].time - moments[now].time <= config.ahead)
        .last()
        .unwrap_or(now);
    let end = (now + 1..=last).find(|&index| at(index).in_hand != held);
    let taken = end.filter(|_| held.is_none()).and_then(|index| at(index).in_hand);
    let until = end.unwrap_or(last);
    let mut best: Option<(f64, f64, ObjectId)> = None;
    for number in 0..header.objects.len() {
        let id = ObjectId(number as u32);
        let distance = here.bare(number);
        let near = !distance.is_nan() && config.reach.falling(before == Some(id), distance);
        if !near
            || taken.is_some_and(|taken| taken != id)
            || !may_be_acted_on(header, id, held, config)
        {
            continue;
        }
        let rate = rate(moments, now, hand, number, config.smooth);
        let slack = if before == Some(id) { 0.5 } else { 1.0 } * config.approach;
        // A hand that will take something may also move along it, and one that works on something stays in touch.
        let near = taken == Some(id) || distance <= 0.0;
        if rate.map_or(before != Some(id), |rate| rate >= if near { slack } else { -slack }) {
            continue;
        }
        let mut score = distance;
        if config.ahead > 0.0 && taken.is_none() {
            let (nearest, place) = (now..=until)
                .map(|index| (at(index).distance(held, number), index))
                .filter(|(distance, _)| !distance.is_nan())
                .fold((f64::INFINITY, now), |best, next| if next.0 < best.0 { next } else { best });
            let under_way = end.is_none() && place + 1 >= until && at(until).moves;
            let meant = if held.is_some() {
                // What is held comes to something when it touches it and stays or stops there, or is let go.
                let touches = |index: usize| at(index).distance(held, number) <= config.touch.high;
                let stops = (now..=until).any(|index| !at(index).moves && touches(index));
                let stays = (place..=until).all(touches)
                    && moments[until].time - moments[place].time >= config.ahead / 2.0;
                stops || stays || place == until && end.is_some() && touches(until)
            } else {
                (place..=until).take(STOP).any(|index| !at(index).moves)
            };
            if !under_way && !meant {
                continue;
            }
            score = nearest;
        }
        if best.is_none_or(|(other, far, _)| (score, distance) < (other, far)) {
            best = Some((score, distance, id));
        }
    }
    best.map(|(_, _, id)| id)
}

/// Within so many frames after it came nearest to something, a hand that meant it stops.
const STOP: usize = 15;

/// Whether a hand that holds `held` can act on an object at all.
fn may_be_acted_on(header: &Header, id: ObjectId, held: Option<ObjectId>, config: &Config) -> bool {
    let object = &header.objects[id.index()];
    let furniture = object.region || object.fixed && object.joints.is_empty();
    let alike = config.same_class
        && held.is_some_and(|held| header.objects[held.index()].kind == object.kind);
    !furniture && held != Some(id) && !alike && !config.never_acted_on.contains(&object.kind)
}

/// How fast the distance of a hand to an object grows, in metres per second, over so many seconds before and after; none where there is nothing to compare.
fn rate(
    moments: &VecDeque<Moment>,
    now: usize,
    hand: HandId,
    object: usize,
    half: f64,
) -> Option<f64> {
    let reading = |index: usize| {
        let distance = moments[index].hands[hand.index()].bare(object);
        (!distance.is_nan()).then_some((moments[index].time, distance))
    };
    let near = |index: &usize| (moments[*index].time - moments[now].time).abs() <= half;
    let first = (0..now).rev().take_while(near).filter_map(reading).last();
    let last = (now + 1..moments.len()).take_while(near).filter_map(reading).last();
    let here = reading(now)?;
    let (from, to) = (first.unwrap_or(here), last.unwrap_or(here));
    (to.0 > from.0).then(|| (to.1 - from.1) / (to.0 - from.0))
}

impl HandMoment {
    /// The distance of the hand itself to an object; not a number where it is unknown.
    pub(super) fn bare(&self, object: usize) -> f64 {
        self.bare.get(object).map_or(f64::NAN, |&distance| f64::from(distance))
    }

    /// The distance of the hand, with what it holds, to an object; not a number where it is unknown.
    pub(super) fn distance(&self, held: Option<ObjectId>, object: usize) -> f64 {
        let distances = match held {
            Some(held) if self.holding == Some(held) => &self.gaps,
            _ => &self.bare,
        };
        distances.get(object).map_or(f64::NAN, |&distance| f64::from(distance))
    }
}
