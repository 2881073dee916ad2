#!/usr/bin/env bash
# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
# Installs what is missing, builds into build/ and runs every test: C++ with damaged files among them, then the site of the
# documentation, then Python (examples, tests, damaged files) with the wheel in a fresh virtual environment, then C++ once more
# with AddressSanitizer and UndefinedBehaviorSanitizer, in build/sanitized, then 20 seconds of libFuzzer for each file format,
# which are skipped where clang cannot be had. Warnings are errors, and test/check-style.sh has no finding. The last lines say
# what each part took, and what it found in the caches. Options are handed on to ctest, for example -R StackMaps.
#
# Python needs ITK's source (wrapping/build-itk.sh says where that comes from). Where it is not to be had, the last line says
# so, and what was tested counts. SENSORNOISE_PYTHON=1: that is a failure, too; SENSORNOISE_PYTHON=0: Python is left out.
# SENSORNOISE_STYLE in the same way: 1, or CI=true: it is a failure that a program which checks the style is not to be had;
# 0: the style is left out. SENSORNOISE_SITE in the same way, for the site of the documentation. SENSORNOISE_SANITIZE=0: the
# sanitizers are left out; SENSORNOISE_FUZZ=0: libFuzzer is; SENSORNOISE_BROWSER=0: the page that measures bursts in a browser
# is, which is skipped where Emscripten cannot be had. SENSORNOISE_TIME_LIMIT=SECONDS: sanitizers and libFuzzer are left out, and
# the last lines say so, if the parts before them took longer, as a cold build may. examples/setup.sh has the variables of the
# caches.
set -euo pipefail
here="$(cd "$(dirname "$0")/.." && pwd)"
source "$here/examples/setup.sh"
export SENSORNOISE_WARNINGS_AS_ERRORS="${SENSORNOISE_WARNINGS_AS_ERRORS:-ON}"

started="$(date +%s)"
failed=()
skipped=()
times=()
export CCACHE_STATSLOG="$here/build/ccache.log" # what ccache did since a part began
# took PART: notes the time since the last part ended, and how many of its objects ccache had.
took() {
  local objects=0 found=0 note=
  if [ -e "$CCACHE_STATSLOG" ]; then
    found="$(grep -cE '^(direct|preprocessed)_cache_hit' "$CCACHE_STATSLOG")" || true
    objects="$((found + $(grep -c '^cache_miss' "$CCACHE_STATSLOG" || true)))"
    rm -f "$CCACHE_STATSLOG"
  fi
  [ "$objects" = 0 ] || note="$found of $objects objects from the cache"
  times+=("$(printf '%6d s  %-26s %s' "$SECONDS" "$1" "$note")")
  SECONDS=0
}

# is_in_time PART: whether the limit of the time leaves room for a part. If not, it is noted as skipped.
is_in_time() {
  local elapsed="$(($(date +%s) - started))"
  [ "$elapsed" -gt "${SENSORNOISE_TIME_LIMIT:-$elapsed}" ] || return 0
  skipped+=("$1: not run, the parts before took $elapsed s, and SENSORNOISE_TIME_LIMIT is $SENSORNOISE_TIME_LIMIT s")
  return 1
}

# run_cpp_tests FOLDER [options for ctest]
run_cpp_tests() {
  local status=0
  rm -rf "$1/test-results"
  ctest --test-dir "$1" --output-on-failure -j "$(nproc)" "${@:2}" || status=$?
  python3 "$here/test/summarise_tests.py" "$1/test-results" --longest 5 || true
  return "$status"
}

# is_required VALUE: whether a part must not be skipped, by the value of its variable.
is_required() {
  if [ "$1" = 1 ] || [ "${CI:-}" = true ]; then echo yes; else echo no; fi
}

# run_part NAME TIMED SKIPPED REQUIRED SCRIPT [arguments]: runs a part with a log of its own, and notes its time. A script that
# cannot run exits with 69, and its last line, "script: reason", says why: unless REQUIRED is yes, that is noted with the
# words SKIPPED. Any other exit code is a failure of NAME.
run_part() {
  local log="$here/build/${1// /-}.log" status
  # Not `bash … || …`: the exit code of tee would be the one looked at.
  set +e
  bash "${@:5}" 2>&1 | tee "$log"
  status="${PIPESTATUS[0]}"
  set -e
  if [ "$status" = 69 ] && [ "$4" != yes ]; then
    skipped+=("$3, $(sed -n '$s/^[^ ]*\.sh: //p' "$log")")
  elif [ "$status" != 0 ]; then
    failed+=("$1")
  fi
  took "$2"
}

# OpenCV that reads images and videos, for examples/opencv: 60 MB to download, 230 MB on the disk.
sensornoise_packages+=(libopencv-imgcodecs-dev libopencv-videoio-dev)

mkdir -p "$here/build"
rm -f "$here"/build/{pytest,fuzz,coverage-guided-search,ccache}.log
SECONDS=0
sensornoise_install
# A browser for the pages of --plot: 115 MB to download, 360 MB on the disk. Without it their tests are skipped.
command -v chromium >/dev/null || sensornoise_install_if_possible chromium
sensornoise_prune_cache
took "packages"
sensornoise_build "$here/build" -DBUILD_TESTING=ON -DSensorNoise_BUILD_STUDIES=ON \
  -DSensorNoise_BUILD_INFLUENCE=ON -DSensorNoise_INFLUENCE_FLAGS=-O1
took "build"
run_cpp_tests "$here/build" "$@" || failed+=(C++)
took "C++ tests"

# The page in a browser, which Python's tests look at.
if [ "${SENSORNOISE_BROWSER:-}" != 0 ]; then
  run_part "page in a browser" "build of the page" "page in a browser: not built" no "$here/examples/browser/build.sh"
fi

if [ "${SENSORNOISE_STYLE:-}" != 0 ]; then
  run_part style style "style: not checked" "$(is_required "${SENSORNOISE_STYLE:-}")" "$here/test/check-style.sh"
fi

if [ "${SENSORNOISE_SITE:-}" != 0 ]; then
  run_part documentation "site of the documentation" "site of the documentation: not built" \
    "$(is_required "${SENSORNOISE_SITE:-}")" "$here/documentation/build.sh" "$here/build/site"
fi

# test_wheel WHEEL: the wheel as a user installs it. Run from build/, so that nothing of the checkout is imported.
test_wheel() (
  set -e
  venv="$here/build/python"
  "${PYTHON:-python3}" -m venv --clear "$venv"
  # uv links to the packages in its cache, in a second; pip takes two minutes to copy and compile them.
  uv="$(sensornoise_venv uv 'uv>=0.9,<1')/bin/uv"
  export UV_CACHE_DIR="$sensornoise_cache/uv"
  "$uv" pip install -q --python "$venv/bin/python" "$1[test]"
  "$uv" cache prune -q
  [ "$(du -sm "$UV_CACHE_DIR" | cut -f1)" -lt 5000 ] || "$uv" cache clean -q # MB
  cd "$here/build"
  # Hundreds of interpreters import the same packages: each is compiled to bytecode once.
  unset PYTHONDONTWRITEBYTECODE
  export PYTHONPYCACHEPREFIX="$here/build/pycache" SENSORNOISE_BIN="$here/build/bin"
  "$venv/bin/python" "$here/examples/python/estimate.py"
  "$venv/bin/python" "$here/examples/python/denoise.py" --picture denoised.png
  "$venv/bin/python" "$here/examples/python/lazy.py"
  "$venv/bin/python" "$here/examples/python/pipeline.py"
  "$venv/bin/python" "$here/examples/python/run_notebook.py" executed.ipynb
  # Whole files to one process each: they share the stacks that they simulate.
  "$venv/bin/python" -m pytest -p no:cacheprovider -n "$(nproc)" --dist loadfile --durations 5 "$here/wrapping/test" 2>&1 |
    tee pytest.log
  "$venv/bin/python" "$here/test/fuzz/fuzz_files.py" --bin "$SENSORNOISE_BIN" --python "$venv/bin/python" --count 1000 \
    --seconds 120 2>&1 | tee fuzz.log
)
if [ "${SENSORNOISE_PYTHON:-}" != 0 ]; then
  log="$here/build/wheel.log"
  # Not `test_wheel || …`: there bash would ignore set -e inside it.
  set +e
  # The wheel's path goes to a file: what the build says, and no more, goes on to the screen and to the log.
  bash "$here/wrapping/build-wheel.sh" 2>&1 >"$here/build/wheel.path" | tee "$log" >&2
  status="${PIPESTATUS[0]}"
  took "wheel"
  if [ "$status" = 69 ] && [ "${SENSORNOISE_PYTHON:-}" != 1 ]; then
    skipped+=("Python: not tested, $(sed -n '$s/^build-itk.sh: //p' "$log")")
    status=0
  elif [ "$status" = 0 ]; then
    test_wheel "$(cat "$here/build/wheel.path")"
    status=$?
    took "Python tests"
  fi
  set -e
  [ "$status" = 0 ] || failed+=(Python)
fi

if [ "${SENSORNOISE_SANITIZE:-}" != 0 ] && is_in_time sanitizers; then
  cmake -S "$here" --preset sanitized >"$here/build/sanitized.log" 2>&1 ||
    { cat "$here/build/sanitized.log" >&2; exit 1; }
  cmake --build "$here/build/sanitized"
  took "build with sanitizers"
  # ITK keeps what it allocates once, and hands over vectors that it filled itself.
  ASAN_OPTIONS=detect_leaks=0:detect_container_overflow=0 run_cpp_tests "$here/build/sanitized" "$@" ||
    failed+=("C++ with sanitizers")
  took "C++ tests with sanitizers"
fi

if [ "${SENSORNOISE_FUZZ:-}" != 0 ] && is_in_time "coverage-guided search for damaged files"; then
  run_part "coverage-guided search" "coverage-guided search" "coverage-guided search for damaged files: skipped" no \
    "$here/test/fuzz/coverage_guided.sh" --runs 30000
fi

# What failed once more, where it is seen: hundreds of lines may stand between.
grep -hE '^(FAILED|ERROR) ' "$here/build/pytest.log" 2>/dev/null || true
grep -hE '^(CRASH|HANG|[A-Z ]+): number ' "$here/build/fuzz.log" 2>/dev/null || true
grep -hE '^(FINDING|  file: )' "$here/build/coverage-guided-search.log" 2>/dev/null || true
cat "$here"/build/Testing/Temporary/LastTestsFailed*.log "$here"/build/sanitized/Testing/Temporary/LastTestsFailed*.log \
  2>/dev/null || true
echo "what each part took:"
printf '%s\n' "${times[@]}" | sort -rn
[ ! -d "$sensornoise_cache" ] || echo "caches: $(du -sh "$sensornoise_cache" | cut -f1) in $sensornoise_cache"
[ ${#skipped[@]} = 0 ] || printf '%s\n' "${skipped[@]}" >&2
[ ${#failed[@]} = 0 ] || { echo "failed: ${failed[*]}" >&2; exit 1; }
