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

# add_candidates DRIVE: boxes as from before suppression around the drive's labels, whose scores fall off as a Gaussian.
add_candidates() {
  awk '{ s = ($10 - $8) / 40
    for (k = 0; k < 16; ++k) {
      down = 2 * sin(1.7 * k); taller = 3 * sin(2.9 * k + 1)
      printf "%d %s %.2f %.2f %.2f %.2f %.4f\n", $1, $3, $7, $8 + s * (down - taller), $9, $10 + s * down,
             0.9 * exp(-0.1 * (down * down + taller * taller))
    } }' "$1/label_02.txt" > "$1/candidates.txt"
}

# add_road_with_a_map DRIVE FOLDER: the drive's images as a plain folder with camera and map, like a sequence of The Hague.
add_road_with_a_map() {
  mkdir -p "$2"
  cp -r "$1/image_0" "$2/images"
  awk '$1 == "P0:" { printf "[camera]\nfx_px = %s\nfy_px = %s\ncx_px = %s\ncy_px = %s\ncamera_height_m = 1.65\n", $2, $7, $4, $8 }' \
    "$1/calib.txt" > "$2/camera.toml"
  echo 'length_m = 30.0' > "$2/map.toml"
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
