# Every integrator by its name; an unknown one gets the list; frames and logs do not disturb a run that chooses its steps.
ply m.ply "$tetra_points" "$tetra_triangles"
refused 1 '"rk4".*"rkn4".*"rk-adaptive"' balloon-sim m.ply --set time.integrator=rk5
refused 1 'tolerance is 0; it must be from 1e-12 to 0.1' balloon-sim m.ply --set time.tolerance=0
refused 1 'tolerance is 1e-13; it must be from 1e-12' balloon-sim m.ply --set time.tolerance=1e-13
refused 1 'tolerance = 1e-12: balloons\[0\] is so far from the origin that .* 4e-10 radii at best' balloon-sim m.ply \
    --set time.integrator=rk-adaptive --set time.tolerance=1e-12 --set 'balloons[0].position=[1e6, 0, 0]' \
    --set 'balloons[0].radius=5'

hash_of() # INTEGRATOR OPTION...: of a short run
{
    name=$1
    shift
    expect 0 balloon-sim m.ply --set time.integrator="$name" --set time.end=0.5 --set 'balloons[0].pressure=2' --hash "$@"
    tail -n 1 .stdout
}

for name in symplectic-euler explicit-euler verlet rk4 rkn4 rk-adaptive backward-euler implicit-midpoint bdf2 xpbd; do
    plain=$(hash_of $name)
    watched=$(hash_of $name --log $name.tsv --set view.rate=100)
    [ "$plain" = "$watched" ] || fail "$name: $plain, and with a log $watched"
done
# A row a frame, at its own time, from steps that are longer.
[ "$(cut -f 1 rk-adaptive.tsv | sed -n '3p;$p' | tr '\n' ' ')" = "0.01 0.5 " ] || fail "rows at other times"
[ "$(wc -l <rk-adaptive.tsv)" = 52 ] || fail "$(wc -l <rk-adaptive.tsv) rows, wanted 52"

# CVODE is there, or it says what it needs.
code=0
balloon-sim m.ply --set time.integrator=cvode-bdf --set time.end=0.1 --hash --quiet >.stdout 2>.stderr || code=$?
[ "$code" = 0 ] || { [ "$code" = 1 ] && stderr_has 'libsundials-dev.*or use "bdf2"'; }
