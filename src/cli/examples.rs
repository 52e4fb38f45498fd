//! The examples that `--help` shows. The tests run them as they stand; lines of more than 100 characters would be broken.

pub(super) const RUN: &str = "\
Examples:
  cpdmp run scenarios/pick_and_place.toml
  cpdmp run scenarios/pick_and_place.toml --seed 3 --set object.toy.radius_m=0.035";

pub(super) const CHECK: &str = "\
Examples:
  cpdmp check scenarios/
  cpdmp check scenarios/ --format github --junit junit.xml
  cpdmp check runs/pick_and_place-0
  cpdmp check path.csv --scene scenarios/pick_and_place.toml";

pub(super) const VALIDATE: &str = "\
Examples:
  cpdmp validate scenarios/
  cpdmp validate scenarios/pick_and_place.toml --robot builtin:baxter --format json";

pub(super) const MIGRATE: &str = "\
Examples:
  cpdmp migrate scenarios/pick_and_place.toml --dry-run";

pub(super) const SWEEP: &str = "\
Examples:
  cpdmp sweep scenarios/pick_and_place.toml --grid parameters.block_height_m=0.18,0.21 --repeat 2
  cpdmp sweep scenarios/pick_and_place.toml --repeat 3 --shard 1/2 --out sweeps/one
  cpdmp sweep scenarios/pick_and_place.toml --repeat 3 --shard 2/2 --out sweeps/two --resume";

pub(super) const MERGE: &str = "\
Examples:
  cpdmp merge sweeps/one sweeps/two --out whole.parquet";

pub(super) const TEACH: &str = "\
Examples:
  cpdmp teach scenarios/pick_and_place.toml --out demonstrations/pick_and_place
  cpdmp teach scenarios/pick_and_place.toml --set teaching.repetitions=2 --out twice";

pub(super) const REPLAY: &str = "\
Examples:
  cpdmp replay runs/pick_and_place-0
  cpdmp replay runs/pick_and_place-0 --from execute
  cpdmp replay runs/pick_and_place-0 --from-time 20
  cpdmp replay runs/pick_and_place-0 --set object.toy.friction=0.5";

pub(super) const FIGURES: &str = "\
Examples:
  cpdmp figures runs/pick_and_place-0 --out figures";

pub(super) const EXPLAIN: &str = "\
Examples:
  cpdmp explain 10
  cpdmp explain unknown_key";

pub(super) const SCHEMA: &str = "\
Examples:
  cpdmp schema scenario";

pub(super) const COMPLETIONS: &str = "\
Examples:
  cpdmp completions bash";
