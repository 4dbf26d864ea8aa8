# Shared by tools/demo and tools/test; sourced, not run.
# shellcheck shell=bash

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
jobs=$(nproc)

say() { printf '\n== %s\n' "$*"; }
die() { printf '%s: %s\n' "$(basename "$0")" "$*" >&2; exit 2; }

as_root() {
  if [ "$(id -u)" = 0 ]; then "$@"; elif command -v sudo >/dev/null; then sudo "$@"; else
    die "cannot install packages: run as root or install sudo; missing: ${missing[*]}"
  fi
}

# install_packages FILE: installs the Debian packages that FILE names, one a line, and that are not there yet.
install_packages() {
  missing=()
  local package
  while read -r package; do
    case "$package" in ''|'#'*) continue ;; esac
    dpkg-query -W -f='${Status}' "$package" 2>/dev/null | grep -q 'ok installed' || missing+=("$package")
  done < "$1"
  [ ${#missing[@]} = 0 ] && return 0
  say "Installing ${#missing[@]} Debian packages: ${missing[*]}"
  as_root apt-get update -qq
  as_root env DEBIAN_FRONTEND=noninteractive apt-get install -y --no-install-recommends "${missing[@]}" \
    | sed -un 's/^Setting up \([^ ]*\).*/  \1/p'
}

# configure PRESET: makes build/PRESET ready.
configure() {
  local launcher=()
  command -v ccache >/dev/null && launcher=(-DCMAKE_CXX_COMPILER_LAUNCHER=ccache)
  (cd "$root" && cmake --preset "$1" "${launcher[@]}" > "build-$1.log" 2>&1) || {
    cat "$root/build-$1.log" >&2; die "configuring $1 failed"
  }
  rm -f "$root/build-$1.log"
}

# build PRESET [targets...]: ninja prints its own progress.
build() {
  local preset=$1; shift
  NINJA_STATUS="  [%f/%t] " ninja -C "$root/build/$preset" -j "$jobs" "$@"
}
