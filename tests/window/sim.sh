# The live window: it inflates at once, no faster than the clock, stops, goes on, takes single steps, begins anew; and looking around is
# no part of the run.
. "$CASES/live.sh"

began=$(date +%s%N)
open_live
sleep 3
pause
passed=$((($(date +%s%N) - began) / 1000000))
picture paused
press period period period
quit
log_has "it did not inflate" 'at(1, "time") < at(-1, "time") && at(-1, "mean_radius") > 45.1'
log_has "it ran ahead of the clock: $passed ms" "at(-1, \"time\") < $passed / 1000 + 4 * 0.025"
log_has "three single steps are not 0.075 s" 'near((at(-1, "time") / 0.025) % 1, 0) || near((at(-1, "time") / 0.025) % 1, 1)'

# Looking around while it is paused adds no row, and so no step.
open_live
pause
press period
for key in 1 3 7 ctrl+1 ctrl+3 ctrl+7 Home f s o o o o c w w w v v v Tab Tab F1; do
    press $key
    picture "key-$key"
done
press F1
drag 2 300 300 400 330
drag 3 300 300 320 300
xdotool click 4 click 5
settle
xdotool keydown alt
drag 1 400 300 470 320
xdotool keyup alt
picture looked-around
xdotool windowsize "$window" 500 400
settle
picture small
press period
quit
log_has "looking around made rows" 'near(at(-1, "time") - at(-2, "time"), 0.025)'

open_live
sleep 1
press r
wait_title '^ball.cfg - '
sleep 0.5
quit
awk -F'\t' 'NR > 2 && $1 < before { back = 1 } { before = $1 } END { exit !back }' live.tsv || fail "time never went back"

# A window is no larger than the screen.
open_live --set view.size=[3000,2000]
xdotool getwindowgeometry --shell "$window" >log
[ "$(grep -E '^(WIDTH|HEIGHT)=' log | tr '\n' ' ')" = 'WIDTH=1280 HEIGHT=1024 ' ] || fail "the window is not that of the screen"

# A signal ends it in a pause, too.
pause
kill -TERM "$program"
ends 143
