# Blocks that contradict each other, or name nothing: the line, the reason, exit 1.
cp "$PROGRAMS/data/sphere.ply" .
scene() { # BLOCKS: a scene with them in its balloon, from line 2 on
    printf 'balloons = ( { mesh = "sphere.ply";\n%s\n} );\n' "$1" > bad.cfg
}
scene 'gas = { fill = 2; };'
expect 1 balloon-sim bad.cfg --check
stderr_has 'bad.cfg:2: balloons\[0\].gas: give ambient'
scene 'gas = { ambient = 10; }; pressure = 4;'
expect 1 balloon-sim bad.cfg --check
stderr_has 'bad.cfg:2: balloons\[0\].gas: the gas makes the pressure, and pressure = 4 gives another'
scene 'gas = { ambient = 10; fill = -1; };'
expect 1 balloon-sim bad.cfg --check
stderr_has 'bad.cfg:2: .*fill'
scene 'gas = { ambient = 10; }; tube = { to = 1; area = 3; };'
expect 1 balloon-sim bad.cfg --check
stderr_has 'bad.cfg:2: balloons\[0\].tube: leads to balloons\[1\], but the balloons are 0 to 0'
scene 'pins = { place = [0.0, 0.0, 0.0]; };'
expect 1 balloon-sim bad.cfg --check
stderr_has 'bad.cfg:2: balloons\[0\].pins: place = \[0, 0, 0\] names no point'
scene 'gaz = { ambient = 10; };'
expect 1 balloon-sim bad.cfg --check
stderr_has 'bad.cfg:2: .*`gaz`.*did you mean `gas`'
