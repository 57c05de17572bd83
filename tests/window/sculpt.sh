# A hand carves: each tool, wheel, mirror, undo, redo, save, save as, quit-and-ask, resize. What it leaves behind is the
# sculpture that its chip script makes.
. "$CASES/hand.sh"

open_sculptor a.oct --depth 5
picture start

# from the front, the middle of the window is the middle of the cube's face
press 1
press b
click 480 360
journal_has '^chip box 0\.4[0-9]* 0\.4[0-9]* 0\.9[0-9]* 0\.5[0-9]* 0\.5[0-9]* 1\.0'
journal_has '^step'

[ "$(grep -c '^chip' "$journal")" = 1 ] || fail "one click was more than one chip"

press s
xdotool keydown ctrl click 4 click 4 click 4 keyup ctrl # a larger brush: 0.08 x 1.1^3
click 400 300
journal_has '^chip sphere .* 0\.10648'
press c
click 560 300
journal_has '^chip cylinder '
press d
drag 1 380 420 580 420
journal_has '^chip capsule '
press Tab
press m
drag 1 420 260 520 260
journal_has '^material 2'
journal_has '^fill capsule '
press Tab
press x
press s
click 420 440
journal_has '^mirror x'
press x
press n
click 400 300
journal_has '^sandpaper '
press h
click 560 300
journal_has '^heat '
press k
drag 1 330 500 630 520
journal_has '^chip half-space '
picture carved

# turning, panning and zooming touch nothing
lines=$(wc -l <"$journal")
drag 2 300 300 400 330
drag 3 300 300 320 300
xdotool click 4
settle
xdotool keydown alt
drag 1 400 300 470 320
xdotool keyup alt
press Home
picture looked-around
for view in 1 3 7 ctrl+1 ctrl+3 ctrl+7; do
    press $view
    picture "view-$view"
done
press 1
drag 2 300 300 400 330
[ "$(wc -l <"$journal")" = "$lines" ] || fail "looking around was an operation"
picture turned

press ctrl+z
press ctrl+z
press ctrl+y
[ "$(grep -c '^undo' "$journal")" = 2 ] && [ "$(grep -c '^redo' "$journal")" = 1 ] || fail "undo and redo are not there"

xdotool windowsize "$window" 700 500
settle
press F1
picture help
press F1
press p
picture balloon
press i
picture inflating
if command -v import >/dev/null; then # what was said of the one is not said beside the other
    corner() { import -window "$window" -crop 12x12+8+8 +repage "$1.ppm"; }
    corner silent
    click 350 250
    corner told
    cmp -s silent.ppm told.ppm && fail "that a balloon is for looking is not seen"
    press p
    corner back
    cmp -s silent.ppm back.ppm || fail "that a balloon is for looking is said beside the sculpture"
    press ctrl+y ctrl+y # there is nothing more to do again
    corner told
    cmp -s silent.ppm told.ppm && fail "that there is nothing more to do again is not seen"
    press i
    corner inflating
    cmp -s silent.ppm inflating.ppm || fail "what was said of the sculpture is said beside the balloon"
fi
press p

press ctrl+s
wait_title a.oct
cp "$journal" replay.chips
balloon-sculpt -q --script replay.chips --depth 5 -o replay.oct
same_cells a.oct replay.oct

# unsaved work is asked for, a stroke that is not at its end too
press 1 d
pull 1 300 300 340 330
"$ASK_TO_CLOSE" "$window"
settle
kill -0 "$program" 2>/dev/null || fail "the window closed in the midst of a stroke"
release 1
wait_title 'a.oct *'
press Escape ctrl+z ctrl+s
wait_title a.oct
press 1 s
click 300 300
"$ASK_TO_CLOSE" "$window"
settle
picture question
kill -0 "$program" || fail "the window closed with unsaved work"
press Escape
press ctrl+shift+s
press BackSpace BackSpace BackSpace BackSpace # .oct
xdotool type b.oct
press Return
wait_title ab.oct
press ctrl+q
ends 0
[ ! -e a.oct.journal ] && [ ! -e ab.oct.journal ] || fail "a journal is left behind"
[ ! -s said ] || fail "it said something"

# a killed program loses nothing: the next start offers it
open_sculptor ab.oct
press 1
click 350 400
journal=ab.oct.journal
journal_has '^step'
kill -9 "$program"
wait "$program" 2>/dev/null || true
cp ab.oct before.oct
open_sculptor ab.oct
picture recover
press r
press ctrl+s
press ctrl+q
ends 0
balloon-sculpt -q before.oct --export 1.vox
balloon-sculpt -q ab.oct --export 2.vox
! cmp -s 1.vox 2.vox || fail "the work before the kill is lost"
