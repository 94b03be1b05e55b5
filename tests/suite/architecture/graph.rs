//! Determines which source file of the workspace uses which other source file.
//!
//! Paths are followed through modules, imports and re-exports to the file that defines the named item. Code under
//! `#[cfg(test)]` does not count, because tests may use anything.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

use proc_macro2::{TokenStream, TokenTree};
use syn::visit::Visit;
use syn::{Attribute, Item, UseTree};

/// A module: its file, its definitions, its imports.
#[derive(Default)]
struct Module {
    file: PathBuf,
    /// Names of items other than modules.
    items: BTreeSet<String>,
    /// Names brought in by `use`, and the paths that they denote.
    imports: BTreeMap<String, Vec<String>>,
    /// Modules from which all names are brought in.
    globs: Vec<Vec<String>>,
    /// All paths in the code, both those of private imports and those written out where they are used.
    paths: Vec<Vec<String>>,
    /// Macros that the module calls.
    macros: BTreeSet<String>,
}

/// All modules of the workspace, by their path, which begins with the name of the crate.
pub struct Graph {
    modules: BTreeMap<Vec<String>, Module>,
}

impl Graph {
    /// Reads crates: name and root file of each.
    pub fn of(crates: &[(&str, PathBuf)]) -> Self {
        let mut modules = BTreeMap::new();
        for (name, root) in crates {
            let directory = root.parent().unwrap().to_path_buf();
            read(&mut modules, vec![(*name).to_string()], root, &directory);
        }
        Graph { modules }
    }

    /// Edges between files: the using file, the used file, and the path in the code that names the item.
    pub fn edges(&self) -> BTreeMap<(PathBuf, PathBuf), String> {
        let mut edges = BTreeMap::new();
        for (at, module) in &self.modules {
            for path in &module.paths {
                let Some(to) = self.definer(at, path, 0) else { continue };
                let to = &self.modules[&to].file;
                if *to != module.file {
                    edges.entry((module.file.clone(), to.clone())).or_insert_with(|| path.join("::"));
                }
            }
        }
        edges
    }

    /// For each file, the names that it uses: all words of its paths, and its macros.
    pub fn names(&self) -> BTreeMap<PathBuf, BTreeSet<String>> {
        let mut names: BTreeMap<PathBuf, BTreeSet<String>> = BTreeMap::new();
        for module in self.modules.values() {
            let own = names.entry(module.file.clone()).or_default();
            own.extend(module.paths.iter().flatten().cloned());
            own.extend(module.macros.iter().cloned());
        }
        names
    }

    /// The module that defines the item that `path` names in the module `at`.
    /// `None` if the name is foreign, or if the path names a module.
    fn definer(&self, at: &[String], path: &[String], depth: usize) -> Option<Vec<String>> {
        if depth > 16 {
            return None;
        }
        let (mut at, mut rest) = (at.to_vec(), path);
        match rest.first()?.as_str() {
            "crate" => (at, rest) = (vec![at[0].clone()], &rest[1..]),
            "self" => rest = &rest[1..],
            "super" => {
                while rest.first().is_some_and(|word| word == "super") {
                    at.pop();
                    rest = &rest[1..];
                }
            }
            name => {
                let known = self.child(&at, name).is_some()
                    || self.modules[&at].items.contains(name)
                    || self.modules[&at].imports.contains_key(name);
                if !known && self.modules.contains_key(&vec![name.to_string()]) {
                    (at, rest) = (vec![name.to_string()], &rest[1..]);
                }
            }
        }
        loop {
            let name = rest.first()?;
            let module = self.modules.get(&at)?;
            if let Some(child) = self.child(&at, name) {
                (at, rest) = (child, &rest[1..]);
                continue;
            }
            if module.items.contains(name) {
                return Some(at);
            }
            if let Some(target) = module.imports.get(name) {
                let whole: Vec<String> = target.iter().chain(&rest[1..]).cloned().collect();
                return if whole == path { None } else { self.definer(&at, &whole, depth + 1) };
            }
            let through = |glob: &Vec<String>| {
                let whole: Vec<String> = glob.iter().chain(rest).cloned().collect();
                self.definer(&at, &whole, depth + 1)
            };
            return module.globs.iter().find_map(through);
        }
    }

    fn child(&self, at: &[String], name: &str) -> Option<Vec<String>> {
        let path: Vec<String> = at.iter().cloned().chain([name.to_string()]).collect();
        self.modules.contains_key(&path).then_some(path)
    }
}

/// Reads a module from its file, and then its submodules.
/// `directory` contains the files of the submodules.
fn read(modules: &mut BTreeMap<Vec<String>, Module>, at: Vec<String>, file: &Path, directory: &Path) {
    let text = fs::read_to_string(file).unwrap_or_else(|error| panic!("{}: {error}", file.display()));
    let code = syn::parse_file(&text).unwrap_or_else(|error| panic!("{}: {error}", file.display()));
    take(modules, at, file, directory, &code.items);
}

fn take(modules: &mut BTreeMap<Vec<String>, Module>, at: Vec<String>, file: &Path, directory: &Path, items: &[Item]) {
    let mut module = Module { file: file.to_path_buf(), ..Module::default() };
    for item in items {
        if is_test(attributes(item)) {
            continue;
        }
        match item {
            Item::Mod(inner) => {
                let name = inner.ident.to_string();
                let below = directory.join(&name);
                let path: Vec<String> = at.iter().cloned().chain([name]).collect();
                if let Some((_, items)) = &inner.content {
                    take(modules, path, file, &below, items);
                } else if let Some(own) = own_path(&inner.attrs) {
                    let own = file.parent().unwrap().join(own);
                    let under = own.parent().unwrap().to_path_buf();
                    read(modules, path, &own, &under);
                } else {
                    read(modules, path, &below.with_extension("rs"), &below);
                }
            }
            Item::Use(import) => {
                // A re-export is no dependency: code that names the re-exported item depends on the file that
                // defines the item.
                let handed_on = !matches!(import.vis, syn::Visibility::Inherited);
                let mut leaves = Vec::new();
                expand(&import.tree, &mut Vec::new(), &mut leaves);
                for (path, name) in leaves {
                    if name == "*" {
                        module.globs.push(path.clone());
                    } else {
                        module.imports.insert(name, path.clone());
                    }
                    if !handed_on {
                        module.paths.push(path);
                    }
                }
            }
            other => {
                module.items.extend(name_of(other));
                let mut finder = Finder { paths: &mut module.paths, macros: &mut module.macros };
                finder.visit_item(other);
            }
        }
    }
    modules.insert(at, module);
}

struct Finder<'a> {
    paths: &'a mut Vec<Vec<String>>,
    macros: &'a mut BTreeSet<String>,
}

impl<'ast> Visit<'ast> for Finder<'_> {
    fn visit_path(&mut self, path: &'ast syn::Path) {
        if path.segments.len() > 1 {
            self.paths.push(path.segments.iter().map(|segment| segment.ident.to_string()).collect());
        }
        syn::visit::visit_path(self, path);
    }

    fn visit_macro(&mut self, call: &'ast syn::Macro) {
        self.visit_path(&call.path);
        self.macros.extend(call.path.segments.last().map(|segment| segment.ident.to_string()));
        words(call.tokens.clone(), self.paths);
    }

    fn visit_item_use(&mut self, import: &'ast syn::ItemUse) {
        let mut leaves = Vec::new();
        expand(&import.tree, &mut Vec::new(), &mut leaves);
        self.paths.extend(leaves.into_iter().map(|(path, _)| path));
    }
}

/// Paths in the tokens of a macro.
fn words(tokens: TokenStream, paths: &mut Vec<Vec<String>>) {
    let (mut path, mut joined) = (Vec::new(), 0);
    let mut end = |path: &mut Vec<String>| {
        if path.len() > 1 {
            paths.push(path.clone());
        }
        path.clear();
    };
    let mut groups = Vec::new();
    for token in tokens {
        match token {
            TokenTree::Ident(word) => {
                if joined < 2 {
                    end(&mut path);
                }
                path.push(word.to_string());
                joined = 0;
            }
            TokenTree::Punct(sign) if sign.as_char() == ':' => joined += 1,
            TokenTree::Group(group) => {
                groups.push(group.stream());
                end(&mut path);
                joined = 0;
            }
            _ => {
                end(&mut path);
                joined = 0;
            }
        }
    }
    end(&mut path);
    for group in groups {
        words(group, paths);
    }
}

/// Leaves of an import tree: for each leaf, the whole path and the local name.
fn expand(tree: &UseTree, before: &mut Vec<String>, leaves: &mut Vec<(Vec<String>, String)>) {
    match tree {
        UseTree::Path(path) => {
            before.push(path.ident.to_string());
            expand(&path.tree, before, leaves);
            before.pop();
        }
        UseTree::Name(name) if name.ident == "self" => {
            leaves.push((before.clone(), before.last().cloned().unwrap_or_default()));
        }
        UseTree::Name(name) => leaves.push((with(before, &name.ident), name.ident.to_string())),
        UseTree::Rename(name) => leaves.push((with(before, &name.ident), name.rename.to_string())),
        UseTree::Glob(_) => leaves.push((before.clone(), "*".to_string())),
        UseTree::Group(group) => group.items.iter().for_each(|tree| expand(tree, before, leaves)),
    }
}

fn with(before: &[String], name: &syn::Ident) -> Vec<String> {
    before.iter().cloned().chain([name.to_string()]).collect()
}

fn is_test(attributes: &[Attribute]) -> bool {
    let word = |c: char| !c.is_alphanumeric();
    let tests = |list: &syn::MetaList| list.tokens.to_string().split(word).any(|word| word == "test");
    attributes.iter().any(|own| own.path().is_ident("cfg") && own.meta.require_list().is_ok_and(tests))
}

fn own_path(attributes: &[Attribute]) -> Option<String> {
    attributes.iter().find(|attribute| attribute.path().is_ident("path")).and_then(|attribute| {
        let syn::Meta::NameValue(pair) = &attribute.meta else { return None };
        let syn::Expr::Lit(syn::ExprLit { lit: syn::Lit::Str(text), .. }) = &pair.value else { return None };
        Some(text.value())
    })
}

fn attributes(item: &Item) -> &[Attribute] {
    match item {
        Item::Const(item) => &item.attrs,
        Item::Enum(item) => &item.attrs,
        Item::Fn(item) => &item.attrs,
        Item::Impl(item) => &item.attrs,
        Item::Macro(item) => &item.attrs,
        Item::Mod(item) => &item.attrs,
        Item::Static(item) => &item.attrs,
        Item::Struct(item) => &item.attrs,
        Item::Trait(item) => &item.attrs,
        Item::Type(item) => &item.attrs,
        Item::Use(item) => &item.attrs,
        _ => &[],
    }
}

fn name_of(item: &Item) -> Option<String> {
    Some(match item {
        Item::Const(item) => item.ident.to_string(),
        Item::Enum(item) => item.ident.to_string(),
        Item::Fn(item) => item.sig.ident.to_string(),
        Item::Macro(item) => item.ident.as_ref()?.to_string(),
        Item::Static(item) => item.ident.to_string(),
        Item::Struct(item) => item.ident.to_string(),
        Item::Trait(item) => item.ident.to_string(),
        Item::Type(item) => item.ident.to_string(),
        Item::Union(item) => item.ident.to_string(),
        _ => return None,
    })
}
