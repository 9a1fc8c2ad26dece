#!/bin/sh
# Builds contact and solver with counters, runs their unit and hard-case tests and prints which share of their lines and
# branches was run, file by file. Branches that only exceptions take are left out. Needs Eigen alone; some minutes.
#
#   share/scripts/coverage.sh [ctest arguments …]     MICROSLIP_COVERAGE_BUILD: the folder, build/coverage by default
set -eu
root=$(cd "$(dirname "$0")/../.." && pwd)
"$root/share/scripts/setup.sh" --coverage
build="${MICROSLIP_COVERAGE_BUILD:-$root/build/coverage}"
mkdir -p "$build"
cmake -G Ninja -S "$root" -B "$build" -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_FLAGS_RELEASE="-O1 -fno-inline --coverage" \
  -DMICROSLIP_UNITY=ON -DMICROSLIP_WITH_FEM=OFF -DBUILD_TESTING=ON >"$build/configure.log" 2>&1 || { cat "$build/configure.log" >&2; exit 1; }
echo "coverage: building in $build"
ninja -C "$build" contact_tests solver_tests hard_cases_tests >"$build/build.log" 2>&1 || { grep -v '^\[' "$build/build.log" >&2; exit 1; }
find "$build" -name '*.gcda' -delete # of an earlier run
ctest --test-dir "$build" --output-on-failure -R "^(contact|solver|hard_cases)[.]" -LE "campaign|benchmark" -j2 "$@"
exec gcovr --root "$root" --filter contact/ --filter solver/ --exclude-throw-branches --exclude-unreachable-branches \
  --print-summary --txt "$build/files.txt" "$build"
