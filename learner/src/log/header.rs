//! The JSON of a header goes in, and a checked [`Header`] with the units of its log comes out; and back.

use std::collections::BTreeSet;

use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

use super::fault::{BadLine, Fault};
use super::{Hand, HandId, Header, Joint, Motion, Object, ObjectId, Reach, Type};

/// A header as short as it can be.
pub(super) const EXAMPLE: &str = r#"{"caveat-log":1,"agents":[{"name":"person","hands":[{"name":"right-hand"}]}],"objects":[{"name":"cube","type":"cube","size":[0.05,0.05,0.05]}]}"#;

/// How much one unit of a log is in metres, radians and seconds.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Scale {
    pub length: f64,
    pub angle: f64,
    pub time: f64,
}

/// The first line of a log.
#[derive(Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Line {
    #[serde(rename = "caveat-log")]
    version: u64,
    #[serde(default = "world")]
    frame: String,
    #[serde(default = "rate")]
    rate: f64,
    #[serde(default)]
    units: Units,
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    types: Vec<TypeLine>,
    agents: Vec<AgentLine>,
    objects: Vec<ObjectLine>,
}

fn world() -> String {
    String::from("world")
}

fn rate() -> f64 {
    90.0
}

#[derive(Debug, Default, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
struct Units {
    length: Length,
    angle: Angle,
    time: Time,
}

#[derive(Debug, Default, Clone, Copy, Serialize, Deserialize)]
enum Length {
    #[default]
    #[serde(rename = "m")]
    Metre,
    #[serde(rename = "cm")]
    Centimetre,
    #[serde(rename = "mm")]
    Millimetre,
}

#[derive(Debug, Default, Clone, Copy, Serialize, Deserialize)]
enum Angle {
    #[default]
    #[serde(rename = "rad")]
    Radian,
    #[serde(rename = "deg")]
    Degree,
}

#[derive(Debug, Default, Clone, Copy, Serialize, Deserialize)]
enum Time {
    #[default]
    #[serde(rename = "s")]
    Second,
    #[serde(rename = "ms")]
    Millisecond,
    #[serde(rename = "us")]
    Microsecond,
    #[serde(rename = "ns")]
    Nanosecond,
}

#[derive(Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct TypeLine {
    name: String,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    parent: Option<String>,
}

#[derive(Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct AgentLine {
    name: String,
    hands: Vec<HandLine>,
}

#[derive(Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct HandLine {
    name: String,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    reach: Option<ReachLine>,
}

#[derive(Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct ReachLine {
    centre: [f64; 3],
    radius: f64,
}

#[derive(Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct ObjectLine {
    name: String,
    #[serde(rename = "type")]
    kind: String,
    size: [f64; 3],
    #[serde(default, skip_serializing_if = "is_false")]
    fixed: bool,
    #[serde(default, skip_serializing_if = "is_false")]
    hollow: bool,
    #[serde(default, skip_serializing_if = "is_false")]
    region: bool,
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    joints: Vec<JointLine>,
}

#[derive(Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct JointLine {
    name: String,
    motion: MotionLine,
    axis: [f64; 3],
    lower: f64,
    upper: f64,
}

#[derive(Debug, Clone, Copy, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
enum MotionLine {
    Slides,
    Turns,
}

#[expect(clippy::trivially_copy_pass_by_ref, reason = "serde asks for a reference")]
fn is_false(value: &bool) -> bool {
    !value
}

/// Reads the text of a header, which stands in this line.
pub(super) fn read(text: &[u8], line: u64) -> Result<(Header, Scale), BadLine> {
    #[derive(Deserialize)]
    struct Version {
        #[serde(rename = "caveat-log")]
        version: u64,
    }
    // What has no version is no header, and a later version may have another form.
    match serde_json::from_slice::<Version>(text) {
        Ok(Version { version: 1 }) => {}
        Ok(Version { version }) => return Err(BadLine::new(line, Fault::Version(version))),
        Err(error) if error.is_data() => return Err(BadLine::new(line, Fault::NoHeader)),
        Err(error) => return Err(syntax(line, &error)),
    }
    let text: Line = serde_json::from_slice(text).map_err(|error| syntax(line, &error))?;
    let scale = Scale {
        length: match text.units.length {
            Length::Metre => 1.0,
            Length::Centimetre => 1e-2,
            Length::Millimetre => 1e-3,
        },
        angle: match text.units.angle {
            Angle::Radian => 1.0,
            Angle::Degree => std::f64::consts::PI / 180.0,
        },
        time: match text.units.time {
            Time::Second => 1.0,
            Time::Millisecond => 1e-3,
            Time::Microsecond => 1e-6,
            Time::Nanosecond => 1e-9,
        },
    };
    let header = lower(text, scale);
    header.check().map_err(|(field, fault)| BadLine::of_field(line, field, fault))?;
    Ok((header, scale))
}

/// A fault of JSON as serde tells it, without the place that it adds in its own words.
pub(crate) fn syntax(line: u64, error: &serde_json::Error) -> BadLine {
    let text = error.to_string();
    let message = text.rfind(" at line ").map_or(text.as_str(), |end| &text[..end]);
    // Readers know JSON, but not the types of this program.
    let message = message
        .replace("expected f64", "expected a number")
        .replace("expected ident", "this is no JSON");
    let column = (error.column() > 0).then_some(error.column() as u64);
    BadLine { line, column, field: None, fault: Fault::Form(message) }
}

/// The header that a line says, in metres and radians.
fn lower(text: Line, scale: Scale) -> Header {
    let vector = |value: [f64; 3]| Vector3::from(value);
    let mut hands = Vec::new();
    let mut agents = Vec::new();
    for (number, agent) in text.agents.into_iter().enumerate() {
        agents.push(agent.name);
        hands.extend(agent.hands.into_iter().map(|hand| Hand {
            name: hand.name,
            agent: number as u32,
            reach: hand.reach.map(|reach| Reach {
                centre: vector(reach.centre) * scale.length,
                radius: reach.radius * scale.length,
            }),
        }));
    }
    let joint = |joint: JointLine| {
        let (motion, unit) = match joint.motion {
            MotionLine::Slides => (Motion::Slides, scale.length),
            MotionLine::Turns => (Motion::Turns, scale.angle),
        };
        let axis = vector(joint.axis);
        let axis = axis.try_normalize(1e-9).unwrap_or(axis);
        Joint {
            name: joint.name,
            motion,
            axis,
            lower: joint.lower * unit,
            upper: joint.upper * unit,
        }
    };
    let object = |object: ObjectLine| Object {
        name: object.name,
        kind: object.kind,
        size: vector(object.size) * scale.length,
        fixed: object.fixed,
        hollow: object.hollow,
        region: object.region,
        joints: object.joints.into_iter().map(joint).collect(),
    };
    Header {
        frame: text.frame,
        rate: text.rate,
        types: text
            .types
            .into_iter()
            .map(|kind| Type { name: kind.name, parent: kind.parent })
            .collect(),
        agents,
        hands,
        objects: text.objects.into_iter().map(object).collect(),
    }
}

/// The text of a header, in metres, radians and seconds, without an end of line.
pub(super) fn write(header: &Header) -> String {
    let joint = |joint: &Joint| JointLine {
        name: joint.name.clone(),
        motion: match joint.motion {
            Motion::Slides => MotionLine::Slides,
            Motion::Turns => MotionLine::Turns,
        },
        axis: joint.axis.into(),
        lower: joint.lower,
        upper: joint.upper,
    };
    let object = |object: &Object| ObjectLine {
        name: object.name.clone(),
        kind: object.kind.clone(),
        size: object.size.into(),
        fixed: object.fixed,
        hollow: object.hollow,
        region: object.region,
        joints: object.joints.iter().map(joint).collect(),
    };
    let hand = |hand: &Hand| HandLine {
        name: hand.name.clone(),
        reach: hand
            .reach
            .map(|reach| ReachLine { centre: reach.centre.into(), radius: reach.radius }),
    };
    let line = Line {
        version: 1,
        frame: header.frame.clone(),
        rate: header.rate,
        units: Units::default(),
        types: header
            .types
            .iter()
            .map(|kind| TypeLine { name: kind.name.clone(), parent: kind.parent.clone() })
            .collect(),
        agents: header
            .agents
            .iter()
            .enumerate()
            .map(|(number, name)| AgentLine {
                name: name.clone(),
                hands: header
                    .hands
                    .iter()
                    .filter(|hand| hand.agent == number as u32)
                    .map(hand)
                    .collect(),
            })
            .collect(),
        objects: header.objects.iter().map(object).collect(),
    };
    serde_json::to_string(&line).expect("names and numbers are always JSON")
}

impl Header {
    /// Says which field cannot be so.
    pub(super) fn check(&self) -> Result<(), (String, Fault)> {
        let form = |field: &str, message: String| Err((field.to_string(), Fault::Form(message)));
        if !(self.rate.is_finite() && self.rate > 0.0) {
            return form("rate", format!("{} frames in a second cannot be", self.rate));
        }
        if self.hands.is_empty() {
            return form("agents", String::from("nobody has a hand, so nothing can be learned"));
        }
        // An agent with one hand may be called as that hand is; everything else must be told apart by its name.
        let mut names = BTreeSet::new();
        let mut agents = BTreeSet::new();
        let hands = self.hands.iter().map(|hand| &hand.name);
        let objects = self.objects.iter().map(|object| &object.name);
        for (name, is_agent) in hands
            .chain(objects.clone())
            .map(|name| (name, false))
            .chain(self.agents.iter().map(|name| (name, true)))
        {
            if name.is_empty() || name.contains(|c: char| c.is_whitespace() || "()\";?".contains(c))
            {
                return form(
                    name,
                    format!(
                        "`{name}` is no name: it is empty, or has a space, a parenthesis, a quote, `;` or `?` in it"
                    ),
                );
            }
            let new = if is_agent {
                agents.insert(name) && !objects.clone().any(|object| object == name)
            } else {
                names.insert(name)
            };
            if !new {
                return Err((name.clone(), Fault::Twice(name.clone())));
            }
        }
        let mut kinds = BTreeSet::new();
        for kind in &self.types {
            if !kinds.insert(&kind.name) {
                return Err((String::from("types"), Fault::Twice(kind.name.clone())));
            }
        }
        for hand in &self.hands {
            if let Some(reach) = hand.reach
                && !(reach.centre.iter().all(|value| value.is_finite())
                    && reach.radius.is_finite()
                    && reach.radius > 0.0)
            {
                return form(&hand.name, String::from("a reach has a centre and a radius above 0"));
            }
        }
        for object in &self.objects {
            if !object.size.iter().all(|size| size.is_finite() && *size > 0.0) {
                return form(&object.name, String::from("a size has three numbers above 0"));
            }
            for joint in &object.joints {
                if (joint.axis.norm() - 1.0).abs() > 1e-6 {
                    return form(
                        &object.name,
                        format!("the axis of `{}` has no direction", joint.name),
                    );
                }
                if !(joint.lower.is_finite()
                    && joint.upper.is_finite()
                    && joint.lower < joint.upper)
                {
                    return form(
                        &object.name,
                        format!("`{}` must open from a lower to an upper value", joint.name),
                    );
                }
            }
        }
        Ok(())
    }

    /// The hand of a name.
    pub fn hand(&self, name: &str) -> Option<HandId> {
        self.hands.iter().position(|hand| hand.name == name).map(|place| HandId(place as u32))
    }

    /// The object of a name.
    pub fn object(&self, name: &str) -> Option<ObjectId> {
        self.objects
            .iter()
            .position(|object| object.name == name)
            .map(|place| ObjectId(place as u32))
    }

    /// What is wrong with a name that should be a hand's.
    pub(crate) fn no_hand(&self, name: &str) -> Fault {
        let hint = lang::did_you_mean(name, self.hands.iter().map(|hand| hand.name.as_str()));
        Fault::UnknownHand { name: name.to_string(), hint }
    }

    /// What is wrong with a name that should be an object's.
    pub(crate) fn no_object(&self, name: &str) -> Fault {
        let hint = lang::did_you_mean(name, self.objects.iter().map(|object| object.name.as_str()));
        Fault::UnknownObject { name: name.to_string(), hint }
    }
}
