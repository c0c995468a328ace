//! A small encoded problem with everything in it, as a file.

use super::*;
use crate::encode::{encode, tests::random::Draft};
use crate::limits::Limits;

fn example() -> (Grounded, Encoded, Names) {
    let draft = "init f0; f0 -> -f0 -f2 f1 cost 3; f1 -> -f1 [f3 > f0] f2 cost 10; -> f3 cost 0; f1 -> [f4 > f5]; \
                 derived f4; f4 <= f0 f3; f4 <= f2; goal f2 f4 f5";
    let grounded = Draft::parse(draft).grounded();
    let groups = [vec![FactId(0), FactId(1)], vec![FactId(1), FactId(2)]];
    let encoded = encode(&grounded, &groups, &Limits::default()).expect("nobody asked to stop");
    let names = Names {
        predicates: ["here", "there", "seen", "lit", "Known", "done"]
            .map(str::to_lowercase)
            .to_vec(),
        actions: ["go", "look", "light", "end"].map(str::to_owned).to_vec(),
        objects: Vec::new(),
    };
    (grounded, encoded, names)
}

#[test]
fn the_file_has_every_section() {
    let (grounded, encoded, names) = example();
    let mut out = Vec::new();
    write(&encoded, &grounded, &names, &mut out).expect("a vector takes all");
    insta::assert_snapshot!(String::from_utf8(out).expect("names are UTF-8"));
}

#[test]
fn the_summary_counts_as_fast_downward_does() {
    let (_, encoded, _) = example();
    insta::assert_snapshot!(summary(&encoded), @r"
    Translator variables: 5
    Translator derived variables: 1
    Translator facts: 11
    Translator goal facts: 3
    Translator mutex groups: 1
    Translator total mutex groups size: 2
    Translator operators: 4
    Translator axioms: 2
    ");
}

#[test]
fn numbers_are_decimal() {
    for number in [0, 7, 10, 99, 12_345, u32::MAX] {
        let mut text = Text { bytes: Vec::new(), out: &mut io::sink() };
        text.number(number);
        assert_eq!(text.bytes, number.to_string().into_bytes());
    }
}
