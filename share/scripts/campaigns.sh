#!/bin/sh
# Builds everything and runs the campaigns whole: all random scenes, states and damaged files, of which
# share/scripts/test.sh takes a tenth.
#
#   share/scripts/campaigns.sh [ctest arguments …]
set -eu
root=$(cd "$(dirname "$0")/../.." && pwd)
"$root/share/scripts/setup.sh" --tests
"$root/share/scripts/build.sh" -DBUILD_TESTING=ON
export MICROSLIP_CAMPAIGNS=whole
exec ctest --test-dir "$root/build" --output-on-failure -L campaign -j2 "$@"
