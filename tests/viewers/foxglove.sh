#!/bin/sh
# Shows recordings with their layouts in the open-source Foxglove Studio: tests/viewers/foxglove.sh PICTURES FILE.mcap...
#
# The last open-source version is a library on npm, and foxglove.html is a page that uses it. Python needs the packages of requirements.txt.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
packages="$here/../../target/foxglove"
pictures=$1
shift
if ! command -v npm >/dev/null || ! { command -v chromium || command -v google-chrome; } >/dev/null; then
    echo "Foxglove Studio is skipped: npm and chromium are not installed"
    exit 0
fi
if [ ! -e "$packages/node_modules/@foxglove/studio-base/assets/index.js" ]; then
    mkdir -p "$packages"
    (cd "$packages" && npm install --no-save --ignore-scripts --no-audit --no-fund --silent \
        @foxglove/studio-base@1.48.0 react@17.0.2 react-dom@17.0.2)
fi
mkdir -p "$pictures"
failed=0
for file in "$@"; do
    python "$here/foxglove.py" "$packages" "$file" "$pictures/$(basename "$file" .mcap).foxglove.png" || failed=1
done
exit $failed
