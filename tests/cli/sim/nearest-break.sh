# A run in which nothing breaks says how near it came: of what was shown on the way, or of the end alone.
ply m.ply "$tetra_points" "$tetra_triangles"
set -- m.ply --set time.end=2 --set balloons[0].radius=0 --set balloons[0].threshold_of=edge --set balloons[0].threshold=1.9
expect 0 balloon-sim "$@" --set balloons[0].pressure=8 --hash
stderr_has '^balloon-sim: nearest to breaking at the end is balloons\[0\] at 2 s, to [0-9]* %: an edge stretched 1.[0-9]* times, which lets go at 1.9$'

# A balloon that swells and springs back: the row of the log with the longest edge is the one that is told of.
expect 0 balloon-sim "$@" --set balloons[0].pressure=8 --log log.tsv
stdout_has 'nothing broke$'
told=$(sed -n 's/.*came balloons.0. at \(.*\) s, to \(.*\) %: an edge stretched \(.*\) times, which lets go at 1.9$/\1 \2 \3/p' .stderr)
most=$(awk 'NR > 1 && $7 > most { most = $7; time = $1 } END { printf "%.4g %.0f %.3g", time, 100 * most / 1.9, most }' log.tsv)
[ "$told" = "$most" ] || fail "it says $told, and the log $most"

# Of what is at rest, or bears a thousandfold, nobody expects a burst; and what burst is not told of.
expect 0 balloon-sim "$@" --set balloons[0].pressure=0 --set time.integrator=verlet --set time.step=0.01 --hash
[ ! -s .stderr ] || fail "a balloon at rest is said to be near to breaking"
expect 0 balloon-sim "$@" --set balloons[0].pressure=8 --set balloons[0].threshold=1e9 --hash
! grep -q nearest .stderr || fail "what never breaks is said to be near to it"
expect 0 balloon-sim "$@" --set balloons[0].pressure=1000 --hash
stdout_has 'the first edge broke at'
! grep -q nearest .stderr || fail "it burst, and is said to have come near to it"

# Skin that tears: by the energy of an equal stretch both ways.
cat >torn.cfg <<'END'
time = { step = 0.01; end = 2; integrator = "verlet"; };
balloons = ( { mesh = "m.ply"; pressure = 0; membrane = { thickness = 0.5; }; gas = { ambient = 6; fill = 2; };
               fracture = { mode = "tear"; strength = 4; weakness = 0; }; } );
END
expect 0 balloon-sim torn.cfg --log log.tsv
stderr_has 'nearest to breaking came balloons\[0\] at [0-9.]* s, to [0-9]* %: skin as if stretched 1\.[0-9]* times both ways, which tears at 4$'
expect 0 balloon-sim torn.cfg --quiet --hash
[ ! -s .stderr ] || fail "--quiet says something"

# A rip that waited to the end for its time, or for its stretch.
set -- m.ply --set time.end=0.5 --set time.integrator=verlet --set balloons[0].pressure=0
expect 0 balloon-sim "$@" --set balloons[0].rip.at=3 --hash
stderr_has '^balloon-sim: balloons\[0\]\.rip has not opened: it waits for 3 s, and until the mean edge is 1 times as long as at rest$'
expect 0 balloon-sim "$@" --set balloons[0].rip.stretch=1.5 --hash
stderr_has 'it waits for 0 s, and until the mean edge is 1.5 times as long'
expect 0 balloon-sim "$@" --set balloons[0].rip.at=0.1 --hash
! grep -q 'not opened' .stderr || fail "it has opened, and is said not to have"
