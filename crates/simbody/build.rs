//! Compiles the shim and links the Simbody library. Simbody comes from a package of the operating system.

use std::env;
use std::path::{Path, PathBuf};
use std::process::exit;

fn main() {
    println!("cargo::rerun-if-env-changed=SIMBODY_HOME");
    for file in ["src/shim.cpp", "src/shim.h"] {
        println!("cargo::rerun-if-changed={file}");
    }
    // On docs.rs Simbody is not installed. The documentation does not need the library, so nothing is compiled here.
    if env::var_os("DOCS_RS").is_some() {
        return;
    }
    // If `SIMBODY_HOME` is set, its path is the only candidate. Simbody's build files use the same variable.
    // If `SIMBODY_HOME` is not set, the candidates are the prefixes of Debian and of a build from source.
    let home = env::var_os("SIMBODY_HOME").map(PathBuf::from);
    let prefixes: Vec<PathBuf> = match &home {
        Some(home) => vec![home.clone()],
        None => vec!["/usr".into(), "/usr/local".into()],
    };
    let Some(prefix) = prefixes.iter().find(|prefix| headers(prefix).join("Simbody.h").is_file()) else {
        let places: Vec<String> = prefixes.iter().map(|prefix| headers(prefix).display().to_string()).collect();
        eprintln!(
            "error: Simbody's headers are needed for the feature `simbody`, but there is no Simbody.h in {}; install \
             them (Debian and Ubuntu: apt-get install libsimbody-dev), or name the prefix of your own build in \
             SIMBODY_HOME",
            places.join(" or ")
        );
        exit(1);
    };
    cc::Build::new()
        .cpp(true)
        .std("c++11")
        .file("src/shim.cpp")
        // Simbody's headers are included as system headers, because they would otherwise cause compiler warnings.
        .flag("-isystem")
        .flag(headers(prefix))
        .warnings_into_errors(false)
        .extra_warnings(true)
        // Simbody's headers contain assertions that depend on `NDEBUG`. Simbody's library was built with `NDEBUG`, so
        // the shim is built with `NDEBUG` too.
        .define("NDEBUG", None)
        .compile("linkproof_simbody_shim");
    if home.is_some() {
        for directory in ["lib", "lib64"].map(|name| prefix.join(name)).iter().filter(|path| path.is_dir()) {
            println!("cargo::rustc-link-search=native={}", directory.display());
        }
    }
    for library in ["SimTKsimbody", "SimTKmath", "SimTKcommon"] {
        println!("cargo::rustc-link-lib=dylib={library}");
    }
}

fn headers(prefix: &Path) -> PathBuf {
    prefix.join("include").join("simbody")
}
