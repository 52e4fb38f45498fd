//! Whether a recording holds the entities that are documented, all of them and no others.

use std::collections::BTreeSet;

use rerun::log::Chunk;

/// Fails on an entity that fits none of the patterns (`a/{name}/b`), and on a pattern that no entity fits.
pub fn assert_documented(chunks: &[Chunk], patterns: &[&str]) {
    let fits = |entity: &str, pattern: &str| {
        let same = entity.split('/').zip(pattern.split('/')).all(|(part, pattern)| part == pattern || pattern.starts_with('{'));
        same && entity.matches('/').count() == pattern.matches('/').count()
    };
    let found: BTreeSet<String> = chunks.iter().map(|chunk| chunk.entity_path().to_string().trim_start_matches('/').to_owned()).collect();
    for entity in found.iter().filter(|entity| !entity.starts_with("__")) {
        assert!(patterns.iter().any(|pattern| fits(entity, pattern)), "{entity} is not documented");
    }
    for pattern in patterns {
        assert!(found.iter().any(|entity| fits(entity, pattern)), "nothing is logged to {pattern}");
    }
}
