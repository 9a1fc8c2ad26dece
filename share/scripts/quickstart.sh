#!/bin/sh
# From a bare Debian 12 to the results of the default study: installs what is missing, builds, runs.
#
#   share/scripts/quickstart.sh          results in runs/blade_to_ground
set -eu
root=$(cd "$(dirname "$0")/../.." && pwd)
"$root/share/scripts/setup.sh"
"$root/share/scripts/build.sh" -DBUILD_TESTING=OFF
exec "$root/build/bin/microslip" run "$root/share/scenes/blade_to_ground.toml" \
  --without bracket -o "$root/runs/blade_to_ground"
