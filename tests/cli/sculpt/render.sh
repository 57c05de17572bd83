# A picture of the sculpture; none of an empty one.
expect 0 balloon-sculpt --depth 3 --render cube.png
a_file cube.png
[ "$(head -c 4 cube.png | tail -c 3)" = PNG ] || fail "cube.png is no PNG"
echo 'start empty' >empty.chips
refused 1 'empty\.png: the sculpture is empty' balloon-sculpt --script empty.chips --render empty.png
no_file empty.png
