#!/bin/sh
# Opens pages of `linkproof run --html` in headless Chromium: tests/html/run.sh [SCENARIO...]
#
# Default: all of scenarios/*.toml, and runs whose pages differ in kind (one that disagrees, several engines, ...). Pages and screenshots stay in target/html-pages.
# Python packages go into target/html-venv. LINKPROOF names the built command, CHROMIUM a browser.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
top=$(cd "$here/../.." && pwd)
. "$top/tests/tools.sh"
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
linkproof=$(linkproof)
python_with "$environment" "$here/requirements.txt"
mkdir -p "$pages"
what=some
if [ $# -eq 0 ]; then
    what=everything
    set -- "$top"/scenarios/*.toml
fi
"$environment/bin/python" "$here/check.py" "$linkproof" "$CHROMIUM" "$pages" "$what" "$@"
if [ "$what" = everything ]; then
    "$environment/bin/python" "$here/watch.py" "$linkproof" "$CHROMIUM" "$pages"
fi
