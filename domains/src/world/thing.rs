//! What a world is furnished with goes in by measures; bodies with shapes and masses come out, each with its entry of a log's header.

use super::space::at;
use learner::log::{Joint, Motion, Object};
use nalgebra::{Isometry3, Vector3};

/// The shape of a part.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Form {
    /// A box of this extent in metres.
    Box(Vector3<f64>),
    /// An upright cylinder.
    Cylinder {
        /// In metres.
        radius: f64,
        /// In metres.
        height: f64,
    },
}

/// A rigid part of a thing.
#[derive(Debug, Clone)]
pub(crate) struct Part {
    pub(crate) form: Form,
    /// Where it is in the frame of the thing.
    pub(crate) place: Isometry3<f64>,
}

/// How a thing can move.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Mount {
    /// As physics has it.
    Free,
    /// Not at all.
    Fixed,
    /// Along its first joint, against so much friction in newtons.
    Slides(f64),
    /// Everything passes through it.
    Nowhere,
}

/// A thing of a world.
#[derive(Debug, Clone)]
pub(crate) struct Thing {
    /// Its entry in the header.
    pub(crate) object: Object,
    pub(crate) parts: Vec<Part>,
    /// Where it starts; of a drawer, where it is closed.
    pub(crate) pose: Isometry3<f64>,
    /// In kilograms.
    pub(crate) mass: f64,
    pub(crate) friction: f64,
    pub(crate) mount: Mount,
    /// The value of its joint at the start.
    pub(crate) start: f64,
    /// The force in newtons at which it slips out of a hand, and which a hand cannot exceed.
    pub(crate) hold: f64,
    /// Where a hand takes it, in its own frame; the z axis of a hand points from the fingers to the palm.
    pub(crate) grasp: Isometry3<f64>,
}

fn entry(name: &str, kind: &str, size: Vector3<f64>) -> Object {
    Object {
        name: name.to_owned(),
        kind: kind.to_owned(),
        size,
        fixed: false,
        hollow: false,
        region: false,
        joints: Vec::new(),
    }
}

fn single(form: Form) -> Vec<Part> {
    vec![Part { form, place: Isometry3::identity() }]
}

/// A table, of which only the top matters; `pose` is the middle of that.
pub(crate) fn table(name: &str, size: Vector3<f64>, pose: Isometry3<f64>) -> Thing {
    Thing {
        object: Object { fixed: true, ..entry(name, "table", size) },
        parts: single(Form::Box(size)),
        pose,
        mass: 0.0,
        friction: 0.6,
        mount: Mount::Fixed,
        start: 0.0,
        hold: 0.0,
        grasp: Isometry3::identity(),
    }
}

/// A wooden cube.
pub(crate) fn cube(name: &str, edge: f64, pose: Isometry3<f64>) -> Thing {
    let size = Vector3::repeat(edge);
    Thing {
        object: entry(name, "cube", size),
        parts: single(Form::Box(size)),
        pose,
        mass: 600.0 * edge.powi(3),
        friction: 0.6,
        mount: Mount::Free,
        start: 0.0,
        hold: 15.0,
        // A centimetre below the upper face.
        grasp: at(0.0, 0.0, edge / 2.0 - 0.01),
    }
}

/// A round thing such as a plate, taken at a place in its frame.
pub(crate) fn disc(
    name: &str,
    kind: &str,
    (radius, height): (f64, f64),
    mass: f64,
    pose: Isometry3<f64>,
    grasp: Isometry3<f64>,
) -> Thing {
    Thing {
        object: entry(name, kind, Vector3::new(2.0 * radius, 2.0 * radius, height)),
        parts: single(Form::Cylinder { radius, height }),
        pose,
        mass,
        friction: 0.5,
        mount: Mount::Free,
        start: 0.0,
        hold: 20.0,
        grasp,
    }
}

/// A drawer that opens along −y of its frame; `pose` is that of the closed drawer.
pub(crate) fn drawer(name: &str, size: Vector3<f64>, pose: Isometry3<f64>, travel: f64) -> Thing {
    const WALL: f64 = 0.012;
    let wall = |extent: Vector3<f64>, x: f64, y: f64, z: f64| Part {
        form: Form::Box(extent),
        place: at(x, y, z),
    };
    let (side, end) = (Vector3::new(WALL, size.y, size.z), Vector3::new(size.x, WALL, size.z));
    let half = size / 2.0;
    Thing {
        object: Object {
            hollow: true,
            joints: vec![Joint {
                name: "slide".to_owned(),
                motion: Motion::Slides,
                axis: -Vector3::y(),
                lower: 0.0,
                upper: travel,
            }],
            ..entry(name, "drawer", size)
        },
        parts: vec![
            wall(Vector3::new(size.x, size.y, WALL), 0.0, 0.0, WALL / 2.0 - half.z),
            wall(side, WALL / 2.0 - half.x, 0.0, 0.0),
            wall(side, half.x - WALL / 2.0, 0.0, 0.0),
            wall(end, 0.0, WALL / 2.0 - half.y, 0.0),
            wall(end, 0.0, half.y - WALL / 2.0, 0.0),
        ],
        pose,
        mass: 1.5,
        friction: 0.4,
        mount: Mount::Slides(3.0),
        start: 0.0,
        // Fingertips on the edge of a drawer hold far less than a hand around something.
        hold: 22.0,
        // At the front, below the upper edge, with the palm before it.
        grasp: Isometry3::new(
            Vector3::new(0.0, -half.y, half.z - 0.03),
            Vector3::x() * std::f64::consts::FRAC_PI_2,
        ),
    }
}

/// A chair whose backrest is towards +y of its frame.
pub(crate) fn chair(name: &str, pose: Isometry3<f64>) -> Thing {
    let size = Vector3::new(0.42, 0.42, 0.86);
    let half = size / 2.0;
    let mut parts = vec![
        Part { form: Form::Box(Vector3::new(0.42, 0.42, 0.04)), place: at(0.0, 0.0, 0.0) },
        Part {
            form: Form::Box(Vector3::new(0.42, 0.03, 0.43)),
            place: at(0.0, half.y - 0.015, 0.215),
        },
    ];
    for (x, y) in [(-0.19, -0.19), (0.19, -0.19), (-0.19, 0.19), (0.19, 0.19)] {
        let leg = Form::Box(Vector3::new(0.04, 0.04, 0.41));
        parts.push(Part { form: leg, place: at(x, y, -0.225) });
    }
    Thing {
        object: entry(name, "chair", size),
        parts,
        pose,
        mass: 6.0,
        // Felt under its feet; it still takes more to push it than a handle can be pulled with.
        friction: 0.3,
        mount: Mount::Free,
        start: 0.0,
        hold: 80.0,
        // Over the upper edge of the backrest.
        grasp: at(0.0, half.y - 0.015, half.z - 0.01),
    }
}

/// A place, as wide as `size`, that things pass through.
pub(crate) fn spot(name: &str, size: Vector3<f64>, pose: Isometry3<f64>) -> Thing {
    Thing {
        object: Object { fixed: true, region: true, ..entry(name, "spot", size) },
        parts: Vec::new(),
        pose,
        mass: 0.0,
        friction: 0.0,
        mount: Mount::Nowhere,
        start: 0.0,
        hold: 0.0,
        grasp: Isometry3::identity(),
    }
}
