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
press period Down bracketleft minus # springs at rest would hold nothing
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

# A pressure from outside: 0 in the middle of its slider.
open_live --set balloons[0].pressure=-3
pause
press Down period
quit
log_has "less pressure by key" 'near(at(-1, "gauge_pressure"), -3.3)'

# What the schedule has made of a step is less than its slider has: no key turns it the other way.
open_live --set schedule[0].at=0 --set schedule[0].step=0.001
pause
press period bracketleft period
quit
log_has "a shorter step by key" 'at(-1, "step") <= 0.001'

# In a window of twice 600 x 450 all that lies over the picture is twice as large.
open_live --set view.size=[1200,900]
pause
picture dials-large
click 524 708
press period
quit
log_has "a slider of a large window" 'near(at(-1, "gauge_pressure"), 7.5)'

# Springs ten times as stiff.
open_live
pause
steps 20
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
open_live
pause
press r space less less less less less # each to a fifth of the slider, which goes from a tenth to the tenfold
settle
picture slow
press r
sleep 1
quit
log_has "speed by key" 'at(-1, "time") < 0.5'

# Where gas makes the pressure the first dial is the pump, 0 in the middle of its slider: at constant temperature (p + ambient) V is the amount.
open_gas() # ARGUMENT...
{
    open_live --set 'balloons[0].pressure=0' --set 'balloons[0].gas.ambient=0.01' --set 'time.guard=substep' "$@"
}
amount_is() # MESSAGE AMOUNT: over the first
{
    log_has "$1" "near((at(-1, \"gauge_pressure\") + 0.01) * at(-1, \"volume\"), $2 * 0.01 * at(1, \"volume\"))"
}
open_gas
pause
click 262 504 # one of what it began with, a second
picture pump
press period period
quit
amount_is "pump by slider" 1.05

open_gas --set 'balloons[0].gas.pump=2' --set 'balloons[0].gas.pump_until=1'
pause
press Down period Left period # a fiftieth of the whole slider, 10 a second, less; the past has the scene's pump
press Up period # past what the scene would pump
quit
amount_is "pump by key" 1.055

open_gas --set 'balloons[0].gas.fill=2'
pause
click 132 504
press period period
quit
amount_is "gas is let out" 1.95
