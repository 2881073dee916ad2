# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
# Functions of the scripts that build (examples/quickstart.sh, test/run.sh, wrapping/): install what is missing, build, and
# keep what is slow to make. For sourcing.
#
# Environment:
#   SENSORNOISE_CACHE          folder of what is kept between builds, for all checkouts (default: ~/.cache/itk-sensornoise)
#   SENSORNOISE_CCACHE=0       compiles without ccache; otherwise it is used where it is installed
#   SENSORNOISE_CCACHE_SIZE    limit of compiled objects on the disk (default: 3G)

# Debian's or Ubuntu's packages; on other systems, the same by their own means. OpenCV's photo, 6 MB to download and 36 MB
# on the disk with what it needs, is for denoising; without it the tool has ITK's denoiser. LibRaw is for raw files of cameras,
# OpenSSL for the SHA-256 of the frames' files in reports, librsvg, 25 MB on the disk with what it needs, for --plot FILE.png.
sensornoise_packages=(g++ ccache cmake ninja-build python3 libinsighttoolkit5-dev libgdcm-dev libfftw3-dev libtiff-dev
  libcli11-dev nlohmann-json3-dev zlib1g-dev libgtest-dev libbenchmark-dev libopencv-photo-dev libraw-dev
  libssl-dev librsvg2-dev pkg-config)

sensornoise_cache="${SENSORNOISE_CACHE:-$HOME/.cache/itk-sensornoise}"

sensornoise_install() {
  local missing=()
  if ! command -v dpkg-query >/dev/null; then
    echo "not a Debian system: expecting ITK >= 5.2.1, CLI11, nlohmann-json, zlib, GoogleTest and Google Benchmark; OpenCV for denoising, LibRaw for raw files of cameras; OpenSSL and librsvg for reports" >&2
    return
  fi
  for package in "${sensornoise_packages[@]}"; do
    dpkg-query -W -f '${Status}' "$package" 2>/dev/null | grep -q 'ok installed' || missing+=("$package")
  done
  [ ${#missing[@]} -gt 0 ] || return 0
  echo "installing ${missing[*]}"
  sensornoise_apt "${missing[@]}"
}

sensornoise_apt() {
  local sudo=
  [ "$(id -u)" = 0 ] || sudo=sudo
  $sudo apt-get update -qq &&
    $sudo env DEBIAN_FRONTEND=noninteractive apt-get install -qq -y --no-install-recommends "$@" >/dev/null
}

# sensornoise_install_if_possible PACKAGE: what nothing but some tests needs, which are skipped without it.
sensornoise_install_if_possible() {
  command -v apt-get >/dev/null || return 0
  echo "installing $1"
  sensornoise_apt "$1" || echo "$1 cannot be installed: tests that need it are skipped" >&2
}

# sensornoise_use_ccache BASE: compilers that CMake finds from now on are called through ccache. Sources below the folder
# BASE are known by their path from there, so that all checkouts share what is compiled.
sensornoise_use_ccache() {
  [ "${SENSORNOISE_CCACHE:-}" != 0 ] && command -v ccache >/dev/null || return 0
  export CCACHE_DIR="$sensornoise_cache/ccache" CCACHE_MAXSIZE="${SENSORNOISE_CCACHE_SIZE:-3G}"
  export CCACHE_BASEDIR="$1" CCACHE_NOHASHDIR=1 CCACHE_DEPEND=1
  # What ccache asks for where headers are precompiled; nothing here uses __TIME__. A fresh checkout has new file times.
  export CCACHE_SLOPPINESS=pch_defines,time_macros,include_file_mtime,include_file_ctime
  export CMAKE_C_COMPILER_LAUNCHER=ccache CMAKE_CXX_COMPILER_LAUNCHER=ccache
}

# sensornoise_venv NAME REQUIREMENT...: prints the folder of a virtual environment in the cache that has these Python
# packages. Another interpreter or other requirements get another one. Fails if they cannot be installed.
sensornoise_venv() {
  local name="$1" python="${PYTHON:-python3}" venv
  shift
  venv="$sensornoise_cache/$name-$( ("$python" -VV; "$python" -c 'import sys; print(sys.base_prefix)'; echo "$@") |
    sha256sum | cut -c1-16)"
  mkdir -p "$sensornoise_cache"
  (
    flock 9
    if [ ! -e "$venv/ready" ]; then
      "$python" -m venv --clear "$venv" &&
        "$venv/bin/pip" -q --disable-pip-version-check install "$@" && touch "$venv/ready" || exit 1
    fi
    touch "$venv" # it is in use: sensornoise_prune_cache
  ) 9>"$sensornoise_cache/$name.lock" >&2 || return 1
  echo "$venv"
}

# sensornoise_prune_cache: removes what no build has used for 30 days; ccache bounds its own part.
sensornoise_prune_cache() {
  [ -d "$sensornoise_cache" ] || return 0
  find "$sensornoise_cache" -mindepth 1 -maxdepth 1 -type d \( -name 'itk-*' -o -name 'venv-*' -o -name 'style-*' \
    -o -name 'uv-*' -o -name 'site-*' \) -mtime +30 -exec rm -rf {} +
  [ ! -d "$sensornoise_cache/tidy" ] || find "$sensornoise_cache/tidy" -type f -mtime +30 -delete
}

# sensornoise_build FOLDER [CMake options]: configures quietly and builds, with SENSORNOISE_WARNINGS_AS_ERRORS=ON so.
sensornoise_build() {
  local folder="$1"
  shift
  local source
  source="$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)"
  mkdir -p "$folder"
  sensornoise_use_ccache "$source"
  # The distribution's GDCM names programs in its CMake files that its library packages leave out: pages of notes.
  cmake -G Ninja -S "$source" -B "$folder" -DCMAKE_BUILD_TYPE=Release \
    -DSensorNoise_WARNINGS_AS_ERRORS="${SENSORNOISE_WARNINGS_AS_ERRORS:-OFF}" "$@" >"$folder/configure.log" 2>&1 ||
    { cat "$folder/configure.log" >&2; return 1; }
  cmake --build "$folder"
}
