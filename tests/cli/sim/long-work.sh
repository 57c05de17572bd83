# A run that would take for ever says so where no progress bar is shown: how much is done, and how long the rest takes.
ply m.ply "$tetra_points" "$tetra_triangles"
set -- m.ply --set time.integrator=verlet --set time.end=1e9 --set 'balloons[0].pressure=0' --set view.rate=1e-6 --hash
run_for_a_while() # COMMAND...
{
    command_line=$*
    "$@" >.stdout 2>.stderr </dev/null &
    running=$!
    for second in $(seq 400); do
        sleep 1
        grep -q 'the rest takes' .stderr && break
        [ "$second" -lt 30 ] || [ "$quiet" = no ] || break
    done
    kill "$running"
    wait "$running" || true
}
quiet=no
run_for_a_while balloon-sim "$@"
stderr_has '^balloon-sim: inflating: .* % is done after .*; at this pace the rest takes [0-9.e+]* (minutes|hours|days|years)$'
quiet=yes
run_for_a_while balloon-sim --quiet "$@"
[ "$(wc -l <.stderr)" = 1 ] || fail "a quiet run says more than that it was interrupted"
