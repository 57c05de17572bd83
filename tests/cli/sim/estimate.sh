# --estimate says how good a run is and what half the error costs, by the order of its method; the state is the same without it.
cp "$PROGRAMS/data/sphere.ply" "$PROGRAMS/data/sphere.cfg" .
calm='--set time.end=0.5 --set balloons[0].pressure=4 --set time.step=0.005 --set view.rate=20'

# estimated METHOD FACTOR: the line that a method of this order gives; leaves the error in $error
estimated()
{
    expect 0 balloon-sim sphere.cfg $calm --set time.integrator=$1 --estimate --log $1.tsv --hash
    stdout_has "^position error [0-9.e-]+ of the radius; halving it would take $2 x the time \(at 0\.[0-9]+ s\)$"
    error=$(sed -n 's/^position error \([^ ]*\) .*/\1/p' .stdout)
    hash=$(tail -n 1 .stdout)
    printf '%s\n' "$hash" | grep -Eqx '[0-9a-f]{16}' || fail "the last line is no hash"
    column=$(head -n 1 $1.tsv | tr '\t' '\n' | grep -nx position_error | cut -d : -f 1)
    [ "$column" ] || fail "the log has no column for it"
    awk -F'\t' -v worst="$error" -v c="$column" 'NR == 2 && $c != 0 { exit 1 } NR > 1 && !($c <= 1.06 * worst + 1e-300) { exit 1 }' $1.tsv ||
        fail "the column does not agree with the largest error $error"
}

estimated symplectic-euler '(1\.9|2\.0|2\.1)'
coarse=$error
with=$hash
estimated verlet 1\.4
estimated rk4 1\.2
awk -v a="$coarse" -v b="$error" 'BEGIN { exit !(b < 1e-3 * a) }' || fail "rk4 is no better than Euler: $error, $coarse"

expect 0 balloon-sim sphere.cfg $calm --set time.integrator=symplectic-euler --hash
[ "$(tail -n 1 .stdout)" = "$with" ] || fail "another state without --estimate"

# the estimate is true: against a run whose error is a hundred times less
mean() { tail -n 1 "$1" | cut -f 2; }
expect 0 balloon-sim sphere.cfg $calm --set time.integrator=symplectic-euler --log e.tsv
awk -v a="$(mean e.tsv)" -v b="$(mean rk4.tsv)" -v e="$(tail -n 1 symplectic-euler.tsv | cut -f "$column")" \
    'BEGIN { d = (a - b) / 45; if (d < 0) d = -d; exit !(d < 1.2 * e && d > 0.5 * e) }' ||
    fail "the mean radius is off by another amount than estimated: $(mean e.tsv), $(mean rk4.tsv), $coarse"

# what auto splits in other parts than for the estimate is compared at the same moments, inside the scene's steps, too: it was told to be 2e-3
expect 0 balloon-sim sphere.cfg $calm --set time.end=0.4 --set time.step=0.2 --set time.integrator=auto --set view.rate=40 --estimate
awk '/^position error/ { found = $3 > 0 && $3 < 2e-5 } END { exit !found }' .stdout || fail "$(cat .stdout)"

# after the first break single runs mean nothing
expect 0 balloon-sim sphere.cfg --set time.end=1 --estimate --log burst.tsv
stdout_has 'its largest until the first break\)$'
[ "$(tail -n 1 burst.tsv | cut -f "$column")" = nan ] || fail "an error after the break: $(tail -n 1 burst.tsv)"

# nothing that moves, nothing to be wrong about
expect 0 balloon-sim sphere.cfg $calm --set 'balloons[0].pressure=0' --estimate
stdout_has '^position error 0 of the radius: finer steps move no point by a bit$'
