#!/bin/sh
# Configures and builds the optimised program into build/; prints little unless something fails.
#
#   share/scripts/build.sh [CMake arguments …]
set -eu
root=$(cd "$(dirname "$0")/../.." && pwd)
build="$root/build"
mkdir -p "$build"

echo "build: configuring in $build"
cmake -G Ninja -S "$root" -B "$build" -DCMAKE_BUILD_TYPE=Release -DMICROSLIP_UNITY=ON "$@" >"$build/configure.log" 2>&1 ||
  { cat "$build/configure.log" >&2; exit 1; }
# A compiler of VTK code takes up to 1 GB: two at a time where memory is short.
jobs=$(awk '/MemAvailable/ {n = int($2 / 1.5e6); print n < 1 ? 1 : n}' /proc/meminfo)
[ "$jobs" -le "$(nproc)" ] || jobs=$(nproc)
echo "build: compiling, $jobs at a time"
ninja -C "$build" -j "$jobs" >"$build/build.log" 2>&1 || { grep -v '^\[' "$build/build.log" >&2; exit 1; }
echo "build: $build/bin/microslip"
