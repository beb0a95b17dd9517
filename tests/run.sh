#!/usr/bin/env bash
# Installs what is missing, builds, and passes the tests.
# shellcheck source=demo/setup.sh
source "$(dirname -- "${BASH_SOURCE[0]}")/../demo/setup.sh"

if [[ ${1-} == --help || ${1-} == -h ]]; then
  cat <<HELP
Usage: tests/run.sh [ARGUMENT...]

Sets up Debian 12 or Ubuntu 24.04 and later (packages through apt-get, as root or with sudo), builds the preset
\`release\`, and runs \`ctest --preset release ARGUMENT...\`. Examples:

  tests/run.sh -L property
  tests/run.sh -R Tessellation --verbose
HELP
  exit
fi

build all
run ctest --preset release --parallel "$(nproc)" "$@"
