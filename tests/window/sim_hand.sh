# A click pricks the skin that it hits; a drag pulls it, until the button is let go.
. "$CASES/live.sh"

open_live
pause
click 400 300
picture pricked
click 20 80 # beside it
press period
quit
log_has "no hole of one triangle" 'at(1, "triangles_active") == 128 && at(-1, "triangles_active") == 127'
log_has "not three edges" 'at(1, "edges_active") - at(-1, "edges_active") == 3'

open_live --set 'balloons[0].threshold=9' --set 'balloons[0].damping=5'
pause
pull 1 400 300 460 300
steps 40
picture pulled
release 1
steps 80
quit

awk -F'\t' '$7 + 0 > most { most = $7 + 0 } END { exit !(most > 1.1 && $7 - 1 < (most - 1) / 2) }' live.tsv ||
    fail "the pull stretches nothing, or does not let go"
log_has "the hand did no work" 'at(-1, "user_work") > 0'
log_has "a pull broke something" 'at(-1, "edges_active") == at(1, "edges_active")'
