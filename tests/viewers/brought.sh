#!/bin/sh
# Shows recordings in viewers that are in no package registry: LICHTBLICK=DIRECTORY PLOTJUGGLER=COMMAND tests/viewers/brought.sh [FILE.mcap...]
#
# LICHTBLICK is the directory of Lichtblick's built web page, with index.html. PLOTJUGGLER is the installed command.
# Either may be left out. Default: recordings/*.mcap. Pictures stay in target/viewers-pictures for inspection.
# Lichtblick needs chromium, PlotJuggler needs Xvfb. LINKPROOF names the built command.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
top=$(cd "$here/../.." && pwd)
. "$top/tests/tools.sh"
environment="$top/target/viewers-venv"
pictures="$top/target/viewers-pictures"

if [ -z "${LICHTBLICK:-}${PLOTJUGGLER:-}" ]; then
    echo "neither LICHTBLICK nor PLOTJUGGLER is set: name a viewer" >&2
    exit 2
fi
[ $# -gt 0 ] || set -- "$top"/recordings/*.mcap
linkproof=$(linkproof)
python_with "$environment" "$here/requirements.txt"
PATH="$environment/bin:$PATH"
mkdir -p "$pictures"
failed=0
for file in "$@"; do
    name=$(basename "$file" .mcap)
    if [ -n "${LICHTBLICK:-}" ]; then
        python "$here/lichtblick.py" "$LICHTBLICK" "$file" "$pictures/$name.lichtblick.png" || failed=1
    fi
    if [ -n "${PLOTJUGGLER:-}" ]; then
        python "$here/plotjuggler.py" "$PLOTJUGGLER" "$linkproof" "$file" "$pictures/$name.plotjuggler.png" || failed=1
    fi
done
exit $failed
