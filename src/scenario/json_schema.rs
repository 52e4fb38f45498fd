//! The table of keys as a JSON Schema, from which editors complete, explain and check scenario files.
//!
//! A file without `extends` must name every required key; one layer on top of another may leave out what the one below says. JSON Schema
//! cannot ask what the other file says, so each table has two definitions, and the root picks one.

use serde_json::{Map, Value, json};

use super::key::{Key, Kind, Length, Preset, Shape, Variant};
use super::measure::Measure;
use super::schema::{LEARNING_FILE, SCENARIO};

/// The dialect that is written.
const DIALECT: &str = "https://json-schema.org/draft/2020-12/schema";

/// The JSON Schema of scenario files.
#[must_use]
pub fn scenario_schema() -> Value {
    let (whole, layer) = (Writer { whole: true }, Writer { whole: false });
    let mut extending = layer.plain_table(SCENARIO.keys);
    extending["properties"]["extends"] = json!({ "type": "string", "description": "the scenario file that this one is put on top of" });
    extending["required"] = json!(["extends"]);
    json!({
        "$schema": DIALECT,
        "title": "cpdmp scenario",
        "type": "object",
        "if": { "required": ["extends"] },
        "then": extending,
        "else": whole.plain_table(SCENARIO.keys),
    })
}

/// The JSON Schema of files with nothing but settings of learning (`cpdmp learn --settings`).
#[must_use]
pub fn learning_schema() -> Value {
    let mut schema = Writer { whole: true }.plain_table(LEARNING_FILE.keys);
    schema["$schema"] = json!(DIALECT);
    schema["title"] = json!("cpdmp learning settings");
    schema
}

/// Writes tables that are whole, or layers that may leave out what is required.
struct Writer {
    whole: bool,
}

impl Writer {
    fn table(&self, shape: &Shape) -> Value {
        if shape.variants.is_empty() {
            return self.plain_table(shape.keys);
        }
        json!({ "anyOf": shape.variants.iter().map(|variant| self.variant(shape, variant)).collect::<Vec<_>>() })
    }

    fn variant(&self, shape: &Shape, variant: &Variant) -> Value {
        let keys: Vec<Key> = shape.keys.iter().chain(variant.keys).copied().collect();
        let mut table = self.plain_table(&keys);
        table["properties"]["kind"]["const"] = json!(variant.kind);
        table
    }

    fn plain_table(&self, keys: &[Key]) -> Value {
        let properties: Map<String, Value> = keys.iter().map(|key| (key.name.to_owned(), self.key(key))).collect();
        let mut table = json!({ "type": "object", "properties": properties, "additionalProperties": false });
        let required: Vec<&str> = keys.iter().filter(|key| matches!(key.preset, Preset::Required)).map(|key| key.name).collect();
        if self.whole && !required.is_empty() {
            table["required"] = json!(required);
        }
        table
    }

    fn key(&self, key: &Key) -> Value {
        let mut schema = self.kind(&key.kind);
        let unit = unit(&key.kind).map_or(String::new(), |unit| format!(" ({unit})"));
        schema["description"] = json!(format!("{}{unit}", key.meaning));
        match key.preset {
            Preset::Flag(flag) => schema["default"] = json!(flag),
            Preset::Count(count) => schema["default"] = json!(count),
            // JSON has no infinity.
            Preset::Number(number) if number.is_finite() => schema["default"] = json!(number),
            Preset::Vector(numbers) => schema["default"] = json!(numbers),
            Preset::Text(text) => schema["default"] = json!(text),
            Preset::Number(_) | Preset::Required | Preset::Optional | Preset::Empty => {}
        }
        schema
    }

    fn kind(&self, kind: &Kind) -> Value {
        match kind {
            Kind::Flag => json!({ "type": "boolean" }),
            Kind::Count(min, max) => count(*min, *max),
            Kind::CountOrWord(min, max, word) => json!({ "anyOf": [count(*min, *max), { "const": word }] }),
            Kind::Number(measure) => number(measure),
            Kind::Quantity(measure) => json!({ "anyOf": [number(measure), name()] }),
            Kind::NumberOrWord(measure, word) => json!({ "anyOf": [number(measure), { "const": word }] }),
            Kind::Vector(measure, length) => list(number(measure), *length),
            Kind::Windows(measure) => json!({ "type": "array", "items": list(number(measure), Length::Exactly(2)) }),
            Kind::Text | Kind::Path(_) | Kind::Tag => json!({ "type": "string" }),
            Kind::Name | Kind::Reference(_) => name(),
            Kind::Folders | Kind::Texts => json!({ "type": "array", "items": { "type": "string" } }),
            Kind::Choice(choices) => json!({ "enum": choices }),
            Kind::References(_) => json!({ "type": "array", "items": name() }),
            Kind::Section(shape) => self.table(shape),
            Kind::List(shape) => json!({ "type": "array", "items": self.table(shape) }),
            Kind::Numbers => json!({ "type": "object", "additionalProperties": { "type": "number" } }),
            Kind::Grid => json!({ "type": "object", "additionalProperties": { "type": "array", "items": { "type": "number" } } }),
            Kind::Values => json!({ "type": "array", "minItems": 1 }),
            // A dotted key without quotes is a table in a table.
            Kind::Ranges => {
                let pair = list(number(&Measure::ANY), Length::Exactly(2));
                json!({ "type": "object", "minProperties": 1, "additionalProperties": { "anyOf": [pair, { "type": "object" }] } })
            }
        }
    }
}

fn name() -> Value {
    json!({ "type": "string", "pattern": "^[A-Za-z0-9_-]{1,64}$" })
}

fn count(min: i64, max: i64) -> Value {
    let mut schema = json!({ "type": "integer", "minimum": min });
    if max < i64::MAX {
        schema["maximum"] = json!(max);
    }
    schema
}

fn number(measure: &Measure) -> Value {
    let mut schema = json!({ "type": "number" });
    if measure.min > f64::MIN {
        schema[if measure.open { "exclusiveMinimum" } else { "minimum" }] = json!(measure.min);
    }
    // TOML's `inf` is above any maximum.
    if measure.max < f64::MAX && !measure.infinite {
        schema["maximum"] = json!(measure.max);
    }
    schema
}

fn list(items: Value, length: Length) -> Value {
    match length {
        Length::Exactly(count) => json!({ "type": "array", "items": items, "minItems": count, "maxItems": count }),
        Length::AtLeast(count) => json!({ "type": "array", "items": items, "minItems": count }),
    }
}

fn unit(kind: &Kind) -> Option<&'static str> {
    match kind {
        Kind::Number(m) | Kind::Quantity(m) | Kind::NumberOrWord(m, _) | Kind::Vector(m, _) | Kind::Windows(m) => Some(m.unit),
        _ => None,
    }
    .filter(|unit| !unit.is_empty())
}
