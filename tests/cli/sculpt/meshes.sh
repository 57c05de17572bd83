# A mesh becomes the cells that it encloses.
ply tetra.ply "$tetra_points" "$tetra_triangles"
expect 0 balloon-sculpt --import tetra.ply -o tetra.oct --info
[ ! -s .stderr ] || fail "stderr is not empty"
stdout_has '^depth +7 '
stdout_has '^chip log +none$'
# a sixth of a cube of 126 cells a side is 333396 cells; its faces, 2.37 x 126^2, pass through 38000, half of which count
cells=$(awk '/^cells/ { print $2 }' .stdout)
[ "$cells" -gt 324000 ] || fail "$cells cells, wanted 333396 or so"
[ "$cells" -lt 343000 ] || fail "$cells cells, wanted 333396 or so"
expect 0 balloon-sculpt --import tetra.ply --depth 4 --info
stdout_has '^depth +4 '

# The faces of a full cube are the largest cube that leaves a cell free: 14 cells a side.
expect 0 balloon-sculpt --depth 3 --export cube.ply
expect 0 balloon-sculpt --import cube.ply --depth 4 --info
stdout_has '^cells +2744$'

# What is repaired, or open, is told of; what cannot be told is refused.
ply twice.ply "$tetra_points" "$tetra_triangles
0 2 1"
expect 0 balloon-sculpt --import twice.ply --info
stderr_has 'twice\.ply: 1 repeated triangle dropped'
ply sheet.ply "$tetra_points" '0 2 1'
refused 1 'sheet\.ply: the mesh encloses none of the cells \(3 of its edges are open\)' \
    balloon-sculpt --import sheet.ply -o out.oct
ply corner.ply "$tetra_points" '0 2 1
0 1 3'
refused 1 'corner\.ply: the mesh (encloses none|is too open)' balloon-sculpt --import corner.ply -o out.oct
ply flat.ply '0 0 0
1 1 1
2 2 2' '0 1 2'
refused 1 'flat\.ply' balloon-sculpt --import flat.ply -o out.oct
ply wild.ply '0 0 0
nan 1 1
2 2 0' '0 1 2'
refused 1 'wild\.ply' balloon-sculpt --import wild.ply -o out.oct
printf 'ply\nformat binary_little_endian 1.0\nelement vertex 4000000000\nproperty float x\nproperty float y\nproperty float z\n' >huge.ply
printf 'element face 4000000000\nproperty list uchar int vertex_indices\nend_header\n' >>huge.ply
refused 1 'huge\.ply' balloon-sculpt --import huge.ply -o out.oct
{
    head -c 80 /dev/zero
    printf '\377\377\377\377'
} >huge.stl
refused 1 'huge\.stl' balloon-sculpt --import huge.stl -o out.oct
: >empty.stl
refused 1 'empty\.stl' balloon-sculpt --import empty.stl -o out.oct
refused 1 'missing\.obj: cannot open' balloon-sculpt --import missing.obj -o out.oct
refused 2 '--depth 1: a mesh needs one from 2 to 10' balloon-sculpt --import tetra.ply --depth 1 -o out.oct
no_file out.oct
# A million faces out, in little room. (The address sanitizer needs more than that for itself.)
if (ulimit -v 120000; balloon-sculpt --version) >/dev/null 2>&1; then
    awk 'BEGIN { print "depth 7\nstart empty"
                 for (i = 0; i < 32; i++) print "fill box 0 0", i / 32, "1 1", i / 32 + 1 / 128 }' >slabs.chips
    expect 0 sh -c 'ulimit -v 120000; balloon-sculpt --script slabs.chips --export slabs.ply'
fi
