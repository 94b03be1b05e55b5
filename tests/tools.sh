# What scripts that try the command share; to be sourced, with the top of the repository in `top`.

# The command: LINKPROOF, or what is built now.
linkproof() {
    if [ -n "${LINKPROOF:-}" ]; then
        realpath "$LINKPROOF"
    else
        cargo build --quiet --release --manifest-path "$top/Cargo.toml"
        echo "${CARGO_TARGET_DIR:-$top/target}/release/linkproof"
    fi
}

# python_with ENVIRONMENT REQUIREMENTS: an environment of Python with these packages, made anew where they have changed.
python_with() {
    if ! cmp -s "$2" "$1/installed.txt"; then
        python3 -m venv "$1"
        "$1/bin/pip" install --quiet --disable-pip-version-check -r "$2"
        cp "$2" "$1/installed.txt"
    fi
}
