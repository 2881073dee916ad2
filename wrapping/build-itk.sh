#!/usr/bin/env bash
# Builds the part of ITK that wrapping a module needs, C++ libraries and SWIG interface files, and prints its build tree.
# ITK's own Python modules are in the `itk` wheel and need no compiling.
#
#   build-itk.sh VENV      VENV: a virtual environment with cmake, ninja, swig and itk, see build-wheel.sh
#
# The result is kept in SENSORNOISE_CACHE (default: ~/.cache/itk-sensornoise), keyed by ITK version, compiler, SWIG and
# flags. ITK's source comes from ITK_SOURCE (folder or archive) if set, else from ../shared/itk beside this repository if
# present, else from ITK's release archive, whose checksum is verified.
set -euo pipefail
here="$(cd "$(dirname "$0")/.." && pwd)"
venv="$(cd "$1" && pwd)"
version=5.4.7
cache="${SENSORNOISE_CACHE:-$HOME/.cache/itk-sensornoise}"
python="$venv/bin/python3"
swig="$venv/bin/swig"

flags=(-DCMAKE_BUILD_TYPE=Release -DBUILD_SHARED_LIBS=OFF -DCMAKE_POSITION_INDEPENDENT_CODE=ON -DBUILD_TESTING=OFF
  -DBUILD_EXAMPLES=OFF -DITK_WRAP_PYTHON=ON -DITK_USE_SYSTEM_CASTXML=ON -DITK_USE_SYSTEM_SWIG=ON
  -DITK_BUILD_DEFAULT_MODULES=OFF -DITKGroup_Core=OFF -DModule_ITKMesh=ON -DModule_ITKImageFilterBase=ON
  -DModule_ITKStatistics=ON -DModule_ITKImageCompose=ON -DModule_ITKBridgeNumPy=ON -DModule_ITKEigen3=ON
  # As the wheel: once a filter of the wheel has run, TBB threads everyone, and without it every filter of ours throws.
  -DModule_ITKTBB=ON
  # The wheel's pixel types.
  "-DITK_WRAP_IMAGE_DIMS=2;3" -DITK_WRAP_unsigned_char=ON -DITK_WRAP_unsigned_short=ON -DITK_WRAP_signed_short=ON
  -DITK_WRAP_float=ON -DITK_WRAP_double=ON -DITK_WRAP_rgb_unsigned_char=OFF -DITK_WRAP_rgba_unsigned_char=OFF
  -DITK_WRAP_complex_float=OFF)
key="$( (echo "$version"; c++ --version; "$swig" -version; castxml --version; "$python" --version; echo "${flags[@]}") |
  sha256sum | cut -c1-16)"
tree="$cache/itk-$version-$key"

if [ ! -e "$tree/ready" ]; then
  mkdir -p "$cache"
  source_folder="${ITK_SOURCE:-}"
  if [ ! -d "$source_folder" ]; then
    archive="$source_folder"
    [ -n "$archive" ] || archive="$here/../shared/itk/itk-$version-source.tar.xz"
    if [ ! -e "$archive" ]; then
      [ -z "${ITK_SOURCE:-}" ] || { echo "ITK_SOURCE is $ITK_SOURCE, which does not exist" >&2; exit 2; }
      archive="$cache/InsightToolkit-$version.tar.gz"
      url="https://github.com/InsightSoftwareConsortium/ITK/releases/download/v$version/InsightToolkit-$version.tar.gz"
      curl -fsSL -o "$archive" "$url"
    fi
    source_folder="$cache/source-$version"
    rm -rf "$source_folder" && mkdir -p "$source_folder"
    tar xf "$archive" -C "$source_folder" --strip-components=1
  fi
  # Other programs' standard output goes to standard error: this one's is the build tree.
  {
    "$venv/bin/cmake" -G Ninja -S "$source_folder" -B "$tree" "${flags[@]}" -DSWIG_EXECUTABLE="$swig" \
      -DPython3_EXECUTABLE="$python" -DCMAKE_MAKE_PROGRAM="$venv/bin/ninja"
    targets="$("$venv/bin/ninja" -C "$tree" -t targets all | sed -nE 's/^(lib\/lib[^:]*\.a|[A-Za-z0-9]+Swig):.*/\1/p')"
    # shellcheck disable=SC2086 # a list of words
    "$venv/bin/ninja" -C "$tree" $targets
  } >&2
  touch "$tree/ready"
fi
echo "$tree"
