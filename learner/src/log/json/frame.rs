//! One line of JSON goes in; a frame comes out, made while the line is parsed, or the place and kind of its first fault.

use std::cell::RefCell;
use std::collections::HashMap;
use std::fmt;

use serde::de::{self, DeserializeSeed, Deserializer, IgnoredAny, MapAccess, SeqAccess, Visitor};

use super::super::fault::{BadLine, Fault};
use super::super::header::{Scale, syntax};
use super::super::{Fact, Frame, HandSample, HandState, Header, ObjectId, ObjectSample, sample};

/// Where names stand in the header.
#[derive(Debug)]
pub(super) struct Index {
    hands: HashMap<String, usize>,
    objects: HashMap<String, usize>,
    /// What went wrong in the line that is parsed now: serde has only words for it.
    fault: RefCell<Option<(String, Fault)>>,
}

impl Index {
    /// The index of a header.
    pub fn new(header: &Header) -> Self {
        let hands = header.hands.iter().enumerate().map(|(place, hand)| (hand.name.clone(), place));
        let objects =
            header.objects.iter().enumerate().map(|(place, object)| (object.name.clone(), place));
        Self { hands: hands.collect(), objects: objects.collect(), fault: RefCell::new(None) }
    }

    /// Keeps a fault and gives serde something to stop with.
    fn fail<E: de::Error>(&self, field: impl Into<String>, fault: Fault) -> E {
        let error = E::custom("fault");
        self.fault.borrow_mut().get_or_insert((field.into(), fault));
        error
    }
}

/// Reads a line; the number of the line in an error is 0.
pub(super) fn read(
    line: &[u8],
    header: &Header,
    index: &mut Index,
    scale: Scale,
    before: Option<f64>,
) -> Result<Frame, BadLine> {
    *index.fault.borrow_mut() = None;
    let context = Context { header, index, scale, before };
    let mut input = serde_json::Deserializer::from_slice(line);
    let read = context.deserialize(&mut input).and_then(|frame| input.end().map(|()| frame));
    read.map_err(|error| {
        let mut bad = syntax(0, &error);
        if let Some((field, fault)) = index.fault.borrow_mut().take() {
            bad.field = Some(field).filter(|field| !field.is_empty());
            bad.fault = fault;
        } else if not_finite(line, error.column())
            || error.to_string().starts_with("number out of range")
        {
            bad.fault = Fault::NotFinite;
        }
        bad
    })
}

/// Whether JSON broke off at what other programs write for numbers that are none.
fn not_finite(line: &[u8], column: usize) -> bool {
    let from = column.saturating_sub(2).min(line.len());
    let rest = &line[from..];
    ["NaN", "nan", "Infinity", "inf", "-Infinity", "-inf", "-NaN", "-nan"].iter().any(|word| {
        (0..2).any(|skip| rest.get(skip..).is_some_and(|rest| rest.starts_with(word.as_bytes())))
    })
}

/// What is needed to read a frame.
#[derive(Clone, Copy)]
struct Context<'a> {
    header: &'a Header,
    index: &'a Index,
    scale: Scale,
    before: Option<f64>,
}

impl<'de> DeserializeSeed<'de> for Context<'_> {
    type Value = Frame;

    fn deserialize<D: Deserializer<'de>>(self, input: D) -> Result<Frame, D::Error> {
        input.deserialize_map(self)
    }
}

/// Whether a field is a remark that readers pass over.
fn is_remark(key: &str) -> bool {
    key.starts_with('_')
}

impl<'de> Visitor<'de> for Context<'_> {
    type Value = Frame;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a frame such as {\"t\":0.1,\"hands\":{…},\"objects\":{…}}")
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Frame, A::Error> {
        let mut time = None;
        let mut frame = Frame {
            time: 0.0,
            hands: self.header.hands.iter().map(|_| None).collect(),
            objects: self.header.objects.iter().map(|_| None).collect(),
            facts: None,
        };
        while let Some(key) = map.next_key::<Key>()? {
            match key.0.as_ref() {
                "t" => {
                    let value = map.next_value::<f64>()?;
                    let value = sample::time(value, self.scale, self.before);
                    time = Some(value.map_err(|fault| self.index.fail("t", fault))?);
                }
                "hands" => map.next_value_seed(Hands { context: self, out: &mut frame.hands })?,
                "objects" => {
                    map.next_value_seed(Objects { context: self, out: &mut frame.objects })?;
                }
                "facts" => frame.facts = Some(facts(map.next_value()?, self.index)?),
                other if is_remark(other) => {
                    map.next_value::<IgnoredAny>()?;
                }
                other => {
                    let hint = lang::did_you_mean(other, ["t", "hands", "objects", "facts"]);
                    return Err(self.index.fail(other, Fault::UnknownField(hint)));
                }
            }
        }
        frame.time = time.ok_or_else(|| {
            self.index.fail::<A::Error>("", Fault::Form(String::from("there is no time `t`")))
        })?;
        Ok(frame)
    }
}

/// Facts as lists of words.
fn facts<E: de::Error>(lists: Vec<Vec<String>>, index: &Index) -> Result<Vec<Fact>, E> {
    lists
        .into_iter()
        .map(|mut words| {
            if words.is_empty() {
                return Err(
                    index.fail("facts", Fault::Form(String::from("a fact has a predicate")))
                );
            }
            let arguments = words.split_off(1);
            Ok(Fact { predicate: words.remove(0), arguments })
        })
        .collect()
}

/// A key that is borrowed from the line where it has no escapes.
struct Key<'de>(std::borrow::Cow<'de, str>);

impl<'de> de::Deserialize<'de> for Key<'de> {
    fn deserialize<D: Deserializer<'de>>(input: D) -> Result<Self, D::Error> {
        struct Words;
        impl<'de> Visitor<'de> for Words {
            type Value = Key<'de>;
            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("a name")
            }
            fn visit_borrowed_str<E: de::Error>(self, text: &'de str) -> Result<Key<'de>, E> {
                Ok(Key(text.into()))
            }
            fn visit_str<E: de::Error>(self, text: &str) -> Result<Key<'de>, E> {
                Ok(Key(text.to_string().into()))
            }
        }
        input.deserialize_str(Words)
    }
}

/// The hands of a frame, by their names.
struct Hands<'a, 'o> {
    context: Context<'a>,
    out: &'o mut Vec<Option<HandSample>>,
}

impl<'de> DeserializeSeed<'de> for Hands<'_, '_> {
    type Value = ();

    fn deserialize<D: Deserializer<'de>>(self, input: D) -> Result<(), D::Error> {
        input.deserialize_map(self)
    }
}

impl<'de> Visitor<'de> for Hands<'_, '_> {
    type Value = ();

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("hands by their names")
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<(), A::Error> {
        let Context { header, index, .. } = self.context;
        let mut place = 0;
        while let Some(Key(name)) = map.next_key::<Key>()? {
            let found = match header.hands.get(place) {
                Some(hand) if hand.name == name => Some(place),
                _ => index.hands.get(name.as_ref()).copied(),
            };
            place = found.ok_or_else(|| index.fail::<A::Error>("hands", header.no_hand(&name)))?;
            if self.out[place].is_some() {
                return Err(index.fail(format!("hands.{name}"), Fault::Twice(name.into_owned())));
            }
            let body =
                map.next_value_seed(Body { context: self.context, name: &name, object: None })?;
            self.out[place] = body.map(|body| HandSample {
                pose: body.pose,
                grip: body.grip,
                teach: body.teach,
                given: body.given,
            });
            place += 1;
        }
        Ok(())
    }
}

/// The objects of a frame, by their names.
struct Objects<'a, 'o> {
    context: Context<'a>,
    out: &'o mut Vec<Option<ObjectSample>>,
}

impl<'de> DeserializeSeed<'de> for Objects<'_, '_> {
    type Value = ();

    fn deserialize<D: Deserializer<'de>>(self, input: D) -> Result<(), D::Error> {
        input.deserialize_map(self)
    }
}

impl<'de> Visitor<'de> for Objects<'_, '_> {
    type Value = ();

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("objects by their names")
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<(), A::Error> {
        let Context { header, index, .. } = self.context;
        let mut place = 0;
        while let Some(Key(name)) = map.next_key::<Key>()? {
            // Logs have the order of the header nearly always.
            let found = match header.objects.get(place) {
                Some(object) if object.name == name => Some(place),
                _ => index.objects.get(name.as_ref()).copied(),
            };
            place =
                found.ok_or_else(|| index.fail::<A::Error>("objects", header.no_object(&name)))?;
            if self.out[place].is_some() {
                return Err(index.fail(format!("objects.{name}"), Fault::Twice(name.into_owned())));
            }
            let object = Some(ObjectId(place as u32));
            let body = map.next_value_seed(Body { context: self.context, name: &name, object })?;
            self.out[place] = body.map(|body| ObjectSample {
                pose: body.pose,
                joints: body.joints,
                seen: body.seen,
            });
            place += 1;
        }
        Ok(())
    }
}

/// What is said of one hand, or of one object: a pose alone, or an object with more; null where it is lost.
struct Body<'a> {
    context: Context<'a>,
    name: &'a str,
    object: Option<ObjectId>,
}

/// All that can be said of a hand or an object.
struct Said {
    pose: nalgebra::Isometry3<f64>,
    joints: Vec<f64>,
    seen: f64,
    grip: Option<f64>,
    teach: bool,
    given: Option<HandState>,
}

/// What the log itself says that a hand does.
#[derive(serde::Deserialize)]
#[serde(deny_unknown_fields)]
struct Given {
    moves: bool,
    #[serde(rename = "acted-on")]
    acted_on: Option<String>,
    #[serde(rename = "in-hand")]
    in_hand: Option<String>,
}

impl Body<'_> {
    /// A fault in what is said of it.
    fn fail<E: de::Error>(&self, part: &str, fault: Fault) -> E {
        let group = if self.object.is_some() { "objects" } else { "hands" };
        let dot = if part.is_empty() { "" } else { "." };
        self.context.index.fail(format!("{group}.{}{dot}{part}", self.name), fault)
    }

    /// The seven numbers of a pose.
    fn pose<'de, A: SeqAccess<'de>>(
        &self,
        mut seq: A,
    ) -> Result<nalgebra::Isometry3<f64>, A::Error> {
        let mut values = [0.0; 7];
        let mut count = 0;
        while let Some(value) = seq.next_element::<f64>()? {
            if count < 7 {
                values[count] = value;
            }
            count += 1;
        }
        if count != 7 {
            return Err(self.fail("pose", Fault::Pose(count)));
        }
        sample::pose(values, self.context.scale).map_err(|fault| self.fail("pose", fault))
    }

    /// A name of an object, or none.
    fn named<E: de::Error>(&self, part: &str, name: Option<String>) -> Result<Option<ObjectId>, E> {
        let index = self.context.index;
        name.map(|name| {
            let place = index.objects.get(&name);
            let found = place.map(|&place| ObjectId(place as u32));
            found.ok_or_else(|| self.fail(part, self.context.header.no_object(&name)))
        })
        .transpose()
    }
}

impl<'de> DeserializeSeed<'de> for Body<'_> {
    type Value = Option<Said>;

    fn deserialize<D: Deserializer<'de>>(self, input: D) -> Result<Self::Value, D::Error> {
        input.deserialize_any(self)
    }
}

impl<'de> Visitor<'de> for Body<'_> {
    type Value = Option<Said>;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a pose [x,y,z,qx,qy,qz,qw], an object with a `pose`, or null")
    }

    fn visit_unit<E: de::Error>(self) -> Result<Self::Value, E> {
        Ok(None)
    }

    fn visit_seq<A: SeqAccess<'de>>(self, seq: A) -> Result<Self::Value, A::Error> {
        let pose = self.pose(seq)?;
        Ok(Some(Said {
            pose,
            joints: Vec::new(),
            seen: 1.0,
            grip: None,
            teach: false,
            given: None,
        }))
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Self::Value, A::Error> {
        let fields: &[&str] = if self.object.is_some() {
            &["pose", "joints", "seen"]
        } else {
            &["pose", "grip", "teach", "given"]
        };
        let mut pose = None;
        let (mut joints, mut seen) = (Vec::new(), 1.0);
        let (mut grip, mut teach, mut given) = (None, false, None);
        while let Some(Key(key)) = map.next_key::<Key>()? {
            match key.as_ref() {
                key if is_remark(key) => {
                    map.next_value::<IgnoredAny>()?;
                }
                key if !fields.contains(&key) => {
                    let hint = lang::did_you_mean(key, fields.iter().copied());
                    return Err(self.fail(key, Fault::UnknownField(hint)));
                }
                "pose" => pose = Some(map.next_value_seed(Pose(&self))?),
                "joints" => joints = map.next_value()?,
                "seen" => {
                    seen = sample::share(map.next_value()?)
                        .map_err(|fault| self.fail("seen", fault))?;
                }
                "grip" => {
                    let value: Option<f64> = map.next_value()?;
                    grip = value
                        .map(sample::share)
                        .transpose()
                        .map_err(|fault| self.fail("grip", fault))?;
                }
                "teach" => teach = map.next_value()?,
                _ => {
                    let said: Option<Given> = map.next_value()?;
                    given = match said {
                        Some(said) => Some(HandState {
                            moves: said.moves,
                            acted_on: self.named("given", said.acted_on)?,
                            in_hand: self.named("given", said.in_hand)?,
                        }),
                        None => None,
                    };
                }
            }
        }
        let Some(pose) = pose else {
            return Err(self.fail("", Fault::Form(String::from("there is no `pose`"))));
        };
        if let Some(object) = self.object
            && !joints.is_empty()
        {
            let object = &self.context.header.objects[object.index()];
            sample::joints(&mut joints, object, self.context.scale)
                .map_err(|fault| self.fail("joints", fault))?;
        }
        Ok(Some(Said { pose, joints, seen, grip, teach, given }))
    }
}

/// The pose within an object.
struct Pose<'a, 'b>(&'b Body<'a>);

impl<'de> DeserializeSeed<'de> for Pose<'_, '_> {
    type Value = nalgebra::Isometry3<f64>;

    fn deserialize<D: Deserializer<'de>>(self, input: D) -> Result<Self::Value, D::Error> {
        input.deserialize_seq(self)
    }
}

impl<'de> Visitor<'de> for Pose<'_, '_> {
    type Value = nalgebra::Isometry3<f64>;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a pose [x,y,z,qx,qy,qz,qw]")
    }

    fn visit_seq<A: SeqAccess<'de>>(self, seq: A) -> Result<Self::Value, A::Error> {
        self.0.pose(seq)
    }
}
