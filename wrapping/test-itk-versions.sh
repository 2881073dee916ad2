#!/usr/bin/env bash
# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
# Tests a wheel with the oldest and the newest ITK 5.4 of the package index, each in a fresh virtual environment in build/.
# The last lines say which versions passed. Exit codes: 0 both passed, another one: a test failed, or ITK is not to be had.
#
#   test-itk-versions.sh [WHEEL [options for pytest]]      default: the wheel in dist/, all tests of Python
set -euo pipefail
here="$(cd "$(dirname "$0")/.." && pwd)"
source "$here/examples/setup.sh"
wheel="${1:-$(echo "$here"/dist/itk_sensornoise-*.whl)}"
[ -e "$wheel" ] || { echo "there is no wheel $wheel: build it by wrapping/build-wheel.sh" >&2; exit 2; }
wheel="$(realpath "$wheel")"
uv="$(sensornoise_venv uv 'uv>=0.9,<1')/bin/uv"
export UV_CACHE_DIR="$sensornoise_cache/uv" SENSORNOISE_BIN="${SENSORNOISE_BIN:-$here/build/bin}"
mkdir -p "$here/build"
cd "$here/build" # so that nothing of the checkout is imported
results=()
status=0
# Of the requirements named here, uv takes the oldest versions or the newest; of all others, the newest.
for resolution in lowest-direct highest; do
  venv="$here/build/python-$resolution"
  "${PYTHON:-python3}" -m venv --clear "$venv"
  "$uv" pip install -q --python "$venv/bin/python" --resolution "$resolution" "$wheel[test]" 'itk==5.4.*'
  version="$("$venv/bin/python" -c 'from importlib.metadata import version; print(version("itk-core"))')"
  echo "ITK $version:"
  if "$venv/bin/python" -m pytest -p no:cacheprovider -q "${@:2}" "$here/wrapping/test"; then
    results+=("ITK $version: passed")
  else
    results+=("ITK $version: failed")
    status=1
  fi
done
printf '%s\n' "${results[@]}"
exit "$status"
