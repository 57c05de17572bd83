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
scene 'membrane = { law = "gent"; };'
expect 1 balloon-sim bad.cfg --check
stderr_has 'bad.cfg:2: balloons\[0\].membrane: give thickness'
scene 'membrane = { thickness = 0.4; }; viscosity = { };'
expect 1 balloon-sim bad.cfg --check
stderr_has 'bad.cfg:2: balloons\[0\].membrane: it has no springs for viscosity'
scene 'bending = { stiffness = -1; };'
expect 1 balloon-sim bad.cfg --check
stderr_has 'bad.cfg:2: stiffness is -1; it must be from 0 to'
scene 'bending = { }; } ); time = { integrator = "xpbd"; }; gravity = { }; needles = ( { from = [0.0, 9.0, 0.0];'
expect 1 balloon-sim bad.cfg --check
stderr_has 'bad.cfg:2: balloons\[0\].bending: time.integrator "xpbd" moves springs only'
scene '} ); needles = ( { velocity = [0.0, -1.0, 0.0];'
expect 1 balloon-sim bad.cfg --check
stderr_has 'bad.cfg:2: needles\[0\] names no point; give from'
scene '} ); schedule = ( { at = 1.0; pump = 2.0;'
expect 1 balloon-sim bad.cfg --check
stderr_has 'bad.cfg:2: balloons\[0\].gas: schedule\[0\] turns its pump, but there is no gas'
scene 'gas = { ambient = 10; }; } ); schedule = ( { at = 1.0; pressure = 2.0;'
expect 1 balloon-sim bad.cfg --check
stderr_has 'bad.cfg:2: balloons\[0\].gas: the gas makes the pressure, which schedule\[0\] cannot change; let it change pump'
scene '} ); schedule = ( { at = 1.0; gas = { pump = 2.0; };'
expect 1 balloon-sim bad.cfg --check
stderr_has 'bad.cfg:2: `gas` is a block, which no schedule changes; .*keys that can change'
scene 'membrane = { thickness = 0.3; ogden = ( (1.0, 2.0, 3.0) ); };'
expect 1 balloon-sim bad.cfg --check
stderr_has 'bad.cfg:2: ogden must be 2 numbers: \(a, b\)'
scene '} ); drag = { density = 1.0; }; needles = ( { from = [0.0, 99.0, 0.0];'
expect 1 balloon-sim bad.cfg --check
stderr_has 'bad.cfg:2: unknown key `density` in drag \(did you mean `air_density`'
# Gas needs a skin that holds it.
ply open.ply '0 0 0
1 0 0
0 1 0
0 0 1' '0 2 1
0 1 3
0 3 2'
printf 'balloons = ( { mesh = "open.ply"; gas = { ambient = 10; }; } );\n' > open.cfg
expect 1 balloon-sim open.cfg --check
stderr_has 'open.ply: the edge from .* has one triangle only, .*; a balloon must be closed to hold air'
# Nor does a skin that lies flat hold any; nor is there a height over which its springs could vary.
ply flat.ply '1 0 0
0 0 1
-1 0 0
0 0 -1
0 0 0
0.1 0 0.1' '0 1 4
1 2 4
2 3 4
3 0 4
1 0 5
2 1 5
3 2 5
0 3 5'
printf 'balloons = (\n{ mesh = "flat.ply"; pressure = 0; gas = { ambient = 10; }; } );\n' >flat.cfg
refused 1 'flat.cfg:2: balloons\[0\].gas: the mesh has a volume of .*, no room for gas; take one that does not lie flat$' balloon-sim flat.cfg
printf 'balloons = (\n{ mesh = "flat.ply"; pressure = 0; spring_by_height = { profile = ( (0, 1), (1, 2) ); }; } );\n' >flat.cfg
refused 1 'flat.cfg:2: balloons\[0\].spring_by_height: all points are at one height, over which nothing varies; .*' balloon-sim flat.cfg
