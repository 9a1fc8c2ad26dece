#!/bin/sh
# Installs what is missing, builds everything and runs all tests: the benchmarks apart, and a tenth of each
# campaign (share/scripts/campaigns.sh runs them whole).
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
exec ctest --test-dir "$root/build" --output-on-failure -LE benchmark -j2 "$@"
