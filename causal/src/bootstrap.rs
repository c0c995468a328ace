//! A table goes in; how often each arc is found in tables resampled from it comes out (Friedman et al. 1999, "Data analysis with
//! Bayesian networks: a bootstrap approach").

use std::collections::BTreeMap;

use rayon::prelude::*;

use crate::chance::chance;
use crate::discover::{Config, DiscoverError, discover};
use crate::knowledge::Knowledge;
use crate::network::Strength;
use crate::pattern::Join;
use crate::table::Table;
use crate::variable::VariableId;

/// Learns from `samples` tables of as many trials as there are, drawn with replacement under a seed; pairs that were ever joined come
/// out, the stronger first, each in the direction that more of the patterns have.
pub fn strengths(
    table: &Table,
    knowledge: &Knowledge,
    config: &Config,
    samples: u64,
    seed: u64,
) -> Result<Vec<Strength>, DiscoverError> {
    let patterns = (0..samples)
        .into_par_iter()
        .map(|sample| {
            let mut random = chance(seed, sample);
            let rows: Vec<u32> =
                (0..table.len()).map(|_| random.u32(..table.len() as u32)).collect();
            discover(&table.select(&rows), knowledge, config).map(|found| found.pattern)
        })
        .collect::<Result<Vec<_>, _>>()?;
    // For each pair how often it was joined, and how often forwards; an arc without a direction is half of each.
    let mut pairs: BTreeMap<(VariableId, VariableId), (f64, f64)> = BTreeMap::new();
    for pattern in &patterns {
        for one in table.ids() {
            for other in table.ids().filter(|&other| one < other) {
                let forward = match pattern.between(one, other) {
                    Join::None => continue,
                    Join::Forward => 1.0,
                    Join::Backward => 0.0,
                    Join::Undirected => 0.5,
                };
                let pair = pairs.entry((one, other)).or_default();
                pair.0 += 1.0;
                pair.1 += forward;
            }
        }
    }
    let all = samples.max(1) as f64;
    let name = |id: VariableId| table.variable(id).name.clone();
    let mut strengths: Vec<Strength> = pairs
        .into_iter()
        .map(|((one, other), (joined, forward))| {
            let turned = forward * 2.0 < joined;
            let (from, to) = if turned { (other, one) } else { (one, other) };
            let directed = if turned { joined - forward } else { forward };
            Strength {
                from: name(from),
                to: name(to),
                joined: joined / all,
                directed: directed / all,
            }
        })
        .collect();
    strengths.sort_by(|one, two| {
        two.joined
            .total_cmp(&one.joined)
            .then_with(|| (&one.from, &one.to).cmp(&(&two.from, &two.to)))
    });
    Ok(strengths)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::variable::Variable;

    #[test]
    fn an_arc_of_the_data_is_found_again_and_a_seed_gives_one_answer() {
        let mut random = fastrand::Rng::with_seed(2);
        let a: Vec<u8> = (0..300).map(|_| random.u8(..2)).collect();
        let b = a.iter().map(|&a| if random.f64() < 0.8 { a } else { 1 - a }).collect();
        let c = (0..300).map(|_| random.u8(..2)).collect();
        let variables = ["a", "b", "c"].map(|name| Variable::of_words(name, ["0", "1"])).to_vec();
        let table = Table::new(variables, vec![a, b, c]).unwrap();
        let learn =
            |seed| strengths(&table, &Knowledge::default(), &Config::default(), 40, seed).unwrap();
        let found = learn(1);
        let mut ends = [found[0].from.as_str(), found[0].to.as_str()];
        ends.sort_unstable();
        assert_eq!(ends, ["a", "b"]);
        // Nothing tells the direction, but for what chance made of `c` in some samples.
        assert!(
            (found[0].joined - 1.0).abs() < 1e-12 && (0.5..0.6).contains(&found[0].directed),
            "{found:?}"
        );
        assert!(found[1..].iter().all(|one| one.joined < 0.5), "{found:?}");
        assert_eq!(found, learn(1));
    }
}
