# A sculpture becomes a mesh in each format; the same whatever it is begun with; the default and the paper's settings.
echo 'depth 0' >cube.chips
expect 0 balloon-sculpt --script cube.chips -o cube.oct
expect 0 balloon-surface cube.oct -o cube.ply
[ ! -s .stdout ] || fail "stdout is not empty"
[ ! -s .stderr ] || fail "stderr is not empty"
a_file cube.ply
expect 0 balloon-surface cube.oct --seeds random --seed 5 -o again.ply
same_file cube.ply again.ply
expect 0 balloon-surface cube.oct --seed 5 -o again.ply
stderr_has '--seed does nothing: there are random points with --seeds random only'
for format in stl obj; do
    expect 0 balloon-surface cube.oct -o cube.$format
    a_file cube.$format
done

# The paper's: one Gaussian in the basic cube gives a sphere; about 3000 triangles.
expect 0 balloon-surface cube.oct --fields-per-cube 1 --triangles 3000 --info
stdout_has '^triangles +(29|30)[0-9][0-9]$'
stdout_has '^components +1$'
stdout_has '^euler +2$'
stdout_has '^worst_residual +[0-9.]+e-1[0-9] '
expect 0 balloon-surface cube.oct --fields-per-cube 0 --fields-per-area 900 --sigma 0.1u --info
stdout_has '^components +2$'
stdout_has '^euler +4$'
