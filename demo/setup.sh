# What demo/run.sh and tests/run.sh share: install what is missing, configure, build. Sourced, not run.
# shellcheck shell=bash
set -euo pipefail

packages=(cmake ninja-build g++ libeigen3-dev libbullet-dev libosmesa6-dev libpng-dev libcli11-dev
          nlohmann-json3-dev libgtest-dev libassimp-dev)
readonly least_cmake=3.25 # for the presets

root=$(CDPATH='' cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.." && pwd)
readonly root

# Shows a command, then runs it.
run() {
  printf '+'
  printf ' %q' "$@"
  printf '\n'
  "$@"
}

as_root() {
  if ((EUID == 0)); then run "$@"; else run sudo "$@"; fi
}

# Says why set-up cannot go on and what would let it.
stop() {
  printf '%s\nThe build needs cmake %s or later and these packages, named as in Debian 12 and Ubuntu 24.04:\n  %s\n' \
    "$1" "$least_cmake" "${packages[*]}"
  printf 'With them in place: cmake --workflow --preset release; then the programs are in build/release/bin.\n'
  exit 2
} >&2

missing_packages() {
  local package
  for package in "${packages[@]}"; do
    [[ $(dpkg-query --show --showformat='${db:Status-Status}' "$package" 2>/dev/null) == installed* ]] || echo "$package"
  done
}

# Before anything is installed: an old release is told so at once.
check_cmake() {
  local version
  if command -v cmake >/dev/null; then
    version=$(cmake --version | sed -n '1s/.* //p')
  else
    version=$(apt-cache show --no-all-versions cmake | sed -n 's/^Version: //p')
  fi
  dpkg --compare-versions "$version" ge "$least_cmake" || stop "Here, cmake is ${version:-not to be had}."
}

install_missing() {
  local missing
  command -v apt-get >/dev/null || stop "This system has no apt-get: packages have to be installed by hand."
  mapfile -t missing < <(missing_packages)
  if ((${#missing[@]})); then
    echo "Missing: ${missing[*]}"
    ((EUID == 0)) || command -v sudo >/dev/null || stop "To install them takes root or sudo."
    as_root apt-get update || stop "apt-get update failed."
    check_cmake
    as_root env DEBIAN_FRONTEND=noninteractive apt-get install --yes --no-install-recommends "${missing[@]}" ||
      stop "apt-get install failed."
  else
    check_cmake
  fi
}

# Builds one target of the preset `release`, after all that it takes.
build() {
  install_missing
  cd "$root"
  run cmake --preset release
  run cmake --build --preset release --target "$1"
}
