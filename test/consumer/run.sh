#!/usr/bin/env bash
# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
# Installs a build of the library, then configures, builds and runs the project of this folder, and the project that the
# documents show, against what was installed.
#
#   bash test/consumer/run.sh BUILD_DIR WORK_DIR [options for the consumer's cmake]
#
# BUILD_DIR is a complete build. What is in WORK_DIR is made anew.
set -euo pipefail
here="$(cd "$(dirname "$0")" && pwd)"
[ $# -ge 2 ] || { echo "usage: run.sh BUILD_DIR WORK_DIR [cmake options]" >&2; exit 2; }
build="$1"
work="$2"
shift 2

mkdir -p "$work"
work="$(cd "$work" && pwd)"
rm -rf "$work/prefix" "$work/build"
cmake --install "$build" --prefix "$work/prefix" >"$work/install.log"
# _ROOT is searched first: no other SensorNoise on the machine is taken for the installed one.
cmake -S "$here" -B "$work/build" -DCMAKE_BUILD_TYPE=Release -DSensorNoise_ROOT="$work/prefix" "$@"
cmake --build "$work/build"
"$work/build/consumer"
"$work/build/core"
# The core calls no code of the page: a program links that from a static library where it makes a page.
page_code="$(nm -C "$work/build/core" | grep -E ' sensornoise::(ToHtml|ToSvg|SvgPanel)' || true)"
[ -z "$page_code" ] || { printf 'core has code of the page:\n%s\n' "$page_code" >&2; exit 1; }
[ ! -e "$work/prefix/bin/estimate-sensor-noise" ] || "$work/prefix/bin/estimate-sensor-noise" --version

# The project that the documents show, as it stands there, measures a burst.
rm -rf "$work/shown" "$work/shown-build"
python3 "$here/documents.py" "$work/shown" "$here/../../README.md" "$here/../../documentation/guides/pipeline.md"
cmake -S "$work/shown" -B "$work/shown-build" -DCMAKE_BUILD_TYPE=Release -DCMAKE_PREFIX_PATH="$work/prefix" "$@" \
  >"$work/shown.log" 2>&1 || { cat "$work/shown.log" >&2; exit 1; }
cmake --build "$work/shown-build"
if [ -e "$work/prefix/bin/simulate-sensor-noise" ]; then
  "$work/prefix/bin/simulate-sensor-noise" --frames 20 --size 64x64 --output "$work/burst.tif" >/dev/null
  "$work/shown-build/measure" "$work/burst.tif"
fi
