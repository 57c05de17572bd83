# A picture of the mesh, alone or beside it.
expect 0 balloon-sculpt --depth 2 -o cube.oct
expect 0 balloon-surface cube.oct --render cube.png -o cube.ply
a_file cube.png
a_file cube.ply
[ "$(head -c 4 cube.png | tail -c 3)" = PNG ] || fail "cube.png is no .png file"
only_files cube.oct cube.png cube.ply
