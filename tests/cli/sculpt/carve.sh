# A script becomes an octree; the same script the same bytes; the octree's own script an equal octree.
cat >snowman.chips <<'END'
depth 5
start empty
fill sphere 0.5 0.3 0.5 0.25
fill sphere 0.5 0.65 0.5 0.18
material 2
coefficient 2 0.5
fill cone 0.5 0.66 0.66 0.5 0.64 0.85 0.06 0
END
expect 0 balloon-sculpt --script snowman.chips -o a.oct --export back.chips --export faces.ply
[ ! -s .stdout ] || fail "stdout is not empty"
[ ! -s .stderr ] || fail "stderr is not empty"
expect 0 balloon-sculpt --script snowman.chips -o b.oct
same_file a.oct b.oct
expect 0 balloon-sculpt --script back.chips -o b.oct
same_file a.oct b.oct
[ "$(head -c 3 faces.ply)" = ply ] || fail "faces.ply is no .ply file"

# Saved over itself, it stays as it is; carved further, it is the same as carved in one go.
expect 0 balloon-sculpt a.oct -o a.oct
same_file a.oct b.oct
echo 'chip half-space 0.5 0.5 0.5 1 0 0' >half.chips
expect 0 balloon-sculpt a.oct --script half.chips -o a.oct
cat snowman.chips half.chips >both.chips
expect 0 balloon-sculpt --script both.chips -o b.oct
same_file a.oct b.oct
only_files snowman.chips half.chips both.chips back.chips a.oct b.oct faces.ply

# What lies outside of the cube is allowed, and does nothing there.
printf 'depth 4\nchip sphere 2 2 2 0.5\nfill box -9 -9 -9 -1 -1 -1\nchip half-space 0 -5 0 0 -1 0\n' >outside.chips
expect 0 balloon-sculpt --script outside.chips --info
stdout_has '^cells +4096$'
