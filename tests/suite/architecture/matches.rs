//! How many places the compiler asks for when a load is added.

use std::fs;

use syn::visit::Visit;
use syn::{Arm, ExprMatch, File, ItemMod, Pat};

use super::{CRATES, rust_files, top};

/// Matches that list the variants of `Load`, test code aside.
struct Matches(usize);

impl<'ast> Visit<'ast> for Matches {
    fn visit_item_mod(&mut self, module: &'ast ItemMod) {
        if module.ident != "tests" {
            syn::visit::visit_item_mod(self, module);
        }
    }

    fn visit_expr_match(&mut self, found: &'ast ExprMatch) {
        let lists = |arm: &Arm| !matches!(arm.pat, Pat::Wild(_)) && names(&arm.pat);
        self.0 += usize::from(found.arms.len() > 1 && found.arms.iter().all(lists));
        syn::visit::visit_expr_match(self, found);
    }
}

/// Whether a pattern is made of variants of `Load`.
fn names(pattern: &Pat) -> bool {
    match pattern {
        Pat::Struct(of) => of.path.segments.first().is_some_and(|first| first.ident == "Load"),
        Pat::Or(of) => of.cases.iter().all(names),
        Pat::Reference(of) => names(&of.pat),
        _ => false,
    }
}

#[test]
fn the_number_of_matches_on_loads_is_the_one_that_is_told() {
    let (mut matches, mut files) = (0, 0);
    for (_, directory, ..) in CRATES {
        let sources = rust_files(&top().join(directory).join("src"));
        for path in sources.iter().filter(|path| !path.ends_with("tests.rs")) {
            let code: File = syn::parse_file(&fs::read_to_string(path).unwrap()).unwrap();
            let mut own = Matches(0);
            own.visit_file(&code);
            matches += own.0;
            files += usize::from(own.0 > 0);
        }
    }
    let told = format!("{matches} matches in {files} files on `Load`");
    let page = fs::read_to_string(top().join("ARCHITECTURE.md")).unwrap();
    assert!(page.contains(&told), "ARCHITECTURE.md does not say \"{told}\"");
}
