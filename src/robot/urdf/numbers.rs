//! Numbers in attributes, read strictly: every token counts, and none may be infinite or not a number.

use roxmltree::Node;

use super::elements::Check;

impl Check<'_> {
    /// `count` numbers that must be there.
    pub(super) fn required(&mut self, node: Node<'_, '_>, attribute: &str, count: usize) -> Option<Vec<f64>> {
        if node.attribute(attribute).is_none() {
            self.error(node, format!("has no `{attribute}`"), "");
        }
        self.optional(node, attribute, count)
    }

    /// `count` numbers, if the attribute is there.
    pub(super) fn optional(&mut self, node: Node<'_, '_>, attribute: &str, count: usize) -> Option<Vec<f64>> {
        let text = node.attribute(attribute)?;
        let tokens: Vec<&str> = text.split_whitespace().collect();
        if tokens.len() != count {
            let message = format!("`{attribute}` must hold {count} numbers, not {}: \"{text}\"", tokens.len());
            let help = if text.contains(',') { "write points, and spaces between numbers" } else { "" };
            self.error(node, message, help);
            return None;
        }
        let mut numbers = Vec::with_capacity(count);
        for token in tokens {
            match token.parse::<f64>() {
                Ok(number) if number.is_finite() => numbers.push(number),
                Ok(_) => self.error(node, format!("`{attribute}` must be finite, not {token}"), ""),
                Err(_) => {
                    let help = if token.contains(',') { "write a decimal point" } else { "" };
                    self.error(node, format!("`{attribute}` holds \"{token}\", which is no number"), help);
                }
            }
        }
        (numbers.len() == count).then_some(numbers)
    }

    /// One number that must be there.
    pub(super) fn required_number(&mut self, node: Node<'_, '_>, attribute: &str) -> Option<f64> {
        self.required(node, attribute, 1).map(|numbers| numbers[0])
    }

    /// One number, if the attribute is there.
    pub(super) fn optional_number(&mut self, node: Node<'_, '_>, attribute: &str) -> Option<f64> {
        self.optional(node, attribute, 1).map(|numbers| numbers[0])
    }
}
