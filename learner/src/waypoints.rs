//! What a hand did in a demonstration goes in as poses by objects; it lies beside the domain, so that a robot or a world can do the same with other objects.
//!
//! A [`Routine`] belongs to an action of a learned domain. Each of its [`WayPoint`]s says where a hand, or what it carries, shall come to,
//! seen from an argument of the action, and whether the hand is closed there. Way points are plain data; nothing here moves.

use nalgebra::{Isometry3, Quaternion, Translation3, UnitQuaternion};
use serde::{Deserialize, Deserializer, Serialize, Serializer, de::Error};

/// How an action is carried out.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Routine {
    /// The name of the action.
    pub action: String,
    /// The names of its parameters, in their order; of a multi-agent action the agent is the first.
    pub parameters: Vec<String>,
    /// The arguments with which it was shown, where that is known: what is done with others is done as with those that are most like them.
    #[serde(default)]
    pub shown: Vec<String>,
    /// The actions that must be carried out at the same time.
    #[serde(default)]
    pub with: Vec<String>,
    /// It goes to a place that somebody leaves at the same time, and so comes after that.
    #[serde(default)]
    pub follows: bool,
    /// The hands that take part.
    pub hands: Vec<Doer>,
    /// Where they come, in the order of their times.
    pub points: Vec<WayPoint>,
}

/// Which hand takes a part in a routine.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Doer {
    /// The hand that this argument names, or the one of the agent's that it names, chosen as for [`Doer::Any`].
    Argument(u32),
    /// The hand of this name.
    Named(String),
    /// Any hand: one that holds an argument, else a free one that reaches, the nearest first.
    Any,
}

/// Where a hand comes to.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct WayPoint {
    /// The place of the hand in [`Routine::hands`].
    pub hand: u32,
    /// The argument, held by the hand, whose foot comes to the pose; none if the hand itself does.
    /// The foot of a thing is the middle of the lower face of its box.
    pub carried: Option<u32>,
    /// From where the pose is seen, as it was when the action began.
    pub anchor: Anchor,
    /// The pose, seen from the anchor, in metres: `[x, y, z, qx, qy, qz, qw]` in a file.
    #[serde(serialize_with = "write_pose", deserialize_with = "read_pose")]
    pub offset: Isometry3<f64>,
    /// Whether the hand is closed from there on.
    pub grip: bool,
    /// The time since the action began, in seconds.
    pub time: f64,
}

/// From where a pose is seen.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Anchor {
    /// The world.
    World,
    /// The middle of the box of an argument.
    Middle(u32),
    /// The middle of the upper face of the box of an argument.
    Top(u32),
    /// The same, but where something stands, the nearest place on that face where nothing does.
    Free(u32),
    /// Where a hand that takes part was when the action began.
    Hand(u32),
}

impl Routine {
    /// The same for an action of another name, of which each parameter is the one in that place.
    #[must_use]
    pub fn renamed(&self, action: &str, places: &[usize]) -> Self {
        let place = |index: u32| places.get(index as usize).map_or(index, |&place| place as u32);
        let order = |list: &[String]| {
            let mut sorted = list.to_vec();
            for (from, word) in list.iter().enumerate() {
                let to = place(from as u32) as usize;
                if to < sorted.len() {
                    sorted[to].clone_from(word);
                }
            }
            sorted
        };
        let anchor = |anchor| match anchor {
            Anchor::Middle(index) => Anchor::Middle(place(index)),
            Anchor::Top(index) => Anchor::Top(place(index)),
            Anchor::Free(index) => Anchor::Free(place(index)),
            Anchor::World | Anchor::Hand(_) => anchor,
        };
        let doer = |doer: &Doer| match doer {
            Doer::Argument(index) => Doer::Argument(place(*index)),
            other => other.clone(),
        };
        let point = |point: &WayPoint| WayPoint {
            carried: point.carried.map(place),
            anchor: anchor(point.anchor),
            ..point.clone()
        };
        Self {
            action: action.to_owned(),
            parameters: order(&self.parameters),
            shown: order(&self.shown),
            hands: self.hands.iter().map(doer).collect(),
            points: self.points.iter().map(point).collect(),
            ..self.clone()
        }
    }

    /// Of all routines of an action the one that was shown with the most of these arguments; the first of several.
    pub fn nearest<'r>(
        routines: &'r [Routine],
        action: &str,
        arguments: &[String],
    ) -> Option<&'r Routine> {
        let alike = |routine: &Routine| {
            let pairs = routine.shown.iter().zip(arguments);
            pairs.filter(|(one, other)| one.eq_ignore_ascii_case(other)).count()
        };
        let same = routines.iter().filter(|routine| routine.action.eq_ignore_ascii_case(action));
        same.rev().max_by_key(|routine| alike(routine))
    }
}

fn write_pose<S: Serializer>(pose: &Isometry3<f64>, serializer: S) -> Result<S::Ok, S::Error> {
    let (place, turn) = (pose.translation, pose.rotation.quaternion());
    [place.x, place.y, place.z, turn.i, turn.j, turn.k, turn.w].serialize(serializer)
}

fn read_pose<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Isometry3<f64>, D::Error> {
    let numbers = <[f64; 7]>::deserialize(deserializer)?;
    let turn = Quaternion::new(numbers[6], numbers[3], numbers[4], numbers[5]);
    if !(0.9..1.1).contains(&turn.norm()) {
        return Err(D::Error::custom("the last four numbers of a pose are no unit quaternion"));
    }
    let place = Translation3::new(numbers[0], numbers[1], numbers[2]);
    Ok(Isometry3::from_parts(place, UnitQuaternion::from_quaternion(turn)))
}

#[cfg(test)]
mod tests {
    use super::{Anchor, Doer, Routine, WayPoint};
    use nalgebra::{Isometry3, Vector3};

    #[test]
    fn a_routine_is_the_same_after_a_way_through_text() {
        let routine = Routine {
            action: "put-on".to_owned(),
            parameters: vec!["?above".to_owned(), "?below".to_owned()],
            shown: Vec::new(),
            with: vec!["hold".to_owned()],
            follows: false,
            hands: vec![Doer::Any, Doer::Argument(0), Doer::Named("left-hand".to_owned())],
            points: vec![WayPoint {
                hand: 0,
                carried: Some(0),
                anchor: Anchor::Top(1),
                offset: Isometry3::new(Vector3::new(0.0, 0.0, 0.002), Vector3::z() * 0.5),
                grip: false,
                time: 1.25,
            }],
        };
        let text = serde_json::to_string(&routine).expect("plain data");
        assert!(text.contains(r#""anchor":{"top":1}"#), "{text}");
        let back: Routine = serde_json::from_str(&text).expect("what was written can be read");
        assert_eq!(back.action, routine.action);
        assert_eq!(back.hands, routine.hands);
        let off = back.points[0].offset.inverse() * routine.points[0].offset;
        assert!(off.translation.vector.norm() < 1e-12 && off.rotation.angle() < 1e-6);
    }

    #[test]
    fn a_pose_without_a_turn_is_refused() {
        let text = r#"{"hand":0,"carried":null,"anchor":"world","offset":[0,0,0,0,0,0,0],"grip":true,"time":0}"#;
        let error = serde_json::from_str::<WayPoint>(text).expect_err("no quaternion");
        assert!(error.to_string().contains("unit quaternion"), "{error}");
    }
}
