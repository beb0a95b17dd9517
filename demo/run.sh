#!/usr/bin/env bash
# Installs what is missing, builds, and shows the component at work.
# shellcheck source=demo/setup.sh
source "$(dirname -- "${BASH_SOURCE[0]}")/setup.sh"

if [[ ${1-} == --help || ${1-} == -h ]]; then
  cat <<HELP
Usage: demo/run.sh [ARGUMENT...]

Sets up Debian 12 or Ubuntu 24.04 and later (packages through apt-get, as root or with sudo), builds the preset
\`release\`, and runs \`pleat run ARGUMENT...\`. Without arguments: a kick in a skirt, with pictures in out/kick.
Examples:

  demo/run.sh skirt_kick --rate 30 --out out/skirt_kick
  demo/run.sh kick --clip FILE.bvh --surface flat

All arguments: build/release/bin/pleat run --help
HELP
  exit
fi

(build pleat_demo) # in a shell of its own: the program reads and writes where the user stands

pleat=$root/build/release/bin/pleat
if (($#)); then
  run "$pleat" run "$@"
else
  out=$root/out/kick
  run "$pleat" run kick --out "$out" --json "$out/report.json"
  cat <<DONE

The table above is also in $out/report.json. Look at, in the same folder:
  sheet.png   the kick at a glance
  stages.png  one moment: simulated triangles, smoothed, with length control, and the control itself
  video.mp4   the film, where ffmpeg is installed
DONE
fi
