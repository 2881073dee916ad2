#!/usr/bin/env bash
# Builds the part of ITK that wrapping a module needs, C++ libraries and SWIG interface files, and prints its build tree.
# ITK's own Python modules are in the `itk` wheel and need no compiling.
#
#   build-itk.sh VENV      VENV: a virtual environment with cmake, ninja and swig, see build-wheel.sh
#
# The result is kept in SENSORNOISE_CACHE (default: ~/.cache/itk-sensornoise), keyed by ITK version, compiler, SWIG and
# flags: about 10 minutes on 2 cores the first time, nothing later. An interrupted build is resumed, and of two at once
# the second waits for the first. ITK's source comes from the first of these that is to be had:
#   1. ITK_SOURCE, a folder or an archive, if set; an archive is verified if ITK_SOURCE_SHA256 is set, too
#   2. ../shared/itk beside this repository
#   3. the cache, where it stays once unpacked
#   4. ITK's release archive, in the cache or from its page; ITK_SOURCE_SHA256 replaces the checksum that is known here
#   5. the distribution's source package (Debian, Ubuntu), where that is the same version; apt verifies it
# Exit codes: 0 done, 69 the source is not to be had (the last line says why), another one: anything else went wrong.
set -euo pipefail
here="$(cd "$(dirname "$0")/.." && pwd)"
source "$here/examples/setup.sh"
[ $# = 1 ] || { sed -n '2,/^set/s/^# \{0,1\}//p' "$0" >&2; exit 2; }
venv="$(cd "$1" && pwd)"
version=5.4.7
release="InsightToolkit-$version.tar.gz"
release_sha256=4907033e0e93fb04734df8556b88a670ba630b4f42b52e9f25ed4d084a7ab925 # as in Homebrew's formula of ITK 5.4.7
shared="$here/../shared/itk/itk-$version-source.tar.xz"
shared_sha256=a4840ec4cea4a0a231f76dda91e627d44c8bce10b6569af642b1a821e06713ba
cache="$sensornoise_cache"
python="$venv/bin/python3"
swig="$venv/bin/swig"

flags=(-DCMAKE_BUILD_TYPE=Release -DBUILD_SHARED_LIBS=OFF -DCMAKE_POSITION_INDEPENDENT_CODE=ON -DBUILD_TESTING=OFF
  -DBUILD_EXAMPLES=OFF -DITK_WRAP_PYTHON=ON -DITK_USE_SYSTEM_CASTXML=ON -DITK_USE_SYSTEM_SWIG=ON
  -DITK_BUILD_DEFAULT_MODULES=OFF -DITKGroup_Core=OFF -DModule_ITKMesh=ON -DModule_ITKImageFilterBase=ON
  -DModule_ITKStatistics=ON -DModule_ITKImageCompose=ON -DModule_ITKBridgeNumPy=ON -DModule_ITKEigen3=ON
  -DModule_ITKIOImageBase=ON -DModule_ITKZLIB=ON
  # The formats that the command-line tools of the wheel write.
  -DModule_ITKIOMeta=ON -DModule_ITKIONRRD=ON -DModule_ITKIOTIFF=ON
  # As the wheel: once a filter of the wheel has run, TBB threads everyone, and without it every filter of ours throws.
  -DModule_ITKTBB=ON
  # The wheel's pixel types.
  "-DITK_WRAP_IMAGE_DIMS=2;3" -DITK_WRAP_unsigned_char=ON -DITK_WRAP_unsigned_short=ON -DITK_WRAP_signed_short=ON
  -DITK_WRAP_float=ON -DITK_WRAP_double=ON -DITK_WRAP_rgb_unsigned_char=OFF -DITK_WRAP_rgba_unsigned_char=OFF
  -DITK_WRAP_complex_float=OFF)
key="$( (echo "$version"; "${CXX:-c++}" --version; "$swig" -version; castxml --version; "$python" --version
  echo "${flags[@]} file-prefix-map" ${CFLAGS:+"$CFLAGS"} ${CXXFLAGS:+"$CXXFLAGS"}) | sha256sum | cut -c1-16)"
tree="$cache/itk-$version-$key"

stop() { echo "build-itk.sh: $*" >&2; exit 2; }

# Ends with sysexits.h's EX_UNAVAILABLE, which no program called here returns.
unavailable() {
  local why
  why="$(printf '; %s' "${tried[@]}")"
  echo "build-itk.sh: ITK $version's source is not to be had (${why#; }); ITK_SOURCE can name a folder or an archive" >&2
  exit 69
}

# verify ARCHIVE SHA256
verify() {
  local found
  found="$(sha256sum "$1" | cut -d' ' -f1)"
  [ "$found" = "$2" ] || stop "$1 has the SHA-256 $found, expected $2"
}

# Where the source was looked for in vain, and why.
tried=()

# download_release ARCHIVE SHA256
download_release() {
  local page="https://github.com/InsightSoftwareConsortium/ITK/releases/download/v$version/$release" message status=0
  message="$(curl -fSL --connect-timeout 20 --retry 3 -w '%{errormsg}' -o "$1.part" "$page")" || status=$?
  if [ "$status" != 0 ]; then
    tried+=("release page: ${message:-"curl ended with $status"}")
    return 1
  fi
  verify "$1.part" "$2"
  mv "$1.part" "$1"
}

# Sets archive. apt gets a state of its own and the system's repositories as repositories of source: that needs no
# root and changes nothing in the system.
download_package() {
  local package="insighttoolkit${version%%.*}" apt list parts file found candidate upstream
  if ! command -v apt-get >/dev/null; then
    tried+=("no apt-get")
    return 1
  fi
  apt="$(cd "$cache" && pwd)/apt"
  rm -rf "$apt/sources" && mkdir -p "$apt/sources" "$apt/lists/partial" "$apt/archives/partial"
  eval "$(apt-config shell list Dir::Etc::sourcelist/f parts Dir::Etc::sourceparts/d)"
  for file in "$list" "$parts"/*.list "$parts"/*.sources; do
    [ ! -e "$file" ] ||
      sed -E 's/^[[:space:]]*deb(-src)?[[:space:]]/deb-src /; s/^Types:.*/Types: deb-src/' "$file" \
        >"$apt/sources/${file##*/}"
  done
  local own=(-o Dir::Etc::SourceList=/dev/null -o Dir::Etc::SourceParts="$apt/sources" -o Dir::State::Lists="$apt/lists"
    -o Dir::Cache="$apt" -o APT::Sandbox::User=root -o Acquire::Languages=none -o Acquire::http::Timeout=10)
  # One repository of several without source is no failure.
  apt-get "${own[@]}" -qq update >"$apt/log" 2>&1 || true
  found="$(apt-cache "${own[@]}" showsrc "$package" 2>>"$apt/log" | sed -n 's/^Version: //p')" || true
  for candidate in $found; do
    # Without epoch and revision. One that was repacked (5.4.7+dfsg) lacks libraries that the build takes from it.
    upstream="${candidate#*:}"
    [ "${upstream%-*}" = "$version" ] || continue
    if (cd "$apt" && apt-get "${own[@]}" -q source --download-only --tar-only "$package=$candidate" >&2); then
      archive="$(find "$apt" -maxdepth 1 -name "${package}_$version.orig.tar.*" ! -name '*.asc')"
      return
    fi
    tried+=("$package $candidate: apt-get could not download it")
    return 1
  done
  found="${found//$'\n'/, }"
  tried+=("the distribution's $package: ${found:-not found}")
  return 1
}

# Sets source_folder; archives are unpacked under another name first, so that an interruption leaves no half of one.
find_source() {
  local archive="${ITK_SOURCE:-}" expected="${ITK_SOURCE_SHA256:-}" unpacked="$cache/source-$version" found
  if [ -n "$archive" ]; then
    [ -e "$archive" ] || stop "ITK_SOURCE is $archive, which does not exist"
  elif [ -e "$shared" ]; then
    archive="$shared"
    expected="$shared_sha256"
  elif [ -d "$unpacked" ]; then
    archive="$unpacked"
  else
    archive="$cache/$release"
    expected="${expected:-$release_sha256}"
    if [ ! -e "$archive" ] && ! download_release "$archive" "$expected"; then
      expected=
      download_package || unavailable
    fi
  fi
  if [ -d "$archive" ]; then
    source_folder="$(cd "$archive" && pwd)"
  else
    [ -z "$expected" ] || verify "$archive" "$expected"
    source_folder="$unpacked"
    if [ ! -d "$source_folder" ]; then
      rm -rf "$source_folder.part" && mkdir "$source_folder.part"
      tar xf "$archive" -C "$source_folder.part" --strip-components=1
      mv "$source_folder.part" "$source_folder"
      rm -f "$cache"/apt/*.orig.tar.*
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
  # An error names the file of the source that it comes from: not where that stood on this machine.
  export CXXFLAGS="${CXXFLAGS:+$CXXFLAGS }-ffile-prefix-map=$source_folder=ITK"
  sensornoise_use_ccache "$cache"
  {
    "$venv/bin/cmake" -G Ninja -S "$source_folder" -B "$tree" "${flags[@]}" -DSWIG_EXECUTABLE="$swig" \
      -DPython3_EXECUTABLE="$python" -DCMAKE_MAKE_PROGRAM="$venv/bin/ninja"
    # The tools need no interface files of the formats.
    targets="$("$venv/bin/ninja" -C "$tree" -t targets all |
      sed -nE '/^ITKIO(Meta|NRRD|TIFF)Swig:/d; s/^(lib\/lib[^:]*\.a|[A-Za-z0-9]+Swig):.*/\1/p')"
    # shellcheck disable=SC2086 # a list of words
    "$venv/bin/ninja" -C "$tree" $targets
  } >&2
  touch "$tree/ready"
fi
touch "$tree" # it is in use: sensornoise_prune_cache
echo "ITK $version, key $key" >&2
echo "$tree"
