//! `docs/json.md`, made from the types that commands print: names and types of keys, and what their doc comments say of them.
//!
//! Types are read from the sources as `rustfmt` leaves them: a struct that derives `Serialize` is a record; one whose doc comment
//! begins with a schema, as `` `ibr.validate`: `ibr validate SCENARIO DATA` ``, is an answer.

use crate::json_source::{Before, Shape, between, fields, meaning, variants};
use crate::support::repository;
use std::cell::RefCell;
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

/// Folders of the crates whose types are read.
const CRATES: [&str; 8] = ["src", "models", "data", "fem", "compare", "sweep", "challenge", "verification"];

const HEAD: &str = "\
# JSON

With `--json` a command prints one JSON object and nothing else.
Two keys are in every object: `schema` is its name, `version` goes up when a key changes its meaning or goes.
New keys may come without a new version.

Types: `number`, `text`, `bool`; a name is a record of the second part; `[]` is a list; a type with `?` may be null.
A key with `?` is not in every object. Numbers that are not finite are null.
Units are in the name of the key too. A column without a unit holds shares, counts, words or records.

This page is made from the types: `IBR_WRITE_JSON_MD=1 cargo test --test fast json_md` writes it.

";

/// One key of a record, as a row of the page.
#[derive(Debug, Clone)]
pub(crate) struct JsonKey {
    pub name: String,
    /// Type of its value, as the page prints it.
    pub kind: String,
    /// Whether the key may be missing.
    pub optional: bool,
    meaning: String,
    unit: String,
}

#[derive(Debug, Clone)]
struct Type {
    /// Crate and file that declare the type.
    part: String,
    file: String,
    is_public: bool,
    docs: String,
    shape: Shape,
}

/// All types that are written as JSON.
pub(crate) struct Types {
    by_name: BTreeMap<String, Vec<Type>>,
    uses: BTreeMap<String, Vec<String>>,
    /// Records that were met, and the file of each.
    met: RefCell<BTreeMap<String, String>>,
}

impl Types {
    /// Reads the types of all sources of [`CRATES`].
    pub(crate) fn read() -> Types {
        let mut types = Types { by_name: BTreeMap::new(), uses: BTreeMap::new(), met: RefCell::default() };
        for part in CRATES {
            let root = repository().join(part);
            types.folder(part, &if part == "src" { root } else { root.join("src") });
        }
        types
    }

    fn folder(&mut self, part: &str, folder: &Path) {
        let mut entries: Vec<_> = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
        entries.sort();
        for path in entries {
            if path.is_dir() {
                self.folder(part, &path);
            } else if path.extension().is_some_and(|end| end == "rs") {
                self.file(part, &path.to_string_lossy(), &std::fs::read_to_string(&path).unwrap());
            }
        }
    }

    fn file(&mut self, part: &str, file: &str, text: &str) {
        let uses = text.replace("\npub(crate) use ", "\nuse ");
        let uses =
            uses.split("\nuse ").skip(1).filter_map(|rest| rest.split_once(';')).map(|(used, _)| used.to_string());
        self.uses.insert(file.into(), uses.collect());
        let mut lines = text.lines();
        let mut before = Before::default();
        while let Some(line) = lines.next() {
            if before.takes(line) {
                // A long list of traits is broken.
                if line == "#[derive(" {
                    before.attributes.extend(lines.by_ref().take_while(|line| *line != ")]"));
                }
                continue;
            }
            let own = std::mem::take(&mut before);
            let words: Vec<&str> = line.split(|c: char| !c.is_alphanumeric() && c != '_').collect();
            let word_after = |word: &str| words.iter().position(|w| *w == word).map(|i| words[i + 1].to_string());
            let serialised = own.attributes.contains("Serialize") && line.ends_with('{');
            let made = if let Some(name) = word_after("type").filter(|_| line.ends_with(';')) {
                let kind = line.split_once(" = ").map(|(_, kind)| kind.trim_end_matches(';').to_string());
                kind.map(|kind| (name, Shape::Alias(kind)))
            } else if let Some(name) = word_after("struct").filter(|_| serialised) {
                Some((name, Shape::Record(fields(&mut lines))))
            } else if let Some(name) = word_after("enum").filter(|_| serialised) {
                Some((name, variants(&mut lines, &own.attributes)))
            } else {
                None
            };
            if let Some((name, shape)) = made {
                let found = Type {
                    part: part.into(),
                    file: file.into(),
                    is_public: line.starts_with("pub "),
                    docs: own.docs(),
                    shape,
                };
                self.by_name.entry(name).or_default().push(found);
            }
        }
    }

    /// The type of that name: of the same file, of the same crate, or the only one.
    fn get(&self, from: &Type, name: &str) -> &Type {
        let all = self.by_name.get(name).unwrap_or_else(|| panic!("{name} in {}: no type that is written", from.file));
        let only = |is: &dyn Fn(&&Type) -> bool| {
            let mut found = all.iter().filter(is);
            found.next().filter(|_| found.next().is_none())
        };
        only(&|t| t.file == from.file)
            .or_else(|| only(&|t| t.part == from.part))
            .or_else(|| only(&|t| self.is_used(&from.file, t, name)))
            .or_else(|| only(&|t| t.is_public))
            .unwrap_or_else(|| panic!("{name} in {}: the name of several types that are written", from.file))
    }

    /// Whether a file takes the name from the crate of that type, or from the prelude.
    fn is_used(&self, file: &str, found: &Type, name: &str) -> bool {
        let words = |used: &str| -> Vec<String> {
            used.split(|c: char| !c.is_alphanumeric() && c != '_').filter(|w| !w.is_empty()).map(String::from).collect()
        };
        let is_prelude = |file: &str| file.ends_with("src/prelude.rs");
        let from =
            |other: &str| other == file || is_prelude(other) && self.uses[file].contains(&"crate::prelude::*".into());
        let mut uses =
            self.uses.iter().filter(|(other, _)| from(other)).flat_map(|(_, used)| used).map(|used| words(used));
        uses.any(|words| words.first() == Some(&found.part) && words.iter().any(|word| word == name))
    }

    /// What a type as written is in JSON, with the words that it may be.
    fn kind(&self, from: &Type, written: &str) -> (String, String) {
        let written = written.trim().trim_start_matches('&').trim();
        let written =
            written.strip_prefix('\'').and_then(|rest| rest.split_once(' ')).map_or(written, |(_, rest)| rest);
        let list = |inside: &str| {
            let (kind, words) = self.kind(from, inside);
            (format!("{kind}[]"), words)
        };
        if let Some(inside) = written.strip_prefix('[').and_then(|rest| rest.strip_suffix(']')) {
            // `[T; N]` has its length behind the last bracket.
            let length = inside.rsplit_once(';').filter(|(_, length)| !length.contains([']', '>']));
            return list(length.map_or(inside, |(inside, _)| inside));
        }
        if written.starts_with('(') {
            return ("list".into(), String::new());
        }
        let (name, inside) = match written.split_once('<') {
            Some((name, rest)) => (name, rest.strip_suffix('>').unwrap_or(rest)),
            None => (written, ""),
        };
        let name = name.rsplit("::").next().unwrap_or(name);
        match name {
            "f64" | "f32" | "usize" | "u64" | "u32" | "u16" | "u8" | "i64" | "i32" => ("number".into(), String::new()),
            "String" | "str" | "char" | "Path" | "PathBuf" => ("text".into(), String::new()),
            "bool" => ("bool".into(), String::new()),
            "Option" => {
                let (kind, words) = self.kind(from, inside);
                (format!("{}?", kind.trim_end_matches('?')), words)
            }
            "Vec" => list(inside),
            "Box" | "Arc" | "Cow" => self.kind(from, inside.trim_start_matches("'a, ")),
            "BTreeMap" => {
                let value = inside.rsplit(", ").next().unwrap_or_default();
                (format!("map of {}", self.kind(from, value).0), String::new())
            }
            // A parameter of a type is one letter.
            "Value" => ("any".into(), String::new()),
            parameter if parameter.len() == 1 => ("any".into(), String::new()),
            _ => {
                let found = self.get(from, name);
                match &found.shape {
                    Shape::Alias(kind) => self.kind(found, kind),
                    Shape::Words(words) => {
                        ("text".into(), words.iter().map(|w| format!("`{w}`")).collect::<Vec<_>>().join(", "))
                    }
                    Shape::Either(names) => {
                        let kinds: Vec<String> = names.iter().map(|n| self.kind(found, n).0).collect();
                        (kinds.join(" or "), String::new())
                    }
                    Shape::Record(_) => {
                        let before = self.met.borrow_mut().insert(name.into(), found.file.clone());
                        let one = before.is_none_or(|file| file == found.file);
                        assert!(one, "two records of the JSON are called {name}: rename one");
                        (name.to_string(), String::new())
                    }
                }
            }
        }
    }

    fn keys(&self, found: &Type) -> Vec<JsonKey> {
        let Shape::Record(fields) = &found.shape else { panic!("{found:?} is no record") };
        let mut keys = Vec::new();
        for field in fields {
            let has = |word: &str| field.serde.split(['(', ')', ',', ' ']).any(|part| part == word);
            if has("skip") {
                continue;
            }
            let (kind, words) = self.kind(found, &field.kind);
            if has("flatten") {
                let name = kind.trim_end_matches('?');
                keys.extend(self.keys(self.get(found, name)));
                continue;
            }
            let name = between(&field.serde, "rename = \"", '"').unwrap_or(&field.name).to_string();
            let (meaning, unit) = meaning(&field.docs, &name);
            let nullable = meaning.contains("null") && !kind.ends_with('?');
            let kind = match kind.strip_suffix("[]").filter(|_| nullable) {
                Some("number") => "number?[]".to_string(),
                _ if nullable => format!("{kind}?"),
                _ => kind,
            };
            let optional = has("skip_serializing_if");
            // What is left out is never null.
            let kind = if optional { kind.trim_end_matches('?').to_string() } else { kind };
            let meaning = if words.is_empty() { meaning } else { format!("{meaning}: {words}") };
            keys.push(JsonKey { name, kind, optional, meaning, unit });
        }
        keys.sort_by(|a, b| a.name.cmp(&b.name));
        keys
    }

    /// Answers by their schema: what is typed for one, and its keys.
    pub(crate) fn answers(&self) -> BTreeMap<String, (String, Vec<JsonKey>)> {
        let schema = |found: &Type| {
            let rest = found.docs.strip_prefix("`ibr.")?;
            let (name, typed) = rest.split_once("`: ")?;
            Some((format!("ibr.{name}"), (typed.to_string(), self.keys(found))))
        };
        self.by_name.values().flatten().filter_map(schema).collect()
    }

    /// All records that these keys lead to, by name.
    pub(crate) fn records<'k>(&self, from: impl Iterator<Item = &'k JsonKey>) -> BTreeMap<String, Vec<JsonKey>> {
        let mut found: BTreeMap<String, Vec<JsonKey>> = BTreeMap::new();
        let mut next: BTreeSet<String> = from.flat_map(records_of).collect();
        while let Some(name) = next.pop_first() {
            let file = self.met.borrow()[&name].clone();
            let keys = self.keys(self.by_name[&name].iter().find(|t| t.file == file).unwrap());
            next.extend(keys.iter().flat_map(records_of).filter(|name| !found.contains_key(name)));
            found.insert(name, keys);
        }
        found
    }

    /// The whole page as Markdown: answers, then records.
    pub(crate) fn page(&self) -> String {
        let (mut page, answers) = (HEAD.to_string() + "## Answers\n", self.answers());
        for (schema, (typed, keys)) in &answers {
            let version = if schema == "ibr.bench" { 2 } else { 1 };
            page += &format!("\n### {schema} {version}\n\n{typed}\n\n{}", table(keys));
        }
        page += "\n## Records\n";
        for (name, keys) in self.records(answers.values().flat_map(|(_, keys)| keys)) {
            page += &format!("\n### {name}\n\n{}", table(&keys));
        }
        page
    }
}

/// Names of records in a type.
fn records_of(key: &JsonKey) -> Vec<String> {
    let names = key.kind.split(" or ").map(|kind| kind.trim_start_matches("map of ").trim_end_matches(['?', '[', ']']));
    names.filter(|name| name.starts_with(char::is_uppercase)).map(String::from).collect()
}

fn table(keys: &[JsonKey]) -> String {
    let row = |key: &JsonKey| {
        let mark = if key.optional { "?" } else { "" };
        format!("| {}{mark} | {} | {} | {} |\n", key.name, key.kind, key.unit, key.meaning.replace('|', "\\|"))
    };
    format!("| key | type | unit | meaning |\n|---|---|---|---|\n{}", keys.iter().map(row).collect::<String>())
}

/// `docs/json.md` is stale when a type or a comment of one changed.
#[test]
fn json_md_is_that_of_the_types() {
    let (path, made) = (repository().join("docs/json.md"), Types::read().page());
    if std::env::var_os("IBR_WRITE_JSON_MD").is_some() {
        std::fs::write(&path, &made).unwrap();
    }
    let there = std::fs::read_to_string(path).unwrap();
    let first = there.lines().zip(made.lines()).find(|(there, made)| there != made);
    assert!(
        there == made,
        "docs/json.md is older than the types: write it with IBR_WRITE_JSON_MD=1 cargo test --test fast json_md; first difference: {first:?}"
    );
}
