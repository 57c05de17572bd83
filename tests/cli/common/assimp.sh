# What this project does not read itself is read through assimp, and told what is missing where that is not there. The
# files are made here: a tetrahedron as .off, .gltf (twice, once moved and enlarged by its node) and .dae.
cat >tetra.off <<'END'
OFF
4 4 6
0 0 0
1 0 0
0 1 0
0 0 1
3 0 2 1
3 0 1 3
3 0 3 2
3 1 2 3
END
refused 1 'missing\.gltf: cannot open: No such file' balloon-sculpt --import missing.gltf --info
refused 1 'missing\.dae: cannot open: No such file' balloon-sim missing.dae --check

got=0
balloon-sim tetra.off --check >.stdout 2>.stderr || got=$?
if [ $got != 0 ]; then
    refused 1 'tetra\.off: .*assimp.*(libassimp5|libassimp-dev).*\.ply, \.stl or \.obj' balloon-sim tetra.off --check
    refused 1 'tetra\.off: .*assimp' balloon-sculpt --import tetra.off --info
    echo "assimp is not there: only what is said then was looked at"
    exit 77
fi
stdout_has '4 points, 6 edges, 4 triangles'
expect 0 balloon-sculpt --import tetra.off --depth 5 --info
stdout_has '^depth +5 '
ply tetra.ply "$tetra_points" "$tetra_triangles"
expect 0 balloon-sculpt --import tetra.ply -o ours.oct
expect 0 balloon-sculpt --import tetra.off -o theirs.oct
same_file ours.oct theirs.oct

# Corners that are apart for their normals are one point of the skin, as in a .dae, where z is up unless y is.
faces='0 0 2 0 1 0  0 1 1 1 3 1  0 2 3 2 2 2  1 3 2 3 3 3'
cat >tetra.dae <<END
<?xml version="1.0" encoding="utf-8"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
  <asset><up_axis>Y_UP</up_axis></asset>
  <library_geometries><geometry id="g"><mesh>
    <source id="p"><float_array id="pa" count="12">0 0 0 1 0 0 0 1 0 0 0 1</float_array>
      <technique_common><accessor source="#pa" count="4" stride="3">
        <param name="X" type="float"/><param name="Y" type="float"/><param name="Z" type="float"/></accessor></technique_common></source>
    <source id="n"><float_array id="na" count="12">0 0 -1 0 -1 0 -1 0 0 .577 .577 .577</float_array>
      <technique_common><accessor source="#na" count="4" stride="3">
        <param name="X" type="float"/><param name="Y" type="float"/><param name="Z" type="float"/></accessor></technique_common></source>
    <vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
    <triangles count="4"><input semantic="VERTEX" source="#v" offset="0"/><input semantic="NORMAL" source="#n" offset="1"/>
      <p>$faces</p></triangles>
  </mesh></geometry></library_geometries>
  <library_visual_scenes><visual_scene id="s"><node><instance_geometry url="#g"/></node></visual_scene></library_visual_scenes>
  <scene><instance_visual_scene url="#s"/></scene>
</COLLADA>
END
expect 0 balloon-sim tetra.dae --check
stdout_has '4 points, 6 edges, 4 triangles'
expect 0 balloon-sculpt --import tetra.dae -o theirs.oct
same_file ours.oct theirs.oct

# A scene names one too, here with its numbers in a file beside it: floats 0 and 1, and shorts.
printf '\0\0\0\0\0\0\0\0\0\0\0\0\0\0\200\77\0\0\0\0\0\0\0\0\0\0\0\0\0\0\200\77\0\0\0\0\0\0\0\0\0\0\0\0\0\0\200\77' >tetra.bin
printf '\0\0\2\0\1\0\0\0\1\0\3\0\0\0\3\0\2\0\1\0\2\0\3\0' >>tetra.bin
cat >tetra.gltf <<'END'
{ "asset": { "version": "2.0" }, "scene": 0, "scenes": [ { "nodes": [ 0, 1 ] } ],
  "nodes": [ { "mesh": 0 }, { "mesh": 0, "translation": [ 5, 6, 7 ], "scale": [ 2, 2, 2 ] } ],
  "meshes": [ { "primitives": [ { "attributes": { "POSITION": 0 }, "indices": 1 } ] } ],
  "accessors": [ { "bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3", "min": [ 0, 0, 0 ], "max": [ 1, 1, 1 ] },
    { "bufferView": 1, "componentType": 5123, "count": 12, "type": "SCALAR" } ],
  "bufferViews": [ { "buffer": 0, "byteOffset": 0, "byteLength": 48 }, { "buffer": 0, "byteOffset": 48, "byteLength": 24 } ],
  "buffers": [ { "uri": "tetra.bin", "byteLength": 72 } ] }
END
printf 'time = { end = 0.0; };\nballoons = ( { mesh = "tetra.gltf"; radius = 0.0; } );\n' >tetra.cfg
expect 0 balloon-sim tetra.cfg --check
stdout_has '8 points, 12 edges, 8 triangles' # a scene of two nodes with the same mesh
expect 0 balloon-sim tetra.cfg -o end.obj
sides=$(awk '/^v/ { for (i = 2; i < 5; i++) { if (NR == 1 || $i < least) least = $i; if (NR == 1 || $i > most) most = $i } }
    END { printf "%.3f", most - least }' end.obj)
[ "$sides" = 9.000 ] || fail "the model reaches over $sides, wanted 9: from 0 to 7 + 2"

# What is no such file is refused in a line, and so are scenes without a mesh.
for name in bad.fbx bad.dae bad.gltf bad.off bad.blend bad.3ds; do
    echo 'PK this is nothing' >$name
    refused 1 "$name: " balloon-sim $name --check
    refused 1 "$name: " balloon-sculpt --import $name -o bad.oct
done
no_file bad.oct
printf 'OFF\n4 1 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 9\n' >bad.off
refused 1 'bad\.off: ' balloon-sim bad.off --check
refused 2 '\.stl, \.ply and \.obj are read, and through assimp' balloon-sculpt --import a.txt --info
