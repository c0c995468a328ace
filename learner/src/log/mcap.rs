//! A recording of ROS 2 messages in MCAP goes in, with a [`Mapping`] from topics to hands and objects; frames of an even rate come out.
//!
//! Understood are `geometry_msgs/msg/PoseStamped`, `tf2_msgs/msg/TFMessage`, `sensor_msgs/msg/JointState`, and `std_msgs/msg/Float32`, `Float64` and `Bool`, in CDR.
//! A recording is read from its start to its end once, in memory that its longest chunk bounds.

use std::collections::{BTreeMap, HashMap, VecDeque};
use std::io::Read;

use mcap::records::Record;
use mcap::sans_io::linear_reader::{LinearReadEvent, LinearReader};
use nalgebra::Isometry3;
use serde::Deserialize;

use super::cdr::Message;
use super::fault::{BadLine, Fault};
use super::{Frame, HandSample, Header, ObjectSample, header};

/// What the topics and frames of a recording are.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Mapping {
    /// The header of the log, as JSON Lines have it. A recording has none; its units are metres, radians and seconds.
    pub header: serde_json::Value,
    /// What each topic is about; other topics are passed over.
    #[serde(default)]
    pub topics: BTreeMap<String, Topic>,
    /// The names of hands and objects by those of their frames in transforms, which are read from all topics that have any.
    #[serde(default)]
    pub frames: BTreeMap<String, String>,
    /// How old, in seconds, a pose may be before its hand or object counts as lost.
    #[serde(default = "stale")]
    pub stale: f64,
}

fn stale() -> f64 {
    0.1
}

/// What a topic is about.
#[derive(Debug, Clone, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Topic {
    /// The pose of a hand.
    Hand(String),
    /// The pose of an object.
    Object(String),
    /// How far a hand is closed.
    Grip(String),
    /// Whether a hand is in teach mode.
    Teach(String),
    /// The joints of an object, by their names in the header.
    Joints(String),
}

/// The latest of one hand or object.
#[derive(Debug, Default)]
struct Body {
    /// Poses with their times in seconds since the first message, of the last moments.
    poses: VecDeque<(f64, Isometry3<f64>)>,
    grip: Option<f64>,
    teach: bool,
    joints: Vec<f64>,
}

/// Reads a recording: an iterator over its frames at the rate of the header. The number of a [`BadLine`] is that of the message.
pub struct Reader<R> {
    input: R,
    records: LinearReader,
    mapping: Mapping,
    header: Header,
    schemas: HashMap<u16, String>,
    channels: HashMap<u16, (String, u16)>,
    /// The frame above each frame, with the transform from the one to the other.
    transforms: HashMap<String, (String, Isometry3<f64>)>,
    hands: Vec<Body>,
    objects: Vec<Body>,
    number: u64,
    consumed: u64,
    /// The time of the first message in nanoseconds, and of the latest in seconds since then.
    origin: Option<u64>,
    newest: f64,
    tick: u64,
    ready: VecDeque<Result<Frame, BadLine>>,
    ended: bool,
}

/// A hand or an object, by its place.
#[derive(Clone, Copy)]
enum Place {
    Hand(usize),
    Object(usize),
}

impl<R: Read> Reader<R> {
    /// A reader of a recording. The text of the mapping is JSON.
    pub fn new(input: R, mapping: &[u8]) -> Result<Self, BadLine> {
        let mapping: Mapping = serde_json::from_slice(mapping)
            .map_err(|error| header::syntax(error.line() as u64, &error))?;
        let (header, _) = header::read(mapping.header.to_string().as_bytes(), 1)?;
        for topic in mapping.topics.values() {
            let known = match topic {
                Topic::Hand(name) | Topic::Grip(name) | Topic::Teach(name) => {
                    header.hand(name).map(|_| ()).ok_or_else(|| header.no_hand(name))
                }
                Topic::Object(name) | Topic::Joints(name) => {
                    header.object(name).map(|_| ()).ok_or_else(|| header.no_object(name))
                }
            };
            known.map_err(|fault| BadLine::of_field(1, "topics", fault))?;
        }
        for name in mapping.frames.values() {
            if header.hand(name).is_none() && header.object(name).is_none() {
                return Err(BadLine::of_field(1, "frames", header.no_object(name)));
            }
        }
        Ok(Self {
            input,
            records: LinearReader::new(),
            schemas: HashMap::new(),
            channels: HashMap::new(),
            transforms: HashMap::new(),
            hands: header.hands.iter().map(|_| Body::default()).collect(),
            objects: header.objects.iter().map(|_| Body::default()).collect(),
            header,
            mapping,
            number: 0,
            consumed: 0,
            origin: None,
            newest: 0.0,
            tick: 0,
            ready: VecDeque::new(),
            ended: false,
        })
    }

    /// What is tracked.
    pub fn header(&self) -> &Header {
        &self.header
    }

    /// How many bytes were read so far, to show progress by.
    pub fn consumed(&self) -> u64 {
        self.consumed
    }

    /// Reads one record, or some bytes.
    fn step(&mut self) {
        let stop = |this: &mut Self, message: String| {
            this.ended = true;
            let line = this.number;
            this.ready.push_back(Err(BadLine::new(line, Fault::Unreadable(message))));
        };
        match self.records.next_event() {
            None => {
                self.ended = true;
                if self.origin.is_some() {
                    self.emit(f64::INFINITY);
                }
            }
            Some(Err(error)) => stop(self, error.to_string()),
            Some(Ok(LinearReadEvent::ReadRequest(wanted))) => {
                match self.input.read(self.records.insert(wanted)) {
                    Ok(count) => {
                        self.records.notify_read(count);
                        self.consumed += count as u64;
                    }
                    Err(error) => stop(self, error.to_string()),
                }
            }
            Some(Ok(LinearReadEvent::Record { data, opcode })) => {
                match mcap::parse_record(opcode, data) {
                    Ok(Record::Schema { header, .. }) => {
                        self.schemas.insert(header.id, header.name);
                    }
                    Ok(Record::Channel(channel)) => {
                        self.channels.insert(channel.id, (channel.topic, channel.schema_id));
                    }
                    Ok(Record::Message { header, data }) => {
                        self.number += 1;
                        let data = data.into_owned();
                        let Some((topic, schema)) = self.channels.get(&header.channel_id).cloned()
                        else {
                            return;
                        };
                        let kind = self.schemas.get(&schema).cloned().unwrap_or_default();
                        if let Err(fault) = self.message(&topic, &kind, header.log_time, &data) {
                            self.ready.push_back(Err(BadLine::of_field(self.number, topic, fault)));
                        }
                    }
                    Ok(_) => {}
                    Err(error) => stop(self, error.to_string()),
                }
            }
        }
    }

    /// Takes a message.
    fn message(&mut self, topic: &str, kind: &str, logged: u64, data: &[u8]) -> Result<(), Fault> {
        let kind = kind.replace("/msg/", "/");
        let about = self.mapping.topics.get(topic).cloned();
        if kind == "tf2_msgs/TFMessage" && !self.mapping.frames.is_empty() {
            return self.transforms(&mut Message::new(data)?, logged);
        }
        let Some(about) = about else { return Ok(()) };
        let mut message = Message::new(data)?;
        match (kind.as_str(), &about) {
            ("geometry_msgs/PoseStamped", Topic::Hand(name) | Topic::Object(name)) => {
                let stamp = message.stamp()?;
                let pose = message.pose()?;
                if stamp.frame != self.header.frame {
                    let text = format!(
                        "the pose is in the frame `{}`, not in `{}`",
                        stamp.frame, self.header.frame
                    );
                    return Err(Fault::Form(text));
                }
                let time = self.time(stamp.time, logged);
                self.pose(name, time, pose);
            }
            ("sensor_msgs/JointState", Topic::Joints(name)) => {
                let stamp = message.stamp()?;
                let names =
                    (0..message.count()?).map(|_| message.text()).collect::<Result<Vec<_>, _>>()?;
                let values = (0..message.count()?)
                    .map(|_| message.double())
                    .collect::<Result<Vec<_>, _>>()?;
                self.time(stamp.time, logged);
                let object = self.header.object(name).expect("the mapping was checked").index();
                let joints = &self.header.objects[object].joints;
                let value = |joint: &super::Joint| {
                    let place = names.iter().position(|name| *name == joint.name)?;
                    values.get(place).copied().filter(|value| value.is_finite())
                };
                let found: Option<Vec<f64>> = joints.iter().map(value).collect();
                self.objects[object].joints =
                    found.ok_or(Fault::Joints { expected: joints.len(), found: values.len() })?;
            }
            ("std_msgs/Float32", Topic::Grip(name)) => {
                let value = message.single()?;
                self.grip(name, value, logged)?;
            }
            ("std_msgs/Float64", Topic::Grip(name)) => {
                let value = message.double()?;
                self.grip(name, value, logged)?;
            }
            ("std_msgs/Bool", Topic::Teach(name)) => {
                let teach = message.truth()?;
                self.time(0, logged);
                let hand = self.header.hand(name).expect("the mapping was checked");
                self.hands[hand.index()].teach = teach;
            }
            _ => {
                let text = format!("messages of the type `{kind}` cannot be {about:?}");
                return Err(Fault::Form(text));
            }
        }
        Ok(())
    }

    /// Takes how far a hand is closed.
    fn grip(&mut self, name: &str, value: f64, logged: u64) -> Result<(), Fault> {
        let value = super::sample::share(value)?;
        self.time(0, logged);
        let hand = self.header.hand(name).expect("the mapping was checked");
        self.hands[hand.index()].grip = Some(value);
        Ok(())
    }

    /// Takes transforms, and finds where the mapped frames are now.
    fn transforms(&mut self, message: &mut Message<'_>, logged: u64) -> Result<(), Fault> {
        let mut changed = Vec::new();
        let mut time = 0.0;
        for _ in 0..message.count()? {
            let stamp = message.stamp()?;
            let child = message.text()?;
            let pose = message.pose()?;
            time = self.time(stamp.time, logged);
            self.transforms.insert(child.clone(), (stamp.frame, pose));
            changed.push(child);
        }
        for (frame, name) in self.mapping.frames.clone() {
            let mut pose = Isometry3::identity();
            let mut here = frame.as_str();
            let mut moved = false;
            // A chain of frames that leads nowhere is no chain; one longer than this is a circle.
            for _ in 0..64 {
                let Some((parent, step)) = self.transforms.get(here) else { break };
                moved |= changed.iter().any(|child| child == here);
                pose = step * pose;
                here = parent;
                if here == self.header.frame {
                    break;
                }
            }
            if moved && here == self.header.frame {
                self.pose(&name, time, pose);
            }
        }
        Ok(())
    }

    /// The time of a message in seconds since the first one: its own, or that of the recording where it has none.
    fn time(&mut self, stamped: u64, logged: u64) -> f64 {
        let nanoseconds = if stamped == 0 { logged } else { stamped };
        let origin = *self.origin.get_or_insert(nanoseconds);
        let time = (i128::from(nanoseconds) - i128::from(origin)) as f64 * 1e-9;
        if time > self.newest {
            self.newest = time;
            self.emit(time - self.mapping.stale);
        }
        time
    }

    /// Takes a pose of a hand or object.
    fn pose(&mut self, name: &str, time: f64, pose: Isometry3<f64>) {
        let place = match self.header.hand(name) {
            Some(hand) => Place::Hand(hand.index()),
            None => {
                Place::Object(self.header.object(name).expect("the mapping was checked").index())
            }
        };
        let body = match place {
            Place::Hand(hand) => &mut self.hands[hand],
            Place::Object(object) => &mut self.objects[object],
        };
        body.poses.push_back((time, pose));
    }

    /// Makes the frames up to a time: nothing that comes later is nearer to them.
    fn emit(&mut self, until: f64) {
        loop {
            let time = self.tick as f64 / self.header.rate;
            if time > until.min(self.newest) {
                return;
            }
            let stale = self.mapping.stale;
            let hands = self.hands.iter_mut().map(|body| {
                let pose = body.at(time, stale)?;
                Some(HandSample { pose, grip: body.grip, teach: body.teach, given: None })
            });
            let hands = hands.collect();
            let objects = self.objects.iter_mut().zip(&self.header.objects).map(|(body, what)| {
                // What never moves is often told only once.
                let stale = if what.fixed { f64::INFINITY } else { stale };
                let pose = body.at(time, stale)?;
                Some(ObjectSample { pose, joints: body.joints.clone(), seen: 1.0 })
            });
            let frame = Frame { time, hands, objects: objects.collect(), facts: None };
            self.ready.push_back(Ok(frame));
            self.tick += 1;
        }
    }
}

impl Body {
    /// The pose that is nearest to a time, if it is near enough; forgets what is older than needed.
    fn at(&mut self, time: f64, stale: f64) -> Option<Isometry3<f64>> {
        while self.poses.len() > 1
            && (self.poses[1].0 - time).abs() <= (self.poses[0].0 - time).abs()
        {
            self.poses.pop_front();
        }
        self.poses.front().filter(|(at, _)| (at - time).abs() <= stale).map(|(_, pose)| *pose)
    }
}

impl<R: Read> Iterator for Reader<R> {
    type Item = Result<Frame, BadLine>;

    fn next(&mut self) -> Option<Self::Item> {
        loop {
            if let Some(ready) = self.ready.pop_front() {
                return Some(ready);
            }
            if self.ended {
                return None;
            }
            self.step();
        }
    }
}
