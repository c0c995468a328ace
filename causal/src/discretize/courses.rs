//! Series go in; the typical courses among them come out: k-means by Euclidean distance (thesis algorithm 1, line 6; equation 2.3).
//!
//! Lloyd's iteration from ten beginnings that k-means++ chose (Arthur and Vassilvitskii 2007), of which the best is kept. The
//! beginnings are fixed, so that the same series have the same courses.

use rayon::prelude::*;

use crate::sample::compare;
use crate::variable::squared_distance;

/// How often k-means begins anew.
const BEGINNINGS: u64 = 10;

/// After so many rounds a cluster is taken as it is.
const ROUNDS: usize = 300;

/// The centroids of `clusters` clusters of series of one length, those that end lowest first. Fewer where there are not so many
/// different series.
pub fn cluster(series: &[&[f64]], clusters: usize) -> Vec<Vec<f64>> {
    // Sorted, so that the order in which series were read does not matter.
    let mut series = series.to_vec();
    series.sort_unstable_by(|one, other| compare(one, other));
    let best = (0..BEGINNINGS)
        .into_par_iter()
        .map(|beginning| {
            let mut random = fastrand::Rng::with_seed(beginning);
            lloyd(&series, begin(&series, clusters, &mut random))
        })
        .collect::<Vec<_>>()
        .into_iter()
        .reduce(|best, other| if other.0 < best.0 { other } else { best });
    let mut centroids = best.map_or_else(Vec::new, |(_, centroids)| centroids);
    centroids.sort_by(|one, other| {
        one.last()
            .partial_cmp(&other.last())
            .expect("values are finite")
            .then_with(|| compare(one, other))
    });
    centroids
}

/// Chooses series to begin with: each next one with a chance that grows with the square of its distance to those chosen.
fn begin(series: &[&[f64]], clusters: usize, random: &mut fastrand::Rng) -> Vec<Vec<f64>> {
    let mut centroids: Vec<Vec<f64>> = Vec::with_capacity(clusters);
    if series.is_empty() || clusters == 0 {
        return centroids;
    }
    centroids.push(series[random.usize(..series.len())].to_vec());
    let mut distances: Vec<f64> =
        series.iter().map(|one| squared_distance(one, &centroids[0])).collect();
    while centroids.len() < clusters {
        let total: f64 = distances.iter().sum();
        if total <= 0.0 {
            break;
        }
        let mut chance = random.f64() * total;
        let chosen = distances.iter().position(|&distance| {
            chance -= distance;
            chance < 0.0 && distance > 0.0
        });
        // Rounding can leave nothing chosen: then the farthest.
        let chosen = chosen.unwrap_or_else(|| {
            let farthest =
                (0..distances.len()).max_by(|&a, &b| distances[a].total_cmp(&distances[b]));
            farthest.expect("there are series")
        });
        let centroid = series[chosen].to_vec();
        for (distance, one) in distances.iter_mut().zip(series) {
            *distance = distance.min(squared_distance(one, &centroid));
        }
        centroids.push(centroid);
    }
    centroids
}

/// Moves centroids to the middle of what is nearest to them until nothing changes. The sum of the squared distances comes first.
fn lloyd(series: &[&[f64]], mut centroids: Vec<Vec<f64>>) -> (f64, Vec<Vec<f64>>) {
    let mut nearest = vec![usize::MAX; series.len()];
    let mut total = 0.0;
    for _ in 0..ROUNDS {
        let mut changed = false;
        total = 0.0;
        for (one, nearest) in series.iter().zip(&mut nearest) {
            let mut least = (f64::INFINITY, 0);
            for (at, centroid) in centroids.iter().enumerate() {
                let distance = squared_distance(one, centroid);
                if distance < least.0 {
                    least = (distance, at);
                }
            }
            total += least.0;
            changed |= *nearest != least.1;
            *nearest = least.1;
        }
        if !changed {
            break;
        }
        let length = series.first().map_or(0, |one| one.len());
        let mut sums = vec![vec![0.0; length]; centroids.len()];
        let mut counts = vec![0_usize; centroids.len()];
        for (one, &nearest) in series.iter().zip(&nearest) {
            counts[nearest] += 1;
            sums[nearest].iter_mut().zip(*one).for_each(|(sum, value)| *sum += value);
        }
        for ((centroid, sum), &count) in centroids.iter_mut().zip(sums).zip(&counts) {
            // A centroid that lost all its series stays where it is.
            if count > 0 {
                *centroid = sum.into_iter().map(|value| value / count as f64).collect();
            }
        }
    }
    (total, centroids)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn three_courses_are_found_in_the_middle_of_their_series() {
        let course = |slope: f64, shift: f64| -> Vec<f64> {
            (0..9).map(|moment| slope * f64::from(moment) + shift).collect()
        };
        let mut all: Vec<Vec<f64>> = Vec::new();
        for slope in [-1.0, 0.0, 2.0] {
            all.extend([-0.2, 0.0, 0.2].map(|shift| course(slope, shift)));
        }
        let mut series: Vec<&[f64]> = all.iter().map(Vec::as_slice).collect();
        let centroids = cluster(&series, 3);
        for (centroid, slope) in centroids.iter().zip([-1.0, 0.0, 2.0]) {
            assert!(squared_distance(centroid, &course(slope, 0.0)) < 1e-20, "{centroid:?}");
        }
        series.reverse();
        assert_eq!(cluster(&series, 3), centroids, "the order of the series does not matter");
    }

    #[test]
    fn there_are_no_more_courses_than_different_series() {
        let one = [0.0, 1.0];
        assert_eq!(cluster(&[&one, &one, &one], 4), [vec![0.0, 1.0]]);
        assert!(cluster(&[], 2).is_empty());
    }
}
