# What cannot tear as it is told: the line, the reason, exit 1, and nothing is written.
cp "$PROGRAMS/data/sphere.ply" .
scene() { # BLOCKS PATTERN: a scene with them in its balloon, from line 2 on
    printf 'balloons = ( { mesh = "sphere.ply";\n%s\n} );\n' "$1" >bad.cfg
    refused 1 "bad.cfg:2: $2" balloon-sim bad.cfg --log log.tsv --pieces pieces.tsv
    only_files sphere.ply bad.cfg
}
scene 'threshold = 1;' 'threshold is 1; it must be from 1.001 '
scene 'threshold = 0.5;' 'threshold is 0.5; it must be from 1.001 '
scene 'fracture = { strength = 1.0; };' 'strength is 1; it must be from 1.01 to 100'
scene 'fracture = { toughness = -0.1; };' 'toughness is -0.1; it must be from 0 '
scene 'fracture = { weakness = 1.0; };' 'weakness is 1; it must be from 0 to 0.99'
scene 'fracture = { weakness = 2.5; };' 'weakness is 2.5; it must be from 0 to 0.99'
scene 'fracture = { mode = "shred"; };' 'mode is "shred"; it must be one of "tear", "paper"'
scene 'fracture = { strenght = 2.0; };' '.*`strenght`.*did you mean `strength`'
scene 'fracture = { mode = "tear"; }; plasticity = { yield = 1.2; };' '.*(plasticity|yield)'
scene 'rip = { place = [0.0, 0.0, 0.0]; };' 'balloons\[0\].rip: place and direction must be .* no such place on the skin'
scene 'rip = { place = [0.0, 1.0, 0.0]; direction = [0.0, 2.0, 0.0]; };' 'balloons\[0\].rip: place and direction must be'
scene 'rip = { length = 7.0; };' 'length is 7; it must be from 0 to 6.2832 radii'

# meshes that are torn already, and what is no surface: the edge
mesh() { # PATTERN
    printf 'balloons = ( { mesh = "m.ply"; fracture = { mode = "tear"; }; } );\n' >bad.cfg
    refused 1 "m.ply: the edge from .* $1" balloon-sim bad.cfg --pieces pieces.tsv
    no_file pieces.tsv
}
expect 0 balloon-sim sphere.ply --set time.end=0.5 --set balloons[0].fracture.mode=tear --set balloons[0].rip.at=0 -o m.ply
mesh 'has one triangle only, as [0-9]+ edges do; a balloon must be closed'
expect 0 balloon-sim sphere.ply --set time.end=2 -o m.ply
mesh '(has one triangle only|has more than two triangles)'
ply m.ply "$tetra_points
-1 -1 -1" "$tetra_triangles
0 1 4
1 0 4"
mesh 'has more than two triangles; a balloon must be one surface'
