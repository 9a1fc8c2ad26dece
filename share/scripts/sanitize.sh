#!/bin/sh
# Builds with AddressSanitizer and UndefinedBehaviorSanitizer and runs the unit, verification and hard-case tests: any finding ends
# the test that made it. Everything takes an hour or more. --lean: contact, solver and the readers of meshes and scenes, with
# the tests that need these alone; --quick: of those the ones that are not slow, some minutes in all, campaigns to a tenth.
# Otherwise campaigns are left out, and always hard_cases.failing_calls, whose library stands in for the functions that
# AddressSanitizer replaces; tests that leave the process little address space say that they are skipped. Time limits are ten
# times as long.
#
#   share/scripts/sanitize.sh [--lean | --quick] [ctest arguments …]
#                                     MICROSLIP_SANITIZE_BUILD: the folder, build/sanitize or build/sanitize-lean by default
set -eu
root=$(cd "$(dirname "$0")/../.." && pwd)

# Left out by --quick: some 15 s of processor time or more each under sanitizers, where all others take two and a half minutes.
slow="
  contact.test_friction_cycle_reference contact.test_line_events contact.test_line_events_jacobian
  contact.test_line_events_reference contact.test_planar_cycle_events contact.test_planar_cycle_jacobian
  contact.test_planar_cycle_reference contact.test_planar_steady contact.test_sampled_line contact.test_sampled_plane
  contact.test_sleeping_set contact.test_surface_line_events contact.test_surface_line_events_reference contact.test_work_error
  solver.test_common_harmonics solver.test_enrichment solver.test_floquet solver.test_modal_enclosure solver.test_optimum
  solver.test_peak_harmonics solver.test_peak_trace solver.test_point_shift solver.test_richer_peak
  solver.test_special_points solver.test_time_integration
  hard_cases.contact_point hard_cases.metamorphic hard_cases.planar_layers hard_cases.planar_point
  hard_cases.time_integration
  verification.harmonics_chosen verification.lanes_against_events verification.planar_time verification.random_scenes
  verification.stability_against_time verification.time_against_balance verification.time_order verification.time_scenes
"

folder=sanitize
with_fem=ON
flags="-O1 -g1"
left_out=""
unlabelled="campaign|benchmark"
if [ "${1:-}" = --lean ] || [ "${1:-}" = --quick ]; then
  folder=sanitize-lean
  with_fem=OFF
  flags="-O1 -g0"
  if [ "$1" = --quick ]; then
    # shellcheck disable=SC2086  # a list of words
    left_out=$(echo $slow | tr ' ' ';')
    unlabelled="benchmark"
  fi
  shift
  set -- -E "^layout[.]|pictures" "$@" # programs of Python
fi
"$root/share/scripts/setup.sh" --tests
build="${MICROSLIP_SANITIZE_BUILD:-$root/build/$folder}"
mkdir -p "$build"
cmake -G Ninja -S "$root" -B "$build" -DCMAKE_BUILD_TYPE=Release -DMICROSLIP_UNITY=ON -DBUILD_TESTING=ON \
  -DCMAKE_CXX_FLAGS_RELEASE="$flags" -DMICROSLIP_SANITIZE=address,undefined \
  -DMICROSLIP_WITH_FEM="$with_fem" -DMICROSLIP_READERS=ON -DMICROSLIP_TESTS_LEFT_OUT="$left_out" \
  >"$build/configure.log" 2>&1 || { cat "$build/configure.log" >&2; exit 1; }
echo "sanitize: building in $build"
ninja -C "$build" >"$build/build.log" 2>&1 || { grep -v '^\[' "$build/build.log" >&2; exit 1; }
export UBSAN_OPTIONS=halt_on_error=1:print_stacktrace=1
export LSAN_OPTIONS=suppressions="$root/tests/support/leaks.txt":print_suppressions=0
exec ctest --test-dir "$build" --output-on-failure -L "unit|hard|verification" -LE "$unlabelled" -j2 "$@"
