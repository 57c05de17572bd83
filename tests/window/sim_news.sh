# What the run tells is said, and written on the picture below the state; before it has happened it is on neither.
. "$CASES/live.sh"

open_live --set time.guard=substep --set time.step=0.5
tries=0
until grep -q 'time.step 0.5 is split in [0-9]*: ' said; do
    tries=$((tries + 1))
    [ $tries -lt 200 ] || fail "that steps are split is not said"
    sleep 0.05
done
pause
picture told
command -v import >/dev/null && import -window "$window" -crop 500x12+8+58 +repage told.ppm
press Prior Prior Prior Prior
picture start
command -v import >/dev/null && import -window "$window" -crop 500x12+8+58 +repage start.ppm
quit
[ -e told.ppm ] && cmp -s told.ppm start.ppm && fail "what is said is not seen"
true
