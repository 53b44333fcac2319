//! Files of a crate import each other in one direction: no file needs, over any number of others, itself.
//!
//! An arrow leads from a file to the file that defines what it names by `crate::`, `super::` or the name of a submodule; a re-export is
//! followed to its source. Tests do not count. `cargo test -p ibr-spelling --test circles -- --nocapture` prints every circle.

#![allow(clippy::unwrap_used, reason = "tests: a panic is the failure to report")]

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

use petgraph::algo::tarjan_scc;
use petgraph::graphmap::DiGraphMap;
use syn::visit::Visit;

/// Circles of files in each crate. The numbers only fall: lower one when a circle is broken.
const CIRCLES: [(&str, usize); 13] = [
    ("models", 0),
    ("fem", 0),
    ("data", 0),
    ("compare", 0),
    ("report", 0),
    ("sweep", 0),
    ("spelling", 0),
    ("python", 0),
    ("capi", 0),
    ("web", 0),
    ("challenge", 0),
    ("verification", 0),
    (".", 0),
];

/// Name of a module from the root of its crate.
type Module = Vec<String>;

/// A file of a crate: what it names, and what it passes on under a name.
#[derive(Default)]
struct Source {
    /// Paths from the root of the crate.
    names: BTreeSet<Module>,
    /// What `use` makes known in this module: the name, and where it comes from.
    passes_on: BTreeMap<String, Module>,
}

struct Reader<'a> {
    here: &'a Module,
    source: Source,
    children: &'a BTreeSet<Module>,
}

fn is_test(attributes: &[syn::Attribute]) -> bool {
    attributes.iter().any(|a| match &a.meta {
        syn::Meta::List(list) => list.path.is_ident("cfg") && list.tokens.to_string().contains("test"),
        _ => false,
    })
}

impl Reader<'_> {
    /// A path as seen from the root of the crate; `None`: it leaves the crate, or names something in this file.
    fn absolute(&self, path: &[String]) -> Option<Module> {
        let up = path.iter().take_while(|s| *s == "super").count();
        let (mut from, rest) = match path.first()?.as_str() {
            "crate" => (vec![], &path[1..]),
            "self" => (self.here.clone(), &path[1..]),
            "super" => (self.here[..self.here.len().checked_sub(up)?].to_vec(), &path[up..]),
            first => {
                let child = [self.here.as_slice(), &[first.to_string()]].concat();
                if !self.children.contains(&child) {
                    return None;
                }
                (self.here.clone(), path)
            }
        };
        from.extend(rest.iter().cloned());
        Some(from)
    }

    fn tree(&mut self, before: &[String], tree: &syn::UseTree) {
        let with = |name: &syn::Ident| [before, &[name.to_string()]].concat();
        let (path, name) = match tree {
            syn::UseTree::Path(path) => return self.tree(&with(&path.ident), &path.tree),
            syn::UseTree::Group(group) => return group.items.iter().for_each(|item| self.tree(before, item)),
            syn::UseTree::Name(name) if name.ident == "self" => (before.to_vec(), before.last().cloned()),
            syn::UseTree::Name(name) => (with(&name.ident), Some(name.ident.to_string())),
            syn::UseTree::Rename(rename) => (with(&rename.ident), Some(rename.rename.to_string())),
            syn::UseTree::Glob(_) => (before.to_vec(), None),
        };
        let Some(path) = self.absolute(&path) else { return };
        if let Some(name) = name {
            self.source.passes_on.insert(name, path.clone());
        }
        self.source.names.insert(path);
    }
}

impl<'ast> Visit<'ast> for Reader<'_> {
    fn visit_item_mod(&mut self, item: &'ast syn::ItemMod) {
        if !is_test(&item.attrs) {
            syn::visit::visit_item_mod(self, item);
        }
    }
    fn visit_item_fn(&mut self, item: &'ast syn::ItemFn) {
        if !is_test(&item.attrs) {
            syn::visit::visit_item_fn(self, item);
        }
    }
    fn visit_item_use(&mut self, item: &'ast syn::ItemUse) {
        if is_test(&item.attrs) || item.leading_colon.is_some() {
            return;
        }
        let only_passed_on = !matches!(item.vis, syn::Visibility::Inherited);
        let named = self.source.names.clone();
        self.tree(&[], &item.tree);
        if only_passed_on {
            self.source.names = named;
        }
    }
    fn visit_path(&mut self, path: &'ast syn::Path) {
        let segments: Vec<String> = path.segments.iter().map(|s| s.ident.to_string()).collect();
        // `::compare::…` is another crate.
        if segments.len() > 1
            && path.leading_colon.is_none()
            && let Some(path) = self.absolute(&segments)
        {
            self.source.names.insert(path);
        }
        syn::visit::visit_path(self, path);
    }
}

fn files(folder: &Path, found: &mut Vec<PathBuf>) {
    for path in fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()) {
        let name = path.file_stem().unwrap().to_string_lossy().into_owned();
        if path.is_dir() && name != "tests" {
            files(&path, found);
        } else if path.extension().is_some_and(|end| end == "rs") && name != "tests" && !name.ends_with("_tests") {
            found.push(path);
        }
    }
}

fn module(source: &Path, file: &Path) -> Module {
    let inner = file.strip_prefix(source).unwrap().with_extension("");
    let mut names: Module = inner.iter().map(|s| s.to_string_lossy().into_owned()).collect();
    if matches!(names.last().map(String::as_str), Some("mod" | "lib" | "main")) {
        names.pop();
    }
    names
}

/// The module that defines what a path names: as far down as modules go, through whatever passes the next name on.
fn defined_in<'a>(path: &[String], sources: &'a BTreeMap<Module, Source>, steps: usize) -> Option<&'a Module> {
    let known = (0..=path.len()).rev().find_map(|n| sources.get_key_value(&path[..n]))?;
    let (module, rest) = (known.0, &path[known.0.len()..]);
    match rest.first().and_then(|name| known.1.passes_on.get(name)) {
        Some(other) if steps > 0 => defined_in(&[other.as_slice(), &rest[1..]].concat(), sources, steps - 1),
        _ => Some(module),
    }
}

fn circles_of(source: &Path) -> Vec<Vec<Module>> {
    let mut paths = Vec::new();
    files(source, &mut paths);
    let modules: BTreeSet<Module> = paths.iter().map(|file| module(source, file)).collect();
    let mut sources = BTreeMap::new();
    for file in &paths {
        let here = module(source, file);
        let mut reader = Reader { here: &here, source: Source::default(), children: &modules };
        let parsed = syn::parse_file(&fs::read_to_string(file).unwrap()).unwrap();
        reader.visit_file(&parsed);
        let source = reader.source;
        sources.insert(here, source);
    }
    let mut arrows: DiGraphMap<&Module, ()> = DiGraphMap::new();
    for (from, source) in &sources {
        for to in source.names.iter().filter_map(|path| defined_in(path, &sources, 16)).filter(|to| *to != from) {
            arrows.add_edge(from, to, ());
        }
    }
    let groups = tarjan_scc(&arrows).into_iter().filter(|group| group.len() > 1);
    groups.map(|group| group.into_iter().cloned().collect()).collect()
}

#[test]
fn no_file_needs_itself_over_others() {
    let mut wrong = Vec::new();
    for (name, allowed) in CIRCLES {
        let found = circles_of(&Path::new(env!("CARGO_MANIFEST_DIR")).join("..").join(name).join("src"));
        for circle in &found {
            let names: Vec<String> = circle.iter().map(|module| module.join("::")).collect();
            println!("{name}: {} files: {}", circle.len(), names.join(", "));
        }
        if found.len() > allowed {
            wrong.push(format!("{name}: {} circles of files, {allowed} in the list", found.len()));
        }
    }
    assert!(wrong.is_empty(), "{wrong:#?}; run with -- --nocapture to see them");
}
