#!/usr/bin/env bash
# Counts what floating-point instructions one run of a system does and moves, under callgrind.
set -euo pipefail

if [[ $# -lt 2 || $1 == -* ]]; then
  cat <<HELP
Usage: bench/systems/flop.sh PROGRAM CASE...

Counts the flop of one run of each case of the program \`systems\`, for example hinge_bending/66/avx2, and the bytes that
its vector instructions load and store, what they spill included: a roof to hold its time against. Additions,
multiplications, divisions, square roots, minima and maxima count as one each, for every lane that is worked on.
HELP
  [[ ${1-} == --help || ${1-} == -h ]] && exit
  exit 2
fi
readonly program=$1
shift
scratch=$(mktemp -d)
trap 'rm -rf -- "$scratch"' EXIT

objdump --disassemble --no-show-raw-insn "$program" >"$scratch/code"

# The code gives each address its flop and bytes, the profile how often it was executed.
# shellcheck disable=SC2016
readonly count='
  function lanes(name, operands) { return name ~ /s[sd]$/ ? 1 : operands ~ /%ymm/ ? 8 : 4 }
  FILENAME ~ /code$/ && /^[0-9a-f]+ <_ZN5pleat5bench6Moment3runEv>:/ { entry = $1; sub(/^0*/, "", entry) }
  FILENAME ~ /code$/ {
    if ($1 !~ /^[0-9a-f]+:$/ || !/%[xy]mm/) next
    address = substr($1, 1, length($1) - 1)
    operands = $0
    sub(/.*[ \t]/, "", operands)
    if ($2 ~ /^v?(add|sub|mul|div|sqrt|min|max)[sp]s$/) flop[address] = lanes($2, operands)
    if (operands ~ /\(/ && operands !~ /\(%rip\)/) moved[address] = 4 * lanes($2, operands)
    next
  }
  /^calls=/ { called = 1; next } # the line behind it is the cost of what is called
  /^0x[0-9a-f]+ / {
    address = substr($1, 3)
    if (address == entry) runs = $NF
    if (!called) { all += flop[address] * $NF; bytes += moved[address] * $NF }
    called = 0
  }
  END { printf "%-40s %12.0f %12.0f\n", name, all / runs, bytes / runs }'

printf '%-40s %12s %12s\n' case flop bytes
for case in "$@"; do
  valgrind --tool=callgrind --callgrind-out-file="$scratch/out" --dump-instr=yes --compress-pos=no --compress-strings=no \
    --toggle-collect='pleat::bench::Moment::run()' "$program" --benchmark_filter="^$case/manual_time$" \
    --benchmark_min_time=0 >"$scratch/log" 2>&1 || { cat "$scratch/log" >&2; exit 1; }
  awk -v name="$case" "$count" "$scratch/code" "$scratch/out"
done
