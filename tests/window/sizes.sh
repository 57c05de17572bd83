# A window of any size, and one that is out of sight for a while, carves as before.
. "$CASES/hand.sh"

open_sculptor a.oct --depth 5
press 1
steps=0

# carves_at X Y NAME
carves_at()
{
    settle
    steps=$((steps + 1))
    click "$1" "$2"
    until_true "a click in a window $3 does nothing" journal_counts step $steps
    picture "$3"
}

carves_at 480 360 as-it-was
xdotool windowsize "$window" 60 40
press Home
carves_at 30 22 tiny
xdotool windowsize "$window" 1 1
settle
xdotool windowsize "$window" 2400 1800
press Home
carves_at 700 500 huge
xdotool windowsize "$window" 701 500
press v Home
carves_at 175 330 stereo
press v v Home

xdotool windowunmap "$window"
settle
xdotool windowmap --sync "$window"
xdotool windowfocus "$window" 2>/dev/null || true
at 10 10
carves_at 400 200 back
xdotool windowsize "$window" 650 450
settle
command -v import >/dev/null && import -window "$window" -crop 500x20+0+424 +repage before.ppm
press ctrl+s
wait_title a.oct
settle
picture saved
# what has been written does not make the letters of the lowest line smaller
command -v import >/dev/null && import -window "$window" -crop 500x20+0+424 +repage after.ppm
[ ! -e before.ppm ] || cmp -s before.ppm after.ppm || fail "the tool's line is another once it is saved"
press ctrl+q
ends 0
balloon-sculpt -q a.oct --info | grep -q '^chip log' || fail "no sculpture"
[ ! -s said ] || fail "it said something"
