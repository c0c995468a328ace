//! Writes a log of an hour at 90 Hz with 30 objects into the file that is named, unless it is there; then reads, observes and segments it, and says how long that took and how much memory it needed.

use std::fs::File;
use std::io::{BufReader, BufWriter};
use std::time::Instant;

use learner::log::{Frame, Hand, HandId, HandSample, Header, Object, ObjectId, ObjectSample, json};
use learner::observe::{self, Observer};
use learner::segment::{self, Segmenter, Tree};
use nalgebra::{Isometry3, UnitQuaternion, Vector3};

const RATE: f64 = 90.0;
const SECONDS: u32 = 3600;
const OBJECTS: usize = 30;

fn main() {
    let path = std::env::args().nth(1).expect("name a file for the log");
    if !std::path::Path::new(&path).exists() {
        let start = Instant::now();
        write(&path);
        let size = std::fs::metadata(&path).expect("it was just written").len();
        println!("written: {:.2} s, {:.0} MB", start.elapsed().as_secs_f64(), size as f64 / 1e6);
    }
    for observing in [false, true] {
        let (start, busy) = (Instant::now(), processor());
        let input = BufReader::with_capacity(1 << 16, File::open(&path).expect("the log is there"));
        let mut reader = json::Reader::new(input).expect("the header is well formed");
        let header = reader.header().clone();
        let mut observer = Observer::new(&header, observe::Config::default());
        let mut segmenter =
            Segmenter::new(Tree::published(), segment::Config::default(), header.hands.len());
        let (mut frames, mut segments, mut changes) = (0u64, 0, 0);
        for frame in &mut reader {
            let frame = frame.expect("every line is well formed");
            frames += 1;
            if observing {
                for observation in observer.push(&frame) {
                    changes += observation.changes.len();
                    segments += segmenter.push(&observation).len();
                }
            }
        }
        for observation in observer.finish() {
            changes += observation.changes.len();
            segments += segmenter.push(&observation).len();
        }
        segments += segmenter.finish().len();
        let seconds = start.elapsed().as_secs_f64();
        let busy = processor() - busy;
        println!(
            "{frames} frames, {segments} segments, {changes} changes: {seconds:.2} s, {busy:.2} s of the processor, {} at most",
            memory()
        );
    }
}

/// How many seconds the processor spent on this process, as Linux tells it in hundredths.
fn processor() -> f64 {
    let line = std::fs::read_to_string("/proc/self/stat").unwrap_or_default();
    let numbers = line.rsplit(") ").next().unwrap_or_default().split_whitespace();
    numbers.skip(11).take(2).filter_map(|ticks| ticks.parse::<f64>().ok()).sum::<f64>() / 100.0
}

/// The most memory that this process ever had, as Linux tells it.
fn memory() -> String {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"));
    line.map_or(String::from("unknown memory"), |line| line.trim().to_string())
}

/// Two hands that carry cubes from place to place, with noise of 2 mm.
fn write(path: &str) {
    let object = |number: usize| Object {
        name: format!("cube-{number}"),
        kind: "cube".into(),
        size: Vector3::repeat(0.05),
        fixed: number == 0,
        hollow: false,
        region: false,
        joints: Vec::new(),
    };
    let mut objects: Vec<Object> = (0..OBJECTS).map(object).collect();
    objects[0].name = "table".into();
    objects[0].size = Vector3::new(4.0, 4.0, 0.04);
    let hand = |name: &str| Hand { name: name.into(), agent: 0, reach: None };
    let header = Header {
        frame: "world".into(),
        rate: RATE,
        types: Vec::new(),
        agents: vec!["person".into()],
        hands: vec![hand("left-hand"), hand("right-hand")],
        objects,
    };
    let out =
        BufWriter::with_capacity(1 << 20, File::create(path).expect("the log can be written"));
    let mut writer = json::Writer::new(out, &header).expect("there is room");
    let mut noise = Noise(7);
    let mut places: Vec<Vector3<f64>> = (0..OBJECTS)
        .map(|number| {
            Vector3::new((number % 6) as f64 * 0.25, (number / 6) as f64 * 0.25 - 0.5, 0.025)
        })
        .collect();
    places[0] = Vector3::new(0.0, 0.0, -0.02);
    let mut hands =
        [Hands::new(Vector3::new(0.0, 0.6, 0.3), 3), Hands::new(Vector3::new(0.0, -0.6, 0.3), 5)];
    for number in 0..SECONDS * RATE as u32 {
        for hand in &mut hands {
            hand.step(&mut places, &mut noise);
        }
        let mut pose = |place: &Vector3<f64>| {
            let shift = Vector3::new(noise.normal(), noise.normal(), noise.normal()) * 0.002;
            let turn = Vector3::new(noise.normal(), noise.normal(), noise.normal()) * 0.01;
            Isometry3::from_parts((place + shift).into(), UnitQuaternion::new(turn))
        };
        let frame = Frame {
            time: f64::from(number) / RATE,
            hands: hands
                .iter()
                .map(|hand| {
                    let grip = Some(if hand.held { 0.8 } else { 0.1 });
                    Some(HandSample { pose: pose(&hand.place), grip, teach: false, given: None })
                })
                .collect(),
            objects: places
                .iter()
                .map(|place| {
                    Some(ObjectSample { pose: pose(place), joints: Vec::new(), seen: 1.0 })
                })
                .collect(),
            facts: None,
        };
        writer.write(&frame).expect("there is room");
    }
    writer.finish().expect("there is room");
}

/// A hand that takes a cube, carries it elsewhere, lets go, and begins again.
struct Hands {
    place: Vector3<f64>,
    from: Vector3<f64>,
    to: Vector3<f64>,
    tick: u32,
    phase: u32,
    held: bool,
    cube: ObjectId,
    hand: HandId,
}

impl Hands {
    fn new(place: Vector3<f64>, cube: u32) -> Self {
        Self {
            place,
            from: place,
            to: place,
            tick: 0,
            phase: 4,
            held: false,
            cube: ObjectId(cube),
            hand: HandId(cube % 2),
        }
    }

    /// One frame: phases of 80 frames, at their beginning a new aim.
    fn step(&mut self, places: &mut [Vector3<f64>], noise: &mut Noise) {
        if self.tick == 0 {
            self.phase = (self.phase + 1) % 5;
            self.from = self.place;
            self.held = matches!(self.phase, 2 | 3);
            self.to = match self.phase {
                0 => {
                    let free = (OBJECTS - 1) / 2;
                    self.cube =
                        ObjectId(1 + (noise.even() * free as f64) as u32 * 2 + self.hand.0 % 2);
                    places[self.cube.index()]
                }
                2 => Vector3::new(noise.even() * 1.5, noise.even() * 1.5 - 0.7, 0.25),
                3 => Vector3::new(self.place.x, self.place.y, 0.025),
                4 => self.place + Vector3::new(0.0, 0.0, 0.2),
                _ => self.place,
            };
        }
        self.tick = (self.tick + 1) % 80;
        let part = (f64::from(self.tick) / 60.0).min(1.0);
        let way = part.powi(3) * (10.0 - 15.0 * part + 6.0 * part * part);
        if self.tick > 0 {
            self.place = self.from + (self.to - self.from) * way;
        }
        if self.held {
            places[self.cube.index()] = self.place;
        }
    }
}

/// Random numbers (splitmix64).
struct Noise(u64);

impl Noise {
    fn even(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut bits = self.0;
        bits = (bits ^ (bits >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        bits = (bits ^ (bits >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        ((bits ^ (bits >> 31)) >> 11) as f64 / (1u64 << 53) as f64
    }

    fn normal(&mut self) -> f64 {
        (0..12).map(|_| self.even()).sum::<f64>() - 6.0
    }
}
