# What can be repaired is, and the user is told: repeated points, flat and repeated triangles, an inside-out mesh.
ply m.ply "$tetra_points
0 0 0
5 5 5" '4 2 1
0 1 3
0 3 2
1 2 3
0 1 3
1 1 2'
expect 0 balloon-sim m.ply --check
stderr_has 'm.ply: '
stderr_has 'weld|repeated'
stdout_has 'balloons\[0\]: m.ply: 4 points, 6 edges, 4 triangles'

ply inside-out.ply "$tetra_points" '0 1 2
0 3 1
0 2 3
1 3 2'
expect 0 balloon-sim inside-out.ply --set time.end=0.1 --log log.tsv
stderr_has 'inside out'
awk -F'\t' 'NR > 1 && $3 <= 0 { exit 1 }' log.tsv || fail "its volume is not positive"
expect 0 balloon-sim -q inside-out.ply --hash --set time.end=0.1
[ ! -s .stderr ] || fail "--quiet is not quiet"
