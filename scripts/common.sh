# Sourced by the commands beside it: where the project is, its packages, its build.

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
build=$root/build

fail() {
  printf '%s: %s\n' "$(basename "$0")" "$1" >&2
  exit 1
}

# quietly <log> <command>...: shows what the command printed only if it fails.
quietly() {
  local log=$1
  shift
  if ! "$@" >"$log" 2>&1; then
    cat "$log" >&2
    fail "failed: $*"
  fi
}

# name_campaign: which part of campaigns tests make, by the number of commits.
name_campaign() {
  local commits
  commits=$(git -C "$root" rev-list --count HEAD 2>/dev/null || echo 0)
  export COURANT_CAMPAIGN=${COURANT_CAMPAIGN:-$((commits % 4))/4}
}

# install_packages <list file>: installs what is missing of the Debian packages in the list.
install_packages() {
  command -v dpkg-query >/dev/null || return 0 # not Debian: CMake says what it does not find
  local wanted missing=() name as_root=()
  wanted=$(grep -v '^#' "$1")
  for name in $wanted; do
    [ "$(dpkg-query -W -f '${db:Status-Status}' "$name" 2>/dev/null)" = installed ] || missing+=("$name")
  done
  [ ${#missing[@]} -eq 0 ] && return 0

  if [ "$(id -u)" -ne 0 ]; then
    if command -v sudo >/dev/null && { [ -t 0 ] || sudo -n true 2>/dev/null; }; then
      as_root=(sudo)
    else
      fail "Debian packages are missing and need root to install: apt-get install ${missing[*]}"
    fi
  fi
  printf 'Installing %s ...\n' "${missing[*]}" >&2
  local log
  log=$(mktemp)
  quietly "$log" "${as_root[@]}" apt-get -o DPkg::Lock::Timeout=300 update
  quietly "$log" "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
    apt-get -o DPkg::Lock::Timeout=300 install -y --no-install-recommends "${missing[@]}"
  rm -f "$log"
}

# build_in <build directory> <target> [<CMake option>...]: configures and builds the target there.
build_in() {
  local dir=$1 target=$2
  shift 2
  local options=("$@")
  # Without the first ccache keeps nothing that uses a precompiled header, without the second it preprocesses twice. With the others
  # what it keeps of one checkout serves another.
  export CCACHE_SLOPPINESS=${CCACHE_SLOPPINESS-pch_defines,time_macros} CCACHE_DEPEND=${CCACHE_DEPEND-1}
  export CCACHE_BASEDIR=${CCACHE_BASEDIR-$root} CCACHE_NOHASHDIR=${CCACHE_NOHASHDIR-1}
  mkdir -p "$dir"
  if [ ! -f "$dir/CMakeCache.txt" ]; then
    command -v ninja >/dev/null && options+=(-G Ninja)
    command -v ccache >/dev/null && options+=(-D CMAKE_CXX_COMPILER_LAUNCHER=ccache)
    options=(-D COURANT_UNITY=ON "${options[@]}")
    printf 'Building in %s (some minutes the first time) ...\n' "$dir" >&2
  fi
  quietly "$dir/configure.log" cmake -S "$root" -B "$dir" "${options[@]}"
  quietly "$dir/build.log" cmake --build "$dir" --target "$target" --parallel "$(nproc)"
}

# build_command <target> [<CMake option>...]: builds it in $build, without the tests where nothing is configured yet: these need packages
# of their own, and scripts/test turns them on.
build_command() {
  local options=()
  [ -f "$build/CMakeCache.txt" ] || options=(-D COURANT_BUILD_TESTS=OFF)
  build_in "$build" "$1" "${options[@]}" "${@:2}"
}
