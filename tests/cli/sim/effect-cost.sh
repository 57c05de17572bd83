# What each effect of a scene costs and changes: a table on stdout and in a file, what cannot be left out, a picture.
balloon-sculpt -q --depth 1 -o cube.oct
balloon-surface -q cube.oct --cube-size 0.3 -o cube.ply
calm='--set time.end=0.4 --set balloons[0].point_mass=1 --set balloons[0].threshold=100 --set balloons[0].pressure=0'
effects='--set gravity.acceleration=[0,-3,0] --set drag.air_density=1e-12 --set balloons[0].gas.ambient=0.01'
expect 0 balloon-sim cube.ply $calm $effects --set 'balloons[0].pressure_on=areas' --effect-cost cost.tsv
[ "$(head -n 1 .stdout)" = "$(printf 'without\tshare\tseconds\tbytes\tposition\tvolume\tpressure\tfirst_break\tpieces\tsteps')" ] ||
    fail "the header is another"
same_file .stdout cost.tsv
grep -v '^#' cost.tsv | awk -F'\t' 'NF != 10 { exit 1 }' || fail "a row has not ten columns"
[ "$(grep -v '^#' cost.tsv | cut -f 1 | tr '\n' ' ')" = "without - gas gravity drag " ] || fail "other effects are in the table"
stdout_has '^# drag: (saves )?[0-9.e+]+ % of the time, changes the answer by [0-9.e-]+: you may not need it$'
stdout_has '^# gravity: (saves )?[0-9.e+]+ % of the time, changes positions by 0\.[0-9]+ radii, the volume by '
stdout_has '^# gas in place of a constant pressure, '
only_files cube.oct cube.ply cost.tsv

# of what makes no step nothing can be told: each effect was said not to be needed
expect 1 balloon-sim cube.ply $calm $effects --set time.end=0.01 --effect-cost cost.tsv
stderr_has '--effect-cost: time\.end = 0\.01 is over before a step of time\.step = 0\.025$'
refused 1 '--effect-cost: time\.end = 0\.01 is over before' balloon-sim cube.ply $calm $effects --set time.end=0.01 --effect-cost cost.tsv --check

# what is for a run is told that its place is taken, and the work is done
expect 0 balloon-sim cube.ply $calm --set gravity.acceleration=[0,-3,0] --threads 2 --effect-cost cost.tsv
stderr_has '--threads is for a run, whose place --effect-cost takes: it does nothing'

# what needs another, and what only says what something means, cannot be left out alone
expect 0 balloon-sim cube.ply --set time.end=0.1 --set 'balloons[0].pressure=0.1' --set 'balloons[0].pressure_on=areas' --effect-cost cost.tsv
stdout_has '^# pressure_on: cannot be left out alone: it says how the pressure acts'
two='--set balloons[1].mesh=cube.ply --set balloons[1].position=[200,0,0] --set balloons[1].gas.ambient=10'
expect 0 balloon-sim cube.ply $two --set time.end=0.1 --set 'balloons[0].gas.ambient=10' --set 'balloons[0].tube.to=1' \
    --set 'balloons[0].tube.area=1' --effect-cost cost.tsv
stdout_has '^# gas: cannot be left out alone: .*tube: balloons.0. has no gas that could flow'
stdout_has '^# tube: '

# a run that is refused midway without an effect is a row of the table: only the membrane does without springs that are made too stiff
cp "$PROGRAMS/data/ball.ply" .
stiff='--set time.step=0.01 --set time.end=0.2 --set time.guard=refuse --set schedule[0].at=0.1 --set schedule[0].spring_factor=1e6'
expect 0 balloon-sim ball.ply $stiff --set 'balloons[0].pressure=0.1' --set 'balloons[0].membrane.thickness=0.45' \
    --set 'balloons[0].membrane.density=0.1' --effect-cost cost.tsv
stdout_has '^# membrane: you need it; without it: .*refused at time 0\.1: time\.step 0\.01 is too large'
stdout_has '^-	1	[0-9.e-]*[1-9][0-9.e-]*	.*	1	20$'

# a skin that only bending keeps from being crushed is crushed without it
crush='--set time.step=0.01 --set time.end=1.2 --set balloons[0].damping=2 --set balloons[0].threshold=100 --set contact.thickness=2'
expect 0 balloon-sim ball.ply $crush --set 'balloons[0].pressure=-10' --set 'balloons[0].bending.stiffness=200' --effect-cost cost.tsv
stdout_has '^# bending: saves [0-9]+ % of the time, changes positions by 0\.[3-9]'

# what a scene bursts by is told
expect 0 balloon-sim cube.ply --set time.end=0.5 --set 'balloons[0].pressure=0' --set 'balloons[0].rip.at=0.2' --effect-cost cost.tsv
stdout_has '^# rip: .*without it nothing breaks \(with it at 0\.[0-9]+ s\): you need it$'

refused 1 'has no effects: there is nothing to leave out' balloon-sim cube.ply --effect-cost cost.tsv
refused 1 'has no effects: there is nothing to leave out' balloon-sim cube.ply --effect-cost cost.tsv --check
refused 1 'no-folder/cost.tsv' balloon-sim cube.ply $effects --effect-cost no-folder/cost.tsv
refused 2 'must end in \.tsv, \.png or \.svg' balloon-sim cube.ply --effect-cost cost.pdf
refused 2 'leave one of the two out' balloon-sim cube.ply --effect-cost cost.tsv --accuracy-cost cost.tsv
if command -v gnuplot >/dev/null; then
    expect 0 balloon-sim cube.ply $calm --set drag.air_density=1e-12 --effect-cost cost.svg
    a_file cost.svg
    grep -q drag cost.svg || fail "drag is not in the picture"
else
    echo "gnuplot is not installed: no picture was drawn"
fi

# Bars of time stand on nothing, however much each effect takes.
mkdir bin
printf '#!/bin/sh\ncat >"%s/script"\n' "$PWD" >bin/gnuplot
chmod +x bin/gnuplot
expect 0 env PATH="$PWD/bin:$PATH" balloon-sim cube.ply $calm --set 'balloons[0].gas.ambient=0.01' --effect-cost cost.svg
from='[0:*]'
awk -F'\t' '!/^#/ && NR > 1 && $2 < 0 { found = 1 } END { exit !found }' cost.tsv && from='[*:*]' # one that saves time
grep -qxF "set yrange $from" script || fail "the bars stand on $(grep 'set yrange' script)"
