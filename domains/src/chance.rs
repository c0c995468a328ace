//! A seed goes in; the same numbers come out each time, spread as a world needs them.

use nalgebra::Vector3;

/// A seeded source of random numbers.
#[derive(Debug, Clone)]
pub struct Chance(fastrand::Rng);

impl Chance {
    /// A source for a purpose, such that different purposes with one seed share no numbers.
    pub fn new(purpose: &str, numbers: &[u64]) -> Self {
        // FNV-1a over all that tells sources apart; a plain sum would make neighbouring seeds alike.
        let bytes = purpose.bytes().chain(numbers.iter().flat_map(|number| number.to_le_bytes()));
        let seed = bytes.fold(0xcbf2_9ce4_8422_2325_u64, |hash, byte| {
            (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3)
        });
        Self(fastrand::Rng::with_seed(seed))
    }

    /// A number from a range, each as likely.
    pub fn within(&mut self, range: (f64, f64)) -> f64 {
        range.0 + (range.1 - range.0) * self.0.f64()
    }

    /// Whether something of a probability happens.
    pub fn happens(&mut self, probability: f64) -> bool {
        self.0.f64() < probability
    }

    /// A whole number below a bound.
    pub fn below(&mut self, bound: usize) -> usize {
        self.0.usize(0..bound)
    }

    /// A number from the normal distribution with mean 0 and standard deviation 1.
    pub fn normal(&mut self) -> f64 {
        // The polar method of Marsaglia, which needs no trigonometry.
        loop {
            let (first, second) = (self.within((-1.0, 1.0)), self.within((-1.0, 1.0)));
            let square = first * first + second * second;
            if square > 0.0 && square < 1.0 {
                return first * (-2.0 * square.ln() / square).sqrt();
            }
        }
    }

    /// A vector of independent normal numbers.
    pub fn normals(&mut self) -> Vector3<f64> {
        Vector3::new(self.normal(), self.normal(), self.normal())
    }

    /// Things in another order.
    pub fn shuffle<T>(&mut self, things: &mut [T]) {
        self.0.shuffle(things);
    }
}

#[cfg(test)]
mod tests {
    use super::Chance;

    #[test]
    fn normal_numbers_have_mean_zero_and_deviation_one() {
        let mut chance = Chance::new("test", &[1]);
        let numbers: Vec<f64> = (0..20_000).map(|_| chance.normal()).collect();
        let mean = numbers.iter().sum::<f64>() / 20_000.0;
        let variance = numbers.iter().map(|number| number * number).sum::<f64>() / 20_000.0;
        assert!(mean.abs() < 0.03, "{mean}");
        assert!((variance - 1.0).abs() < 0.05, "{variance}");
    }

    #[test]
    fn purposes_and_seeds_differ() {
        let first = Chance::new("a", &[1, 2]).within((0.0, 1.0));
        assert!((first - Chance::new("a", &[1, 2]).within((0.0, 1.0))).abs() < 1e-15);
        assert!((first - Chance::new("a", &[2, 1]).within((0.0, 1.0))).abs() > 1e-9);
        assert!((first - Chance::new("b", &[1, 2]).within((0.0, 1.0))).abs() > 1e-9);
    }
}
