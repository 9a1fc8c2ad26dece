#!/bin/sh
# Installs what is missing, builds everything and runs all tests: the benchmarks apart, and a tenth of each
# campaign (share/scripts/campaigns.sh runs them whole). Where it is given no arguments those that are not slow run once more
# under sanitizers (share/scripts/sanitize.sh runs all of them).
#
#   share/scripts/test.sh [ctest arguments …]
set -eu
root=$(cd "$(dirname "$0")/../.." && pwd)
"$root/share/scripts/setup.sh" --tests
"$root/share/scripts/build.sh" -DBUILD_TESTING=ON
if [ -z "${PVBATCH:-}" ]; then
  if "$root/share/scripts/paraview.sh" "$root/build/paraview"; then
    export PVBATCH="$root/build/paraview/pvbatch"
  else
    echo "test: no ParaView: the test of its macro is skipped"
  fi
fi
code=0
ctest --test-dir "$root/build" --output-on-failure -LE benchmark -j2 "$@" || code=$?
[ "$#" -gt 0 ] || "$root/share/scripts/sanitize.sh" --quick || code=$?
exit "$code"
