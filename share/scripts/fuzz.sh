#!/bin/sh
# Fuzzes the readers of TOML, of --set, tables, units, formulas, meshes, STEP files and matrices with libFuzzer,
# AddressSanitizer and UndefinedBehaviorSanitizer. What it finds stays in build/fuzz, and ends the script with an error.
#
#   share/scripts/fuzz.sh [SECONDS [READER …]]     60 s each by default
#                                                  readers: toml overrides csv units expression msh step matrix nodes
#                                                  MICROSLIP_FUZZ_BUILD: the folder, build/fuzz by default
#                                                  MICROSLIP_FUZZ_RUNS: ended after as many inputs, if that is sooner
set -eu
root=$(cd "$(dirname "$0")/../.." && pwd)
"$root/share/scripts/setup.sh" --fuzz
seconds=${1:-60}
[ "$#" -eq 0 ] || shift
[ "$#" -gt 0 ] || set -- toml overrides csv units expression msh step matrix nodes
build="${MICROSLIP_FUZZ_BUILD:-$root/build/fuzz}"
mkdir -p "$build"
cd "$root"

sources_of() {
  text="pipelines/text"
  case "$1" in
    toml) echo "$text/toml_text.cpp" ;;
    overrides) echo "pipelines/scene/scene_overrides.cpp $text/toml_text.cpp" ;;
    csv) echo "$text/csv_table.cpp $text/units.cpp $text/nearest_name.cpp" ;;
    units) echo "$text/units.cpp $text/nearest_name.cpp" ;;
    expression) echo "$text/expression.cpp $text/nearest_name.cpp" ;;
    msh) ls mesh/body/*.cpp mesh/checks/*.cpp mesh/elements/*.cpp mesh/import/gmsh_*.cpp mesh/import/mesh_reader.cpp ;;
    step) ls mesh/import/step_units.cpp mesh/import/step_statements.cpp ;;
    matrix | nodes) echo "pipelines/scene/matrix_files.cpp $text/csv_table.cpp $text/units.cpp $text/nearest_name.cpp" ;;
    *) echo "fuzz: no reader is called $1" >&2; exit 1 ;;
  esac
}

# Inputs to begin with, beside those found earlier.
seeds_of() {
  mkdir -p "$build/corpus_$1"
  case "$1" in
    toml) cp share/scenes/*.toml "$build/corpus_$1" ;;
    csv) cp share/scenes/plate/nodes.csv "$build/corpus_$1" ;;
    units) for t in "210 GPa" "2.5 mm" "0.2 %" "3000 rpm" "1e12 N/m^3"; do printf '%s' "$t" >"$build/corpus_$1/$(echo "$t" | tr ' /%' '___')"; done ;;
    expression) printf '2000*(0.2 + 0.8*(2*p/L - 1)^2)' >"$build/corpus_$1/bar" ;;
    *) cp "tests/fuzz/corpus_$1"/* "$build/corpus_$1" ;;
  esac
}

# toml++ comes with its headers here, to be fuzzed too; the library that the program links was built without its assertions, one of
# which fails on "[=".
toml_as_linked='-DTOML_ASSERT(x)=static_assert(true)'
# A text that is no unit costs UDUNITS-2 some bytes.
export LSAN_OPTIONS=suppressions="$root/tests/support/leaks.txt":print_suppressions=0
for reader in "$@"; do
  sources=$(sources_of "$reader")
  # shellcheck disable=SC2086  # lists of words
  clang++ -std=c++20 -O1 -g1 -fsanitize=fuzzer,address,undefined -fno-sanitize-recover=undefined -I"$root" \
    -include share/scripts/clang_source_location.hpp -isystem /usr/include/eigen3 "tests/fuzz/fuzz_$reader.cpp" \
    "$toml_as_linked" $sources -o "$build/fuzz_$reader" -lfmt -ludunits2 -lmuparser
  seeds_of "$reader"
  echo "fuzz: $reader, $seconds s"
  (cd "$build" && "./fuzz_$reader" -max_total_time="$seconds" \
    -runs="${MICROSLIP_FUZZ_RUNS:--1}" -timeout=5 -rss_limit_mb=1024 -max_len=20000 \
    -artifact_prefix="$reader-" -print_final_stats=1 "corpus_$reader" >"$reader.log" 2>&1) ||
    { tail -n 40 "$build/$reader.log" >&2; exit 1; }
  grep -E "number_of_executed_units|peak_rss" "$build/$reader.log"
done
echo "fuzz: nothing found"
