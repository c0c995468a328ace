//! A change of a relation and the moments around it go in; the objects that it is about, and the hands that may have brought it about, come out.

use super::relation::Flip;
use super::{Credit, Ground, Observer, Relation, Thing};
use crate::log::{HandId, ObjectId};

impl Observer<'_> {
    /// The objects that a change of a relation is about.
    pub(super) fn about(&self, ground: &Ground, flips: &[Flip]) -> Vec<ObjectId> {
        let mut things = ground.things.clone();
        let partners: &[Relation] = match ground.relation {
            Relation::Clear => &[Relation::OnTop, Relation::At],
            Relation::Unblocked => &[Relation::Blocks],
            _ => &[],
        };
        for &relation in partners {
            things.extend(self.state.partners(relation, ground.things[0]));
            let flipped = flips
                .iter()
                .filter(|flip| flip.relation == relation && flip.second == ground.things[0]);
            things.extend(flipped.map(|flip| flip.first));
        }
        let mut objects: Vec<ObjectId> = things
            .into_iter()
            .filter_map(|thing| match thing {
                Thing::Object(object) => Some(object),
                Thing::Hand(_) => None,
            })
            .collect();
        objects.sort_unstable();
        objects.dedup();
        objects
    }

    /// Where all hands were around a moment, seen from the objects of a change.
    pub(super) fn credits(&self, now: usize, objects: &[ObjectId]) -> Vec<Credit> {
        let time = self.moments[now].time;
        // What is fixed does not change, so being near to it earns nothing.
        let loose = |object: &&ObjectId| self.loose[object.index()];
        let mut credits: Vec<Credit> = Vec::new();
        for number in 0..self.header.hands.len() {
            let hand = HandId(number as u32);
            let mut best: Option<Credit> = None;
            for moment in self
                .moments
                .iter()
                .filter(|moment| (moment.time - time).abs() <= self.config.credit)
            {
                let here = &moment.hands[number];
                for &object in objects.iter().filter(loose) {
                    let holds = here.in_hand == Some(object);
                    let distance = here.distance(here.in_hand, object.index());
                    // `max` would make 0 of the distance of a hand that is lost from sight, and a hand that nobody sees the one that touches.
                    if !holds && distance.is_nan() {
                        continue;
                    }
                    let distance = if holds { 0.0 } else { distance.max(0.0) };
                    let limit = if here.in_hand.is_some() {
                        self.config.touch.high
                    } else {
                        self.config.hold.low
                    };
                    let touches = holds || distance <= limit;
                    let acts = here.acted_on == Some(object);
                    let credit =
                        best.get_or_insert(Credit { hand, object, distance, holds, touches, acts });
                    if (holds, -distance) > (credit.holds, -credit.distance) {
                        credit.object = object;
                    }
                    credit.distance = credit.distance.min(distance);
                    credit.holds |= holds;
                    credit.touches |= touches;
                    credit.acts |= acts;
                }
            }
            credits.extend(best);
        }
        credits.sort_by(|one, other| {
            other
                .holds
                .cmp(&one.holds)
                .then(one.distance.total_cmp(&other.distance))
                .then(one.hand.cmp(&other.hand))
        });
        credits
    }
}
