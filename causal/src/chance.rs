//! A seed and the number of a piece of work go in; the chance of that piece comes out, the same in whatever thread it is done.

/// The numbers that piece `piece` draws under a seed. Seeds that differ in one bit would give like numbers at first: both are mixed by
/// a generator of their own.
pub fn chance(seed: u64, piece: u64) -> fastrand::Rng {
    let mixed = fastrand::Rng::with_seed(seed).u64(..) ^ fastrand::Rng::with_seed(piece).u64(..);
    fastrand::Rng::with_seed(mixed)
}
