# The guard splits a step that is too large and says so once; or refuses it; or lets it go, and what runs away is caught.
ply m.ply "$tetra_points" "$tetra_triangles"
large='--set time.step=1 --set time.end=4 --set balloons[0].threshold=1e300'
expect 0 balloon-sim m.ply $large --set time.guard=substep --set view.rate=1 --log log.tsv
one_message
stderr_has 'time.step 1 is split in [0-9]+: steps up to 0.0[0-9]+ are surely stable for symplectic-euler; most of that is for the (dampers|springs) at point [0-9]+ of balloons\[0\]$'
stdout_has '^4 s in [0-9]{2,} steps'
awk -F'\t' 'NR == 3 && $13 < 0.1 { small = 1 } END { exit !small }' log.tsv || fail "the log's step is not the split one"
# It says so again when steps are split in ten times as many parts.
expect 0 balloon-sim m.ply $large --set time.guard=substep --set schedule[0].at=2 --set schedule[0].damping=20 --log log.tsv
stderr_has '^balloon-sim: at 2.0[0-9]* s: time.step 1 is split in [0-9]{3,}: steps up to 0.00[0-9]+ are surely stable'
[ "$(grep -c 'is split in' .stderr)" = 2 ] || fail "told $(grep -c 'is split in' .stderr) times of split steps"
for option in --hash --check; do
    refused 3 'refused at time 0: time.step 1 is too large: steps up to 0.0' balloon-sim m.ply $option $large --set time.guard=refuse
done
expect 0 balloon-sim m.ply --check $large --set time.step=0.001 --set time.guard=refuse
expect 3 balloon-sim m.ply --hash $large --set time.end=1000 --set time.guard=off
stderr_has 'diverged at time .* on an edge of length .*; kinetic energy .*; time.step 1 is too large: steps up to 0.0'
[ ! -s .stdout ] || fail "stdout is not empty"
# Let go, it is told of all the same, once, whether numbers run away or not; again where it has become ten times as large; not with steps that are stable.
[ "$(grep -c '^balloon-sim: time.step 1 is too large: steps up to 0.0.*; it is taken all the same: time.guard is off$' .stderr)" = 1 ] || fail "not told that the step is too large"
expect 0 balloon-sim m.ply --hash --set time.guard=off --set time.step=0.001 --set time.end=0.1 --set time.integrator=symplectic-euler
[ ! -s .stderr ] || fail "something is said of stable steps"
expect 0 balloon-sim m.ply --hash --set time.guard=off --set time.step=0.01 --set time.end=0.07 --set time.integrator=symplectic-euler \
    --set balloons[0].threshold=1e300 --set schedule[0].at=0.05 --set schedule[0].damping=20
stderr_has '^balloon-sim: at 0.0[56] s: time.step 0.01 is too large: steps up to 0.00.*; it is taken all the same: time.guard is off$'
one_message
# What asks for short steps is named, and xpbd, for which springs ask for nothing, splits what wind asks for.
expect 0 balloon-sim m.ply --set time.guard=substep --set time.integrator=xpbd --set drag.air_density=1 --set drag.wind=[1000,0,0] --check
stdout_has 'time.step 0.025 is split in [0-9]+: .* surely stable for xpbd; most of that is for the drag at point [0-9]+ of'
expect 0 balloon-sim m.ply --set time.integrator=xpbd --set balloons[0].spring=1e6 --check
stdout_has 'every step is stable for xpbd$'
# A weight on a string is none of the points that a method solves for: what it asks for is told, and refused where no split would do.
weight='--set balloons[0].string.stiffness=1e12 --set time.integrator=bdf2 --set time.guard=substep'
expect 0 balloon-sim m.ply $weight --set balloons[0].string.weight=1 --check
stdout_has 'time.step 0.025 is split in [0-9]+: steps up to 3.54e-07 follow the weight on the string of balloons\[0\], .*softer string'
for option in --hash --check; do
    refused 3 'refused at time 0: time.step 0.025 is too large to be split: steps up to .* follow the weight on the string' \
        balloon-sim m.ply $weight --set balloons[0].string.weight=1e-6 $option
done
refused 1 'guard is "maybe"; it must be one of "substep", "refuse", "off"' balloon-sim m.ply --set time.guard=maybe

expect 0 balloon-sim m.ply $large --set time.guard=substep --check
stdout_has 'time.step 1 is split in [0-9]+: '
expect 0 balloon-sim m.ply --set time.step=0.001 --set time.guard=substep --check
stdout_has ': steps up to 0.[0-9]+ are surely stable'

# Where a scene names no method, trials choose one, and say which and why; whatever the number of threads.
printf 'time = { step = 0.1; end = 2.0; };\nballoons = ( { mesh = "m.ply"; pressure = 4; } );\n' >s.cfg
expect 0 balloon-sim s.cfg --hash --threads 1
stderr_has '^balloon-sim: (symplectic-euler|verlet|rk4|rkn4), [0-9]+ substeps?: stiffness ratio [0-9.]+, error [0-9.e-]+ radii a step, [0-9.]+ evaluations a step$'
tail -n 1 .stdout >one
expect 0 balloon-sim s.cfg --hash --threads 3
tail -n 1 .stdout >three
same_file one three
