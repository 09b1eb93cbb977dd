//! A part of a sweep: every N-th member, beginning with the K-th.

use std::str::FromStr;

/// The shard `K/N` has the members K − 1, K − 1 + N, ….
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Shard {
    first: usize,
    step: usize,
}

impl Shard {
    /// All members of the sweep.
    pub const WHOLE: Self = Self { first: 0, step: 1 };

    pub fn number(&self) -> usize {
        self.first + 1
    }

    pub fn step(&self) -> usize {
        self.step
    }

    pub fn has(&self, index: usize) -> bool {
        index % self.step == self.first
    }

    /// Returns the indices of its members in a sweep of `n_members`.
    pub fn places(&self, n_members: usize) -> Vec<usize> {
        (self.first..n_members).step_by(self.step).collect()
    }
}

impl FromStr for Shard {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let numbers = text.split_once('/').map(|(k, n)| (k.parse::<usize>(), n.parse::<usize>()));
        match numbers {
            Some((Ok(k), Ok(n))) if 1 <= k && k <= n => Ok(Self { first: k - 1, step: n }),
            _ => Err("a shard is K/N with K from 1 to N, such as 3/10".to_string()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shards_share_out_all_members() {
        let shards = ["1/3", "2/3", "3/3"].map(|text| text.parse::<Shard>().unwrap());
        let mut places: Vec<usize> = shards.iter().flat_map(|shard| shard.places(8)).collect();
        places.sort_unstable();
        assert_eq!(places, Shard::WHOLE.places(8));
        assert!(shards[1].has(4) && !shards[1].has(3));
    }
}
