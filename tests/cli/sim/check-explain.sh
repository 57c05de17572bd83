# --check says what a scene holds, --explain which effects are on; neither runs.
cp "$PROGRAMS/data/sphere.ply" "$PROGRAMS/data/sphere.cfg" .
expect 0 balloon-sim sphere.cfg --check --log log.tsv
stdout_has 'sphere.ply: 15[0-9]+ points, 4[0-9]+ edges, 30[0-9]+ triangles, mean radius 45'
stdout_has 'sphere.cfg: good: [0-9]+ bytes, 400 steps of symplectic-euler'
no_file log.tsv
expect 0 balloon-sim sphere.cfg --explain
stdout_has '^off	rip	no balloon calls for it$'
expect 0 balloon-sim sphere.cfg --explain --set 'balloons[0].rip.at=1'
stdout_has '^on	rip	1 of 1 balloons call for it \(paper 4.1\)	needs [^;]*; adds to a step: none$'
stdout_has '^off	spring_by_height	'
expect 0 balloon-sim sphere.cfg --explain --set 'balloons[0].pressure=0' --set 'balloons[0].gas.ambient=10' --set 'gravity.air_density=1.2'
stdout_has '^on	gas	1 of 1 balloons call for it .*adds to a step: '
stdout_has '^on	gravity	the scene has the block '
stdout_has '^off	drag	the scene has no such block$'

# pressure_on is a key, not a block; a block in the mode of the paper calls for nothing
expect 0 balloon-sim sphere.cfg --explain --set 'balloons[0].pressure_on=areas' --set 'balloons[0].fracture.mode=paper'
stdout_has '^on	pressure_on	1 of 1 balloons call for it '
stdout_has '^off	fracture	no balloon calls for it$'

# whether it can burst by itself, and what would do: the paper's sphere settles at .4 of its pressure; toy balloons are pricked below their strength
stays() { stdout_has '^off	burst	balloons\[0\]: .* is too low to burst it by itself; it takes about [0-9.e+]+ or more \(an estimate'; }
expect 0 balloon-sim sphere.cfg --explain
stdout_has '^on	burst	balloons\[0\]: pressure 10 may burst it by itself, as from about [0-9.]+ on \(an estimate'
expect 0 balloon-sim sphere.cfg --explain --set 'balloons[0].pressure=4'
stays
expect 0 balloon-sim sphere.cfg --set 'balloons[0].pressure=4' --set time.end=10 --hash
stdout_has '(nothing broke|in [1-3] pieces?)'
expect 0 balloon-sim sphere.cfg --explain --set 'balloons[0].pressure=4' --set 'schedule[0].at=1' --set 'schedule[0].pressure=50'
stdout_has '^on	burst	balloons\[0\]: pressure 50 may'
expect 0 balloon-sim sphere.cfg --explain --set 'balloons[0].threshold=1e300'
stdout_has '^off	burst	balloons\[0\]: no pressure bursts it: its skin bears any stretch$'
for scene in pricked overblown; do cp "$PROGRAMS/data/$scene.cfg" "$PROGRAMS/data/round.ply" .; done
expect 0 balloon-sim pricked.cfg --explain
stays
stdout_has 'evenly to a stretch of 2\.[23]'
expect 0 balloon-sim overblown.cfg --explain
stdout_has '^on	burst	balloons\[0\]: gas filling 19 may' # by the end, though the pump would go on to 30

# what the pump or the schedule would bring after the end, or past an open neck, bursts nothing
expect 0 balloon-sim overblown.cfg --explain --set time.end=1
stdout_has '^off	burst	balloons\[0\]: gas filling [0-9.]+ is too low to burst it by itself'
expect 0 balloon-sim overblown.cfg --explain --set balloons[0].gas.neck=1 --set balloons[0].gas.neck_at=1
stdout_has '^off	burst	balloons\[0\]: gas filling [0-9.]+ is too low to burst it by itself'
expect 0 balloon-sim sphere.cfg --explain --set 'balloons[0].pressure=4' --set 'schedule[0].at=20' --set 'schedule[0].pressure=50'
stays

# What is far from round swells unevenly: the fox's belly tears at a fifth of the filling that would do if it were stretched all alike.
says_uneven='and nothing is lost; this shape swells unevenly, and may tear long before\)$'
! grep -Eq "$says_uneven" .stdout || fail "a ball is said to swell unevenly"
cp "$PROGRAMS/data/fox.ply" "$PROGRAMS/data/fox.cfg" .
expect 0 balloon-sim fox.cfg --explain
stays
stdout_has "$says_uneven"

# A law of rubber that takes more work is expected to.
share() # LAW
{
    expect 0 balloon-sim "$PROGRAMS/data/sphere.ply" --set balloons[0].membrane.thickness=0.4 --set "balloons[0].membrane.law=$1" --explain
    sed -n 's/^on	membrane	.*adds to a step: \([0-9]*\) %$/\1/p' .stdout
}
[ "$(share neo-hookean)" -lt "$(share gent)" ] && [ "$(share gent)" -lt "$(share ogden)" ] || fail "all laws take the same"

# What is for a run, and what takes its place, does nothing beside it, nor beside --help-scene, and that is said.
idle() # OPTION-GIVEN OPTION-THAT-COUNTS
{
    expect 0 balloon-sim sphere.cfg "$2" "$1" left-out.tsv
    stderr_has "^balloon-sim: $1 is for a run, whose place $2 takes: it does nothing\$"
    one_message
    no_file left-out.tsv
}
idle --log --explain
idle --accuracy-cost --explain
idle --effect-cost --help-scene
idle --log --help-scene
