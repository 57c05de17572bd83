# A scene that cannot be done is refused with its line; nothing is written.
ply m.ply "$tetra_points" "$tetra_triangles"
bad() # PATTERN TEXT
{
    printf '%s\n' "$2" >s.cfg
    refused 1 "$1" balloon-sim s.cfg --log out.tsv
    no_file out.tsv
}

bad 's.cfg:2: unknown key `presure`.*did you mean `pressure`' 'balloons = ( { mesh = "m.ply";
presure = 3; } );'
bad 's.cfg:1: step must be a number' 'time = { step = "x"; };'
bad 's.cfg:1: step is -1; it must be from 1e-09 to 1e\+06 s' 'time = { step = -1; };'
bad 's.cfg:1: step is 0;' 'time = { step = 0; };'
bad 's.cfg:1: step is 1e\+300;' 'time = { step = 1e300; };'
bad 's.cfg:1: syntax error' 'time = { step = nan; };'
bad 's.cfg:1: syntax error' 'time = { step = inf; };'
bad 's.cfg:2: syntax error' 'time = { step = '
bad 's.cfg:2: balloons\[1\].mesh: no-such.ply: cannot open' 'balloons = ( { mesh = "m.ply"; },
{ mesh = "no-such.ply"; } );'
bad 's.cfg: has no balloon' ''
printf 'time = { };\0 and more' >s.cfg
refused 1 's.cfg: is not a scene file' balloon-sim s.cfg
refused 1 'no.cfg: cannot open' balloon-sim no.cfg
refused 1 'cannot read|is a folder' balloon-sim .

for value in nan inf -inf 1e300 -1 0; do
    refused 1 "^balloon-sim: --set: step " balloon-sim m.ply --set time.step=$value
    refused 1 "^balloon-sim: --set: point_mass " balloon-sim m.ply --set "balloons[0].point_mass=$value"
done
for key in spring damping threshold pressure; do
    for value in nan inf 1e301; do
        refused 1 "^balloon-sim: --set: $key " balloon-sim m.ply --set "balloons[0].$key=$value"
    done
done
refused 1 'unknown key `gass` .*did you mean `gas`' balloon-sim m.ply --set 'balloons[0].gass.fill=1'
# What is hardly out of range is not rounded into it.
refused 1 '^balloon-sim: --set: tolerance is 0.100000001; it must be from 1e-12 to 0.1 radii' balloon-sim m.ply --set time.tolerance=0.100000001
refused 1 '^balloon-sim: --set: seed is 2147483648; it must be from 0 to 2147483647' balloon-sim m.ply --set 'balloons[0].fracture.seed=2147483648.0'

# A block in the wrong place is told its own; text without quotes, and what is not a scene at all.
bad 's.cfg:2: the block `gas` stands inside a balloon' 'balloons = ( { mesh = "m.ply"; } );
gas = { ambient = 6; };'
bad 's.cfg:1: the block `gravity` stands outside of balloons' 'balloons = ( { mesh = "m.ply"; gravity = { }; } );'
bad 's.cfg:1: syntax error; .*text in quotes$' 'balloons = ( { mesh = m.ply; } );'
balloon-sculpt -q --depth 1 -o cube.oct
refused 1 'cube.oct: is not a scene file: .*a scene \(.cfg\) or a mesh .* is wanted$' balloon-sim cube.oct

# A sculpture is not inflated itself.
printf 'BALLOON\000oct' >fox.oct
refused 1 'fox.oct: .* a sculpture, of which balloon-surface makes a mesh; ' balloon-sim fox.oct --hash
