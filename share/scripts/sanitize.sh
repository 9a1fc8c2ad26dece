#!/bin/sh
# Builds everything with AddressSanitizer and UndefinedBehaviorSanitizer and runs the unit, verification and hard-case tests:
# any finding ends the test that made it. Takes an hour or more; of contact and solver alone, which need Eigen alone, some minutes.
# Left out are campaigns, and hard_cases.failing_calls, whose library stands in for the functions that AddressSanitizer
# replaces; tests that leave the process little address space say that they are skipped. Time limits are ten times as long.
#
#   share/scripts/sanitize.sh [--lean] [ctest arguments …]     --lean: contact and solver alone
#                                                              MICROSLIP_SANITIZE_BUILD: the folder, build/sanitize by default
set -eu
root=$(cd "$(dirname "$0")/../.." && pwd)
fem=ON
if [ "${1:-}" = --lean ]; then
  fem=OFF
  shift
fi
"$root/share/scripts/setup.sh" --tests
build="${MICROSLIP_SANITIZE_BUILD:-$root/build/sanitize}"
mkdir -p "$build"
cmake -G Ninja -S "$root" -B "$build" -DCMAKE_BUILD_TYPE=Release -DMICROSLIP_UNITY=ON \
  -DCMAKE_CXX_FLAGS_RELEASE="-O1 -g1" -DMICROSLIP_WITH_FEM="$fem" -DBUILD_TESTING=ON -DMICROSLIP_SANITIZE=address,undefined \
  >"$build/configure.log" 2>&1 || { cat "$build/configure.log" >&2; exit 1; }
echo "sanitize: building in $build"
ninja -C "$build" >"$build/build.log" 2>&1 || { grep -v '^\[' "$build/build.log" >&2; exit 1; }
export UBSAN_OPTIONS=halt_on_error=1:print_stacktrace=1
export LSAN_OPTIONS=suppressions="$root/tests/support/leaks.txt":print_suppressions=0
exec ctest --test-dir "$build" --output-on-failure -L "unit|hard|verification" -LE "campaign|benchmark" -j2 "$@"
