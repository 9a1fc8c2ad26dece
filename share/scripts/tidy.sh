#!/bin/sh
# Installs what is missing, runs clang-tidy over the product's sources and fails on any finding. Builds
# nothing, and reads every source without precompiled headers: a missing include is found as well.
#
#   share/scripts/tidy.sh [SOURCE …]     no source: all of mesh, fem, contact, solver and pipelines
set -eu
root=$(cd "$(dirname "$0")/../.." && pwd)
export root
"$root/share/scripts/setup.sh" --tidy
build="$root/build/tidy"
mkdir -p "$build"
cd "$root"

cmake -G Ninja -S "$root" -B "$build" -DBUILD_TESTING=OFF -DCMAKE_BUILD_TYPE=Release \
  -DCMAKE_EXPORT_COMPILE_COMMANDS=ON -DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON >"$build/configure.log" 2>&1 ||
  { cat "$build/configure.log" >&2; exit 1; }
[ "$#" -gt 0 ] || set -- $(find mesh fem contact solver pipelines -name '*.cpp' | sort)
echo "tidy: $# files, $(nproc) at a time"
# Its count of warnings in other people's headers says nothing.
printf '%s\n' "$@" | xargs -P "$(nproc)" -n 1 sh -c \
  'clang-tidy --quiet --extra-arg="-include$root/share/scripts/clang_source_location.hpp" -p "$0" "$1" \
     2>"$0/$(echo "$1" | tr / _).log" ||
   { grep -v "warnings generated" "$0/$(echo "$1" | tr / _).log" >&2; exit 1; }' "$build" ||
  { echo "tidy: there are findings" >&2; exit 1; }
echo "tidy: clean"
