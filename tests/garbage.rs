//! Garbage never crashes a parser: mutated files of the repository and random text, for every entry of `fuzz/entries.rs`.

use crate::entries;

use proptest::prelude::*;

/// Texts that some parser accepts.
const SEEDS: [&str; 9] = [
    include_str!("certs/run/case.toml"),
    include_str!("certs/run/0-itself.json"),
    "%%MatrixMarket matrix coordinate integer general\n% denominator: 64\n2 2 2\n1 1 3\n2 2 -5\n",
    "matrix(QQ, [[1/2, 0], [0, 1.25e-3]])",
    "{{1/2, 0}, {0, 1}}",
    "2\n1 0\n0 1/3\n",
    "(1+z)^3*(2-z^-1)/8",
    "fern {\n 0 0 0 .16 0 0 .01\n .85 .04 -.04 .85 0 1.6 .85\n}\n",
    "{\"maps\": [{\"linear\": [[\"1/2\", 0], [0, 0.5]], \"shift\": [0, 1]}]}",
];

/// Pieces that grammars are sensitive to.
const TOKENS: [&str; 16] = [
    "\"",
    "[",
    "]",
    "{",
    "}",
    "(",
    ")",
    "1e999999999",
    "-",
    "/0",
    "\n",
    "=",
    "#",
    "99999999999999999999",
    "\u{0}",
    "é",
];

fn mutated() -> impl Strategy<Value = String> {
    let edit = (any::<prop::sample::Index>(), 0..TOKENS.len(), 0..3_usize);
    (0..SEEDS.len(), prop::collection::vec(edit, 1..6)).prop_map(|(seed, edits)| {
        let mut text: Vec<char> = SEEDS[seed].chars().collect();
        for (place, token, kind) in edits {
            let k = place.index(text.len() + 1).min(text.len());
            match kind {
                0 => drop(text.splice(k..k, TOKENS[token].chars())),
                1 => text.truncate(k.max(1)),
                _ => drop(text.splice(k..(k + 3).min(text.len()), TOKENS[token].chars())),
            }
        }
        text.into_iter().collect()
    })
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 200, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn mutated_files_never_crash(text in mutated()) {
        for (name, _) in entries::ENTRIES {
            entries::feed(name, &text);
        }
    }

    #[test]
    fn random_text_never_crashes(text in "\\PC{0,80}") {
        for (name, _) in entries::ENTRIES {
            entries::feed(name, &text);
        }
    }
}
