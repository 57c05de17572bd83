# Saving goes on beside carving: what is carved meanwhile is not lost by a kill, quitting waits, a full disk changes
# nothing. A pipe that nobody reads is a disk as slow as one likes.
. "$CASES/hand.sh"

printf 'depth 5\nchip sphere 0.5 0.5 0 0.3\n' >begun.chips
balloon-sculpt -q --script begun.chips -o a.oct
cp a.oct before.oct

# a file that may have no more than 4096 bytes is like a full disk
(
    ulimit -f 8
    exec balloon-sculpt a.oct >log 2>said </dev/null
) &
program=$!
window=$(timeout 60 xdotool search --sync --onlyvisible --name "balloon-sculpt" | tail -n 1)
at 10 10
settle
press 1 g
click 480 360
journal_has '^step'
wait_title 'a.oct *'
press ctrl+s
settle
picture full
title_is 'a.oct *' || fail "a save that failed counts as one"
cmp -s a.oct before.oct || fail "the old file was touched"
for found in *; do
    case $found in
    a.oct | before.oct | begun.chips | a.oct.journal | a.oct.journal-base | log | said) ;;
    *) fail "$found was left behind" ;;
    esac
done
# and carving goes on
click 400 300
until_true "the journal ends with the failed save" journal_counts step 2
press ctrl+q
picture unsaved
kill -0 "$program" || fail "the window closed with unsaved work"
press d
ends 0

# killed while it saves
mkfifo slow.oct
echo 'a model' >m.vox
open_sculptor a.oct
press 1 g
click 480 360
press ctrl+shift+s
# a model that the sculpture came from stays what it is
press BackSpace BackSpace BackSpace BackSpace BackSpace
xdotool type m.vox
press Return
press Return
picture model
[ "$(cat m.vox)" = 'a model' ] || fail "a sculpture took a model's place"
title_is 'a.oct *' || fail "it goes by the model's name"
press BackSpace BackSpace BackSpace BackSpace BackSpace
xdotool type slow.oct
press Return
press Return
picture saving
click 400 300
until_true "no carving while a file is written" journal_counts step 2
kill -9 "$program"
wait "$program" 2>/dev/null || true
balloon-sculpt -q --recover a.oct -o recovered.oct
cat begun.chips - >want.chips <<'END'
chip sphere 0.515625 0.484375 0.984375 0.08
chip sphere 0.328125 0.640625 0.984375 0.08
END
balloon-sculpt -q --script want.chips -o want.oct
same_cells recovered.oct want.oct

# quitting waits, and what was carved meanwhile is asked for; then the journal is the new name's, with all there was
open_sculptor a.oct
press r
press 1 g
click 350 500
press ctrl+shift+s
press BackSpace BackSpace BackSpace BackSpace BackSpace
xdotool type slow.oct
press Return
press Return
click 560 300
press ctrl+q
kill -0 "$program" || fail "it did not wait for what was being written"
title_is 'a.oct *' || fail "it is saved before it is written"
cat slow.oct >got.oct
wait_title 'slow.oct *'
echo 'chip sphere 0.234375 0.203125 0.984375 0.08' | cat want.chips - >saved.chips
balloon-sculpt -q --script saved.chips -o saved.oct
same_cells got.oct saved.oct
journal=slow.oct.journal
[ ! -e a.oct.journal ] && [ ! -e a.oct.journal-base ] || fail "the old journal is still there"
press Escape
press ctrl+z ctrl+z
until_true "undo is not in the journal that went along" journal_counts undo 2
kill -9 "$program"
wait "$program" 2>/dev/null || true
rm slow.oct
mv got.oct slow.oct
balloon-sculpt -q --recover slow.oct -o recovered.oct
same_cells recovered.oct want.oct

# killed after it was saved: nothing is lost, so that nothing is asked, and carving goes on
journal=want.oct.journal
open_sculptor want.oct
press 1 g
click 480 360
until_true "nothing was carved" journal_counts step 1
press ctrl+s
wait_title 'want.oct'
kill -9 "$program"
wait "$program" 2>/dev/null || true
open_sculptor want.oct
press 1 g
click 350 500
until_true "there is a question about what was saved" journal_counts chip 2
press ctrl+q
press d
ends 0
[ ! -e "$journal" ] || fail "the journal stays"

# a name of more than a thousand letters is proposed whole: what is cut is another file's
long=$(printf './%.0s' $(seq 600))a.oct
open_sculptor "$long"
press 1 g
click 480 360
wait_title "$long *"
press ctrl+shift+s
press Return
wait_title "$long"
press ctrl+q
ends 0
