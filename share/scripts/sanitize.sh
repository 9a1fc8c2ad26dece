#!/bin/sh
# Builds contact and solver with AddressSanitizer and UndefinedBehaviorSanitizer and runs their unit and hard-case tests:
# any finding ends the test that made it. Needs Eigen alone; some minutes.
#
#   share/scripts/sanitize.sh [ctest arguments …]
set -eu
root=$(cd "$(dirname "$0")/../.." && pwd)
"$root/share/scripts/setup.sh" --tests
build="$root/build/sanitize"
mkdir -p "$build"
cmake -G Ninja -S "$root" -B "$build" -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_FLAGS_RELEASE="-O1 -g1" \
  -DMICROSLIP_WITH_FEM=OFF -DBUILD_TESTING=ON -DMICROSLIP_SANITIZE=address,undefined \
  >"$build/configure.log" 2>&1 || { cat "$build/configure.log" >&2; exit 1; }
echo "sanitize: building in $build"
ninja -C "$build" >"$build/build.log" 2>&1 || { grep -v '^\[' "$build/build.log" >&2; exit 1; }
export UBSAN_OPTIONS=halt_on_error=1:print_stacktrace=1
exec ctest --test-dir "$build" --output-on-failure -L "unit|hard" -LE "campaign|benchmark" -j2 "$@"
