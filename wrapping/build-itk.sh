#!/usr/bin/env bash
# Builds the part of ITK that wrapping a module needs, C++ libraries and SWIG interface files, and prints its build tree.
# ITK's own Python modules are in the `itk` wheel and need no compiling.
#
#   build-itk.sh VENV      VENV: a virtual environment with cmake, ninja and swig, see build-wheel.sh
#
# The result is kept in SENSORNOISE_CACHE (default: ~/.cache/itk-sensornoise), keyed by ITK version, compiler, SWIG and
# flags: about 10 minutes on 2 cores the first time, nothing later. An interrupted build is resumed, and of two at once
# the second waits for the first. ITK's source comes from
#   1. ITK_SOURCE, a folder or an archive, if set; an archive is verified if ITK_SOURCE_SHA256 is set, too
#   2. ../shared/itk beside this repository, if present
#   3. ITK's release archive; ITK_SOURCE_SHA256 replaces the checksum that is known here
set -euo pipefail
here="$(cd "$(dirname "$0")/.." && pwd)"
[ $# = 1 ] || { sed -n '2,/^set/s/^# \{0,1\}//p' "$0" >&2; exit 2; }
venv="$(cd "$1" && pwd)"
version=5.4.7
release="InsightToolkit-$version.tar.gz"
release_sha256=4907033e0e93fb04734df8556b88a670ba630b4f42b52e9f25ed4d084a7ab925 # as in Homebrew's formula of ITK 5.4.7
shared="$here/../shared/itk/itk-$version-source.tar.xz"
shared_sha256=a4840ec4cea4a0a231f76dda91e627d44c8bce10b6569af642b1a821e06713ba
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
key="$( (echo "$version"; "${CXX:-c++}" --version; "$swig" -version; castxml --version; "$python" --version
  echo "${flags[@]}" ${CFLAGS:+"$CFLAGS"} ${CXXFLAGS:+"$CXXFLAGS"}) | sha256sum | cut -c1-16)"
tree="$cache/itk-$version-$key"

stop() { echo "build-itk.sh: $*" >&2; exit 2; }

# verify ARCHIVE SHA256
verify() {
  local found
  found="$(sha256sum "$1" | cut -d' ' -f1)"
  [ "$found" = "$2" ] || stop "$1 has the SHA-256 $found, expected $2"
}

# Sets source_folder; archives are unpacked under another name first, so that an interruption leaves no half of one.
find_source() {
  local archive="${ITK_SOURCE:-}" expected="${ITK_SOURCE_SHA256:-}" found
  if [ -n "$archive" ]; then
    [ -e "$archive" ] || stop "ITK_SOURCE is $archive, which does not exist"
  elif [ -e "$shared" ]; then
    archive="$shared"
    expected="$shared_sha256"
  else
    archive="$cache/$release"
    expected="${expected:-$release_sha256}"
    if [ ! -e "$archive" ]; then
      curl -fSL --retry 3 -o "$archive.part" \
        "https://github.com/InsightSoftwareConsortium/ITK/releases/download/v$version/$release" ||
        stop "ITK's source is not to be had; set ITK_SOURCE to its folder or archive"
      verify "$archive.part" "$expected"
      mv "$archive.part" "$archive"
    fi
  fi
  if [ -d "$archive" ]; then
    source_folder="$(cd "$archive" && pwd)"
  else
    [ -z "$expected" ] || verify "$archive" "$expected"
    source_folder="$cache/source-$version"
    if [ ! -d "$source_folder" ]; then
      rm -rf "$source_folder.part" && mkdir "$source_folder.part"
      tar xf "$archive" -C "$source_folder.part" --strip-components=1
      mv "$source_folder.part" "$source_folder"
    fi
  fi
  found="$(sed -nE 's/^set\(ITK_VERSION_(MAJOR|MINOR|PATCH) "([0-9]+)"\).*/\2/p' "$source_folder/CMake/itkVersion.cmake" |
    paste -sd.)"
  [ "$found" = "$version" ] || stop "$source_folder is ITK ${found:-of no known version}, expected $version"
}

configured_source() { sed -n 's/^CMAKE_HOME_DIRECTORY:INTERNAL=//p' "$tree/CMakeCache.txt" 2>/dev/null || true; }

mkdir -p "$cache"
exec 9>"$cache/lock"
flock 9
# A tree is of no use without the headers that it was made from.
if [ ! -e "$tree/ready" ] || [ ! -d "$(configured_source)" ]; then
  find_source
  [ "$(configured_source)" = "$source_folder" ] || rm -rf "$tree"
  echo "building ITK $version's libraries and interface files in $tree" >&2
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
echo "ITK $version, key $key" >&2
echo "$tree"
