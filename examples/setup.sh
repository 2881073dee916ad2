# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
# Functions of the start scripts (examples/quickstart.sh, test/run.sh): install what is missing, build. For sourcing.

# Debian's or Ubuntu's packages; on other systems, the same by their own means. OpenCV's photo, 6 MB to download and 36 MB
# on the disk with what it needs, is for denoising; without it the tool has ITK's denoiser. LibRaw is for raw files of cameras,
# OpenSSL for the SHA-256 of the frames' files in reports, librsvg, 25 MB on the disk with what it needs, for --plot FILE.png.
sensornoise_packages=(g++ cmake ninja-build python3 libinsighttoolkit5-dev libgdcm-dev libfftw3-dev libtiff-dev
  libcli11-dev nlohmann-json3-dev zlib1g-dev libgtest-dev libbenchmark-dev libopencv-photo-dev libraw-dev
  libssl-dev librsvg2-dev pkg-config)

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

# sensornoise_build FOLDER [CMake options]: configures quietly and builds, with SENSORNOISE_WARNINGS_AS_ERRORS=ON so.
sensornoise_build() {
  local folder="$1"
  shift
  local source
  source="$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)"
  mkdir -p "$folder"
  # The distribution's GDCM names programs in its CMake files that its library packages leave out: pages of notes.
  cmake -G Ninja -S "$source" -B "$folder" -DCMAKE_BUILD_TYPE=Release \
    -DSensorNoise_WARNINGS_AS_ERRORS="${SENSORNOISE_WARNINGS_AS_ERRORS:-OFF}" "$@" >"$folder/configure.log" 2>&1 ||
    { cat "$folder/configure.log" >&2; return 1; }
  cmake --build "$folder"
}
