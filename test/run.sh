#!/usr/bin/env bash
# Installs what is missing, builds into build/ and runs every test: C++, then Python (examples and tests) with the wheel in a
# fresh virtual environment. Options are handed on to ctest, for example -R Codes.
#
# Python needs ITK's source (wrapping/build-itk.sh says where that comes from). Where it is not to be had, the last line says
# so, and what was tested counts. SENSORNOISE_PYTHON=1: that is a failure, too; SENSORNOISE_PYTHON=0: Python is left out.
set -euo pipefail
here="$(cd "$(dirname "$0")/.." && pwd)"
source "$here/examples/setup.sh"

sensornoise_install
sensornoise_build "$here/build" -DBUILD_TESTING=ON -DSensorNoise_BUILD_STUDIES=ON
failed=()
ctest --test-dir "$here/build" --output-on-failure -j "$(nproc)" "$@" || failed+=(C++)

# test_wheel WHEEL: the wheel as a user installs it. Run from build/, so that nothing of the checkout is imported.
test_wheel() (
  set -e
  venv="$here/build/python"
  "${PYTHON:-python3}" -m venv --clear "$venv"
  "$venv/bin/pip" -q --disable-pip-version-check install "$1[test]"
  cd "$here/build"
  export PYTHONDONTWRITEBYTECODE=1 SENSORNOISE_BIN="$here/build/bin"
  "$venv/bin/python" "$here/examples/python/estimate.py"
  "$venv/bin/python" "$here/examples/python/pipeline.py"
  "$venv/bin/python" "$here/examples/python/run_notebook.py" executed.ipynb
  "$venv/bin/python" -m pytest -p no:cacheprovider "$here/wrapping/test"
)
untested=
if [ "${SENSORNOISE_PYTHON:-}" != 0 ]; then
  log="$here/build/wheel.log"
  # Not `test_wheel || …`: there bash would ignore set -e inside it.
  set +e
  # The wheel's path goes to a file: what the build says, and no more, goes on to the screen and to the log.
  bash "$here/wrapping/build-wheel.sh" 2>&1 >"$here/build/wheel.path" | tee "$log" >&2
  status="${PIPESTATUS[0]}"
  if [ "$status" = 69 ] && [ "${SENSORNOISE_PYTHON:-}" != 1 ]; then
    untested="$(sed -n '$s/^build-itk.sh: //p' "$log")"
  elif [ "$status" = 0 ]; then
    test_wheel "$(cat "$here/build/wheel.path")"
    status=$?
  fi
  set -e
  [ "$status" = 0 ] || [ -n "$untested" ] || failed+=(Python)
fi
[ -z "$untested" ] || echo "Python: not tested, $untested" >&2
[ ${#failed[@]} = 0 ] || { echo "failed: ${failed[*]}" >&2; exit 1; }
