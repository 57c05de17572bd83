# Work that takes long is not done in silence where no progress bar is shown: what it is, how large, how much is done, how long the rest takes.
ply m.ply "$tetra_points" "$tetra_triangles"
run_until() # PATTERN COMMAND...: until a line of stderr matches; or for a quarter of a minute, where it is to be quiet
{
    pattern=$1
    shift
    command_line=$*
    "$@" >.stdout 2>.stderr </dev/null &
    running=$!
    for second in $(seq 400); do
        sleep 1
        ! grep -Eq "$pattern" .stderr || break
        [ "$second" -lt 15 ] || [ "$quiet" = no ] || break
    done
    kill "$running"
    wait "$running" || true
    [ "$quiet" = yes ] || stderr_has "$pattern"
}
rest='% is done after [0-9.]* s; at this pace the rest takes [0-9.e+]* (s|minutes|hours|days|years)$'
set -- m.ply --set time.integrator=verlet --set time.end=1e9 --set 'balloons[0].pressure=0' --set view.rate=1e-6 --hash
quiet=no
run_until "^balloon-sim: inflating: 4 triangles, to 1e\\+09 s in 4e\\+10 steps; [0-9.e-]* $rest" balloon-sim "$@"
run_until "^balloon-sim: inflating: [0-9.e-]* $rest" balloon-sim "$@"
quiet=yes
run_until '% is done' balloon-sim --quiet "$@"
[ "$(wc -l <.stderr)" = 1 ] || fail "a quiet run says more than that it was interrupted"

quiet=no
echo 'depth 3' >cube.chips
expect 0 balloon-sculpt --script cube.chips -o cube.oct
run_until '^balloon-surface: meshing: 1 box in 8 cells a side; [0-9.e-]* % is done after' \
    balloon-surface cube.oct --triangles 300000 --relax 1000 -o cube.ply

# On a terminal the bar is there at once, and a note takes a line of its own.
needs script
cat >wind.cfg <<'END'
time = { step = 0.01; end = 1e6; };
balloons = ( { mesh = "m.ply"; gas = { ambient = 10; fill = 3; }; fracture = { mode = "tear"; }; membrane = { thickness = 0.5; }; } );
END
timeout 5 script -qfc 'balloon-sim wind.cfg --hash' typescript >.stdout 2>.stderr </dev/null || true
tr '\r' '\n' <typescript >.stderr
stderr_has '^inflating [#.]{30} +[0-9]+ %'
stderr_has '^.\[Kballoon-sim: '
