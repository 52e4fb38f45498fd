//! In which keys two resolved scenarios differ.

use toml::{Table, Value};

/// The dotted keys whose values differ between two resolved scenarios, sorted table by table. An item of a list is called by its name, else by its
/// number from 0; a list whose items are others is one key.
#[must_use]
pub fn changed_keys(one: &str, other: &str) -> Vec<String> {
    let parsed = |text: &str| Value::Table(text.parse::<Table>().unwrap_or_default());
    let mut changed = Vec::new();
    compare("", &parsed(one), &parsed(other), &mut changed);
    changed
}

fn compare(key: &str, one: &Value, other: &Value, changed: &mut Vec<String>) {
    let below = |name: &str| if key.is_empty() { name.to_owned() } else { format!("{key}.{name}") };
    match (one, other) {
        (Value::Table(a), Value::Table(b)) => {
            for (name, value) in a {
                match b.get(name) {
                    Some(other) => compare(&below(name), value, other, changed),
                    None => changed.push(below(name)),
                }
            }
            changed.extend(b.keys().filter(|name| !a.contains_key(*name)).map(|name| below(name)));
        }
        (Value::Array(a), Value::Array(b)) if are_tables(a) && are_tables(b) && a.iter().map(name_of).eq(b.iter().map(name_of)) => {
            for (index, (one, other)) in a.iter().zip(b).enumerate() {
                let name = name_of(one).map_or_else(|| index.to_string(), str::to_owned);
                compare(&below(&name), one, other, changed);
            }
        }
        _ if one == other => {}
        _ => changed.push(key.to_owned()),
    }
}

fn are_tables(items: &[Value]) -> bool {
    items.iter().all(Value::is_table)
}

fn name_of(item: &Value) -> Option<&str> {
    item.get("name")?.as_str()
}

#[cfg(test)]
mod tests {
    use super::changed_keys;

    /// Contract: every key that differs is told, and no other: values, keys that only one of the two has, and lists with other items.
    #[test]
    fn every_key_that_differs_is_told_and_no_other() {
        let one = "a = 1.0\nfar = inf\n[b]\nc = [1, 2]\nd = 3\n[[object]]\nname = \"x\"\nm = 1\n[[object]]\nname = \"y\"\n[[w]]\nt = 0\n";
        assert!(changed_keys(one, &one.replace("a = 1.0", "a    = 1.0 # the same")).is_empty());
        for (from, to, key) in [
            ("a = 1.0", "a = 2.0", "a"),
            ("c = [1, 2]", "c = [1, 3]", "b.c"),
            ("d = 3", "", "b.d"),
            ("d = 3", "d = 3\ne = 4", "b.e"),
            ("m = 1", "m = 2", "object.x.m"),
            ("name = \"y\"", "name = \"z\"", "object"),
            ("t = 0", "t = 1", "w.0.t"),
        ] {
            let other = one.replace(from, to);
            assert_eq!((changed_keys(one, &other), changed_keys(&other, one)), (vec![key.to_owned()], vec![key.to_owned()]), "{from} {to}");
        }
    }
}
