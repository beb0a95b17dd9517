#!/usr/bin/env bash
# Draws the README's pictures anew, with its commands: demo/gallery/draw.sh [FOLDER]. They need the program
# build/release/bin/pleat and replace those beside this script, or appear in FOLDER. What the close-ups say on the
# way, how far their rows differ, is in the README too; scaling.svg is of `scaling --svg`.
set -euo pipefail
gallery=$(CDPATH='' cd -- "$(dirname -- "${BASH_SOURCE[0]}")" && pwd)
program=$gallery/../../build/release/bin/pleat
if [[ $# -gt 1 || ${1-} == -* ]]; then
  echo 'Usage: demo/gallery/draw.sh [FOLDER]' >&2
  exit 2
fi
to=$(realpath -- "${1:-$gallery}")
work=$(mktemp -d)
readonly gallery program to work
trap 'rm -rf -- "$work"' EXIT

pleat() {
  printf '+ pleat %s\n' "$*"
  "$program" "$@" | grep '^rows differ' || [[ ${PIPESTATUS[0]} -eq 0 ]]
}

cd -- "$work"
pleat run skirt_kick --rate 30 --frames 36 --size 600x338
mv out/sheet.png kick.png
pleat run skirt_kick --rate 30 --frames 36 --surface paper
mv out/stages.png .
pleat compare skirt_kick --rate 30 --row surface=paper --row surface=pleat --first 12 --every 4 --size 200x260
mv compare.png paper_and_pleat.png
pleat compare skirt_kick --rate 30 --row surface=paper --row surface=pleat --close-up --set level=4 --first 12 --every 2 --columns 14 --size 480x480
mv compare.png close_up.png
pleat compare skirt_kick --rate 30 --row fold_sweeps=0 --row fold_sweeps=8 --close-up --set level=4 --first 12 --every 2 --columns 14 --size 480x360
mv compare.png fold_sweeps.png

mkdir -p -- "$to"
mv -- ./*.png "$to"
du -b -- "$to"/*.png
