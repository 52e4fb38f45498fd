//! The checksum of a skill file: over what it says, not over how it is laid out.

use serde_json::Value;
use twox_hash::XxHash3_64;

use crate::learning::LearningError;

/// The key that holds it.
pub(super) const KEY: &str = "checksum";

/// The checksum of a document as `xxh3-64:…`: over every key but [`KEY`], keys sorted, numbers as the bits of an f64.
pub(super) fn checksum(document: &Value) -> String {
    let mut content = Vec::new();
    match document {
        Value::Object(keys) => {
            let mut sorted: Vec<(&String, &Value)> = keys.iter().filter(|(key, _)| *key != KEY).collect();
            sorted.sort_by_key(|(key, _)| *key);
            feed_entries(&sorted, &mut content);
        }
        other => feed(other, &mut content),
    }
    format!("xxh3-64:{:016x}", XxHash3_64::oneshot(&content))
}

/// Compares the checksum of a document with what it holds. A file without one is accepted: other programs write skills too.
pub(super) fn verify(document: &Value) -> Result<(), LearningError> {
    let Some(found) = document.get(KEY) else { return Ok(()) };
    if found.as_str() == Some(checksum(document).as_str()) {
        return Ok(());
    }
    Err(LearningError::Skill(format!(
        "the file is not as cpdmp wrote it: its content does not fit its \"{KEY}\", {found}; if it was edited on purpose, remove that key"
    )))
}

/// Every value begins with a byte that says its kind, and every text and list with its length: no two documents share their bytes.
fn feed(value: &Value, content: &mut Vec<u8>) {
    match value {
        Value::Null => content.push(b'n'),
        Value::Bool(flag) => content.extend([b'b', u8::from(*flag)]),
        Value::Number(number) => {
            content.push(b'f');
            content.extend(number.as_f64().unwrap_or(f64::NAN).to_bits().to_le_bytes());
        }
        Value::String(text) => feed_text(text, content),
        Value::Array(items) => {
            content.push(b'l');
            content.extend((items.len() as u64).to_le_bytes());
            items.iter().for_each(|item| feed(item, content));
        }
        Value::Object(keys) => {
            let mut sorted: Vec<(&String, &Value)> = keys.iter().collect();
            sorted.sort_by_key(|(key, _)| *key);
            feed_entries(&sorted, content);
        }
    }
}

fn feed_entries(sorted: &[(&String, &Value)], content: &mut Vec<u8>) {
    content.push(b'o');
    content.extend((sorted.len() as u64).to_le_bytes());
    for (key, value) in sorted {
        feed_text(key, content);
        feed(value, content);
    }
}

fn feed_text(text: &str, content: &mut Vec<u8>) {
    content.push(b't');
    content.extend((text.len() as u64).to_le_bytes());
    content.extend(text.as_bytes());
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;

    #[test]
    fn layout_does_not_count_and_content_does() {
        let document = |text: &str| serde_json::from_str::<Value>(text).unwrap();
        let one = checksum(&document(r#"{"a": [1.0, 2], "b": {"x": 0.1, "y": null}}"#));
        assert_eq!(one, checksum(&document(r#"{"b":{"y":null,"x":0.10},"checksum":"old","a":[1,2.0]}"#)));
        for other in [json!({"a": [1, 2], "b": {"x": 0.1}}), json!({"a": [12], "b": {"x": 0.1, "y": null}}), json!([])] {
            assert_ne!(one, checksum(&other));
        }
    }
}
