#!/usr/bin/env bash
# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
# Searches for damaged files that the readers of module/src/files do not survive, by clang's libFuzzer with
# AddressSanitizer and UndefinedBehaviorSanitizer: each format of FrameFile.cxx for itself, guided by the code that it
# reaches. It begins with the files of coverage_seeds.py. Of raw files of cameras it tries what is checked before LibRaw
# decodes them; LibRaw itself, and frames without a header, are not in it.
#
#   coverage_guided.sh [--seconds N] [--runs N] [--format NAME]... [--jobs N]
#
#   --seconds N      at most, for each format (default: 20)
#   --runs N         inputs of each format at most (default: no limit). A limit that is reached repeats exactly
#   --format NAME    as FrameFile.cxx calls it; several times for several formats (default: all)
#   --jobs N         formats at a time (default: one for each processor)
#
# A crash, a finding of a sanitizer, an input of more than 20 seconds, an allocation of more than 192 MB, and pixels that
# cannot be read after an inspection without an error are findings. The file of a finding is kept in
# build/coverage-guided/findings. Prints what each format took and reached: edges, and features, which are edges with the
# number of times that they are taken. Exit codes: 0 clean, 1 findings, 69 clang cannot be had (the last line says why).
set -euo pipefail
cd "$(dirname "$0")/../.."
source examples/setup.sh
seconds=20
runs=-1
jobs="$(nproc)"
formats=()
while [ $# -gt 0 ]; do
  case "$1" in
  --seconds) seconds="${2:?--seconds needs a number}" ;;
  --runs) runs="${2:?--runs needs a number}" ;;
  --format) formats+=("${2:?--format needs a name}") ;;
  --jobs) jobs="${2:?--jobs needs a number}" ;;
  *) sed -n '4,/^set/s/^# \{0,1\}//p' "$0" >&2; exit 2 ;;
  esac
  shift 2
done

folder=build/coverage-guided
rm -rf "$folder"
mkdir -p "$folder"/{findings,logs}

flags=(-std=c++17 -O1 -g1 -Werror -Wall -Wextra -Wshadow -Wconversion -Wno-sign-conversion -Wformat-nonliteral
  -Wctad-maybe-unsupported -D_GLIBCXX_ASSERTIONS -fsanitize=address -fsanitize=undefined -fsanitize=float-cast-overflow
  -fno-sanitize-recover=all -Imodule/src -Imodule/include "-I$folder")

install_clang() {
  command -v clang++ >/dev/null || sensornoise_install_if_possible clang
  if command -v clang++ >/dev/null && [ ! -e "$(clang++ --print-runtime-dir)/libclang_rt.fuzzer-$(uname -m).a" ]; then
    sensornoise_install_if_possible "libclang-rt-$(clang++ -dumpversion | cut -d. -f1)-dev"
  fi
  echo 'extern "C" int LLVMFuzzerTestOneInput(const unsigned char *, unsigned long) { return 0; }' >"$folder/probe.cxx"
  clang++ "${flags[@]}" -fsanitize=fuzzer "$folder/probe.cxx" -o "$folder/probe" >"$folder/logs/probe" 2>&1
}

# The library's readers as one source, which compiles in a quarter of a minute; none of them needs ITK.
build() {
  local compiler=(clang++)
  sensornoise_use_ccache "$PWD"
  [ -z "${CMAKE_CXX_COMPILER_LAUNCHER:-}" ] || compiler=(ccache clang++)
  printf '%s\n' '#define SensorNoise_EXPORT' >"$folder/SensorNoiseExport.h"
  printf '#include "%s"\n' module/src/base/Text.cxx module/src/files/*.cxx | sed 's,module/src/,,' >"$folder/readers.cxx"
  "${compiler[@]}" "${flags[@]}" -fsanitize=fuzzer-no-link -c "$folder/readers.cxx" -o "$folder/readers.o"
  "${compiler[@]}" "${flags[@]}" -fsanitize=fuzzer-no-link -c test/fuzz/FrameFileFuzzer.cxx -o "$folder/fuzzer.o"
  clang++ "${flags[@]}" -fsanitize=fuzzer "$folder/fuzzer.o" "$folder/readers.o" -lz -o "$folder/frame-file-fuzzer"
}

# search FORMAT: a row of the table; fails with a finding.
search() {
  local name="${1// /-}" status=0 log row
  log="$folder/logs/$name" # its last row of numbers: "#1234 DONE cov: 567 ft: 890 corp: ..."
  mkdir -p "$folder/corpus/$1"
  "$folder/frame-file-fuzzer" "--format=$1" -seed=1 "-max_total_time=$seconds" "-runs=$runs" -max_len=65536 -timeout=20 \
    -malloc_limit_mb=192 -rss_limit_mb=1024 -print_final_stats=1 "-artifact_prefix=$folder/findings/$name-" \
    "$folder/corpus/$1" "$folder/seeds/$1" >"$log" 2>&1 || status=$?
  row="$(grep -E '^#[0-9]+.* cov: ' "$log" | tail -1)"
  [ -n "$row" ] || row=" cov: 0 ft: 0"
  printf '%-12s %12s %8s %10s %10s\n' "$1" "$(sed -n 's/^stat::number_of_executed_units: *//p' "$log")" \
    "$(sed -n 's/.* cov: \([0-9]*\).*/\1/p' <<<"$row")" "$(sed -n 's/.* ft: \([0-9]*\).*/\1/p' <<<"$row")" \
    "$([ "$status" = 0 ] && echo 0 || echo 1)"
  [ "$status" != 0 ] || return 0
  {
    echo "FINDING in $1: $(grep -m 1 -oE 'FINDING: .*|runtime error: .*|ERROR: .*|terminate called.*' "$log" || echo "exit code $status")"
    sed -n 's/.*Test unit written to /  file: /p' "$log"
    echo "  again: $folder/frame-file-fuzzer \"--format=$1\" FILE; log: $log"
  } >&2
  return 1
}

install_clang >&2 || { echo "coverage_guided.sh: clang with libFuzzer cannot be installed" >&2; exit 69; }
build
mapfile -t known < <(PYTHONDONTWRITEBYTECODE=1 python3 test/fuzz/coverage_seeds.py "$folder/seeds")
[ ${#formats[@]} -gt 0 ] || formats=("${known[@]}")
for format in "${formats[@]}"; do
  [ -d "$folder/seeds/$format" ] || { echo "no format $format; expected one of: ${known[*]}" >&2; exit 2; }
done
echo "built in $SECONDS s"

# In memory where the system has such a folder: each input is a file.
TMPDIR="$(mktemp -d -p "$([ -w /dev/shm ] && echo /dev/shm || echo "${TMPDIR:-/tmp}")" sensornoise-XXXXXX)"
export TMPDIR folder seconds runs
export -f search
trap 'rm -rf "$TMPDIR"' EXIT
printf '%-12s %12s %8s %10s %10s\n' format executions edges features findings
printf '%s\0' "${formats[@]}" | xargs -0 -P "$jobs" -I{} bash -c 'search "$1"' _ {} || exit 1
