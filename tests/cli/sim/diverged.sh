# A run that diverges ends with 3, names point and time, and keeps the frames and the log so far.
ply m.ply "$tetra_points" "$tetra_triangles"
wild='--set time.step=1 --set time.end=1000 --set view.rate=1 --set view.size=[64,48] --set balloons[0].spring=1e9
    --set balloons[0].threshold=1e300'
refused 3 'm.ply: diverged at time [0-9]+ \(step [0-9]+\): point [0-9]+ of balloons\[0\] is at .*time.step 1 is too large: steps up to .* surely stable for symplectic-euler; most of that is for the (springs|dampers)' \
    balloon-sim -q m.ply $wild --log log.tsv --set balloons[0].damping=1e9
a_file log.tsv
refused 3 'diverged at time' balloon-sim -q m.ply $wild --set balloons[0].damping=1e9 --frames frames --contact-sheet sheet.png
a_file frames/frame_0000.png
refused 3 'diverged at time .*; what was logged and drawn could not be kept: /dev/full: cannot write: No space left on device$' \
    balloon-sim -q m.ply $wild --set balloons[0].damping=1e9 --log /dev/full

# what is left once edges let go is stable in any steps, and tells nothing of those before
refused 3 'sphere.ply: diverged at time .*; what is left is stable in such steps, and time.guard = "off" asks for no more: try time.guard=substep$' \
    balloon-sim -q "$PROGRAMS/data/sphere.ply" --set balloons[0].spring=1e9 --log log.tsv

# gas that flows faster than a method follows does not become less than none
ply tetra.ply "$tetra_points" "$tetra_triangles"
cat >tube.cfg <<'EOF'
time = { step = 0.005; end = 0.1; integrator = "rk-adaptive"; };
balloons = ( { mesh = "tetra.ply"; gas = { ambient = 0.001; }; tube = { to = 1; area = 1e12; }; },
             { mesh = "tetra.ply"; position = [200.0, 0.0, 0.0]; gas = { ambient = 0.001; fill = 1.2; };
               membrane = { thickness = 0.27; }; } );
EOF
expect 3 balloon-sim tube.cfg --log tube.tsv --set time.guard=off
stderr_has '^balloon-sim: tube\.cfg: diverged at time .*: more gas than there is left balloons\[[01]\] within a step; .*tube'
one_message # nor that time.guard does nothing
dense='--set balloons[0].gas.ambient=6 --set balloons[1].gas.ambient=6'
for check in -q --check; do
    refused 3 'tube.cfg: refused at time 0: steps up to .* follow what flows in the tube of balloons\[0\]' \
        balloon-sim tube.cfg --log tube.tsv $dense $check
done

# whatever the method: "auto" tries none that could not be split either, and CVODE says so where it is there
for check in -q --check; do
    refused 3 'tube.cfg: refused at time 0: time.step 0.005 is too large to be split: steps up to .* follow what flows' \
        balloon-sim tube.cfg --log tube.tsv $dense --set time.integrator=auto $check
done
code=0
balloon-sim tube.cfg --log tube.tsv $dense --set time.integrator=cvode-bdf >.stdout 2>.stderr || code=$?
[ "$code" = 1 ] && stderr_has 'libsundials-dev' || [ "$code" = 3 ] || fail "exit $code, wanted 3"
[ "$code" = 1 ] || stderr_has 'tube.cfg: refused at time 0: steps up to .* follow what flows in the tube of balloons\[0\]'
one_message

# steps so short that a run would hardly end are told with their reason, once
balloon-sim tube.cfg --log tube.tsv $dense --set 'balloons[0].tube.area=1e9' --set time.end=10 >.stdout 2>.stderr &
job=$!
for wait in 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16 17 18 19 20; do
    grep -q . .stderr && break
    sleep 0.25
done
sleep 0.2
kill $job
wait $job || true
command_line='balloon-sim tube.cfg, of a wide tube'
stderr_has 'at .* s: rk-adaptive takes steps of [0-9.]+e-0[6-9] s, and .*e\+[01][0-9] of them are left to time.end: steps up to .* follow what flows in the tube of balloons\[0\]'
[ "$(grep -c 'takes steps of' .stderr)" = 1 ] || fail "told $(grep -c 'takes steps of' .stderr) times of short steps"
