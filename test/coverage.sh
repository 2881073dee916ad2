#!/usr/bin/env bash
# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
# Prints which fraction of the lines of module/, filters/ and examples/tools/ the C++ tests run, and writes pages that show each
# line into build/coverage/report. Builds with the preset "coverage" in build/coverage, which takes as long as a first build.
# Exit codes: 0 done, 69 gcovr cannot be installed, another one: a test failed, or fewer lines than SENSORNOISE_LEAST_COVERAGE
# (default: 80, in percent) are run.
#
#   coverage.sh [options for ctest]
set -euo pipefail
here="$(cd "$(dirname "$0")/.." && pwd)"
source "$here/examples/setup.sh"
folder="$here/build/coverage"
sensornoise_install
venv="$(sensornoise_venv coverage 'gcovr==8.3')" || { echo "coverage.sh: gcovr cannot be installed" >&2; exit 69; }
mkdir -p "$folder/report"
sensornoise_use_ccache "$here"
cmake -S "$here" --preset coverage >"$folder/configure.log" 2>&1 || { cat "$folder/configure.log" >&2; exit 1; }
cmake --build "$folder"
find "$folder" -name '*.gcda' -delete # what an earlier run counted
export GCOV_ERROR_FILE=/dev/null # tests of full disks and foreign users would read its complaints as ours
status=0
ctest --test-dir "$folder" --output-on-failure -j "$(nproc)" "$@" || status=$? # the figure is printed all the same
"$venv/bin/gcovr" --root "$here" --filter "$here/module/" --filter "$here/filters/" --filter "$here/examples/tools/" \
  --gcov-ignore-parse-errors --print-summary --html-details "$folder/report/index.html" --json-summary "$folder/report/summary.json" \
  --fail-under-line "${SENSORNOISE_LEAST_COVERAGE:-80}" "$folder" || status=$?
exit "$status"
