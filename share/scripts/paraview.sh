#!/bin/sh
# Unpacks Debian's ParaView with its Python into a folder of its own: its package python3-paraview would remove libvtk9-dev,
# which the build needs. Prints the command that runs it. Safe to run again.
#
#   share/scripts/paraview.sh FOLDER          FOLDER/pvbatch, FOLDER/paraview: 74 MB to download, 540 MB unpacked
#
# Installs a virtual screen as well (as root or with sudo), on which FOLDER/pvbatch draws where no other is: Debian's ParaView
# cannot draw without one.
set -eu
[ $# -eq 1 ] || { echo "usage: paraview.sh FOLDER" >&2; exit 1; }
scripts=$(cd "$(dirname "$0")" && pwd)
# Qt's parts are those that no package of setup.sh brings.
packages="paraview python3-paraview libqt5opengl5 libqt5help5 libqt5sql5"

# $1: program; $2: what is to be done before
write_command() {
  cat >"$folder/$1" <<END
#!/bin/sh
export LD_LIBRARY_PATH="$(echo "$folder"/usr/lib/*-linux-gnu)\${LD_LIBRARY_PATH:+:\$LD_LIBRARY_PATH}"
export PYTHONPATH="$folder/usr/lib/python3/dist-packages\${PYTHONPATH:+:\$PYTHONPATH}"
screen=""
$2
exec \$screen "$folder/usr/bin/$1" "\$@"
END
  chmod +x "$folder/$1"
}

"$scripts/setup.sh" --screen
mkdir -p "$1"
folder=$(cd "$1" && pwd)
if [ ! -x "$folder/pvbatch" ]; then
  echo "paraview: unpacking into $folder"
  new=$(mktemp -d "$folder/new.XXXXXX")
  trap 'rm -rf "$new"' EXIT
  cd "$new"
  # shellcheck disable=SC2086  # a list of words
  apt-get download -q -o Acquire::Retries=0 $packages >log 2>&1 ||
    { grep '^E:' log | head -n 1 >&2; echo "paraview: failed: apt-get download $packages" >&2; exit 1; }
  for package in *.deb; do dpkg -x "$package" "$folder"; done
  write_command paraview ""
  # Without -noreset a screen begins anew, and may not answer, once the first look for it has ended.
  write_command pvbatch '[ -n "${DISPLAY:-}" ] || screen="xvfb-run -a -s -noreset"'
fi
echo "paraview: $folder/pvbatch share/paraview/open_run.py RUN_FOLDER NAME PICTURE.png"
