#!/bin/sh
# Installs what is missing, runs clang-tidy over the product's sources and fails on any finding. Builds
# nothing, and reads every source alone, without precompiled headers and drawers compiled as one unit: a missing
# include is found as well. A source that was clean is read again only when it, or what it includes, has changed
# (tidy.py says more).
#
#   share/scripts/tidy.sh [SOURCE …]     no source: all of mesh, fem, contact, solver and pipelines
set -eu
root=$(cd "$(dirname "$0")/../.." && pwd)
"$root/share/scripts/setup.sh" --tidy
build="$root/build/tidy"
mkdir -p "$build"

configure() {
  if [ "$build/build.ninja" -nt "$0" ]; then # configured by this script: again only if a CMake file changed
    ninja -C "$build" build.ninja
  else
    cmake -G Ninja -S "$root" -B "$build" -DBUILD_TESTING=OFF -DCMAKE_BUILD_TYPE=Release \
      -DCMAKE_EXPORT_COMPILE_COMMANDS=ON -DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON -DCMAKE_UNITY_BUILD=OFF
  fi
}

configure >"$build/configure.log" 2>&1 || { cat "$build/configure.log" >&2; exit 1; }
exec python3 "$root/share/scripts/tidy.py" "$build" "$@"
