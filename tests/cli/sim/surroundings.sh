# Ground, obstacles, needles and contact: what cannot be is refused with its line; what is there runs to the same bits on any threads.
cp "$PROGRAMS/data/sphere.ply" "$PROGRAMS/data/ball.ply" "$PROGRAMS/data/pressed.cfg" .
printf 'balloons = ( { mesh = "sphere.ply"; } );\nneedles = (\n  { at = 1.0; }\n);\n' >needle.cfg
refused 1 'needle.cfg:3: needles\[0\] names no point; give from' balloon-sim needle.cfg
printf 'balloons = ( { mesh = "sphere.ply"; } );\nground = { height = 10.0; };\n' >ground.cfg
refused 1 'ground.cfg:2: balloons\[0\] begins inside the ground' balloon-sim ground.cfg
printf 'balloons = ( { mesh = "sphere.ply"; }, { mesh = "sphere.ply"; position = [9.0, 0.0, 0.0]; } );\ncontact = { };\n' >cross.cfg
refused 1 'cross.cfg:2: contact: the skins of balloons\[0\] and balloons\[1\] cross' balloon-sim cross.cfg
ply crossed.ply '1 1 0
-1 1 0
-1 -1 0
1 -1 0
0 0 -3
2 0 -1' '1 0 4
2 1 4
3 2 4
0 3 4
0 1 5
1 2 5
2 3 5
3 0 5'
printf 'balloons = ( { mesh = "crossed.ply"; } );\ncontact = { };\n' >crossed.cfg
refused 1 'crossed.cfg:2: contact: the skin of balloons\[0\] crosses itself before .* near .*; take a mesh that does not' balloon-sim crossed.cfg
sed 2d cross.cfg >apart.cfg
expect 0 balloon-sim apart.cfg --check
stderr_has 'balloons\[0\] and balloons\[1\] begin in one another.s room, and pass through each other: .* contact = \{ \};$'
expect 0 balloon-sim apart.cfg --check --set 'balloons[1].position=[0,200,0]'
[ ! -s .stderr ] || fail "balloons apart are said to overlap"
printf 'balloons = ( { mesh = "sphere.ply"; } );\nobstacle = ( );\n' >name.cfg
refused 1 'name.cfg:2: unknown key `obstacle` .did you mean `obstacles`' balloon-sim name.cfg
expect 0 balloon-sim pressed.cfg --explain
stdout_has '^on	contact	'
stdout_has '^on	ground	'
expect 0 balloon-sim pressed.cfg -q --hash --threads 1 --set time.end=0.8
tail -n 1 .stdout >one
expect 0 balloon-sim pressed.cfg -q --hash --threads 3 --set time.end=0.8
tail -n 1 .stdout >three
cmp -s one three || fail "another hash with three threads"

# Points that only a tear would make are not in anything's way yet.
printf 'time = { end = 0.1; };\nballoons = ( { mesh = "sphere.ply"; position = [0.0, 100.0, 0.0]; membrane = { thickness = 0.45; }; fracture = { }; } );\n' >high.cfg
printf 'ground = { height = 20; };\nobstacles = ( { } );\n' >>high.cfg
expect 0 balloon-sim -q high.cfg --hash

# A needle that never came to the skin is told of: that nothing broke is no riddle then.
printf 'time = { end = 0.1; };\nballoons = ( { mesh = "sphere.ply"; pressure = 0; } );\n' >needle.cfg
printf 'needles = ( { from = [0, 0, 100]; velocity = [0, 0, -50]; }, { at = 3; from = [0, 0, 100]; } );\n' >>needle.cfg
expect 0 balloon-sim needle.cfg --hash
stdout_has 'nothing broke$'
stderr_has 'needles\[0\] met no skin: at the end it is at .0, 0, 95., [45][0-9.]* from the nearest$'
stderr_has 'needles\[1\] comes at 3 s only$'
expect 0 balloon-sim -q needle.cfg --hash
[ ! -s .stderr ] || fail "--quiet says something"

# What twenty balloons tell in one step is said of each.
ply m.ply "$tetra_points" "$tetra_triangles"
{
    echo 'time = { end = 0.2; }; balloons = ('
    for i in $(seq 0 19); do
        [ "$i" = 0 ] || echo ,
        echo "{ mesh = \"m.ply\"; position = [$((200 * i)).0, 0.0, 0.0]; pins = { until = 0.1; }; }"
    done
    echo ');'
} >many.cfg
expect 0 balloon-sim many.cfg --log many.tsv
[ "$(grep -c ': pins: let go' .stderr)" = 20 ] || fail "not all balloons have their say"

# A needle that comes to skin of which nothing can be cut is told of, once: here corners of a pyramid whose skin may not come in two.
ply m.ply "$tetra_points" "$tetra_triangles"
printf 'time = { step = 0.01; end = 0.7; integrator = "symplectic-euler"; };\nballoons = ( { mesh = "m.ply"; radius = 0; pressure = 0; ' >corner.cfg
printf 'fracture = { smallest = 0.5; }; } );\nneedles = ( { from = [-0.2, -0.23, -1]; velocity = [0, 0, 10]; },\n' >>corner.cfg
printf '{ at = 0.2; from = [0.7, -0.23, -1]; velocity = [0, 0, 10]; }, { at = 0.4; from = [-0.23, 0.7, -1]; velocity = [0, 0, 10]; } );\n' >>corner.cfg
expect 0 balloon-sim corner.cfg --hash
stderr_has '^balloon-sim: at 0.08 s: balloons\[0\]: fracture: the skin tears$'
[ "$(grep -c '^balloon-sim: at 0.28 s: balloons\[0\]: fracture: is pricked where nothing can be cut: ' .stderr)" = 1 ] ||
    fail "a needle that cut nothing is told of otherwise than once"
