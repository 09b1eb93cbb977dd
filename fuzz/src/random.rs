//! Random numbers that are the same on every machine.

use fastrand::Rng;

/// A generator.
pub struct Random(Rng);

impl Random {
    /// Starts the generator of one input.
    pub fn of(seed: u64, input: u64) -> Self {
        Self(Rng::with_seed(seed.wrapping_mul(0x2545_f491_4f6c_dd1d) ^ input))
    }

    /// Returns 64 random bits.
    pub fn bits(&mut self) -> u64 {
        self.0.u64(..)
    }

    /// Returns a whole number below `n`, or 0 if `n` is 0.
    pub fn below(&mut self, n: usize) -> usize {
        if n == 0 { 0 } else { self.0.usize(..n) }
    }

    /// Returns one of the items.
    pub fn one_of<'a, T: ?Sized>(&mut self, all: &[&'a T]) -> &'a T {
        all[self.below(all.len())]
    }

    /// Returns true once in `n` calls on average.
    pub fn once_in(&mut self, n: usize) -> bool {
        self.below(n) == 0
    }

    /// Returns a range within a list of `n` items, mostly a short one.
    pub fn stretch(&mut self, n: usize) -> std::ops::Range<usize> {
        let start = self.below(n + 1);
        let longest = if self.once_in(4) { n } else { 8 };
        start..(start + self.below(longest + 1)).min(n)
    }
}
