//! Contacts that a scenario allows.

use crate::world::{ContactEpisode, Permission};

/// A contact that a scenario allows although the scene would not.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct AllowedContact {
    /// Its name in reports: unique in the scenario.
    pub name: String,
    /// A link of the robot or an object, with all its parts.
    pub a: String,
    /// The other one.
    pub b: String,
}

/// Marks the contacts that the scenario allows.
pub fn allow(contacts: &mut [ContactEpisode], allowed: &[AllowedContact]) {
    for contact in contacts.iter_mut().filter(|contact| !contact.allowed) {
        let between = |one: &&AllowedContact| {
            let is = |part: &str, name: &str| part == name || part.strip_prefix(name).is_some_and(|rest| rest.starts_with('.'));
            (is(&contact.a, &one.a) && is(&contact.b, &one.b)) || (is(&contact.a, &one.b) && is(&contact.b, &one.a))
        };
        if let Some(found) = allowed.iter().find(between) {
            contact.allowed = true;
            contact.permission = Some(Permission::Scenario(found.name.clone()));
        }
    }
}
