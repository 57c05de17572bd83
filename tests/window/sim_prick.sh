# On a skin that tears along cracks a click begins one, which runs on by itself; and the order of its layers is seen.
SPLIT=12 # 1152 triangles
. "$CASES/live.sh"
sed -i 's/ point_mass = 1;//' ball.cfg # rubber has its own

# Filled so far that cracks run, but none begins by itself.
rubber="--set balloons[0].pressure=0 --set balloons[0].gas.ambient=6
    --set balloons[0].gas.fill=1.6 --set balloons[0].gas.density=2.2e-5 --set balloons[0].membrane.shear_modulus=20
    --set balloons[0].membrane.thickness=0.45 --set balloons[0].membrane.density=0.0144
    --set balloons[0].membrane.viscosity=1.2 --set balloons[0].fracture.mode=tear --set time.guard=substep"
open_live $rubber
sleep 1
pause
click 400 300
picture hole
command -v import >/dev/null && import -window "$window" -crop 500x25+0+52 +repage silent.ppm
click 402 300
command -v import >/dev/null && import -window "$window" -crop 500x25+0+52 +repage told.ppm
[ -e told.ppm ] && cmp -s told.ppm silent.ppm && fail "that a click beside a hole does nothing is not said"
steps 60
picture torn
quit
grep -q 's: balloons\[0\]: gas: streams out of a tear$' said || fail "what the gas tells is not said"
log_has "no crack ran from where it was pricked" 'at(1, "torn_length") == 0 && at(-1, "torn_length") > 60'
until=$(tail -n 1 live.tsv | cut -f 1)
balloon-sim ball.cfg $rubber --log untouched.tsv --set "time.end=$until" -q >/dev/null
[ "$(tail -n 1 untouched.tsv | cut -f 22)" = 0 ] || fail "it tears by itself"

# Both walls and what is mirrored in them, the second drawn first where nobody sorts.
if command -v import >/dev/null; then
    open_live --set balloons[0].point_mass=1
    sleep 1
    pause
    for order in sort list peel none sort-again; do
        import -window "$window" -crop 200x200+300+200 +repage "$order.ppm"
        [ -z "${PICTURES:-}" ] || cp "$order.ppm" "$PICTURES"
        press o
    done
    cmp -s sort.ppm none.ppm && fail "unsorted layers look as if they were sorted"
    cmp -s sort.ppm sort-again.ppm || fail "the key does not lead back to sorted layers"
    quit
fi
