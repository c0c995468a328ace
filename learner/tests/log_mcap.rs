//! A recording of ROS 2 messages that is written here goes in; the frames that are read from it come out.
#![cfg(feature = "mcap")]

use std::collections::BTreeMap;
use std::io::Cursor;

use learner::log::mcap::Reader;
use mcap::records::MessageHeader;

const MAPPING: &str = r#"{
  "header": {"caveat-log":1,"rate":50,"agents":[{"name":"robot","hands":[{"name":"gripper"},{"name":"other"}]}],
    "objects":[{"name":"red-cube","type":"cube","size":[0.05,0.05,0.05]},
      {"name":"table","type":"table","size":[1,1,0.04],"fixed":true},
      {"name":"drawer","type":"drawer","size":[0.4,0.4,0.2],"joints":[{"name":"slide","motion":"slides","axis":[1,0,0],"lower":0,"upper":0.3}]}]},
  "topics": {"/gripper/pose":{"hand":"gripper"}, "/gripper/closed":{"grip":"gripper"}, "/gripper/teach":{"teach":"gripper"},
    "/drawer/joints":{"joints":"drawer"}, "/drawer/pose":{"object":"drawer"}},
  "frames": {"cube_link":"red-cube", "table_link":"table"}
}"#;

/// A message in CDR, of either byte order.
struct Cdr {
    bytes: Vec<u8>,
    little: bool,
}

impl Cdr {
    fn new(little: bool) -> Self {
        Self { bytes: vec![0, u8::from(little), 0, 0], little }
    }

    fn put<const N: usize>(&mut self, mut bytes: [u8; N]) -> &mut Self {
        while !(self.bytes.len() - 4).is_multiple_of(N) {
            self.bytes.push(0);
        }
        if !self.little {
            bytes.reverse();
        }
        self.bytes.extend(bytes);
        self
    }

    fn unsigned(&mut self, value: u32) -> &mut Self {
        self.put(value.to_le_bytes())
    }

    fn double(&mut self, value: f64) -> &mut Self {
        self.put(value.to_le_bytes())
    }

    fn text(&mut self, text: &str) -> &mut Self {
        self.unsigned(text.len() as u32 + 1);
        self.bytes.extend(text.bytes());
        self.bytes.push(0);
        self
    }

    fn stamp(&mut self, nanoseconds: u64, frame: &str) -> &mut Self {
        self.unsigned((nanoseconds / 1_000_000_000) as u32);
        self.unsigned((nanoseconds % 1_000_000_000) as u32);
        self.text(frame)
    }

    fn pose(&mut self, x: f64, w: f64) -> &mut Self {
        for value in [x, 0.0, 0.0, 0.0, 0.0, 0.0, w] {
            self.double(value);
        }
        self
    }
}

/// Writes a recording of half a second: a gripper that moves along x at 100 Hz, and a cube on a cart as a chain of transforms.
fn recording() -> Vec<u8> {
    let mut writer = mcap::Writer::new(Cursor::new(Vec::new())).expect("memory is never full");
    let mut channels = BTreeMap::new();
    for (topic, kind) in [
        ("/gripper/pose", "geometry_msgs/msg/PoseStamped"),
        ("/gripper/closed", "std_msgs/msg/Float64"),
        ("/gripper/teach", "std_msgs/msg/Bool"),
        ("/drawer/joints", "sensor_msgs/msg/JointState"),
        ("/drawer/pose", "geometry_msgs/msg/PoseStamped"),
        ("/tf", "tf2_msgs/msg/TFMessage"),
        ("/chatter", "std_msgs/msg/String"),
    ] {
        let schema = writer.add_schema(kind, "ros2msg", b"").expect("it is new");
        let channel =
            writer.add_channel(schema, topic, "cdr", &BTreeMap::new()).expect("it is new");
        channels.insert(topic, channel);
    }
    let start = 1_700_000_000_000_000_000;
    let mut write = |topic: &str, time: u64, message: &Cdr| {
        let header = MessageHeader {
            channel_id: channels[topic],
            sequence: 0,
            log_time: time,
            publish_time: time,
        };
        writer.write_to_known_channel(&header, &message.bytes).expect("memory is never full");
    };
    for step in 0..50u64 {
        let time = start + step * 10_000_000;
        let seconds = step as f64 / 100.0;
        let mut message = Cdr::new(step % 2 == 0);
        write("/gripper/pose", time, message.stamp(time, "world").pose(seconds, 1.0));
        let mut message = Cdr::new(true);
        message
            .unsigned(2)
            .stamp(time, "cart")
            .text("cube_link")
            .pose(0.5, 1.0)
            .stamp(time, "world")
            .text("cart")
            .pose(seconds, 1.0);
        write("/tf", time, &message);
        if step == 0 {
            let mut message = Cdr::new(true);
            message.unsigned(1).stamp(time, "world").text("table_link").pose(0.0, 1.0);
            write("/tf", time, &message);
        }
        if step == 20 {
            write("/gripper/closed", time, Cdr::new(true).double(0.75));
            write("/gripper/teach", time, Cdr::new(true).put([1]));
            write("/gripper/closed", time, Cdr::new(true).double(7.0));
            write("/gripper/pose", time, Cdr::new(true).stamp(time, "camera").pose(0.0, 1.0));
            write("/gripper/pose", time, Cdr::new(true).stamp(time, "world").pose(0.0, 0.0));
            write("/gripper/pose", time, Cdr::new(true).stamp(time, "world"));
            write("/chatter", time, Cdr::new(true).text("hello"));
        }
        if step < 10 {
            write("/drawer/pose", time, Cdr::new(false).stamp(time, "world").pose(2.0, 1.0));
            let mut message = Cdr::new(true);
            message
                .stamp(time, "")
                .unsigned(2)
                .text("other")
                .text("slide")
                .unsigned(2)
                .double(9.0)
                .double(0.125);
            write("/drawer/joints", time, &message);
        }
    }
    writer.finish().expect("memory is never full");
    writer.into_inner().into_inner()
}

#[test]
fn a_recording_is_read_as_frames_of_an_even_rate() {
    let bytes = recording();
    let mut reader = Reader::new(&bytes[..], MAPPING.as_bytes()).expect("the mapping is good");
    let (mut frames, mut bad) = (Vec::new(), Vec::new());
    for frame in reader.by_ref() {
        match frame {
            Ok(frame) => frames.push(frame),
            Err(error) => bad.push(error.to_string()),
        }
    }
    assert_eq!(reader.consumed(), bytes.len() as u64);
    assert_eq!(frames.len(), 25);
    for (number, frame) in frames.iter().enumerate() {
        let time = number as f64 / 50.0;
        assert!((frame.time - time).abs() < 1e-9);
        let hand = frame.hands[0].as_ref().expect("it is always seen");
        assert!(
            (hand.pose.translation.x - time).abs() < 1e-6,
            "{time}: {}",
            hand.pose.translation.x
        );
        assert_eq!(frame.hands[1], None);
        let cube = frame.objects[0].as_ref().expect("it is always seen");
        assert!(
            (cube.pose.translation.x - 0.5 - time).abs() < 1e-6,
            "{time}: {}",
            cube.pose.translation.x
        );
        assert!(frame.objects[1].is_some(), "what is fixed is told once");
        // The drawer is told until 0.09 s and lost a tenth of a second later.
        assert_eq!(frame.objects[2].is_some(), time < 0.195, "{time}");
    }
    assert_eq!(frames[2].objects[2].as_ref().expect("it is seen").joints, [0.125]);
    let last = frames[24].hands[0].as_ref().expect("it is seen");
    assert_eq!((last.grip, last.teach), (Some(0.75), true));
    insta::assert_snapshot!(bad.join("\n"));
}

#[test]
fn what_is_no_recording_or_no_mapping_is_refused() {
    let mut reader =
        Reader::new(&b"{\"caveat-log\":1}"[..], MAPPING.as_bytes()).expect("the mapping is good");
    assert!(reader.next().expect("there is a fault").is_err_and(|bad| bad.is_fatal()));
    assert!(reader.next().is_none());
    let bytes = recording();
    let reader =
        Reader::new(&bytes[..bytes.len() / 2], MAPPING.as_bytes()).expect("the mapping is good");
    let last = reader.last().expect("there is something");
    assert!(
        last.is_err_and(|bad| bad.is_fatal()),
        "a recording that breaks off is told from one that ends"
    );
    let wrong = MAPPING.replace("\"red-cube\", \"table_link\"", "\"red-cub\", \"table_link\"");
    let bad = Reader::new(&bytes[..], wrong.as_bytes()).err().expect("there is no such object");
    assert_eq!(
        bad.to_string(),
        "line 1: `frames`: the header has no object `red-cub`; did you mean `red-cube`?"
    );
}
