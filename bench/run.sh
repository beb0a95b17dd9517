#!/usr/bin/env bash
# Runs every program of bench and writes what they say as one report.
# shellcheck source=demo/setup.sh
source "$(dirname -- "${BASH_SOURCE[0]}")/../demo/setup.sh"

quick=0
case $* in
  '') ;;
  --quick) quick=1 ;;
  *)
    cat <<HELP
Usage: bench/run.sh [--quick]

Builds the preset \`release\` if need be, runs all programs of bench and writes bench/results/report.md, with the JSON
and SVG files that it links to. Takes some 25 minutes on an idle machine; with --quick, smaller grids and fewer runs,
less than three minutes. A bar that is missed is reported and no error; the exit status is 1 where a program failed.
HELP
    [[ $* == --help || $* == -h ]] && exit
    exit 2
    ;;
esac

build all
readonly bin=build/release/bin results=bench/results
mkdir -p "$results"
rm -f -- "$results"/*

# A job a line: its name; seconds it takes in full and with --quick; the program and its arguments.
jobs=(
  'kick_30 15 5 frame_budget --scene skirt_kick --rate 30 --peer bullet'
  'kick_60 15 5 frame_budget --scene skirt_kick --rate 60 --peer bullet'
  'hanging 60 10 frame_budget --scene hanging_square:16 --rate 60 --peer bullet'
  'drape 40 10 frame_budget --scene drape_sphere:16 --rate 60 --peer bullet'
  "error_vs_time 280 20 error_vs_time --svg $results/error_vs_time.svg"
  'dominant 100 8 error_vs_time --dominant'
  'ensembles 60 8 error_vs_time --ensembles'
  'surface_error 3 3 surface_error'
  "stability_map 400 15 stability_map --svg $results/stability_map.svg"
  'validate 120 1 validate'
  'left_out 60 40 bench/left_out.sh build/release'
  'ablation 150 30 ablation'
  "scaling 250 3 scaling --svg $results/scaling.svg"
  'systems 150 7 systems'
)

# What makes a program quick.
quick_options() {
  case $1 in
    frame_budget) echo '--repeat 1' ;;
    surface_error) ;;
    systems) echo '--benchmark_filter=tion/66/avx2' ;;
    *) echo '--quick' ;;
  esac
}

# Left out where Google Benchmark is missing.
[[ -x $bin/systems ]] || unset -v 'jobs[-1]'

declare -A commands=() statuses=()
left=0
for job in "${jobs[@]}"; do
  read -r name full brief program arguments <<<"$job"
  left=$((left + (quick ? brief : full)))
  if [[ $program == *.sh ]]; then
    commands[$name]="$program $arguments"
    continue
  fi
  ((quick)) && arguments+=" $(quick_options "$program")"
  json='--json '
  [[ $program == systems ]] && json='--benchmark_out='
  read -ra words <<<"$bin/$program $arguments $json$results/$name.json"
  commands[$name]="${words[*]}"
done

failed=0
spent=0 # of the seconds expected
readonly begin=$SECONDS
for job in "${jobs[@]}"; do
  read -r name full brief _ <<<"$job"
  # From the pace so far, once there is one.
  printf '%-16s about %d s left\n' "$name" "$((spent > 10 ? left * (SECONDS - begin) / spent : left))"
  statuses[$name]=0
  # shellcheck disable=SC2086
  ${commands[$name]} >"$results/$name.txt" || statuses[$name]=$?
  # Of these two, 1 with all they have to say means a bar that was missed.
  if ((statuses[$name] == 1)) && [[ $name == @(validate|stability_map) && -s $results/$name.json ]]; then
    statuses[$name]=0
  fi
  ((statuses[$name] == 77)) && statuses[$name]=0 # skipped, and it says why
  ((statuses[$name])) && failed=1
  left=$((left - (quick ? brief : full))) spent=$((spent + (quick ? brief : full)))
done

# The first number behind a name in what frame_budget printed of us, or of its peer.
ours() { awk -v name="$2" '/^Bullet/ { exit } $1 == name { printf "%.3g", $2; exit }' "$results/$1.txt"; }
peer() { awk -v name="$2" '/^Bullet/ { on = 1 } on && $1 == name { printf "%.3g", $2; exit }' "$results/$1.txt"; }
machine() { sed -n "s/^ *\"$1\": \"\(.*\)\",*$/\1/p" "$results/kick_30.json"; }

headline() {
  local name title
  echo '| scene | frame, µs | Bullet | longest edge, % | Bullet | deepest in a body, mm | Bullet | at rest, mm a frame |'
  echo '|-|-|-|-|-|-|-|-|'
  while read -r name title; do
    printf '| [%s](%s.json) | %s | %s | %s | %s | %s | %s | %s |\n' "$title" "$name" "$(ours "$name" frame)" \
      "$(peer "$name" frame)" "$(ours "$name" strain_max_percent)" "$(peer "$name" strain_max_percent)" \
      "$(ours "$name" penetration_interior_mm)" "$(peer "$name" penetration_interior_mm)" \
      "$(ours "$name" rest_jitter_mm)"
  done <<'SCENES'
kick_30 skirt, 66 particles, a kick at 30 Hz
kick_60 the same at 60 Hz
hanging square, 256 particles, hung from two corners, 60 Hz
drape square, 256 particles, falls onto a sphere, 60 Hz
SCENES
}

# What a program printed, or of much the lines that a sed script picks, below what was typed.
section() { # name title about [script]
  printf '\n## %s\n\n%s\n\n' "$2" "$3"
  ((statuses[$1])) && printf '**The program failed, status %d.**\n\n' "${statuses[$1]}"
  [[ -e $results/$1.svg ]] && printf '![%s](%s.svg)\n\n' "$2" "$1"
  # shellcheck disable=SC2016
  printf '`%s`; [all it said](%s.txt)' "${commands[$1]}" "$1"
  [[ -e $results/$1.json ]] && printf ', [for scripts](%s.json)' "$1"
  # shellcheck disable=SC2016
  printf '.\n\n```\n%s\n```\n' "$(sed -n "${4-p}" "$results/$1.txt")"
}

scale=''
((quick)) && scale=', quick: small grids, few runs'
# shellcheck disable=SC2016 # a $ is sed's
{
  printf '# pleat, measured\n\n'
  printf -- '- commit %s, %s%s\n' "$(git describe --always --dirty)" "$(date --utc +%F)" "$scale"
  printf -- '- %s, %s cores; one thread is used\n' "$(machine cpu)" "$(nproc)"
  printf -- '- %s, %s\n\n' "$(machine compiler)" "$(machine flags)"
  headline
  printf '\nFrame: the median, with the drawn surface. Bullet: its soft body, in turn with ours, bare particles.\n'
  printf 'Three digits; empty: not measured.\n\n'
  printf -- '- validation: %s\n' "$(tail -n 1 "$results/validate.txt")"
  printf -- '- error against run time: %s\n' "$(tail -n 1 "$results/error_vs_time.txt")"

  section error_vs_time 'Error against run time' \
    'How far from the truth cloth comes to rest, for what a frame costs, and how long others take to come as close. A ratio
below its bar means that the same error is cheaper elsewhere: all surfaces over the same particles are about as far from the
truth, for the particles themselves are, so that a flat surface, or another solver of bare particles, gets there sooner. The
next section says which part of the simulation puts them there.' \
    '/^time to/,$p'
  section dominant 'Where the error comes from' 'RMS distance from the truth, mm, with one part at a time made perfect.'
  section ensembles 'Cloth that buckles or moves' \
    'Where a cloth may end up in several ways, only what is common to many starts can be compared with the truth.'
  section ablation 'What each part is worth' \
    'Microseconds a frame saved where a part is left out, and what that adds to the faults of the cloth. Parts marked +
are put in first. Where cloth may fold in several ways chance moves it too: read distances beside those of the first row.'
  section left_out 'What a scene does not have' \
    'Instructions of its ticks, in the library as it is and in one whose engine was built without the part.'
  section scaling 'As it grows' \
    'What half a second costs for each particle, as one cloth and as a crowd grows; 1 is the middle of the range.'
  [[ -x $bin/systems ]] && section systems 'System by system' \
    'One run of a system again and again in the middle of a kick, on skirts of 66, 264 and 1056 particles, with baseline
x86-64 and with AVX2; first what the machine can do at most. Time is the one to read.'
  section surface_error 'The drawn surface' 'From particles that lie on a known surface.'
  section kick_30 'The kick at 30 Hz' 'What a frame costs, stage by stage, and how good the cloth is for it.'
  section kick_60 'The kick at 60 Hz' 'The same.'
  section hanging 'Square from two corners' 'The same.'
  section drape 'Square over a sphere' 'The same.'
  section stability_map 'Stiff and extreme' \
    'How far the worst edge is stretched at the end, and what is left after things that should not happen.'
  section validate 'Against known answers' \
    'Closed forms and the same schemes in double precision: the gates that failed, and how many passed.' '/FAIL$/p; $p'
} >"$results/report.md"
echo "$results/report.md is written, after $SECONDS s"
exit "$failed"
