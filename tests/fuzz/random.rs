//! The kept texts go in; each is changed at random and held against the promises, and what breaks one comes out, made small.
//!
//! `cargo run -p suite --example random -- SECONDS [SEED [TARGET ...]]` works on stable Rust. It knows nothing of what a text reaches,
//! as libFuzzer does; it knows what PDDL is made of.

mod promises;

use std::fs;
use std::panic;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::sync::Mutex;
use std::time::{Duration, Instant};

/// A text that takes longer than this is a find.
const SLOW: Duration = Duration::from_secs(5);

/// Of different panics of one target, this many are looked at.
const FINDS: usize = 20;

/// No text grows beyond this, in bytes.
const LONGEST: usize = 20_000;

/// Where and with what words the last panic of this process was raised.
static LAST: Mutex<String> = Mutex::new(String::new());

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let number = |at: usize| arguments.get(at).and_then(|word| word.parse().ok());
    let wanted = arguments.get(2..).unwrap_or_default();
    let known = |name: &String| promises::TARGETS.iter().any(|(target, _)| target == name);
    let (Some(seconds), true) = (number(0), wanted.iter().all(known)) else {
        eprintln!("usage: random SECONDS [SEED [TARGET ...]]");
        return ExitCode::from(2);
    };
    let seed = number(1).unwrap_or(1).max(1);
    panic::set_hook(Box::new(|panic| {
        let mut last = LAST.lock().unwrap_or_else(std::sync::PoisonError::into_inner);
        *last = panic.to_string();
    }));
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let finds = root.with_file_name("target").join("fuzz/finds");
    let texts = texts(&root.join("fuzz/corpus"));
    let words = words(&root.join("fuzz/pddl.dict"));
    assert!(texts.len() > 20 && words.len() > 20, "there are texts and words to begin with");
    let mut found = 0;
    for (target, _) in promises::TARGETS {
        if !wanted.is_empty() && !wanted.iter().any(|name| name == target) {
            continue;
        }
        found +=
            run(target, Duration::from_secs(seconds), &mut Random(seed), &texts, &words, &finds);
    }
    if found == 0 { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}

/// Changes texts for as long as there is time; how many different panics and slow texts there were.
fn run(
    target: &str,
    time: Duration,
    random: &mut Random,
    texts: &[Vec<u8>],
    words: &[Vec<u8>],
    finds: &Path,
) -> usize {
    let start = Instant::now();
    let mut runs = 0_u64;
    let mut seen: Vec<String> = Vec::new();
    while start.elapsed() < time && seen.len() < FINDS {
        let text = changed(random, texts, words);
        let begun = Instant::now();
        let place = panicked(target, &text);
        let slow = (begun.elapsed() > SLOW).then(|| format!("slow: {:?}", begun.elapsed()));
        runs += 1;
        let Some(place) = place.or(slow) else { continue };
        let kind = kind(&place);
        if seen.contains(&kind) {
            continue;
        }
        let small = smaller(target, text, &kind);
        let path = finds.join(format!("{target}-{}", seen.len()));
        fs::create_dir_all(finds).and_then(|()| fs::write(&path, &small)).expect("finds are kept");
        println!("{target}: {place}\n  {}\n{}", path.display(), String::from_utf8_lossy(&small));
        seen.push(kind);
    }
    println!("{target}: {runs} texts in {:.0?}, {} finds", start.elapsed(), seen.len());
    seen.len()
}

/// Where and how the target panics on a text, if it does.
fn panicked(target: &str, text: &[u8]) -> Option<String> {
    panic::catch_unwind(|| promises::keep(target, text)).err()?;
    Some(LAST.lock().unwrap_or_else(std::sync::PoisonError::into_inner).clone())
}

/// What tells one panic from another: its place, and how its message begins.
fn kind(place: &str) -> String {
    let mut lines = place.lines();
    let (first, second) = (lines.next().unwrap_or(""), lines.next().unwrap_or(""));
    format!("{first} {}", second.chars().take(20).collect::<String>())
}

/// The text without the pieces that the panic does not need.
fn smaller(target: &str, mut text: Vec<u8>, wanted: &str) -> Vec<u8> {
    let start = Instant::now();
    let mut size = text.len() / 2;
    while size > 0 && start.elapsed() < Duration::from_secs(20) {
        let mut at = 0;
        while at < text.len() {
            let end = (at + size).min(text.len());
            let without = [&text[..at], &text[end..]].concat();
            if panicked(target, &without).is_some_and(|place| kind(&place) == wanted) {
                text = without;
            } else {
                at = end;
            }
        }
        size /= 2;
    }
    text
}

/// One of the texts after one to five changes.
fn changed(random: &mut Random, texts: &[Vec<u8>], words: &[Vec<u8>]) -> Vec<u8> {
    let mut text = random.one_of(texts).clone();
    for _ in 0..=random.below(5) {
        let (start, end) = random.range(text.len());
        match random.below(10) {
            0 => text.truncate(start),
            1 => drop(text.drain(start..end)),
            2 => insert(&mut text, start, &random.one_of(words)[..]),
            3 => {
                let piece = text[start..end].to_vec();
                insert(&mut text, end, &piece.repeat(1 + random.below(4)));
            }
            4 => {
                let other = random.one_of(texts);
                let (from, to) = random.range(other.len());
                insert(&mut text, start, &other[from..to]);
            }
            5 => {
                let piece: Vec<u8> = text.drain(start..end).collect();
                let at = random.below(text.len() + 1);
                insert(&mut text, at, &piece);
            }
            6 => text[start..end].iter_mut().take(1).for_each(|byte| *byte = random.byte()),
            7 => text[start..end].make_ascii_uppercase(),
            // A parenthesis more or less is the commonest mistake.
            8 => insert(&mut text, start, if random.below(2) == 0 { b"(" } else { b")" }),
            _ => {
                let open = |byte: &u8| matches!(byte, b'(' | b')');
                if let Some(at) = text[start..].iter().position(open) {
                    text.remove(start + at);
                }
            }
        }
    }
    text.truncate(LONGEST);
    text
}

fn insert(text: &mut Vec<u8>, at: usize, piece: &[u8]) {
    text.splice(at..at, piece.iter().copied());
}

/// All texts in the folders of the kept corpus.
fn texts(corpus: &Path) -> Vec<Vec<u8>> {
    let entries = |folder: &Path| -> Vec<PathBuf> {
        let entries = fs::read_dir(folder).expect("the kept texts can be listed");
        let mut paths: Vec<_> = entries.map(|entry| entry.expect("it is listed").path()).collect();
        paths.sort();
        paths
    };
    let files = entries(corpus).into_iter().flat_map(|folder| entries(&folder));
    files.map(|file| fs::read(file).expect("a kept text can be read")).collect()
}

/// The words of libFuzzer's dictionary, with a blank before them.
fn words(dictionary: &Path) -> Vec<Vec<u8>> {
    let text = fs::read_to_string(dictionary).expect("the dictionary can be read");
    let word = |line: &str| Some(line.split_once('"')?.1.rsplit_once('"')?.0.to_owned());
    let plain = |word: String| match word.as_str() {
        "\\xEF\\xBB\\xBF" => "\u{feff}".into(),
        "\\x0D\\x0A" => "\r\n".into(),
        _ => format!(" {word}").into_bytes(),
    };
    text.lines().filter_map(word).map(plain).collect()
}

/// Numbers that look random and are the same in every run (xorshift64*).
struct Random(u64);

impl Random {
    fn next(&mut self) -> u64 {
        self.0 ^= self.0 >> 12;
        self.0 ^= self.0 << 25;
        self.0 ^= self.0 >> 27;
        self.0.wrapping_mul(0x2545_F491_4F6C_DD1D)
    }

    fn byte(&mut self) -> u8 {
        (self.next() >> 56) as u8
    }

    /// A number from 0 up to, but not including, `end`, which is not 0.
    fn below(&mut self, end: usize) -> usize {
        ((self.next() >> 32) % end as u64) as usize
    }

    fn one_of<'t>(&mut self, list: &'t [Vec<u8>]) -> &'t Vec<u8> {
        &list[self.below(list.len())]
    }

    /// A piece of something of this length: mostly short.
    fn range(&mut self, length: usize) -> (usize, usize) {
        let start = self.below(length + 1);
        let longest = if self.below(4) == 0 { length } else { 12 };
        (start, (start + self.below(longest + 1)).min(length))
    }
}
