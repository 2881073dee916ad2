#!/usr/bin/env bash
# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
# Builds the page that measures bursts in a browser.
#
#   build.sh               no arguments; --help prints this text
#
# Installs what is missing (Debian, Ubuntu), compiles the library by Emscripten into build/browser, and leaves the page in
# build/browser/site: index.html for a server, and sensor-noise.html, one file that browsers open from the disk. Compiled
# objects are kept as by examples/setup.sh, which has the variables of the caches. SENSORNOISE_ZLIB_SOURCE is a folder with
# the sources of zlib (default: those of the distribution, downloaded once into the cache). Exit codes: 2 wrong
# arguments, 69 Emscripten or the sources cannot be had; the last line says why.
set -euo pipefail
if [ $# -gt 0 ]; then
  if [ "$*" = "--help" ]; then
    sed -n '4,/^set /{/^#/s/^# \{0,1\}//p}' "$0"
    exit 0
  fi
  echo "build.sh: the arguments are \"$*\"; expected none, or --help" >&2
  exit 2
fi
here="$(cd "$(dirname "$0")/../.." && pwd)"
source "$here/examples/setup.sh"
folder="$here/build/browser"

unavailable() {
  echo "build.sh: $1" >&2
  exit 69
}

# The page itself needs no ITK: of the packages of examples/setup.sh only those that compile it.
sensornoise_packages=(emscripten ccache cmake ninja-build python3 libeigen3-dev nlohmann-json3-dev)
sensornoise_install || unavailable "the packages ${sensornoise_packages[*]} cannot be installed"
command -v em++ >/dev/null || unavailable "there is no Emscripten (Debian: apt-get install emscripten)"

# download_zlib FOLDER: the distribution's sources, by a list of sources of their own, so that those of the computer stay.
download_zlib() (
  command -v apt-get >/dev/null || exit 1
  work="$(mktemp -d)"
  trap 'rm -rf "$work"' EXIT
  mkdir -p "$work/lists/partial" "$work/archives/partial" "$(dirname "$1")"
  apt-get indextargets --format '$(REPO_URI) $(CODENAME) $(COMPONENT)' 'Created-By: Packages' |
    awk -v codename="$(. /etc/os-release && echo "$VERSION_CODENAME")" \
      '$2 == codename && $3 == "main" { print "deb-src", $1, $2, $3; exit }' >"$work/sources.list" || exit 1
  options=(-qq -o "Dir::Etc::sourcelist=$work/sources.list" -o Dir::Etc::sourceparts=- -o "Dir::State::lists=$work/lists"
    -o "Dir::Cache::archives=$work/archives" -o APT::Sandbox::User=root)
  apt-get "${options[@]}" update || exit 1
  (cd "$work" && apt-get "${options[@]}" source --download-only zlib) || exit 1
  python3 - "$work"/zlib_*.orig.tar.* "$work/zlib" <<'PYTHON' || exit 1
import pathlib, sys, tarfile
archive, folder = sys.argv[1], pathlib.Path(sys.argv[2])
folder.mkdir()
with tarfile.open(archive) as files:
    for member in files:
        name = pathlib.PurePosixPath(member.name)
        if member.isfile() and len(name.parts) == 2 and name.suffix in (".c", ".h"):
            (folder / name.name).write_bytes(files.extractfile(member).read())
PYTHON
  rm -rf "$1" && mv "$work/zlib" "$1"
)
zlib="${SENSORNOISE_ZLIB_SOURCE:-$sensornoise_cache/zlib-source}" # an incomplete download leaves no folder
[ -e "$zlib/inflate.c" ] || download_zlib "$zlib" || unavailable "the sources of zlib cannot be downloaded"

sensornoise_use_ccache "$here"
if [ -n "${CMAKE_CXX_COMPILER_LAUNCHER:-}" ]; then
  # Emscripten calls the compiler itself: that is what ccache knows.
  unset CMAKE_C_COMPILER_LAUNCHER CMAKE_CXX_COMPILER_LAUNCHER
  export EM_COMPILER_WRAPPER=ccache
fi
export NODE_PATH="${NODE_PATH:-/usr/share/nodejs}" # where Debian's Emscripten has its parser of JavaScript
mkdir -p "$folder"
cmake -S "$here" --preset browser -DSensorNoise_ZLIB_SOURCE="$zlib" \
  -DSensorNoise_WARNINGS_AS_ERRORS="${SENSORNOISE_WARNINGS_AS_ERRORS:-OFF}" >"$folder/configure.log" 2>&1 ||
  { cat "$folder/configure.log" >&2; exit 1; }
cmake --build "$folder"

site="$folder/site"
mkdir -p "$site"
cp "$here"/examples/browser/page/* "$folder"/examples/browser/sensor-noise.{js,wasm} "$site"
python3 "$here/examples/browser/join.py" "$site"
echo "the page is in $site: python3 -m http.server --directory $site, or open $site/sensor-noise.html"
