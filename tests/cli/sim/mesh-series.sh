# A mesh a frame for ParaView, and a cache of motion for Blender: what they hold, and that no frames of two runs stay together.
cp "$PROGRAMS/data/sphere.ply" "$PROGRAMS/data/sphere.cfg" .
meshes() { ls "$1" | grep -c '^mesh_[0-9]*\.'; }

expect 0 balloon-sim sphere.cfg --set time.end=1 --mesh-series series --hash
hash=$(tail -n 1 .stdout)
[ "$(meshes series)" = 41 ] || fail "there are $(meshes series) meshes, wanted 41"
[ "$(grep -c '"name": "mesh_00[0-9][0-9].ply", "time": ' series/mesh.ply.series)" = 41 ] || fail "the list is not of 41 meshes"
head -c 400 series/mesh_0040.ply | grep -a -q 'property float stretch' || fail "there is no stretch"
head -c 400 series/mesh_0040.ply | grep -a -q 'property int piece' || fail "there is no piece"
expect 0 balloon-sim series/mesh_0000.ply --check # our own reader takes it for a balloon
stdout_has '15[0-9]+ points, 4512 edges, 3008 triangles'

# a shorter run there says what it takes away
expect 0 balloon-sim sphere.cfg --set time.end=0.5 --mesh-series series --mesh-series-constant
stderr_has 'series: 41 meshes of an earlier run were removed'
[ "$(meshes series)" = 21 ] || fail "there are $(meshes series) meshes, wanted 21"
[ "$(head -c 400 series/mesh_0000.ply | grep -a 'element vertex')" = 'element vertex 9024' ] || fail "points are not three a triangle"

# a run that goes on goes on in the list; VTK's own format has a list of its own
expect 0 balloon-sim sphere.cfg --set time.end=0.5 --mesh-series parts --mesh-series-format vtp --checkpoint run.ckpt
expect 0 balloon-sim sphere.cfg --set time.end=1 --mesh-series parts --mesh-series-format vtp --resume run.ckpt --hash
[ "$(tail -n 1 .stdout)" = "$hash" ] || fail "another hash"
[ "$(grep -c vtp parts/mesh.vtp.series)" = 41 ] || fail "the list is not of 41 meshes"
head -n 2 parts/mesh_0040.vtp | grep -q 'VTKFile type="PolyData"' || fail "that is no .vtp"

# the cache: 32 bytes of head, and 12 for each of 9024 points in each of 21 samples
expect 0 balloon-sim sphere.cfg --set time.end=0.5 --point-cache run.pc2
[ "$(wc -c <run.pc2)" = $((32 + 12 * 9024 * 21)) ] || fail "run.pc2 has $(wc -c <run.pc2) bytes"
a_file run.ply

echo here >file
refused 1 'file: is a file; give the name of a folder' balloon-sim sphere.cfg --mesh-series file
refused 1 '/proc/m: cannot make the folder' balloon-sim sphere.cfg --mesh-series /proc/m
refused 2 'must be ply or vtp' balloon-sim sphere.cfg --mesh-series s --mesh-series-format obj
refused 2 'give --mesh-series DIR too' balloon-sim sphere.cfg --mesh-series-constant
refused 2 'must end in .pc2' balloon-sim sphere.cfg --point-cache run.mdd
no_file s
