#!/bin/sh
# Opens recordings and models with foreign programs: tests/viewers/run.sh [FILE...]
#
# Recordings (*.mcap) go to their readers and viewers, scenarios (*.toml) to MuJoCo and to parsers of SDF, URDF and USD. Default: recordings/*.mcap, a new recording of a mechanism with
# sliders (scenarios/compressor.toml), and all scenarios that can be exported.
# Pictures are taken of Rerun on a virtual display (xvfb, mesa-vulkan-drivers) and of Foxglove Studio in headless Chromium (chromium,
# npm). Programs that are not installed are reported. Pictures stay in target/viewers-pictures for inspection.
# Python packages go into target/viewers-venv. LINKPROOF names the built command.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
top=$(cd "$here/../.." && pwd)
. "$top/tests/tools.sh"
environment="$top/target/viewers-venv"

everything=
if [ $# -eq 0 ]; then
    everything=yes
    set -- "$top"/recordings/*.mcap
    if [ ! -e "$1" ]; then
        echo "no recordings in $top/recordings: record a scenario first, or name files" >&2
        exit 1
    fi
fi
linkproof=$(linkproof)
if [ "$everything" ]; then
    fresh="$top/target/viewers-recordings"
    "$linkproof" run --record "$fresh" --record-forces "$top/scenarios/compressor.toml" >/dev/null
    "$linkproof" run --record "$fresh" --record-forces --slow 20 --record-hz 400 "$top/scenarios/crank_rocker.toml" >/dev/null
    # No scenario has a resistance on a link that is not hinged to the ground, so one is added here.
    sed 's/^link = "rocker"/link = "coupler"/' "$top/scenarios/crank_rocker.toml" >"$fresh/resisted_coupler.toml"
    set -- "$@" "$fresh/compressor.mcap" "$fresh/crank_rocker.mcap"
    for file in "$top"/scenarios/*.toml; do
        # peers_check.py checks motions under forces.
        if grep -q '^motion = "free"' "$file"; then continue; fi
        # Some loads and laws of motion cannot be exported. Any other error is a failure.
        if why=$("$linkproof" export "$file" --mjcf "$fresh/tried.xml" 2>&1); then
            set -- "$@" "$file"
        elif printf '%s' "$why" | grep -q 'cannot be written to a model for MuJoCo'; then
            printf '%s\n  skipped: %s\n' "$file" "$(printf '%s\n' "$why" | head -n 1)"
        else
            printf '%s\n%s\n' "$file" "$why" >&2
            exit 1
        fi
    done
    set -- "$@" "$fresh/resisted_coupler.toml"
fi
python_with "$environment" "$here/requirements.txt"
PATH="$environment/bin:$PATH"

# The list is divided by kind; the order is kept.
count=$#
scenarios=0
check=mujoco_check.py
for file in "$@"; do
    case "$file" in *.toml) scenarios=$((scenarios + 1)) ;; esac
done
sorted() {
    kind=$1
    shift
    for file in "$@"; do
        shift
        case "$file" in *.toml) this=toml ;; *) this=other ;; esac
        [ "$this" = "$kind" ] && set -- "$@" "$file"
    done
    if [ "$kind" = toml ]; then
        python "$here/$check" "$linkproof" "$@"
    else
        python "$here/check.py" "$@"
    fi
}
# Names of the checks that failed: a traceback far above would be overlooked.
failed=
# The readers of recordings mostly wait for each other, so they run in parallel with MuJoCo.
if [ "$count" -gt "$scenarios" ]; then
    sorted other "$@" &
    readers=$!
fi
if [ "$scenarios" -gt 0 ]; then
    sorted toml "$@" || failed="$failed mujoco_check.py"
    # SDF, URDF and USD.
    if [ "$everything" ]; then
        python "$here/formats_check.py" "$linkproof" "$top"/scenarios/*.toml || failed="$failed formats_check.py"
    else
        check=formats_check.py
        sorted toml "$@" || failed="$failed formats_check.py"
    fi
fi
if [ -n "${readers:-}" ]; then wait "$readers" || failed="$failed check.py"; fi
if [ "$everything" ]; then
    python "$here/mujoco_check.py" "$linkproof" --singular "$top"/scenarios/variants60/*.toml || failed="$failed mujoco_check.py"
    # The viewers themselves.
    pictures="$top/target/viewers-pictures"
    python "$here/rerun_check.py" "$linkproof" "$pictures" "$top/recordings/ov7_base.mcap" "$fresh/crank_rocker.mcap" || failed="$failed rerun_check.py"
    "$here/foxglove.sh" "$pictures" "$fresh/compressor.mcap" "$fresh/crank_rocker.mcap" || failed="$failed foxglove.sh"
    python "$here/live_check.py" "$linkproof" "$pictures" "$top/target/foxglove" || failed="$failed live_check.py"
    python "$here/kills.py" "$linkproof" 20 || failed="$failed kills.py"
    # Motions under forces, with the peers of `linkproof bench`.
    python "$here/peers_check.py" "$linkproof" || failed="$failed peers_check.py"
    python "$here/golden_check.py" "$linkproof" || failed="$failed golden_check.py"
fi
if [ -n "$failed" ]; then
    echo "failed:$failed" >&2
    exit 1
fi
