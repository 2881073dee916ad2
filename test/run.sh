#!/usr/bin/env bash
# Installs what is missing, builds into build/ and runs every test: C++, then Python (examples and tests) with the wheel in a
# fresh virtual environment (SENSORNOISE_PYTHON=0 leaves Python out). Options are handed on to ctest, for example -R Codes.
set -euo pipefail
here="$(cd "$(dirname "$0")/.." && pwd)"
source "$here/examples/setup.sh"

sensornoise_install
sensornoise_build "$here/build" -DBUILD_TESTING=ON
failed=()
ctest --test-dir "$here/build" --output-on-failure -j "$(nproc)" "$@" || failed+=(C++)

# test_wheel: the wheel as a user installs it. Run from build/, so that nothing of the checkout is imported.
test_wheel() (
  set -e
  wheel="$(bash "$here/wrapping/build-wheel.sh")"
  venv="$here/build/python"
  "${PYTHON:-python3}" -m venv --clear "$venv"
  "$venv/bin/pip" -q --disable-pip-version-check install "${wheel}[test]"
  cd "$here/build"
  export PYTHONDONTWRITEBYTECODE=1 SENSORNOISE_BIN="$here/build/bin"
  "$venv/bin/python" "$here/examples/python/estimate.py"
  "$venv/bin/python" "$here/examples/python/pipeline.py"
  "$venv/bin/python" "$here/examples/python/run_notebook.py" executed.ipynb
  "$venv/bin/python" -m pytest -p no:cacheprovider "$here/wrapping/test"
)
if [ "${SENSORNOISE_PYTHON:-1}" != 0 ]; then
  # Not `test_wheel || …`: there bash would ignore set -e inside it.
  set +e
  test_wheel
  status=$?
  set -e
  [ "$status" = 0 ] || failed+=(Python)
fi
[ ${#failed[@]} = 0 ] || { echo "failed: ${failed[*]}" >&2; exit 1; }
