//! Which members of a sweep one machine runs.

use std::fmt;
use std::str::FromStr;

/// Part `number` of `of`: the members whose index leaves `number - 1` when divided by `of`, so that parts take equally long.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Shard {
    number: u64,
    of: u64,
}

impl Shard {
    /// Every member.
    pub const WHOLE: Self = Self { number: 1, of: 1 };

    /// Whether it is the whole.
    pub fn is_whole(self) -> bool {
        self.of == 1
    }

    /// Whether member `index` belongs to it.
    pub fn holds(self, index: u64) -> bool {
        index % self.of == self.number - 1
    }

    /// The members among the first `members` that belong to it, in order.
    pub fn indices(self, members: u64) -> impl Iterator<Item = u64> {
        (self.number - 1..members).step_by(usize::try_from(self.of).unwrap_or(usize::MAX))
    }

    /// How many of `members` belong to it.
    pub fn size(self, members: u64) -> u64 {
        (members + self.of - self.number) / self.of
    }

    /// As part of a file's name: `1-of-4`.
    pub fn in_name(self) -> String {
        format!("{}-of-{}", self.number, self.of)
    }
}

impl fmt::Display for Shard {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}/{}", self.number, self.of)
    }
}

impl FromStr for Shard {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let numbers = text.split_once('/').and_then(|(number, of)| Some((number.parse().ok()?, of.parse().ok()?)));
        match numbers {
            Some((number, of)) if (1..=of).contains(&number) && of <= 1_000_000 => Ok(Self { number, of }),
            _ => Err("a part and how many there are, such as 1/4".to_owned()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shards_part_the_members() {
        for of in 1..=7 {
            for members in 0..20 {
                let shards: Vec<Shard> = (1..=of).map(|number| format!("{number}/{of}").parse().expect("a shard")).collect();
                let mut all: Vec<u64> = shards.iter().flat_map(|shard| shard.indices(members)).collect();
                all.sort_unstable();
                assert_eq!(all, (0..members).collect::<Vec<_>>());
                for shard in shards {
                    assert_eq!(shard.size(members), shard.indices(members).count() as u64, "{shard} of {members}");
                    assert!(shard.indices(members).all(|index| shard.holds(index)));
                }
            }
        }
    }

    #[test]
    fn what_is_no_shard_is_refused() {
        for text in ["", "1", "0/2", "3/2", "1/0", "a/b", "-1/2", "1/2/3"] {
            assert!(text.parse::<Shard>().is_err(), "{text}");
        }
    }
}
