#!/bin/sh
# Runs examples/pytest on a scenario that agrees and on three that do not: tests/pytest/run.sh
#
# Packages go into target/pytest-venv. LINKPROOF names the built command.
set -eu
top=$(cd "$(dirname "$0")/../.." && pwd)
. "$top/tests/tools.sh"
environment="$top/target/pytest-venv"
LINKPROOF=$(linkproof)
mkdir -p "$top/target"
wanted="$top/examples/pytest/requirements.txt"
python_with "$environment" "$wanted"

place=$(mktemp -d)
trap 'rm -r "$place"' EXIT
mkdir "$place/scenarios" "$place/empty"
SCENARIOS="$place/scenarios"
pendulum="$top/scenarios/pendulum.toml"
cp "$pendulum" "$SCENARIOS/right.toml"
{
    cat "$pendulum"
    printf '\n[[formula]]\nname = "w"\nexpression = "phi"\nchannel = "link.rod.omega_rad_s"\n'
} >"$SCENARIOS/wrong.toml"
sed 's/^joint = "O"/joint = "Q"/' "$pendulum" >"$SCENARIOS/broken.toml"
{
    cat "$pendulum"
    printf '\n[engine]\ndt_s = 0.05\n'
} >"$SCENARIOS/coarse.toml"

export LINKPROOF SCENARIOS PYTHONDONTWRITEBYTECODE=1
told="$place/told.txt"
code=0
"$environment/bin/python" -m pytest -p no:cacheprovider "$top/examples/pytest" -rA >"$told" 2>&1 || code=$?
fail() {
    cat "$told"
    echo "pytest: $1" >&2
    exit 1
}
[ "$code" -eq 1 ] || fail "exit code $code instead of 1"
for line in \
    'PASSED .*test_proven\[right\]' 'FAILED .*test_proven\[wrong\]' 'FAILED .*test_proven\[broken\]' 'FAILED .*test_proven\[coarse\]' \
    '^DISAGREE: pendulum' '^worst: .*w as link.rod.omega_rad_s.* times its bound' \
    '^INCONCLUSIVE: pendulum' 'choose a smaller time step' 'broken.toml:[0-9]*: .*"Q"' '^help: '; do
    grep -q "$line" "$told" || fail "no line like $line"
done
# An empty folder must not count as success.
SCENARIOS="$place/empty"
if "$environment/bin/python" -m pytest -p no:cacheprovider -q "$top/examples/pytest" >"$told" 2>&1; then
    fail "the tests pass in an empty folder"
fi
echo "examples/pytest: one scenario passes, three fail with their reasons"
