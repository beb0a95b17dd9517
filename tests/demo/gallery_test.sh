#!/usr/bin/env bash
# Does the README state the commands that draw its pictures, and are the pictures small? gallery_test.sh ROOT
set -euo pipefail
cd -- "$1"
status=0
readme=$(tr '\n' ' ' <README.md | tr -s ' ')
commands=0
while read -r command; do
  commands=$((commands + 1))
  [[ $readme == *"\`$command\`"* ]] || { echo "the README does not state: $command" && status=1; }
done < <(grep '^pleat [rc]' demo/gallery/draw.sh)
pictures=0
for picture in demo/gallery/*.png; do
  pictures=$((pictures + 1))
  [[ $readme == *"($picture)"* ]] || { echo "the README does not show $picture" && status=1; }
  [[ $(stat -c %s "$picture") -le 400000 ]] || { echo "$picture is larger than 400 kB" && status=1; }
done
[[ $commands -eq $pictures ]] || { echo "$pictures pictures, $commands commands that draw them" && status=1; }
code=0
demo/gallery/draw.sh --help 2>/dev/null || code=$?
[[ $code -eq 2 ]] || { echo 'draw.sh takes --help for a folder' && status=1; }
exit "$status"
