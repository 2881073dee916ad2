#!/usr/bin/env bash
# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
# Builds the documentation into build/site, with warnings as errors. Sphinx and its theme, the versions that
# documentation/requirements.txt names, are installed once into the cache (see examples/setup.sh). Doxygen makes the pages
# of the C++ interface. Exit code 69: one of them is not there and cannot be installed.
#
#   build.sh [FOLDER]      another folder for the pages
set -euo pipefail
here="$(cd "$(dirname "$0")/.." && pwd)"
source "$here/examples/setup.sh"
site="${1:-$here/build/site}"
export PYTHONPYCACHEPREFIX="$here/build/pycache" # nothing is written beside the sources

command -v doxygen >/dev/null || sensornoise_install_if_possible doxygen
command -v doxygen >/dev/null ||
  { echo "build.sh: doxygen is not installed (Debian: apt-get install doxygen)" >&2; exit 69; }
mapfile -t requirements < <(grep -v '^#' "$here/documentation/requirements.txt")
venv="$(sensornoise_venv site "${requirements[@]}")" ||
  { echo "build.sh: ${requirements[*]} cannot be installed" >&2; exit 69; }
python3 "$here/documentation/generate.py" --check
rm -rf "$site"
"$venv/bin/python" -m sphinx -q -E -W --keep-going -j auto -d "$here/build/site-doctrees" -b html \
  "$here/documentation" "$site"
echo "$(find "$site" -name '*.html' | wc -l) pages in $site"
