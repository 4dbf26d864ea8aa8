# Functions that the shell scripts in tools/ share. This file is sourced and not run.
# shellcheck shell=bash

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
jobs=$(nproc)

say() { printf '\n== %s\n' "$*"; }
die() { printf '%s: %s\n' "$(basename "$0")" "$*" >&2; exit 2; }

# show_help: prints the comment at the head of the script.
show_help() { awk 'NR == 1 { next } !/^#/ { exit } { sub(/^# ?/, ""); print }' "$0"; }

# unknown_option WORD KNOWN...: ends the script and names the nearest known option. The distance is
# that of platform/nearest_word.hpp.
unknown_option() {
  local near
  near=$(printf '%s\n' "$@" | awk '
    function least(a, b) { return a < b ? a : b }
    function distance(a, b,    i, j, change) {
      for (j = 0; j <= length(b); ++j) d[0, j] = j
      for (i = 1; i <= length(a); ++i) {
        d[i, 0] = i
        for (j = 1; j <= length(b); ++j) {
          change = substr(a, i, 1) != substr(b, j, 1)
          d[i, j] = least(least(d[i - 1, j] + 1, d[i, j - 1] + 1), d[i - 1, j - 1] + change)
          if (i > 1 && j > 1 && substr(a, i, 1) == substr(b, j - 1, 1) && substr(a, i - 1, 1) == substr(b, j, 1))
            d[i, j] = least(d[i, j], d[i - 2, j - 2] + 1)
        }
      }
      return d[length(a), length(b)]
    }
    NR == 1 { word = $0; best = int(length(word) / 3) + 1; next }
    { now = distance(word, $0); if (now < best) { best = now; near = $0 } }
    END { print near }')
  [ -n "$near" ] || die "unknown option $1; see --help"
  die "unknown option $1; did you mean $near?"
}

# need_value OPTION REST...: ends the script when nothing follows the option.
need_value() { [ $# -ge 2 ] || die "$1 wants a value"; }

as_root() {
  if [ "$(id -u)" = 0 ]; then "$@"; elif command -v sudo >/dev/null; then sudo "$@"; else
    die "cannot install packages: run as root or install sudo; missing: ${missing[*]}"
  fi
}

# install_packages FILE: installs the Debian packages of FILE, one per line, that are missing.
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

# configure PRESET [options...]: makes build/PRESET ready.
configure() {
  local preset=$1 launcher=(); shift
  command -v ccache >/dev/null && launcher=(-DCMAKE_CXX_COMPILER_LAUNCHER=ccache)
  (cd "$root" && cmake --preset "$preset" "${launcher[@]}" "$@" > "build-$preset.log" 2>&1) || {
    cat "$root/build-$preset.log" >&2; die "configuring $preset failed"
  }
  rm -f "$root/build-$preset.log"
}

# build PRESET [targets...]: builds. On a terminal ninja shows its progress, elsewhere only errors.
build() {
  local preset=$1 quiet=(); shift
  [ -t 1 ] || quiet=(--quiet)
  NINJA_STATUS="  [%f/%t] " ninja -C "$root/build/$preset" -j "$jobs" "${quiet[@]}" "$@"
}
