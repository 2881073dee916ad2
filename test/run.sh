#!/usr/bin/env bash
# Installs what is missing, builds into build/ and runs every test. Options are handed on to ctest, for example -R Codes.
set -euo pipefail
here="$(cd "$(dirname "$0")/.." && pwd)"
source "$here/examples/setup.sh"

sensornoise_install
sensornoise_build "$here/build" -DBUILD_TESTING=ON
cd "$here/build"
ctest --output-on-failure -j "$(nproc)" "$@"
