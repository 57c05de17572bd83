# A window tells the program what the hand does, shows what a picture would, and closes when the program agrees.
. "$CASES/lib.sh"

start "^events$" "$PROGRAM"
wait_for '^resize 320 240$'
wait_for '^same$' # the window's pixels are those of the off-screen picture

xdotool key a
wait_for '^key 97 0$'
xdotool key shift+a
wait_for '^key 65 1$'
xdotool key ctrl+z
wait_for '^key 122 2$'
xdotool key ctrl+shift+z
wait_for '^key 122 3$'
xdotool key Escape
wait_for '^key 27 0$'
xdotool key F1
wait_for '^key 256 0$'
xdotool key shift+Left
wait_for '^key 268 1$'
xdotool key alt+Home
wait_for '^key 274 4$'

at 100 50
wait_for '^motion 100 50 0$'
xdotool mousedown 1
wait_for '^button 0 1 100 50 0$'
at 120 60
wait_for '^motion 120 60 0$'
xdotool mouseup 1
wait_for '^button 0 0 120 60 0$'
xdotool click 2 click 3 click 4 click 5
wait_for '^button 1 0 120 60 0$'
wait_for '^button 2 0 120 60 0$'
wait_for '^wheel 1 120 60 0$'
wait_for '^wheel -1 120 60 0$'
xdotool keydown ctrl click 4 keyup ctrl
wait_for '^wheel 1 120 60 2$'

xdotool windowsize "$window" 400 300
wait_for '^resize 400 300$'
xdotool key t
wait_for '^timer$'
[ "$(grep -c '^timer$' log)" = 1 ] || fail "a timer that was replaced came too"

"$ASK_TO_CLOSE" "$window"
wait_for '^close refused$'
xdotool key b
wait_for '^key 98 0$' # it lives on
xdotool key s
wait_for '^same 400 300$'
"$ASK_TO_CLOSE" "$window"
wait_for '^close agreed$'
ends 0

start "^events$" "$PROGRAM"
xdotool key q
ends 0
