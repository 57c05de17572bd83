# Back to any frame, on from there, films and pictures.
. "$CASES/live.sh"

open_live
sleep 1.5
press Left
wait_title 'paused'
press Left
press Left
picture back
press Right
quit
log_has "frames back" 'near(at(-3, "time") - at(-2, "time"), 0.025) && near(at(-1, "time") - at(-2, "time"), 0.025)'

# By the slider to the start; from there it goes the same way again.
open_live
sleep 1
drag 1 760 578 133 578
wait_title 'paused'
picture start
press period period period period
quit
log_has "not the start" 'near(at(-1, "time"), 0.1)'
balloon-sim ball.cfg --log again.tsv --set time.end=0.1 -q >/dev/null
[ "$(tail -n 1 live.tsv | cut -f 1-12)" = "$(tail -n 1 again.tsv | cut -f 1-12)" ] || fail "another state than in a run"

open_live
press m
wait_title 'recording'
sleep 5 # a loaded machine draws one frame a second
press m
wait_title '^ball.cfg - '
press p
quit
if command -v ffprobe >/dev/null; then
    count=$(ffprobe -v error -count_frames -select_streams v:0 -show_entries stream=nb_read_frames -of csv=p=0 ball-1.mp4)
    [ "$count" -ge 3 ] || fail "the film has $count frames"
fi
is_picture ball-1.png 800 600
