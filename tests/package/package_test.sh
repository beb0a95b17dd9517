#!/usr/bin/env bash
# Is a host that does as the README says served? package_test.sh BUILD|--archive [CMAKE OPTION...]
# Takes the README's C out of it, builds it against the library of the folder BUILD as installed (CMake, pkg-config) and compiles it
# in one tree with pleat. With --archive, which takes minutes, that tree is built and run, with the library as an archive, which
# is then installed and found. The options go to cmake.
set -euo pipefail
here=$(CDPATH='' cd -- "$(dirname -- "${BASH_SOURCE[0]}")" && pwd)
root=$(dirname -- "$(dirname -- "$here")")
readonly here root build=$1
shift
work=$(mktemp -d)
readonly work
trap 'rm -rf -- "$work"' EXIT

mkdir "$work/sample"
# shellcheck disable=SC2016 # no expansion meant
sed -n '/^```c$/,/^```$/{/^```/!p}' "$root/README.md" >"$work/sample/readme_sample.h"
[[ -s $work/sample/readme_sample.h ]] || { echo 'the README has no C' >&2 && exit 1; }

quietly() { # its output only where it fails
  "$@" >"$work/log" 2>&1 || { cat -- "$work/log" && printf 'FAILED: %s\n' "$*" && exit 1; } >&2
}

compile() { # folder, target, then options of cmake
  local tree=$work/$1 target=$2
  shift 2
  quietly cmake -S "$here" -B "$tree" -DSAMPLE="$work/sample" -DCMAKE_BUILD_TYPE=Debug -DCMAKE_CXX_FLAGS_DEBUG=-O0 \
    "${options[@]}" "$@"
  quietly cmake --build "$tree" --target "$target" --parallel "$(nproc)"
}

host() { # title, folder, then options of cmake
  compile "$2" host "${@:3}"
  quietly "$work/$2/host"
  echo "$1: as it should be"
}

install_to() { # build folder, prefix: moved once installed, for no path may be built in
  quietly cmake --install "$1" --prefix "$2.first"
  mv -- "$2.first" "$2"
}

by_pkg_config() { # title, prefix
  command -v pkg-config >/dev/null || { echo "$1: skipped, there is no pkg-config" && return; }
  local pc flags
  pc=$(find "$2" -name pleat.pc)
  read -ra flags < <(PKG_CONFIG_PATH=$(dirname -- "$pc") pkg-config --cflags --libs 'pleat >= 0.1')
  quietly cc -std=c99 -I "$work/sample" "$here/host.c" "${flags[@]}" -lm -o "$work/by_pkg_config"
  LD_LIBRARY_PATH=$(dirname -- "$(dirname -- "$pc")") quietly "$work/by_pkg_config"
  echo "$1: as it should be"
}

options=("$@")
if [[ $build == --archive ]]; then
  host 'in one tree, an archive' tree -DPLEAT_SOURCE="$root" -DPLEAT_SHARED=OFF
  install_to "$work/tree/pleat" "$work/static"
  host 'installed, an archive' static_host -DCMAKE_PREFIX_PATH="$work/static"
  by_pkg_config 'installed, an archive, pkg-config' "$work/static"
else
  install_to "$build" "$work/shared"
  host 'installed' host -DCMAKE_PREFIX_PATH="$work/shared"
  by_pkg_config 'installed, pkg-config' "$work/shared"
  compile tree sample -DPLEAT_SOURCE="$root"
  echo 'in one tree: compiles'
fi
