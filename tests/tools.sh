# Common part of scripts that test the command; to be sourced, with the root of the repository in `top`.

# The command: LINKPROOF, or a new build.
linkproof() {
    if [ -n "${LINKPROOF:-}" ]; then
        realpath "$LINKPROOF"
    else
        cargo build --quiet --release --manifest-path "$top/Cargo.toml"
        echo "${CARGO_TARGET_DIR:-$top/target}/release/linkproof"
    fi
}

# python_with ENVIRONMENT REQUIREMENTS: a Python environment with these packages, created again if the list has changed.
python_with() {
    if ! cmp -s "$2" "$1/installed.txt"; then
        python3 -m venv "$1"
        "$1/bin/pip" install --quiet --disable-pip-version-check -r "$2"
        cp "$2" "$1/installed.txt"
    fi
}
