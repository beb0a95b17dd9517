#!/usr/bin/env bash
# Proves that what a scene does not have costs it nothing: counts the instructions of its ticks in the library as it is
# and in one whose engine was built without the part. Unlike times they are the same on a busy machine.
set -euo pipefail
shopt -s inherit_errexit # a count that fails is no count of 0

readonly most_percent=0.5 skipped=77
readonly scene='hanging_square:8' frames=50

if [[ $# -lt 1 || $1 == --help || $1 == -h ]]; then
  cat <<HELP
Usage: bench/left_out.sh BUILD

Of the release build in the folder BUILD, such as build/release: builds its library with an engine without collision and
with one without smoothing, in BUILD/lib/without_*, and runs a scene that has neither with each under callgrind. Fails
where the ticks differ by more than $most_percent %, or where a system that the plan leaves out ran. Exits $skipped, skipped, where
valgrind is missing.
HELP
  exit $(($# < 1 ? 2 : 0))
fi
build=$(cd -- "$1" && pwd)
readonly build program="$build/bin/play_frames"

if ! command -v valgrind >/dev/null; then
  echo 'skipped: valgrind is not installed'
  exit "$skipped"
fi
work=$(mktemp -d)
readonly work
trap 'rm -rf -- "$work"' EXIT

# Instructions of the ticks, as "$work/NAME.out" has them function by function.
count() { # name library [setting...]
  local name=$1 library=$2 setting
  shift 2
  local options=()
  for setting; do options+=(--set "$setting"); done
  # What the flat triangles themselves take to draw is no part of smoothing: not counted where all else is compared.
  local without=()
  [[ $name == smoothing* ]] && without=('--toggle-collect=pleat::Tessellation::run*' '--toggle-collect=pleat::DrawnNormals::run*')
  LD_LIBRARY_PATH=$library valgrind --tool=callgrind --callgrind-out-file="$work/$name.out" --collect-atstart=no \
    --toggle-collect='pleat::tick(pleat::World&, float)' "${without[@]}" \
    "$program" --scene "$scene" --frames "$frames" "${options[@]}" 2>&1 | sed -n 's/^==.*Collected : //p'
}

status=0
compare() { # part [setting...]
  local part=$1 with without
  shift
  with=$(count "$part" "$build/lib" "$@")
  without=$(count "${part}_without" "$build/lib/without_$part" "$@")
  awk -v part="$part" -v settings="$*" -v with="$with" -v without="$without" -v most="$most_percent" 'BEGIN {
    percent = 100 * (with / without - 1)
    printf "%-10s %12d instructions with it compiled in, %12d without: %+.4f %%%s\n", part, with, without, percent,
      settings == "" ? "" : "   (" settings ")"
    exit percent > most || percent < -most
  }' || status=1
}

cmake --build "$build" --target pleat_without_collision pleat_without_smoothing --parallel 2 >"$work/log" 2>&1 || {
  cat -- "$work/log"
  exit 1
}

echo "$scene, $frames frames: the ticks of a scene without the part"
compare collision
compare smoothing surface=flat level=1

# Each system of the schedule that the plan leaves out, where it has a class of its row's name.
"$program" --scene "$scene" --frames 1 --explain >"$work/plan"
systems=$(nm -C "$build/lib/libpleat.so" | sed -n 's/.* pleat::\([A-Za-z]*\)::run.*/\1/p' | sort -u)
ran=$(grep -o 'pleat::[A-Za-z]*::run' "$work/collision.out" | sed 's/pleat:://; s/::run//' | sort -u)
checked=0
while read -r row; do
  class=$(sed -E 's/(^|_)([a-z])/\U\2/g' <<<"$row")
  grep -qx -- "$class" <<<"$systems" || continue
  checked=$((checked + 1))
  if grep -qx -- "$class" <<<"$ran"; then
    echo "$row is left out of the plan and ran all the same"
    status=1
  fi
done < <(sed -n 's/^\([a-z_]*\) .*left out: .*/\1/p' "$work/plan")
echo "systems that the plan leaves out: $checked looked for among what ran"
((checked > 0)) || status=1
exit "$status"
