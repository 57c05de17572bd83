# A run that is resumed ends as one that never stopped: the same hash, the same log, frames that go on counting.
cp "$PROGRAMS/data/sphere.ply" "$PROGRAMS/data/sphere.cfg" .
small='--set view.size=[64,48] --set view.rate=10'
rows() { cut -f 1-13,15- "$1"; } # all but the seconds, which are the machine's

expect 0 balloon-sim sphere.cfg $small --set time.end=2 --hash --log whole.tsv --frames whole --threads 1
hash=$(tail -n 1 .stdout)
expect 0 balloon-sim sphere.cfg $small --set time.end=0.8 --checkpoint run.ck --log a.tsv --frames parts --threads 2
a_file run.ck
expect 0 balloon-sim sphere.cfg $small --set time.end=2 --hash --resume run.ck --checkpoint run.ck --log b.tsv \
    --frames parts --threads 3
[ "$(tail -n 1 .stdout)" = "$hash" ] || fail "another hash than without a stop: $(tail -n 1 .stdout), not $hash"
stdout_has '^2 s in 80 steps: .* the first edge broke at 0\.6 s$'
rows whole.tsv >whole.rows
rows b.tsv >b.rows
same_file whole.rows b.rows
[ "$(ls whole)" = "$(ls parts)" ] || fail "frames are numbered otherwise: $(ls parts | tr '\n' ' ')"
for frame in whole/*; do
    same_file "$frame" "parts/$(basename "$frame")"
done

# what is at its end has nothing left to do, and says the same
expect 0 balloon-sim sphere.cfg $small --set time.end=2 --hash --resume run.ck
[ "$(tail -n 1 .stdout)" = "$hash" ] || fail "another hash at the end"

# a log that begins with the resumed run: without what was before
expect 0 balloon-sim sphere.cfg $small --set time.end=0.8 --checkpoint quiet.ck
expect 0 balloon-sim sphere.cfg $small --set time.end=1 --resume quiet.ck --log late.tsv
[ "$(wc -l <late.tsv)" = 3 ] || fail "the log has $(wc -l <late.tsv) lines, wanted a header and two rows"

# across methods: the second half remembers what the first one did
for method in verlet rk4 implicit-midpoint bdf2; do
    expect 0 balloon-sim sphere.cfg --set time.integrator=$method --set time.end=0.4 --checkpoint m.ck
    expect 0 balloon-sim sphere.cfg --set time.integrator=$method --set time.end=0.6 --resume m.ck --hash
    part=$(tail -n 1 .stdout)
    expect 0 balloon-sim sphere.cfg --set time.integrator=$method --set time.end=0.6 --hash
    [ "$(tail -n 1 .stdout)" = "$part" ] || fail "$method: another hash after it was resumed"
done

# springs that have slipped are the state's: the scene is the one that it was
slips='--set balloons[0].plasticity.yield=1 --set balloons[0].pressure=4 --set balloons[0].threshold=4'
expect 0 balloon-sim sphere.cfg $slips --set time.end=0.3 --checkpoint slip.ck
expect 0 balloon-sim sphere.cfg $slips --set time.end=0.4 --resume slip.ck --hash
part=$(tail -n 1 .stdout)
expect 0 balloon-sim sphere.cfg $slips --set time.end=0.4 --hash
[ "$(tail -n 1 .stdout)" = "$part" ] || fail "springs that slip: another hash after they were resumed"

# in the midst of a burst that lets gas out: the guard, too, goes by what is in the file alone
gas='--set balloons[0].pressure=0 --set balloons[0].gas.ambient=0.5 --set balloons[0].gas.fill=6 --set balloons[0].gas.density=1e-5'
for method in symplectic-euler verlet rk4; do
    run="balloon-sim sphere.cfg $gas --set time.integrator=$method --set time.guard=substep"
    expect 0 $run --set time.end=0.5 --hash
    whole=$(tail -n 1 .stdout)
    for stop in 0.2 0.25 0.3 0.35; do
        expect 0 $run --set time.end=$stop --checkpoint gas.ck
        expect 0 $run --set time.end=0.5 --resume gas.ck --hash
        [ "$(tail -n 1 .stdout)" = "$whole" ] || fail "$method, with gas: another hash after a stop at $stop s"
    done
done
