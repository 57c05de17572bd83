# Cubes too coarse for the cells leave a rough surface: it says so, and a sigma that is enough.
echo 'depth 5' >fine.chips
expect 0 balloon-sculpt --script fine.chips -o fine.oct
expect 0 balloon-surface fine.oct --triangles 12000 --info
stderr_has "cubes of 0.03162 are larger than the sculpture's detail, 0.02576: .* smooth it more: --sigma 0.7$"
expect 0 balloon-surface fine.oct --triangles 12000 --sigma 0.7 --info
[ ! -s .stderr ] || fail "what it advised is not enough"
expect 0 balloon-surface fine.oct --triangles 20000 --info
[ ! -s .stderr ] || fail "cubes that are fine enough are found too coarse"
