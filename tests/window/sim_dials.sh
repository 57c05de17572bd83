# Pressure, step, spring constants and speed by key and by slider, between any two steps.
. "$CASES/live.sh"

open_live
pause
press Up Up # two fiftieths of 2.5 times 3 each
press bracketright period
quit
log_has "pressure by key" 'near(at(-1, "gauge_pressure"), 3.3)'
log_has "step by key" 'near(at(-1, "step"), 0.025 * 10 ^ 0.04)'
log_has "the step was not taken" 'near(at(-1, "time") - at(-2, "time"), 0.025 * 10 ^ 0.04) || near(at(-1, "time") - at(-3, "time"), 0.025 * 10 ^ 0.04)'

open_live
pause
press Down bracketleft minus
settle
picture dials-by-key
press plus plus
quit
log_has "pressure by key" 'near(at(-1, "gauge_pressure"), 2.85)'
log_has "stiffer springs hold more, by the user's work" 'at(-1, "user_work") != 0'

# Sliders: tracks from x = 132 to 262, rows 16 high above the time's.
open_live
pause
click 262 504
picture dials
drag 1 200 520 132 520
press period
quit
log_has "pressure by slider" 'near(at(-1, "gauge_pressure"), 7.5)'
log_has "step by slider" 'near(at(-1, "step"), 0.0025)'

# Springs ten times as stiff.
open_live
sleep 1
pause
drag 1 197 536 262 536
quit
log_has "springs by slider" 'at(-1, "user_work") > 1 && near(at(-1, "user_work"), 0.9 * at(-1, "elastic_energy"))'

# A tenth of the speed.
open_live
pause
press r
drag 1 197 552 132 552
sleep 1
quit
log_has "speed by slider" 'at(-1, "time") < 1.2'
