#!/usr/bin/env bash
# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
# Builds the page that measures bursts in a browser.
#
#   build.sh               no arguments; --help prints this text
#
# Installs what is missing (Debian, Ubuntu), compiles the library by Emscripten into build/browser, and leaves the page in
# build/browser/site: index.html for a server, and sensor-noise.html, one file that browsers open from the disk. Compiled
# objects are kept as by examples/setup.sh, which has the variables of the caches. SENSORNOISE_ZLIB_SOURCE and
# SENSORNOISE_LIBRAW_SOURCE are folders with the sources of zlib and LibRaw (default: those of the distribution, with its
# patches, downloaded once into the cache). Exit codes: 2 wrong arguments, 69 Emscripten or the sources cannot be had; the
# last line says why.
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
sensornoise_packages=(emscripten ccache cmake ninja-build python3 libeigen3-dev nlohmann-json3-dev dpkg-dev)
sensornoise_install || unavailable "the packages ${sensornoise_packages[*]} cannot be installed"
command -v em++ >/dev/null || unavailable "there is no Emscripten (Debian: apt-get install emscripten)"

# download_source PACKAGE FOLDER: the distribution's sources with its patches, by a list of sources of their own, so that
# the computer's list stays. Where the newest version cannot be had, the version of the release is taken.
download_source() (
  command -v apt-get >/dev/null || exit 1
  work="$(mktemp -d)"
  trap 'rm -rf "$work"' EXIT
  mkdir -p "$work/lists/partial" "$work/archives/partial" "$(dirname "$2")"
  codename="$(. /etc/os-release && echo "$VERSION_CODENAME")"
  apt-get indextargets --format '$(ORIGIN) $(REPO_URI) $(CODENAME) $(COMPONENT)' 'Created-By: Packages' |
    awk -v codename="$codename" '($1 == "Debian" || $1 == "Ubuntu") && $3 ~ "^" codename "(-updates|-security)?$" {
      print "deb-src", $2, $3, $4 }' >"$work/sources.list" || exit 1
  options=(-qq -o "Dir::Etc::sourcelist=$work/sources.list" -o Dir::Etc::sourceparts=- -o "Dir::State::lists=$work/lists"
    -o "Dir::Cache::archives=$work/archives" -o APT::Sandbox::User=root)
  apt-get "${options[@]}" update || exit 1
  cd "$work"
  apt-get "${options[@]}" source "$1" || apt-get "${options[@]}" source --target-release "$codename" "$1" || exit 1
  folders=("$work/$1"-*/)
  rm -rf "$2" && mv "${folders[0]}" "$2"
)
zlib="${SENSORNOISE_ZLIB_SOURCE:-$sensornoise_cache/zlib-source}" # an incomplete download leaves no folder
libraw="${SENSORNOISE_LIBRAW_SOURCE:-$sensornoise_cache/libraw-source}"
[ -e "$zlib/inflate.c" ] || download_source zlib "$zlib" || unavailable "the sources of zlib cannot be downloaded"
[ -e "$libraw/libraw/libraw.h" ] || download_source libraw "$libraw" ||
  unavailable "the sources of LibRaw cannot be downloaded"

sensornoise_use_ccache "$here"
if [ -n "${CMAKE_CXX_COMPILER_LAUNCHER:-}" ]; then
  # Emscripten calls the compiler itself: that is what ccache knows.
  unset CMAKE_C_COMPILER_LAUNCHER CMAKE_CXX_COMPILER_LAUNCHER
  export EM_COMPILER_WRAPPER=ccache
fi
export NODE_PATH="${NODE_PATH:-/usr/share/nodejs}" # where Debian's Emscripten has its parser of JavaScript
mkdir -p "$folder"
cmake -S "$here" --preset browser -DSensorNoise_ZLIB_SOURCE="$zlib" -DSensorNoise_LIBRAW_SOURCE="$libraw" \
  -DSensorNoise_WARNINGS_AS_ERRORS="${SENSORNOISE_WARNINGS_AS_ERRORS:-OFF}" >"$folder/configure.log" 2>&1 ||
  { cat "$folder/configure.log" >&2; exit 1; }
cmake --build "$folder"

site="$folder/site"
mkdir -p "$site"
cp "$here"/examples/browser/page/* "$folder"/examples/browser/sensor-noise.{js,wasm} "$site"
python3 "$here/examples/browser/join.py" "$site"
echo "the page is in $site: python3 -m http.server --directory $site, or open $site/sensor-noise.html"
