#!/bin/sh
# Installs what is missing, builds everything and runs all tests: the benchmarks apart, and a tenth of each
# campaign (share/scripts/campaigns.sh runs them whole).
#
#   share/scripts/test.sh [ctest arguments …]
set -eu
root=$(cd "$(dirname "$0")/../.." && pwd)
"$root/share/scripts/setup.sh" --tests
"$root/share/scripts/build.sh" -DBUILD_TESTING=ON
exec ctest --test-dir "$root/build" --output-on-failure -LE benchmark -j2 "$@"
