//! A number of trials and a seed go in; as many cubes are dropped onto another, and CSV of what was set and whether the cube stayed comes out.
//!
//! `cargo run --release -p caveat-domains --example one_cube -- 3000 1 > domains/one-cube/trials.csv`
//!
//! Both cubes have edges of 5 cm. The upper one is let go at an offset (uniform within 3 cm in x and y) and at a height above the lower
//! one (0.5 to 10 cm), a little turned and tilted; restitution 0.4, friction 0.5, steps of 1/240 s. Colours do nothing.

use rapier3d::prelude::{
    ColliderBuilder, PhysicsWorld, Pose, RigidBodyBuilder, RigidBodyHandle, Rotation, Vector,
};

const EDGE: f32 = 0.05;
const COLOURS: [&str; 4] = ["blue", "green", "orange", "red"];

fn cube(world: &mut PhysicsWorld, pose: Pose) -> RigidBodyHandle {
    let body = world.insert_body(RigidBodyBuilder::dynamic().pose(pose).can_sleep(false));
    let half = EDGE / 2.0;
    let shape = ColliderBuilder::cuboid(half, half, half).mass(0.1).friction(0.5).restitution(0.4);
    world.insert_collider(shape, Some(body));
    body
}

/// Whether a cube that is let go over another stays on it.
fn stays(x: f32, y: f32, height: f32, turn: f32, tilt: (f32, f32)) -> bool {
    let mut world = PhysicsWorld::new();
    world.gravity = Vector::new(0.0, 0.0, -9.81);
    world.integration_parameters.dt = 1.0 / 240.0;
    // Contacts as fine as the cubes are small.
    world.integration_parameters.length_unit = EDGE;
    let ground = world.insert_body(RigidBodyBuilder::fixed());
    let table = ColliderBuilder::cuboid(1.0, 1.0, 0.05).translation(Vector::new(0.0, 0.0, -0.05));
    world.insert_collider(table.friction(0.5).restitution(0.4), Some(ground));
    let lower = cube(&mut world, Pose::from_translation(Vector::new(0.0, 0.0, EDGE / 2.0)));
    let place = Vector::new(x, y, EDGE * 1.5 + height);
    let turned = Rotation::from_rotation_z(turn)
        * Rotation::from_rotation_x(tilt.0)
        * Rotation::from_rotation_y(tilt.1);
    let upper = cube(&mut world, Pose::from_parts(place, turned));
    let mut rest = 0;
    for _ in 0..240 * 4 {
        world.step();
        let body = &world.bodies[upper];
        let slow = body.linvel().length() < 0.005 && body.angvel().length() < 0.05;
        rest = if slow { rest + 1 } else { 0 };
        // At rest for a tenth of a second, and not at the top of a bounce.
        if rest >= 24 {
            break;
        }
    }
    let (above, below) = (world.bodies[upper].translation(), world.bodies[lower].translation());
    above.z > EDGE * 1.25 && below.z < EDGE && (above - below).length() < EDGE * 1.6
}

fn main() {
    let mut numbers = std::env::args().skip(1).filter_map(|word| word.parse::<u64>().ok());
    let (trials, seed) = (numbers.next().unwrap_or(1000), numbers.next().unwrap_or(1));
    println!("xOff,yOff,dropOff,colorDown,colorUp,onTop");
    for trial in 0..trials {
        let mut random = fastrand::Rng::with_seed(seed << 32 ^ trial);
        // Centimetres, as they are written: what is dropped is what the file says.
        let mut within =
            |low: f64, high: f64| ((low + (high - low) * random.f64()) * 1e4).round() / 1e4;
        let (x, y, height) = (within(-3.0, 3.0), within(-3.0, 3.0), within(0.5, 10.0));
        let mut normal = || (0..12).map(|_| random.f32()).sum::<f32>() - 6.0;
        let (turn, tilt) = (0.05 * normal(), (0.05 * normal(), 0.05 * normal()));
        let (down, up) = (COLOURS[random.usize(..4)], COLOURS[random.usize(..4)]);
        let metres = |centimetres: f64| (centimetres / 100.0) as f32;
        let stayed = stays(metres(x), metres(y), metres(height), turn, tilt);
        println!("{x},{y},{height},{down},{up},{}", u8::from(stayed));
    }
}
