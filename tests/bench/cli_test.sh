#!/usr/bin/env bash
# Runs the programs of bench as a user would, mostly wrongly: cli_test.sh FOLDER_OF_PROGRAMS
set -u
programs=$(realpath "$1")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work" || exit 1
failures=0

fail() {
  echo "FAILED: $*" >&2
  failures=$((failures + 1))
}

# refused TEXT PROGRAM ARGUMENT...: at once, status 2, TEXT on stderr, no new file or folder.
refused() {
  local text=$1 program=$2 status
  shift 2
  timeout 5 "$programs/$program" "$@" >/dev/null 2>"$work.stderr"
  status=$?
  [ "$status" -eq 2 ] || fail "$program $*: status $status, expected 2"
  grep -qF -- "$text" "$work.stderr" || fail "$program $*: does not say \`$text\` but: $(cat "$work.stderr")"
  [ -z "$(ls -A)" ] || fail "$program $*: left something behind: $(ls -A)"
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
rm -f "$work.stderr"

if [ "$failures" -gt 0 ]; then
  echo "$failures checks failed" >&2
  exit 1
fi
echo 'all passed'
