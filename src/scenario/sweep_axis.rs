//! One direction in which a sweep varies a scenario: keys, and the values that they take together.

use super::overrides::spelled;
use super::source::Origin;
use super::tree::{Node, Value};
use crate::math;

/// One direction of a sweep: point i gives every key its i-th value.
#[derive(Clone, Debug)]
pub(super) struct Axis {
    pub keys: Vec<AxisKey>,
    /// How many points there are.
    pub points: u64,
}

/// One key that varies.
#[derive(Clone, Debug)]
pub(super) struct AxisKey {
    /// The key, dotted.
    pub name: String,
    /// Where it was typed.
    pub origin: Origin,
    values: Values,
}

/// The values of a key.
#[derive(Clone, Debug)]
enum Values {
    Listed(Vec<Node>),
    Drawn {
        numbers: Vec<f64>,
        origin: Origin,
    },
    /// Whole numbers from the first one on.
    Rising {
        first: i64,
        origin: Origin,
    },
}

/// How points are drawn from ranges.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Draw {
    /// Each on its own.
    Uniform,
    /// One in each of as many equal slices as there are points, in a random order of its own for every key.
    LatinHypercube,
}

impl Axis {
    /// One key with a list of values.
    pub fn listed(name: &str, origin: Origin, values: Vec<Node>) -> Self {
        let points = values.len() as u64;
        Self { keys: vec![AxisKey { name: spelled(name), origin, values: Values::Listed(values) }], points }
    }

    /// Seeds from `first` on.
    pub fn seeds(first: u64, count: u64, origin: Origin) -> Self {
        // A seed beyond what a scenario takes wraps below 0, which is refused with the place of the count.
        let values = Values::Rising { first: first as i64, origin };
        Self { keys: vec![AxisKey { name: "seed".to_owned(), origin, values }], points: count }
    }

    /// Numbers drawn from the `[min, max]` of every entry of `ranges`. What is drawn depends on `seed`, `number` (the axis among the others)
    /// and the key alone.
    pub fn drawn(draw: Draw, ranges: &Node, count: u64, seed: u64, number: u64) -> Self {
        let key = |entry: &super::tree::Entry| {
            let range = <[f64; 2]>::try_from(entry.node.as_numbers()).ok()?;
            let mut random = math::stream(seed, &format!("sweep/{}", entry.key), number);
            let slices = match draw {
                Draw::Uniform => vec![0; count as usize],
                Draw::LatinHypercube => shuffled(count, &mut random),
            };
            let of = if draw == Draw::Uniform { 1.0 } else { count as f64 };
            let share = |slice: u64| (slice as f64 + math::uniform(&mut random, 0.0, 1.0)) / of;
            let numbers = slices.into_iter().map(share).map(|share| range[0] + (range[1] - range[0]) * share).collect();
            let values = Values::Drawn { numbers, origin: entry.node.origin };
            Some(AxisKey { name: spelled(&entry.key), origin: entry.origin, values })
        };
        Self { keys: ranges.entries().iter().filter_map(key).collect(), points: count }
    }
}

impl AxisKey {
    /// The first value that was listed before: a member that would be run twice.
    pub fn repeated(&self) -> Option<&Node> {
        let Values::Listed(values) = &self.values else { return None };
        values
            .iter()
            .enumerate()
            .find(|(index, node)| values[..*index].iter().any(|earlier| earlier.value == node.value))
            .map(|(_, node)| node)
    }

    /// Whether its values were listed, one by one.
    pub fn is_listed(&self) -> bool {
        matches!(self.values, Values::Listed(_))
    }

    /// The value at `point`.
    pub fn value(&self, point: u64) -> Node {
        match &self.values {
            Values::Listed(values) => values[point as usize].clone(),
            Values::Drawn { numbers, origin } => Node::new(Value::Number(numbers[point as usize]), *origin),
            Values::Rising { first, origin } => Node::new(Value::Integer(first.wrapping_add(point as i64)), *origin),
        }
    }
}

/// The numbers below `count` in a random order (Fisher and Yates).
fn shuffled(count: u64, random: &mut rand_chacha::ChaCha8Rng) -> Vec<u64> {
    let mut order: Vec<u64> = (0..count).collect();
    for last in (1..order.len()).rev() {
        let other = math::uniform(random, 0.0, (last + 1) as f64) as usize;
        order.swap(last, other.min(last));
    }
    order
}

#[cfg(test)]
mod tests {
    use super::super::source::{Source, Sources};
    use super::super::tree::Entry;
    use super::*;

    const COUNT: u64 = 50;

    fn axis(draw: Draw, seed: u64) -> Axis {
        let source = Source { name: "x".to_owned(), directory: "".into(), text: "".into(), rank: 0 };
        let origin = Origin { source: Sources::default().add(source), start: 0, end: 0 };
        let number = |n: f64| Node::new(Value::Number(n), origin);
        let entry = |key: &str, min, max| Entry {
            key: key.to_owned(),
            origin,
            node: Node::new(Value::List(vec![number(min), number(max)]), origin),
        };
        let ranges = Node::new(Value::Table(vec![entry("a", -1.0, 3.0), entry("b", 10.0, 10.5)]), origin);
        Axis::drawn(draw, &ranges, COUNT, seed, 0)
    }

    fn numbers(axis: &Axis, key: usize) -> Vec<f64> {
        (0..axis.points).filter_map(|point| axis.keys[key].value(point).as_number()).collect()
    }

    /// The property that defines the design: every slice of every range holds exactly one point.
    #[test]
    fn a_latin_hypercube_has_one_point_in_every_slice_of_every_range() {
        for seed in 0..5 {
            let axis = axis(Draw::LatinHypercube, seed);
            for (key, [min, max]) in [(0, [-1.0, 3.0]), (1, [10.0, 10.5])] {
                let slice = |x: f64| ((x - min) / (max - min) * COUNT as f64).floor() as u64;
                let mut slices: Vec<u64> = numbers(&axis, key).into_iter().map(slice).collect();
                assert!(slices.windows(2).any(|pair| pair[0] > pair[1]), "the order is random");
                slices.sort_unstable();
                assert_eq!(slices, (0..COUNT).collect::<Vec<_>>());
            }
            let rank = |key| numbers(&axis, key);
            let same = rank(0).iter().zip(rank(1)).filter(|(a, b)| (*a + 1.0) / 4.0 - (b - 10.0) / 0.5 < 1.0 / COUNT as f64).count();
            assert!(same < COUNT as usize, "keys are shuffled each on its own");
        }
    }

    #[test]
    fn draws_stay_in_their_range_and_depend_on_the_seed_alone() {
        let first = numbers(&axis(Draw::Uniform, 1), 0);
        assert!(first.iter().all(|x| (-1.0..3.0).contains(x)));
        assert_eq!(first, numbers(&axis(Draw::Uniform, 1), 0));
        assert_ne!(first, numbers(&axis(Draw::Uniform, 2), 0));
        let mean = first.iter().sum::<f64>() / COUNT as f64;
        assert!((mean - 1.0).abs() < 4.0 * (4.0 / 12_f64.sqrt()) / (COUNT as f64).sqrt(), "{mean} is within four standard errors");
    }
}
