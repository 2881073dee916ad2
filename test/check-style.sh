#!/usr/bin/env bash
# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
# Checks the sources without running them: clang-format and ruff, the versions named below from the package index, and
# Debian's clang-tidy.
#
#   check-style.sh [PART...]     format: C++ as .clang-format; python: pyproject.toml's ruff; tidy: .clang-tidy
#   check-style.sh --fix         formats, and mends what ruff can mend
#
# The two programs are kept in SENSORNOISE_CACHE (default: ~/.cache/itk-sensornoise), and so is what clang-tidy found
# nothing in, which it does not read again. Exit codes: 0 clean, 69 a program is not to be had (the last line says why),
# another one: something was found.
set -euo pipefail
here="$(cd "$(dirname "$0")/.." && pwd)"
source "$here/examples/setup.sh"
requirements=(clang-format==19.1.7 ruff==0.14.5)
fix=
[ "${1:-}" != --fix ] || { fix=1; set -- format python; }
[ $# -gt 0 ] || set -- format python tidy
failed=()
missing="$here/build/style/missing"
mkdir -p "$here/build/style"
rm -f "$missing"

# Ends a part with sysexits.h's EX_UNAVAILABLE; the others are checked all the same.
unavailable() { echo "$*" >>"$missing"; exit 69; }

install_programs() {
  venv="$(sensornoise_venv style "${requirements[@]}")" || unavailable "${requirements[*]} cannot be installed"
}

check_format() {
  install_programs
  find "$here"/{module,filters,examples,test} \( -name '*.cxx' -o -name '*.h' -o -name '*.hxx' \) -print0 |
    xargs -0 -P "$(nproc)" -n 50 "$venv/bin/clang-format" $([ -n "$fix" ] && echo -i || echo --dry-run --Werror)
}

check_python() {
  install_programs
  local status=0
  "$venv/bin/ruff" check --quiet ${fix:+--fix} "$here"/{wrapping,examples,test,documentation} || status=1
  "$venv/bin/ruff" format --quiet $([ -n "$fix" ] || echo --diff) "$here"/{wrapping,examples,test,documentation} || status=1
  return "$status"
}

check_tidy() {
  command -v clang-tidy >/dev/null || (sensornoise_packages+=(clang-tidy) && sensornoise_install) >&2 || true
  command -v clang-tidy >/dev/null || unavailable "clang-tidy cannot be installed"
  # Only configured: for the headers that CMake writes, and for what each source is compiled with.
  cmake -G Ninja -S "$here" -B "$here/build/style" -DCMAKE_EXPORT_COMPILE_COMMANDS=ON -DSensorNoise_UNITY_BUILD=OFF \
    -DBUILD_TESTING=OFF >"$here/build/style/configure.log" 2>&1 || { cat "$here/build/style/configure.log" >&2; return 1; }
  "${PYTHON:-python3}" "$here/test/tidy.py" "$here/build/style/compile_commands.json" --cache "$sensornoise_cache/tidy"
}

for part in "$@"; do
  case "$part" in format | python | tidy) ;; *) sed -n '4,/^set/s/^# \{0,1\}//p' "$0" >&2; exit 2 ;; esac
  SECONDS=0
  # Not `check || …`: there bash would ignore set -e inside it.
  set +e
  (set -e; "check_$part")
  status=$?
  set -e
  [ "$status" = 0 ] || [ "$status" = 69 ] || failed+=("$part")
  echo "$part: $SECONDS s"
done
[ ${#failed[@]} = 0 ] || { echo "check-style.sh: failed: ${failed[*]}" >&2; exit 1; }
[ ! -e "$missing" ] || { echo "check-style.sh: $(sort -u "$missing" | paste -sd ';')" >&2; exit 69; }
