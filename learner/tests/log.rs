//! Logs go in as text or as data; what is read, what is refused and in which words comes out.

#[path = "log/any.rs"]
mod any;
#[path = "log/schema.rs"]
mod schema;

use learner::log::{BadLine, Frame, Header, csv, json};
use learner::truth;
use proptest::prelude::*;

/// A header with a hand, a cube and a drawer, in centimetres, degrees and milliseconds.
const HEADER: &str = r#"{"caveat-log":1,"rate":90,"units":{"length":"cm","angle":"deg","time":"ms"},"types":[{"name":"cube","parent":"item"}],"agents":[{"name":"person","hands":[{"name":"left-hand"},{"name":"right-hand","reach":{"centre":[0,0,40],"radius":80}}]}],"objects":[{"name":"red-cube","type":"cube","size":[5,5,5]},{"name":"door","type":"door","size":[40,2,60],"joints":[{"name":"hinge","motion":"turns","axis":[0,0,2],"lower":0,"upper":90}]}]}"#;

/// The frames of a log, bad lines as their messages.
fn read(text: &str) -> (Header, Vec<Result<Frame, String>>) {
    let mut reader = json::Reader::new(text.as_bytes()).expect("the header is good");
    let frames = reader.by_ref().map(|frame| frame.map_err(|bad| bad.to_string())).collect();
    assert_eq!(reader.consumed(), text.len() as u64);
    (reader.header().clone(), frames)
}

#[test]
fn units_are_those_of_the_program_after_reading() {
    let line = r#"{"t":1500,"hands":{"right-hand":{"pose":[10,0,0,0,0,0,1],"grip":0.5}},"objects":{"door":{"pose":[0,0,100,0,0,0,0.999],"joints":[45]}}}"#;
    let (header, frames) = read(&format!("{HEADER}\n{line}\n"));
    let frame = frames[0].as_ref().expect("the line is good");
    let close = |value: f64, wanted: f64| assert!((value - wanted).abs() < 1e-12, "{value}");
    close(header.objects[0].size.x, 0.05);
    close(header.objects[1].joints[0].upper, std::f64::consts::FRAC_PI_2);
    close(header.objects[1].joints[0].axis.z, 1.0);
    close(header.hands[1].reach.expect("it is there").radius, 0.8);
    close(frame.time, 1.5);
    close(frame.hands[1].as_ref().expect("it is seen").pose.translation.x, 0.1);
    assert!(frame.hands[0].is_none());
    let door = frame.objects[1].as_ref().expect("it is seen");
    close(door.joints[0], std::f64::consts::FRAC_PI_4);
    close(door.pose.rotation.norm(), 1.0);
}

#[test]
fn each_bad_line_is_named_with_its_number_and_reading_goes_on() {
    let bad = [
        r#"{"t":20,"hands":{"right-hand":[0,0,0,0,0,0,1]}"#,
        r#"{"hands":{}}"#,
        r#"{"t":"soon"}"#,
        r#"{"t":5}"#,
        r#"{"t":10}"#,
        r#"{"t":20,"hand":{}}"#,
        r#"{"t":20,"hands":{"rigth-hand":[0,0,0,0,0,0,1]}}"#,
        r#"{"t":20,"objects":{"spoon":[0,0,0,0,0,0,1]}}"#,
        r#"{"t":20,"objects":{"red-cube":[NaN,0,0,0,0,0,1]}}"#,
        r#"{"t":20,"objects":{"red-cube":[0,-Infinity,0,0,0,0,1]}}"#,
        r#"{"t":20,"objects":{"red-cube":[1e999,0,0,0,0,0,1]}}"#,
        r#"{"t":20,"objects":{"red-cube":[0,0,0,0,0,0,0]}}"#,
        r#"{"t":20,"objects":{"red-cube":[0,0,0]}}"#,
        r#"{"t":20,"objects":{"red-cube":{"joints":[]}}}"#,
        r#"{"t":20,"objects":{"door":{"pose":[0,0,0,0,0,0,1],"joints":[1,2]}}}"#,
        r#"{"t":20,"objects":{"red-cube":{"pose":[0,0,0,0,0,0,1],"seen":2}}}"#,
        r#"{"t":20,"objects":{"red-cube":{"pose":[0,0,0,0,0,0,1],"grip":1}}}"#,
        r#"{"t":20,"hands":{"left-hand":{"pose":[0,0,0,0,0,0,1],"given":{"moves":true,"in-hand":"red-cub"}}}}"#,
        r#"{"t":20,"hands":{"left-hand":[0,0,0,0,0,0,1],"left-hand":[0,0,0,0,0,0,1]}}"#,
        r#"{"t":20,"facts":[[]]}"#,
        "[1,2,3]",
        "t = 20",
    ];
    let mut text = format!("{HEADER}\n{{\"t\":10}}\n");
    for line in bad {
        text += line;
        text += "\n";
    }
    text += "\n{\"t\":20,\"_remark\":{\"any\":[1]},\"hands\":{\"left-hand\":null}}\n";
    let (_, frames) = read(&text);
    assert_eq!(frames.len(), bad.len() + 2);
    assert!(frames[0].is_ok());
    assert!(frames[bad.len() + 1].is_ok(), "what comes after bad lines is read");
    let messages: Vec<String> = bad
        .iter()
        .zip(&frames[1..])
        .map(|(line, frame)| format!("{line}\n    {}", frame.as_ref().expect_err(line)))
        .collect();
    insta::assert_snapshot!(messages.join("\n"));
}

#[test]
fn a_log_without_a_sensible_header_is_refused() {
    let headers = [
        "",
        "\n\n",
        r#"{"t":0,"hands":{}}"#,
        "t,x,y,z",
        r#"{"caveat-log":2,"anything":[]}"#,
        r#"{"caveat-log":1,"agents":[],"objects":[]}"#,
        r#"{"caveat-log":1,"agents":[{"name":"p","hands":[{"name":"h"}]}],"objects":[{"name":"h","type":"x","size":[1,1,1]}]}"#,
        r#"{"caveat-log":1,"agents":[{"name":"p","hands":[{"name":"h"}]}],"objects":[{"name":"a b","type":"x","size":[1,1,1]}]}"#,
        r#"{"caveat-log":1,"agents":[{"name":"p","hands":[{"name":"h"}]}],"objects":[{"name":"a","type":"x","size":[1,0,1]}]}"#,
        r#"{"caveat-log":1,"agents":[{"name":"p","hands":[{"name":"h"}]}],"objects":[{"name":"a","type":"x","size":[1,1,1],"joints":[{"name":"j","motion":"slides","axis":[0,0,0],"lower":0,"upper":1}]}]}"#,
        r#"{"caveat-log":1,"units":{"length":"inch"},"agents":[],"objects":[]}"#,
        r#"{"caveat-log":1,"rate":0,"agents":[{"name":"p","hands":[{"name":"h"}]}],"objects":[]}"#,
    ];
    let messages: Vec<String> = headers
        .iter()
        .map(|text| {
            let bad = json::Reader::new(text.as_bytes()).expect_err(text);
            format!("{text:?}\n    {bad}")
        })
        .collect();
    insta::assert_snapshot!(messages.join("\n"));
}

#[test]
fn a_line_without_end_is_refused_without_being_kept() {
    let mut text = format!("{HEADER}\n").into_bytes();
    text.extend(std::iter::repeat_n(b' ', 20 << 20));
    text.extend(b"\n{\"t\":1}\n");
    let mut reader = json::Reader::new(&text[..]).expect("the header is good");
    let bad = reader.next().expect("there is a line").expect_err("it is too long");
    assert_eq!(bad.to_string(), "line 2: is longer than 16 MiB");
    assert!(reader.next().expect("there is another line").is_ok());
}

#[test]
fn a_table_is_read_with_its_faults() {
    let good = "t,left-hand.x,left-hand.y,left-hand.z,left-hand.qx,left-hand.qy,left-hand.qz,left-hand.qw,left-hand.grip,_note,facts";
    let rows = "10,1,2,3,0,0,0,1,0.5,first,on-top a b; clear a\n20,,,,,,,,,,\n15,1,2,3,0,0,0,1,,,\n30,1,2,3,0,0,0,,,,\n30,1,NaN,3,0,0,0,1,,,\n30,1\n30,1,2,3,0,0,0,1,7,,\n40,1,2,3,0,0,0,1,,,;\n";
    let text = format!("# {HEADER}\n{good}\n{rows}");
    let mut reader = csv::Reader::new(text.as_bytes()).expect("the columns are good");
    let frames: Vec<Result<Frame, String>> =
        reader.by_ref().map(|frame| frame.map_err(|bad| bad.to_string())).collect();
    assert_eq!(reader.consumed(), text.len() as u64);
    insta::assert_debug_snapshot!(frames);
    let table = format!("{good}\n{rows}");
    let sidecar = csv::Reader::beside(table.as_bytes(), HEADER.as_bytes()).expect("it is the same");
    assert_eq!(sidecar.flatten().count(), 3);
    let columns = ["x", "t,t", "t,spoon.x", "t,left-hand.q", "t,left-hand.x", "t,left-hnad.x", ""];
    let refused: Vec<String> = columns
        .iter()
        .map(|columns| {
            let text = format!("# {HEADER}\n{columns}\n");
            let bad = csv::Reader::new(text.as_bytes()).err().expect(columns);
            assert!(bad.is_fatal());
            format!("{columns}\n    {bad}")
        })
        .collect();
    insta::assert_snapshot!("columns", refused.join("\n"));
    let bad = csv::Reader::new(&b"t,x\n1,2\n"[..]).err().expect("there is no header");
    assert!(bad.to_string().starts_with("line 1: there is no header"), "{bad}");
}

/// Writes and reads again.
fn again(header: &Header, frames: &[Frame], table: bool) -> (Header, Vec<Frame>, String) {
    let text = if table {
        let mut writer = csv::Writer::new(Vec::new(), header).expect("memory is never full");
        frames.iter().try_for_each(|frame| writer.write(frame)).expect("memory is never full");
        writer.finish().expect("memory is never full")
    } else {
        let mut writer = json::Writer::new(Vec::new(), header).expect("memory is never full");
        frames.iter().try_for_each(|frame| writer.write(frame)).expect("memory is never full");
        writer.finish().expect("memory is never full")
    };
    let good = |frames: &mut dyn Iterator<Item = Result<Frame, BadLine>>| {
        frames.collect::<Result<Vec<Frame>, BadLine>>().expect("what was written is read")
    };
    let (header, frames) = if table {
        let mut reader = csv::Reader::new(&text[..]).expect("what was written is read");
        let frames = good(&mut reader);
        (reader.header().clone(), frames)
    } else {
        let mut reader = json::Reader::new(&text[..]).expect("what was written is read");
        let frames = good(&mut reader);
        (reader.header().clone(), frames)
    };
    (header, frames, String::from_utf8(text).expect("it is UTF-8"))
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    /// Up to the rounding of the text: micrometres and microseconds.
    #[test]
    fn what_is_written_is_read_again((header, frames) in any::logs(), table in any::<bool>()) {
        let (other, read, text) = again(&header, &frames, table);
        prop_assert_eq!(&other, &header);
        prop_assert_eq!(read.len(), frames.len());
        for (one, other) in frames.iter().zip(&read) {
            prop_assert!(any::alike(one, other), "{one:?}\n{other:?}\n{text}");
        }
        // Once more nothing changes at all but the last digit of a rotation that is made right once more.
        let (_, third, _) = again(&header, &read, table);
        for (one, other) in read.iter().zip(&third) {
            prop_assert!(any::alike(one, other));
        }
    }

    #[test]
    fn every_line_is_as_the_schema_says((header, frames) in any::logs()) {
        let (_, _, text) = again(&header, &frames, false);
        for (number, line) in text.lines().enumerate() {
            schema::check(line, if number == 0 { "header" } else { "frame" });
        }
    }

    #[test]
    fn truths_are_read_again_and_are_as_the_schema_says((header, truths) in any::truths()) {
        let mut writer = truth::Writer::new(Vec::new(), &header).expect("memory is never full");
        truths.iter().try_for_each(|truth| writer.write(truth)).expect("memory is never full");
        let text = writer.finish().expect("memory is never full");
        let reader = truth::Reader::new(&text[..], &header).expect("what was written is read");
        let read = reader.collect::<Result<Vec<_>, _>>().expect("what was written is read");
        prop_assert_eq!(read, truths);
        for (number, line) in String::from_utf8(text).expect("it is UTF-8").lines().enumerate() {
            schema::check(line, if number == 0 { "truthHeader" } else { "truth" });
        }
    }

    /// No line whatever makes the reader panic or stop.
    #[test]
    fn any_line_is_read_or_refused(line in "[ -~]{0,60}") {
        let text = format!("{HEADER}\n{line}\n{{\"t\":1e9}}\n");
        let mut reader = json::Reader::new(text.as_bytes()).expect("the header is good");
        prop_assert!(reader.by_ref().last().expect("there are lines").is_ok());
    }
}

#[test]
fn truths_of_other_hands_are_refused() {
    let (header, _) = read(HEADER);
    let state = r#"{"moves":true,"acted-on":null,"in-hand":null,"activity":"Reach"}"#;
    let lines = [
        format!(r#"{{"t":1,"hands":{{"left-hand":{state}}}}}"#),
        format!(r#"{{"t":1,"hands":{{"left-hand":{state},"right-hand":{state},"foot":{state}}}}}"#),
        format!(
            r#"{{"t":1,"hands":{{"left-hand":{state},"right-hand":{}}}}}"#,
            state.replace("Reach", "Sleep")
        ),
        format!(
            r#"{{"t":1,"hands":{{"left-hand":{state},"right-hand":{}}}}}"#,
            state.replace("null", "\"cup\"")
        ),
        format!(r#"{{"t":1,"hands":{{"left-hand":{state},"right-hand":{state}}}}}"#),
        format!(r#"{{"t":0,"hands":{{"left-hand":{state},"right-hand":{state}}}}}"#),
    ];
    let text = format!("{{\"caveat-truth\":1}}\n{}\n", lines.join("\n"));
    let reader = truth::Reader::new(text.as_bytes(), &header).expect("the first line is good");
    let read: Vec<String> = reader
        .map(|truth| truth.map_or_else(|bad| bad.to_string(), |truth| format!("{} s", truth.time)))
        .collect();
    insta::assert_snapshot!(read.join("\n"));
    let bad = truth::Reader::new(HEADER.as_bytes(), &header).expect_err("it is a log");
    assert_eq!(bad.to_string(), "line 1: the first line must be `{\"caveat-truth\":1}`");
}
