#!/bin/sh
# Builds contact and solver with GCC and Clang, at -O0 and -O3 each, and compares what the same scenes answer at fixed
# frequencies (tests/hard_cases/print_solutions.cpp). Fails where two of them differ by more than 1e-9 of the largest
# amplitude of a curve, or find another number of solutions. Some minutes.
#
#   share/scripts/compilers.sh [BUILD BUILD …]     of gcc_O3 gcc_O0 clang_O3 clang_O0, all four by default; the others
#                                                  are compared with the first
#                                                  MICROSLIP_COMPILERS_BUILD: the folder, build/compilers by default
#                                                  MICROSLIP_JOBS: sources compiled at a time, as ninja has it by default
set -eu
root=$(cd "$(dirname "$0")/../.." && pwd)
"$root/share/scripts/setup.sh" --compilers
build="${MICROSLIP_COMPILERS_BUILD:-$root/build/compilers}"

make_and_run() { # name, compiler, options
  folder="$build/$1"
  mkdir -p "$folder"
  cmake -G Ninja -S "$root" -B "$folder" -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_COMPILER="$2" \
    -DCMAKE_CXX_FLAGS_RELEASE="$3" -DMICROSLIP_WITH_FEM=OFF -DBUILD_TESTING=ON -DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON \
    >"$folder/configure.log" 2>&1 || { cat "$folder/configure.log" >&2; exit 1; }
  echo "compilers: $2 $3"
  ninja -C "$folder" ${MICROSLIP_JOBS:+-j "$MICROSLIP_JOBS"} print_solutions >"$folder/build.log" 2>&1 || { grep -v '^\[' "$folder/build.log" >&2; exit 1; }
  "$folder/bin/print_solutions" >"$folder/solutions.txt"
}

[ "$#" -gt 0 ] || set -- gcc_O3 gcc_O0 clang_O3 clang_O0
[ "$#" -gt 1 ] || { echo "compilers: nothing to compare $1 with" >&2; exit 1; }
for name in "$@"; do
  case "$name" in
    gcc_O3) make_and_run "$name" g++ "-O3 -DNDEBUG" ;;
    gcc_O0) make_and_run "$name" g++ "-O0" ;;
    clang_O3) make_and_run "$name" clang++ "-O3 -DNDEBUG" ;;
    clang_O0) make_and_run "$name" clang++ "-O0" ;;
    *) echo "compilers: no build is called $name" >&2; exit 1 ;;
  esac
done
for name in "$@"; do
  set -- "$@" "$build/$name"
  shift
done
exec python3 "$root/tests/hard_cases/compare_solutions.py" "$@"
