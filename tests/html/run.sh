#!/bin/sh
# Opens pages of `linkproof run --html` in headless Chromium: tests/html/run.sh [SCENARIO...]
#
# Default: all of scenarios/*.toml, and runs whose pages differ in kind (one that disagrees, several engines, ...). Pages and screenshots stay in target/html-pages.
# Python packages go into target/html-venv. LINKPROOF names a command that is built already, CHROMIUM a browser.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
top=$(cd "$here/../.." && pwd)
environment="$top/target/html-venv"
pages="$top/target/html-pages"

if [ -z "${CHROMIUM:-}" ]; then
    for name in chromium chromium-browser google-chrome; do
        CHROMIUM=$(command -v "$name") && break
    done
fi
if [ -z "${CHROMIUM:-}" ]; then
    echo "no Chromium here: install it (Debian: chromium), or name one in CHROMIUM" >&2
    exit 1
fi
if [ -n "${LINKPROOF:-}" ]; then
    linkproof=$(realpath "$LINKPROOF")
else
    cargo build --quiet --release --manifest-path "$top/Cargo.toml"
    linkproof="${CARGO_TARGET_DIR:-$top/target}/release/linkproof"
fi
if ! cmp -s "$here/requirements.txt" "$environment/installed.txt"; then
    python3 -m venv "$environment"
    "$environment/bin/pip" install --quiet --disable-pip-version-check -r "$here/requirements.txt"
    cp "$here/requirements.txt" "$environment/installed.txt"
fi
mkdir -p "$pages"
what=some
if [ $# -eq 0 ]; then
    what=everything
    set -- "$top"/scenarios/*.toml
fi
"$environment/bin/python" "$here/check.py" "$linkproof" "$CHROMIUM" "$pages" "$what" "$@"
