//! The JSON Schema of `dataset.toml`, which editors complete and explain it from.

use serde_json::{Value, json};

use super::ParameterSource;

/// The JSON Schema of `dataset.toml`.
#[must_use]
pub fn dataset_schema() -> Value {
    let names = |description: &str| json!({ "type": "array", "items": { "type": "string" }, "description": description });
    let parameters =
        |description: &str| json!({ "type": "object", "additionalProperties": { "type": "number" }, "description": description });
    let text = |description: &str| json!({ "type": "string", "description": description });
    let single = json!({ "anyOf": [
        { "type": "string", "description": "the column's name in the file" },
        { "type": "integer", "minimum": 0, "description": "the column's place, counted from 0" },
    ] });
    let from_unit = json!({
        "type": "object",
        "properties": { "from": single, "unit": text("the file's unit, such as mm or deg") },
        "required": ["from"],
        "additionalProperties": false,
    });
    let quaternion = json!({
        "type": "object",
        "properties": { "from": { "type": "array", "items": single, "minItems": 4, "maxItems": 4 }, "order": { "enum": ["xyzw", "wxyz"] } },
        "required": ["from", "order"],
        "additionalProperties": false,
    });
    let demonstration = json!({
        "type": "object",
        "properties": {
            "file": text("the file's name"),
            "sequence": { "type": ["string", "integer"], "description": "which repetition of the file" },
            "theta_m": parameters("parameters of the motion model"),
            "theta_f": parameters("parameters of the force model"),
        },
        "additionalProperties": false,
    });
    json!({
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "title": "cpdmp dataset",
        "type": "object",
        "required": ["schema_version"],
        "additionalProperties": false,
        "properties": {
            "schema_version": { "const": 1, "description": "version of this format" },
            "motion": names("columns that the motion model learns"),
            "wrench": names("columns that the force model learns"),
            "demonstration": { "type": "array", "items": demonstration },
            "columns": {
                "type": "object",
                "description": "columns under other names, in other units",
                "properties": { "quaternion": quaternion },
                "additionalProperties": { "anyOf": [single, from_unit] },
            },
            "delimiter": { "enum": [",", ";", "tab", "\t", "whitespace", " "], "description": "what separates columns" },
            "header": { "type": "boolean", "description": "whether the first line names the columns" },
            "rate_hz": { "type": "number", "exclusiveMinimum": 0, "description": "rate of files without a column of time (Hz)" },
            "file": text("the one file that holds every repetition"),
            "sequence": text("the column that tells repetitions apart"),
            "theta": { "enum": ParameterSource::ALL.map(ParameterSource::word), "description": "where the motion's parameters come from" },
            "theta_m": names("columns that hold the parameters of the motion model"),
            "theta_f": names("columns that hold the parameters of the force model"),
        },
    })
}
