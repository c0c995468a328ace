//! Numbers of steps a second and of iterations go in; how fast trials of one and of three cubes run with them, and how often their outcome differs from that at 1000 steps, come out.
//!
//! `cargo run --release -p caveat-domains --example fidelity -- 20000`

use std::time::Instant;

use domains::trial::stack::{Parameters, Place, Stack};
use domains::trial::{noise, trials};

fn main() {
    let number = std::env::args().nth(1).and_then(|word| word.parse().ok()).unwrap_or(2000);
    for cubes in [1, 3] {
        let mut reference: Vec<bool> = Vec::new();
        for (rate, travel, iterations) in [
            ((1000.0, 1000.0), 0.1, 8),
            ((1000.0, 1000.0), 0.1, 4),
            ((240.0, 240.0), 0.1, 8),
            ((120.0, 1000.0), 0.1, 4),
            ((120.0, 1000.0), 0.05, 4),
            ((60.0, 1000.0), 0.1, 4),
            ((60.0, 1000.0), 0.2, 4),
        ] {
            let parameters = Parameters { rate, travel, iterations, ..Parameters::default() };
            let stack = Stack::new(cubes, parameters).expect("the settings are possible");
            let began = Instant::now();
            let rows = trials(&stack, 1, 0..number, &|| {});
            let seconds = began.elapsed().as_secs_f64() * rayon::current_num_threads() as f64;
            let outcomes: Vec<bool> = rows.iter().map(|row| row[row.len() - 1] > 0.5).collect();
            if reference.is_empty() {
                reference.clone_from(&outcomes);
            }
            let success = outcomes.iter().filter(|&&one| one).count() as f64 / number as f64;
            let differ =
                outcomes.iter().zip(&reference).filter(|(one, other)| one != other).count();
            println!(
                "{cubes} cubes, {} to {} Hz by {travel} cm, {iterations} iterations: {:.0} trials a second and core, success {:.1} %, {:.1} % other than at 1000 Hz",
                rate.0,
                rate.1,
                number as f64 / seconds,
                success * 100.0,
                differ as f64 / number as f64 * 100.0
            );
        }
        // What nobody can prevent: every cube is put in the middle, from the least height.
        let stack = Stack::new(cubes, Parameters::default()).expect("the settings are possible");
        let least = stack.parameters().drop.0;
        let stands = |trial: u64| {
            let mut tower = stack.begin(noise(1, trial));
            (0..cubes).all(|_| tower.put(Place { x: 0.0, y: 0.0, drop: least }))
        };
        let all = (0..number).filter(|&trial| stands(trial)).count();
        println!("{cubes} cubes in the middle: {:.2} %", all as f64 / number as f64 * 100.0);
    }
}
