# shellcheck shell=bash
# What the tests of command lines share, to be sourced: an empty folder to work in, and a count of what failed.
set -u
work=$(mktemp -d)
trap 'rm -rf "$work" "$work.stderr"' EXIT
cd "$work" || exit 1
failures=0

fail() {
  echo "FAILED: $*" >&2
  failures=$((failures + 1))
}

# refused_command TEXT COMMAND...: status 2, TEXT on stderr, no new file or folder.
refused_command() {
  local text=$1 before status
  shift
  before=$(find . | sort)
  "$@" >/dev/null 2>"$work.stderr"
  status=$?
  [ "$status" -eq 2 ] || fail "$*: status $status, expected 2"
  grep -qF -- "$text" "$work.stderr" || fail "$*: does not say \`$text\` but: $(cat "$work.stderr")"
  [ "$(find . | sort)" = "$before" ] || fail "$*: left something behind: $(find . | sort)"
}

# Ends the test.
finish() {
  if [ "$failures" -gt 0 ]; then
    echo "$failures checks failed" >&2
    exit 1
  fi
  echo 'all passed'
}
