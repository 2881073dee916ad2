#!/usr/bin/env bash
# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
# Installs what is missing, builds into build/, and measures a camera.
#
#   bash examples/quickstart.sh                  a simulated burst: camera B, condition 3 of Sur & Grediac 2015
#   bash examples/quickstart.sh FRAME...         your own raw frames in time order, or one stack file
#
# With SENSORNOISE_BUILT=1 it measures by the programs that build/bin holds, and neither installs nor builds.
set -euo pipefail
here="$(cd "$(dirname "$0")/.." && pwd)"
source "$here/examples/setup.sh"

if [ "${SENSORNOISE_BUILT:-}" != 1 ]; then
  sensornoise_install
  sensornoise_build "$here/build" -DBUILD_TESTING=OFF -DSensorNoise_BUILD_STUDIES=OFF
fi

if [ $# -gt 0 ]; then
  exec "$here/build/bin/estimate-sensor-noise" "$@"
fi
work="$here/build/quickstart"
mkdir -p "$work"
"$here/build/bin/simulate-sensor-noise" --camera B --condition 3 --seed 1 --output "$work/stack.mha" --truth "$work/truth.json"
"$here/build/bin/estimate-sensor-noise" "$work/stack.mha" --json "$work/report.json"
echo
python3 - "$work/truth.json" "$work/report.json" <<'PY'
import json, sys

truth, report = (json.load(open(name)) for name in sys.argv[1:])
print(f"{'quantity':<24} {'truth':>10} {'estimate':>10}  error")
rows = [("gain g", truth["gain"], report["gain"]),
        ("offset mu", truth["offset"], report["offset"]),
        ("read noise sigma", truth["read_noise"], report["read_noise"]),
        ("intercept sigma² - g mu", truth["intercept"], report["intercept"]),
        ("flicker sd", truth["realised_flicker_sd"], report["flicker_sd"]),
        ("vibration sd x", truth["realised_vibration_sd"][0], report["vibration"]["sd_x"]),
        ("vibration sd y", truth["realised_vibration_sd"][1], report["vibration"]["sd_y"])]
for name, value, quantity in rows:
    estimate = "-" if quantity["value"] is None else f"{quantity['value']:.5g}"
    error = "" if quantity["standard_error"] is None else f"± {quantity['standard_error']:.2g}"
    print(f"{name:<24} {value:>10.5g} {estimate:>10}  {error:<10} {quantity['unit'].replace('e-', 'e⁻').replace('^2', '²')}")
PY
echo "stack, truth and report: $work"
