#!/bin/sh
# Installs the Debian packages microslip needs, those only that are missing. Safe to run again.
#
#   share/scripts/setup.sh [--tests | --tidy | --fuzz | --coverage | --compilers | --screen]
#                           --tests: also what the tests alone need; --screen: what paraview.sh needs; others: what tidy.sh, fuzz.sh, … need
#
# Works as root or with sudo; says what it does.
set -eu

build="g++ cmake ninja-build pkg-config"
libraries="libeigen3-dev libslepc-real-dev libgmsh-dev libopenblas-pthread-dev libvtk9-dev
  libtomlplusplus-dev libcli11-dev libspdlog-dev libfmt-dev libudunits2-dev libhdf5-dev
  libmuparser-dev nlohmann-json3-dev"
# The build makes the tests as well unless it is told not to, so their libraries belong here.
testing="libgtest-dev librapidcheck-dev libbenchmark-dev libsundials-dev"
plots="python3-numpy python3-matplotlib python3-meshio python3-h5py python3-netcdf4"
test_programs="calculix-ccx openmpi-bin clang-format chromium-headless-shell
  python3-pandas python3-xarray python3-nbconvert python3-ipykernel python3-pip"

wanted="$build $libraries $testing $plots"
case "${1:-}" in
  "") ;;
  --tests) wanted="$wanted $test_programs" ;;
  --tidy) wanted="$wanted clang-tidy" ;;
  --fuzz) wanted="$wanted clang libclang-rt-dev" ;;
  --compilers) wanted="$wanted clang" ;;
  --screen) wanted="$wanted xvfb xauth" ;;
  --coverage) wanted="$wanted $test_programs gcovr" ;;
  *) echo "usage: setup.sh [--tests | --tidy | --fuzz | --coverage | --compilers | --screen]" >&2; exit 1 ;;
esac

is_installed() {
  dpkg-query -W -f='${Status}' "$1" 2>/dev/null | grep -q '^install ok installed$'
}

missing=""
for package in $wanted; do
  is_installed "$package" || missing="$missing $package"
done
if [ -z "$missing" ]; then
  echo "setup: all packages are installed"
  exit 0
fi

as_root=""
if [ "$(id -u)" -ne 0 ]; then
  if ! command -v sudo >/dev/null; then
    echo "setup: these packages are missing:$missing" >&2
    echo "setup: run this as root, or install sudo" >&2
    exit 1
  fi
  as_root="sudo"
fi

echo "setup: installing$missing"
log=$(mktemp)
trap 'rm -f "$log"' EXIT
run_quietly() {
  "$@" >"$log" 2>&1 || { tail -n 30 "$log" >&2; echo "setup: failed: $*" >&2; exit 1; }
}
run_quietly $as_root apt-get update -q
# shellcheck disable=SC2086  # a list of words
run_quietly $as_root env DEBIAN_FRONTEND=noninteractive \
  apt-get install -q -y --no-install-recommends $missing
echo "setup: done"
