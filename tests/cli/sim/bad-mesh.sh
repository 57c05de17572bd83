# What is no balloon is refused with the file's name, and what is wrong where; nothing is written.
bad() # PATTERN
{
    refused 1 "m.ply.*$1" balloon-sim m.ply --log out.tsv --frames frames
    no_file out.tsv
    no_file frames
}

refused 1 'm.ply: cannot open: No such file' balloon-sim m.ply
: >m.ply
bad ''
printf 'PK\003\004 this is a zip file' >m.ply
bad ''
ply whole.ply "$tetra_points" "$tetra_triangles"
head -c 150 whole.ply >m.ply
bad ''
head -n -1 whole.ply >m.ply
bad ''
printf 'ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nelement face 4294967295\nproperty list uchar int vertex_indices\nend_header\n0123' >m.ply
bad ''
ply m.ply '0 0 0
1 0 0
nan 1 0
0 0 1' "$tetra_triangles"
bad 'nan|finite'
ply m.ply "$tetra_points" '0 2 1
0 1 3
0 3 2
1 2 9'
bad '9'
ply m.ply "$tetra_points" '0 2 1
0 1 3
0 3 2'
bad 'the edge from .* has one triangle only, as 3 edges do; a balloon must be closed'
ply m.ply "$tetra_points
-1 -1 -1" "$tetra_triangles
0 1 4
1 0 4"
bad 'has more than two triangles'
ply m.ply "$tetra_points" '0 1 2
0 1 3
0 3 2
1 2 3'
bad 'is run along in the same sense by both its triangles, as 3 edges do'
mkdir folder.ply
refused 1 'folder.ply' balloon-sim folder.ply
