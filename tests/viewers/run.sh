#!/bin/sh
# Opens recordings with programs that are not ours: tests/viewers/run.sh [FILE...], default recordings/*.mcap
# and, of a mechanism with sliders, a recording made for the purpose: scenarios/compressor.toml.
# Python packages go into target/viewers-venv.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
top=$(cd "$here/../.." && pwd)
environment="$top/target/viewers-venv"

if [ $# -eq 0 ]; then
    set -- "$top"/recordings/*.mcap
    if [ ! -e "$1" ]; then
        echo "no recordings in $top/recordings: record a scenario first, or name files" >&2
        exit 1
    fi
    fresh="$top/target/viewers-recordings"
    cargo run --quiet --release --manifest-path "$top/Cargo.toml" -- run --record "$fresh" "$top/scenarios/compressor.toml" >/dev/null
    set -- "$@" "$fresh/compressor.mcap"
fi
if ! cmp -s "$here/requirements.txt" "$environment/installed.txt"; then
    python3 -m venv "$environment"
    "$environment/bin/pip" install --quiet --disable-pip-version-check -r "$here/requirements.txt"
    cp "$here/requirements.txt" "$environment/installed.txt"
fi
PATH="$environment/bin:$PATH" exec "$environment/bin/python" "$here/check.py" "$@"
