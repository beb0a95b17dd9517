#!/usr/bin/env bash
# Counts the instructions of the library's ticks and compares them with bench/instructions.txt. Unlike times they are
# the same on a busy machine.
set -euo pipefail
shopt -s inherit_errexit # a count that fails is no count of 0

readonly most_percent=3 skipped=77
folder=$(CDPATH='' cd -- "$(dirname -- "${BASH_SOURCE[0]}")" && pwd)
readonly folder file="$folder/instructions.txt"
readonly cases=('skirt_kick 30 50' 'skirt_kick 60 100') # scene, rate, frames: the kick itself

if [[ $# -lt 1 || $1 == --help || $1 == -h ]]; then
  cat <<HELP
Usage: bench/instructions.sh [--update] play_frames

Runs the program \`play_frames\` of a release build under callgrind and fails where a case takes over $most_percent % more
instructions than bench/instructions.txt says; --update writes that file. Exits $skipped, skipped, where valgrind is missing
or the counts would not be comparable: another compiler, other flags, a processor without AVX2.
HELP
  exit $(($# < 1 ? 2 : 0))
fi

update=0
if [[ $1 == --update ]]; then
  update=1
  shift
fi
readonly program=${1-}
[[ -f $program && -x $program ]] || {
  echo "bench/instructions.sh: there is no program \`$program\` to run" >&2
  exit 2
}

skip() {
  echo "skipped: $1"
  exit "$skipped"
}

# What the counts depend on besides the sources.
describe_build() {
  "$program" --frames 1
  grep -qw avx2 /proc/cpuinfo && echo 'vectors avx2' || echo 'vectors baseline'
}

count() { # scene rate frames
  valgrind --tool=callgrind --callgrind-out-file=/dev/null --collect-atstart=no --toggle-collect='pleat::tick(*' \
    "$program" --scene "$1" --rate "$2" --frames "$3" 2>&1 | sed -n 's/^==.*Collected : //p'
}

command -v valgrind >/dev/null || skip 'valgrind is not installed'
build=$(describe_build)
if ((update)); then
  lines=()
  for case in "${cases[@]}"; do
    # shellcheck disable=SC2086
    lines+=("$case $(count $case)")
  done
  {
    echo '# Instructions of the library in a scene: its name, frames a second, frames, count.'
    echo '# Written by: bench/instructions.sh --update build/release/bin/play_frames'
    echo "$build"
    printf '%s\n' "${lines[@]}"
  } >"$file.new"
  mv -- "$file.new" "$file"
  cat -- "$file"
  exit
fi

known=$(grep -E '^(compiler|flags|vectors) ' "$file")
[[ $build == "$known" ]] || skip "counted with another build:"$'\n'"$(diff <(echo "$known") <(echo "$build"))"
status=0
while read -r scene rate frames expected; do
  counted=$(count "$scene" "$rate" "$frames")
  awk -v name="$scene at $rate Hz" -v counted="$counted" -v expected="$expected" -v most="$most_percent" 'BEGIN {
    percent = 100 * (counted / expected - 1)
    printf "%s: %d instructions, %+.2f %%\n", name, counted, percent
    if (percent > most) { printf "more than %d %% above %d\n", most, expected; exit 1 }
    if (percent < -most) print "so much less that bench/instructions.txt should be updated"
  }' || status=1
done < <(grep -vE '^(#|compiler|flags|vectors)' "$file")
exit "$status"
