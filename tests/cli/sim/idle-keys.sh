# What a scene says and nothing goes by is told on a line, and the run goes on; the scenes that come along say nothing of the kind.
idle() { stderr_has "^balloon-sim: $1 nothing: "; }
cp "$PROGRAMS/data/sphere.ply" .
cat >odd.cfg <<'SCENE'
time = { integrator = "rk4"; tolerance = 1e-4; };
gravity = { air_density = 1.2; };
balloons = ( { mesh = "sphere.ply";
               spring = 30; damping = 2;
               membrane = { thickness = 0.4; gent_limit = 20; }; } );
SCENE
expect 0 balloon-sim odd.cfg --check
idle 'odd.cfg:1: time: tolerance does'
idle 'odd.cfg:2: gravity: air_density does'
idle 'odd.cfg:4: balloons\[0\]: spring, damping do'
idle 'odd.cfg:5: balloons\[0\]\.membrane: gent_limit does'
expect 0 balloon-sim odd.cfg --explain --set balloons[0].membrane.law=gent --set time.integrator=auto --set balloons[0].stiffness=cotangent
idle 'odd.cfg:4: balloons\[0\]: spring, stiffness, damping do'
! grep -Eq 'tolerance|gent_limit' .stderr || fail "what the run goes by is said to do nothing"
expect 0 balloon-sim odd.cfg --check -q
[ ! -s .stderr ] || fail "-q is not quiet"
expect 0 balloon-sim sphere.ply --check --set gravity.air_density=1
idle 'sphere.ply: gravity: air_density does'

# a scene that is refused says why, and that alone
rm sphere.ply
refused 1 'sphere.ply' balloon-sim odd.cfg --check

for scene in "$PROGRAMS"/data/*.cfg; do
    expect 0 balloon-sim "$scene" --check
    ! grep -q nothing .stderr || fail "a scene that comes along says what nothing goes by"
done
