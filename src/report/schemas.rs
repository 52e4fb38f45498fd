//! JSON Schemas of what the program writes for other programs.

use schemars::generate::SchemaSettings;
use schemars::{JsonSchema, Schema};
use serde_json::Value;

use super::{CheckReport, LearnReport, Manifest, RunReport};

/// The JSON Schema of `report.json`.
#[must_use]
pub fn report_schema() -> Value {
    written_schema::<RunReport>()
}

/// The JSON Schema of `manifest.json`.
#[must_use]
pub fn manifest_schema() -> Value {
    written_schema::<Manifest>()
}

/// The JSON Schema of what `cpdmp check --format json` prints.
#[must_use]
pub fn check_schema() -> Value {
    written_schema::<CheckReport>()
}

/// The JSON Schema of what `cpdmp learn --format json` prints.
#[must_use]
pub fn learn_schema() -> Value {
    written_schema::<LearnReport>()
}

/// The JSON Schema of what a type is written as, which may be less than what it can be read from.
#[must_use]
pub fn written_schema<T: JsonSchema>() -> Value {
    let schema: Schema = SchemaSettings::draft2020_12().for_serialize().into_generator().into_root_schema_for::<T>();
    schema.to_value()
}
