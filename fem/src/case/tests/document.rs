//! Whether the documents name what a case and the table `[fem]` know.

use super::*;

/// The keys that a table knows, as its refusal of another one lists them.
fn keys_of(table: &str) -> Vec<String> {
    let text = format!("{}\n{table}\nqqqqqqqq = 1\n", "kind = \"fem\"");
    let message = parse(&text).unwrap_err().to_string();
    let list = message.split_once("known here: ").unwrap_or_else(|| panic!("{table}: {message}")).1;
    list.lines().next().unwrap_or_default().split(", ").map(String::from).collect()
}

#[test]
fn every_key_every_generator_and_every_law_is_in_the_document() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs/case.md");
    let document = std::fs::read_to_string(path).unwrap();
    let (mut names, mut tables) = (Vec::new(), keys_of(""));
    assert!(tables.contains(&"mesh".to_string()) && tables.len() > 10, "{tables:?}");
    tables.retain(|t| !["kind", "name", "notes", "mesh", "fabric", "settings"].contains(&t.as_str()));
    for table in tables {
        let header = match table.as_str() {
            "part" | "chamber" => format!("[{table}.x]"),
            "support" | "rigid" | "force" | "obstacle" => format!("[[{table}]]"),
            _ => format!("[{table}]"),
        };
        names.extend(keys_of(&header));
    }
    names.extend(settings::NUMBERS.iter().map(|key| key.name).chain(settings::OTHERS).map(String::from));
    assert!(names.len() > 50, "{names:?}");
    names.extend(GENERATORS.iter().flat_map(|g| g.keys.iter().map(|k| k.key).chain([g.name])).map(String::from));
    let laws = models::fabrics::FABRICS.iter();
    names.extend(laws.flat_map(|l| {
        l.parameters.iter().map(|p| p.key).chain(l.curves.iter().map(|c| c.key)).chain([l.name]).map(String::from)
    }));
    names.extend(models::fabrics::MATERIALS.iter().map(|m| m.name.to_string()));
    for name in names.iter().filter(|n| !n.contains("_kpa")) {
        assert!(document.contains(&format!("`{name}`")) || document.contains(&format!("`\"{name}\"`")), "`{name}`");
    }
}

/// Numbers whose row has their bounds, or says in words what is accepted.
fn have_rows_with_bounds<S>(file: &str, keys: &[DeclaredKey<S>], in_words: &[&str]) {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs").join(file);
    let document = std::fs::read_to_string(path).unwrap();
    let rows: Vec<_> = document.lines().filter(|line| line.starts_with("| `")).collect();
    for key in keys {
        let row = rows
            .iter()
            .find(|row| row.split(" | ").next().is_some_and(|cell| cell.contains(&format!("`{}`", key.name))));
        let row = row.unwrap_or_else(|| panic!("docs/{file} has no row `{}`: {}", key.name, key.meaning));
        let cell = row.split(" | ").nth(2).unwrap_or_default().split(',').next().unwrap_or_default();
        let told: Vec<f64> = cell.replace(' ', "").split('–').map(|bound| bound.parse().unwrap_or(f64::NAN)).collect();
        assert!(told == key.bounds || in_words.contains(&key.name), "bounds of `{}`: {row}", key.name);
    }
}

#[test]
fn every_number_of_the_settings_and_of_the_table_fem_is_in_its_document_with_its_bounds() {
    have_rows_with_bounds("case.md", settings::NUMBERS, &["mass_passes", "output_every_s", "seed"]);
    have_rows_with_bounds("scenario.md", crate::robot::KEYS, &[]);
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs/scenario.md");
    let document = std::fs::read_to_string(path).unwrap();
    for key in crate::robot::OTHERS {
        assert!(document.contains(&format!("`{key}`")), "docs/scenario.md: `{key}`");
    }
}
