# What the slow tests of plumb-kitti share. This file is sourced.
# shellcheck shell=bash
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
root=$(cd "$here/../.." && pwd)
bin=${1:-$root/build/release/bin}
work=$(mktemp -d)

skip() { echo "skipped: $*"; exit 77; }
fail() { echo "FAILED: $*" >&2; exit 1; }
need() { for program in "$@"; do command -v "$program" >/dev/null || skip "no $program (tools/kitti/dependencies.txt)"; done; }
kitti() { "$root/tools/kitti/plumb-kitti" "$@" --bin "$bin"; }

# render TREE FRAMES ROUTE...: official odometry trees of rendered drives 00, 01, ..
render() {
  local tree=$1 frames=$2 number=0 name route; shift 2
  for route in "$@"; do
    name=$(printf '%02d' $number)
    "$bin/plumb-synth" --route "$route" --frames "$frames" --seed $((number + 1)) --quiet \
      --out "$tree/sequences/$name"
    mkdir -p "$tree/poses"
    mv "$tree/sequences/$name/poses.txt" "$tree/poses/$name.txt"
    number=$((number + 1))
  done
}

# same_results A B: every result and the report have the same bytes.
same_results() {
  local file
  (cd "$1" && find runs -name '*.json' -o -name poses.txt -o -name frames.csv | grep ^runs/ | sort) > "$work/list"
  [ -s "$work/list" ] || fail "no results in $1"
  while read -r file; do cmp -s "$1/$file" "$2/$file" || fail "$file differs between $1 and $2"; done < "$work/list"
  cmp -s "$1/report.html" "$2/report.html" || fail "the reports differ"
  echo "$(wc -l < "$work/list") files and the report have the same bytes"
}
