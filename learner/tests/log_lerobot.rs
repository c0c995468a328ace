//! A table as `LeRobot` writes it, made here, goes in; the frames of one of its episodes come out.
#![cfg(feature = "lerobot")]

use std::fs::File;
use std::sync::Arc;

use learner::log::lerobot::Reader;
use parquet::basic::Compression;
use parquet::data_type::{FloatType, Int64Type};
use parquet::file::properties::WriterProperties;
use parquet::file::writer::SerializedFileWriter;
use parquet::schema::parser::parse_message_type;

const MAPPING: &str = r#"{
  "header": {"caveat-log":1,"rate":10,"units":{"length":"cm","angle":"deg"},"agents":[{"name":"robot","hands":[{"name":"gripper"},{"name":"other"}]}],
    "objects":[{"name":"red-cube","type":"cube","size":[5,5,5]}]},
  "episode": 1,
  "hands": {"gripper":{"place":["observation.state",0],"turn":["observation.state",3],"form":"axis-angle","grip":["action"],"grip_range":[50,0]}},
  "objects": {"red-cube":{"place":["observation.state",6]}}
}"#;

/// Two episodes of four frames each, in a file that is removed at the end.
fn table(name: &str) -> std::path::PathBuf {
    let path = std::env::temp_dir().join(format!("caveat-{name}-{}.parquet", std::process::id()));
    let schema = "message table {
        required float timestamp;
        required int64 episode_index;
        required group observation.state (LIST) { repeated group list { required float element; } }
        required float action;
    }";
    let schema = Arc::new(parse_message_type(schema).expect("the schema is good"));
    let properties = WriterProperties::builder().set_compression(Compression::SNAPPY).build();
    let file = File::create(&path).expect("the file can be made");
    let mut writer =
        SerializedFileWriter::new(file, schema, Arc::new(properties)).expect("there is room");
    let mut group = writer.next_row_group().expect("there is room");
    let frames: Vec<(f32, i64)> = (0..8).map(|row| ((row % 4) as f32 / 10.0, row / 4)).collect();
    let states: Vec<f32> = frames
        .iter()
        .flat_map(|&(time, episode)| {
            [100.0 * time, episode as f32, 0.0, 0.0, 0.0, 90.0, 30.0, 0.0, 2.5]
        })
        .collect();
    let levels: Vec<i16> = (0..states.len()).map(|place| i16::from(place % 9 > 0)).collect();
    let mut column = group.next_column().expect("there is room").expect("it is there");
    let times: Vec<f32> = frames.iter().map(|frame| frame.0).collect();
    column.typed::<FloatType>().write_batch(&times, None, None).expect("there is room");
    column.close().expect("there is room");
    let mut column = group.next_column().expect("there is room").expect("it is there");
    let episodes: Vec<i64> = frames.iter().map(|frame| frame.1).collect();
    column.typed::<Int64Type>().write_batch(&episodes, None, None).expect("there is room");
    column.close().expect("there is room");
    let mut column = group.next_column().expect("there is room").expect("it is there");
    let whole = vec![1; states.len()];
    column
        .typed::<FloatType>()
        .write_batch(&states, Some(&whole), Some(&levels))
        .expect("there is room");
    column.close().expect("there is room");
    let mut column = group.next_column().expect("there is room").expect("it is there");
    column
        .typed::<FloatType>()
        .write_batch(&[51.0, 50.0, 25.0, 0.0].repeat(2), None, None)
        .expect("there is room");
    column.close().expect("there is room");
    group.close().expect("there is room");
    writer.close().expect("there is room");
    path
}

#[test]
fn one_episode_is_read_in_the_units_of_the_header() {
    let path = table("episode");
    let reader = Reader::new(File::open(&path).expect("it was written"), MAPPING.as_bytes())
        .expect("all is there");
    let frames = reader.collect::<Result<Vec<_>, _>>().expect("every row is good");
    std::fs::remove_file(&path).expect("it is there");
    assert_eq!(frames.len(), 4);
    for (number, frame) in frames.iter().enumerate() {
        let time = number as f64 / 10.0;
        assert!((frame.time - time).abs() < 1e-6);
        let hand = frame.hands[0].as_ref().expect("it is mapped");
        assert!((hand.pose.translation.x - time).abs() < 1e-6);
        assert!((hand.pose.translation.y - 0.01).abs() < 1e-6, "it is the second episode");
        assert!((hand.pose.rotation.angle() - std::f64::consts::FRAC_PI_2).abs() < 1e-6);
        assert_eq!(hand.grip, [Some(0.0), Some(0.0), Some(0.5), Some(1.0)][number]);
        assert_eq!(frame.hands[1], None);
        let cube = frame.objects[0].as_ref().expect("it is mapped");
        assert!(
            (cube.pose.translation.vector - nalgebra::Vector3::new(0.3, 0.0, 0.025)).norm() < 1e-6
        );
    }
}

#[test]
fn what_is_not_there_is_said() {
    let path = table("fault");
    let open =
        |mapping: &str| Reader::new(File::open(&path).expect("it was written"), mapping.as_bytes());
    let bad =
        open(&MAPPING.replace("\"action\"", "\"actions\"")).err().expect("there is no such column");
    assert!(
        bad.to_string().ends_with("there is no column `actions`; did you mean `action`?"),
        "{bad}"
    );
    let bad = open(&MAPPING.replace("\"gripper\":{\"place\"", "\"griper\":{\"place\""))
        .err()
        .expect("there is no such hand");
    assert!(
        bad.to_string().ends_with("the header has no hand `griper`; did you mean `gripper`?"),
        "{bad}"
    );
    let mut reader = open(&MAPPING.replace("\"observation.state\",6", "\"observation.state\",7"))
        .expect("it shows in rows");
    let bad = reader.next().expect("there is a row").expect_err("the list is too short");
    assert_eq!(bad.to_string(), "line 5: `red-cube`: there is no number 9 in `observation.state`");
    // Without an episode the second one begins before the first one ended.
    let mut reader = open(&MAPPING.replace("\"episode\": 1,", "")).expect("all is there");
    let bad = reader.find_map(Result::err).expect("time runs backwards");
    assert!(bad.to_string().starts_with("line 5: `timestamp`: time runs backwards"), "{bad}");
    std::fs::remove_file(&path).expect("it is there");
}
