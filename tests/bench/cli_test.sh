#!/usr/bin/env bash
# Runs the programs of bench as a user would, mostly wrongly: cli_test.sh FOLDER_OF_PROGRAMS
programs=$(realpath "$1")
# shellcheck source=tests/cli_checks.sh
source "$(dirname -- "${BASH_SOURCE[0]}")/../cli_checks.sh"

# refused TEXT PROGRAM ARGUMENT...: at once, see refused_command.
refused() {
  local text=$1 program=$2
  shift 2
  refused_command "$text" timeout 5 "$programs/$program" "$@"
}

for program in ablation error_vs_time frame_budget scaling stability_map surface_error validate; do
  refused '--json' "$program" --json ''
  refused 'none/a.json' "$program" --json none/a.json
done
refused 'nowhere' surface_error --regenerate --fine nowhere
refused 'nowhere' error_vs_time --regenerate --fine nowhere
refused 'stiffnes' surface_error --regenerate --set stiffnes=1
refused '--json' error_vs_time --regenerate --json a.json
refused '--scene' error_vs_time --ensembles --scene bowl
refused '--clip' frame_budget --clip ''

# Without a reader of stdout files are finished all the same.
{
  sleep 0.2
  "$programs/validate" --quick --json report.json 2>/dev/null
} | true
grep -qF '"cases"' report.json || fail 'validate wrote no report without a reader'
rm -f report.json

for signal in INT TERM; do
  for command in 'play_frames --frames 1000000' 'scaling --json interrupted.json'; do
    # shellcheck disable=SC2086
    timeout --signal "$signal" --kill-after 10 1 "$programs"/$command >/dev/null 2>"$work.stderr"
    if [ $? -ne 124 ] || ! grep -q 'interrupted' "$work.stderr"; then fail "$command does not end at SIG$signal"; fi
    [ -z "$(ls -A)" ] || fail "$command left something behind at SIG$signal"
  done
done
finish
