#!/usr/bin/env bash
# Runs the program `pleat` as a user would, mostly wrongly: cli_test.sh PATH_OF_PLEAT
# Each mistake must end with status 2, a line on stderr that names the place, and nothing left behind.
pleat=$(realpath "$1")
# shellcheck source=tests/cli_checks.sh
source "$(dirname -- "${BASH_SOURCE[0]}")/../cli_checks.sh"

# refused TEXT ARGUMENT...: see refused_command.
refused() {
  local text=$1
  shift
  refused_command "$text" "$pleat" "$@"
}

# accepted COMMAND...: status 0; what it printed is in $output.
accepted() {
  output=$("$pleat" "$@") || fail "pleat $*: status $?"
}

garment='"garment": {"grid": {"rows": 3, "columns": 3}}'
echo "{$garment, \"gravitas\": 1}" >unknown_key.json
echo "{$garment, \"rate\": " >truncated.json
echo '[]' >array.json
echo "{$garment, \"view\": [0, 1, 0]}" >upright.json
echo '{"garment": {"grid": {"rows": 0, "columns": 3}}}' >nothing.json
echo '{"garment": {"grid": {"rows": 2000, "columns": 2500}}}' >ten_million.json
echo '{"garment": {"obj": {"file": "empty.obj"}}}' >empty_garment.json
echo "{$garment, \"settings\": {\"density\": -1}}" >bad_density.json
: >empty.obj
printf 'HIERARCHY\nROOT Hips\n{\n  OFFSET 0 0 0\n' >truncated.bvh
echo text >file
mkdir earlier && echo kept >earlier/frame_0000.png

refused 'no such scene' run no_such_scene
refused 'unknown key' run unknown_key.json
refused 'truncated.json:2' run truncated.json
refused '/garment/grid/rows' run nothing.json
refused 'too large' run ten_million.json
refused 'empty.obj' run empty_garment.json
refused 'density' run bad_density.json
refused 'truncated.bvh' run --clip truncated.bvh
refused 'none.bvh' run --clip none.bvh
refused 'hanging_square:x' run hanging_square:x
refused 'file/out' run hanging_square:3 --frames 2 --out file/out
refused 'none/report.json' run hanging_square:3 --frames 2 --no-render --json none/report.json
refused 'stiffnes' run hanging_square:3 --set stiffnes=3 --out earlier
refused 'should be a number' run hanging_square:3 --set stiffness=nan
refused 'key=value' run hanging_square:3 --set stiffness
refused 'silk' run hanging_square:3 --surface silk
refused 'cannot be' run hanging_square:3 --level 9
refused '--size' run hanging_square:3 --size 12
refused '--rate' run hanging_square:3 --rate 0
refused '--frames' run hanging_square:3 --frames -1
refused '--nonsense' run --nonsense
refused '--rate' run hanging_square:3 --rate nan --no-render
refused '--rate' run hanging_square:3 --rate inf --no-render
refused 'bogus' bogus
refused 'command is missing'
refused 'an array' run array.json
refused '--json' run hanging_square:3 --frames 1 --no-render --json ''
refused '--out' run hanging_square:3 --frames 1 --out ''
refused '--clip' run --frames 1 --no-render --clip ''
long=$(printf 'a%.0s' {1..300})
refused 'name too long' run hanging_square:3 --frames 1 --out "$long"
refused 'name too long' run hanging_square:3 --frames 1 --no-render --json "$long"
refused 'no such scene' run "$long"
refused '/view' run upright.json --frames 1
square=(compare hanging_square:3 --row level=1 --row "level=1,stiffness=1")
refused '--size' "${square[@]}" --columns 1 --size 5000x5000
refused '--size' "${square[@]}" --columns 100 --size 200x200
refused 'look the same' compare hanging_square:3 --row level=1 --row level=1 --columns 2 --close-up
refused 'no such scene' explain no_such_scene
[ "$(cat earlier/frame_0000.png)" = kept ] || fail 'an earlier result was touched'

accepted --help
accepted run --help
accepted --version
[[ $output == 'pleat '[0-9]* ]] || fail "--version says $output"
accepted list
for word in skirt_kick pleat symplectic-euler stiffness; do
  [[ $output == *"$word"* ]] || fail "list does not name $word"
done
accepted explain hanging_square:3
[[ $output == *'left out: '* && $output == *' run'* ]] || fail 'explain gives no reasons'

accepted run hanging_square:4 --frames 14 --size 64x48 --out made/here --json report.json
for file in frame_0000.png frame_0013.png sheet.png; do
  [ -s "made/here/$file" ] || fail "$file was not written"
done
[ -z "$(find made -name '.*')" ] || fail 'a temporary folder was left'
[ -s made/here/pleat_run.txt ] || fail 'there is no list of what was written'
for key in '"all_finite": true' '"watertight": true' '"particles": 16' '"frames": 14' stages_us quality; do
  grep -qF "$key" report.json || fail "the report lacks $key"
done

# A shorter run replaces a longer one; a setting reaches the engine; the picture can be left out.
accepted run hanging_square:4 --frames 2 --size 64x48 --out made/here
[ ! -e made/here/frame_0013.png ] || fail 'frames of an earlier run were left'
accepted run hanging_square:4 --frames 2 --level 3 --no-render --json report.json
grep -qF '"drawn_triangles": 648' report.json || fail '--level 3 should draw 18 * 36 triangles'

# What an earlier run did not write stays, whatever it is called; where a picture would have its name the run is refused.
mkdir made/here/frame_dir.png && echo mine | tee made/here/frame_mine.png >made/here/frame_99.png
accepted run hanging_square:4 --frames 3 --size 64x48 --out made/here
[ "$(cat made/here/frame_mine.png made/here/frame_99.png)" = $'mine\nmine' ] || fail 'a file of the user was touched'
[ -d made/here/frame_dir.png ] || fail 'a folder of the user was removed'
[ -s made/here/frame_0002.png ] || fail 'a folder with files of the user was not written'
for name in frame_0099.png sheet.png stages.png video.mp4 pleat_run.txt; do
  mkdir mine && echo mine >"mine/$name"
  refused "mine/$name" run hanging_square:4 --frames 2 --size 64x48 --out mine
  [ "$(cat "mine/$name")" = mine ] || fail "$name of the user was touched"
  rm -r mine
done
rm made/here/sheet.png && ln -s ../../file made/here/sheet.png
refused 'here/sheet.png' run hanging_square:4 --frames 2 --size 64x48 --out made/here
[ "$(cat file)" = text ] || fail 'what a link in the folder points at was touched'

# A file is written where its name leads: through links, into pipes and devices.
one_frame=(hanging_square:4 --frames 1 --no-render)
mkdir far && echo old >far/report.json
ln -s far/report.json link.json && ln -s far/none_yet.json dangling.json && ln -s link.json chain.json
accepted run "${one_frame[@]}" --json chain.json
accepted run "${one_frame[@]}" --json dangling.json
for link in link chain dangling; do [ -L "$link.json" ] || fail "the link $link.json was replaced"; done
for name in report none_yet; do grep -qF '"frames": 1' "far/$name.json" || fail "$name.json was not written"; done
accepted compare hanging_square:4 --row level=1 --columns 1 --size 32x24 --out link.json
[ -L link.json ] && [ "$(head -c 4 far/report.json | tail -c 3)" = PNG ] || fail 'compare replaced a link'
refused 'none/a.png' compare hanging_square:4 --row level=1 --columns 1 --size 32x24 --out none/a.png
mkfifo pipe
cat pipe >read.json &
accepted run "${one_frame[@]}" --json pipe
wait
[ -p pipe ] || fail 'a pipe was replaced'
grep -qF '"frames": 1' read.json || fail 'the reader of a pipe got nothing'
ln -s /dev/full full && "$pleat" run "${one_frame[@]}" --json full >/dev/null 2>full.stderr
[ $? -eq 1 ] && grep -q 'full: cannot be written' full.stderr || fail "a full disk was not told: $(cat full.stderr)"
[ -c /dev/full ] && [ -L full ] || fail 'a device was replaced'

# Neither narrow pictures, nor cloth that faces straight up, nor a name that is no UTF-8 fail after the work.
accepted run hanging_square:3 --frames 1 --size 16x8192 --out narrow
accepted compare drape_sphere:4 --row air_damping=0 --row air_damping=5 --close-up --columns 3 --size 32x32
accepted run "${one_frame[@]}" --json $'\xff.json'
echo "{$garment}" >hanging.json && cp hanging.json $'\xff-scene.json'
accepted run $'\xff-scene.json' --frames 1 --no-render --json report.json
grep -qF '"frames": 1' report.json || fail 'a scene whose name is no UTF-8 has no report'

# A stdout that takes nothing is told, and keeps no file from being written.
for command in '--help' list 'explain hanging_square:3'; do
  # shellcheck disable=SC2086
  "$pleat" $command >/dev/full 2>full.stderr
  [ $? -eq 1 ] && grep -q 'cannot be written' full.stderr || fail "pleat $command does not tell that stdout is full"
done
{
  sleep 0.2  # until its reader has left
  "$pleat" run "${one_frame[@]}" --json unread.json 2>unread.stderr
  echo $? >unread.status
} | true
[ -s unread.json ] || fail 'without a reader of stdout no report was written'
[ "$(cat unread.status)" -eq 1 ] || fail 'a reader that left is taken for one that read'
[ -s unread.stderr ] && fail "a reader that left is complained about: $(cat unread.stderr)"

# Ctrl-C and SIGTERM end a run and leave nothing behind.
for signal in INT TERM; do
  before=$(find . | sort)
  for command in 'run hanging_square:16 --frames 100000 --out interrupted' 'run hanging_square:64 --frames 1 --out interrupted' \
    'compare hanging_square:16 --row level=1 --columns 9 --every 10000 --size 64x64 --out interrupted.png'; do
    # shellcheck disable=SC2086
    timeout --signal "$signal" --kill-after 10 0.5 "$pleat" $command >/dev/null 2>"$work.stderr"
    [ $? -eq 124 ] && grep -q 'interrupted' "$work.stderr" || fail "pleat $command does not end at SIG$signal"
    [ "$(find . | sort)" = "$before" ] || fail "pleat $command left something behind at SIG$signal"
  done
done
finish
