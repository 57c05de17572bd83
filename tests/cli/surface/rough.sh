# Cubes too coarse for the cells leave a rough surface: it says so, and a sigma that is enough.
echo 'depth 5' >fine.chips
expect 0 balloon-sculpt --script fine.chips -o fine.oct
expect 0 balloon-surface fine.oct --triangles 12000 --info
stderr_has "cubes of 0.03162 are larger than the sculpture's detail, 0.02576: .* smooth it more: --sigma 0.7, which loses what is thinner than 0.052$"
expect 0 balloon-surface fine.oct --triangles 12000 --sigma 0.7 --info
[ ! -s .stderr ] || fail "what it advised is not enough"
expect 0 balloon-surface fine.oct --triangles 20000 --info
[ ! -s .stderr ] || fail "cubes that are fine enough are found too coarse"

# What it says is so: a leg thinner than that is lost, and a thicker one is not.
for radius in 0.045 0.075; do
    printf 'depth 5\nstart empty\nfill box 0 0 0 1 0.5 1\nfill capsule 0.5 0.3 0.5 0.5 0.9 0.5 %s %s\n' $radius $radius >leg.chips
    expect 0 balloon-sculpt --script leg.chips -o leg.oct
    expect 0 balloon-surface leg.oct --triangles 1500 -o leg.obj
    stderr_has "smooth it more: --sigma 1.6, which loses what is thinner than 0.12$"
    expect 0 balloon-surface leg.oct --triangles 1500 --sigma 1.6 -o leg.obj
    awk '$1 == "v" && $3 > high { high = $3 } END { print (high > 0.7) ? "leg" : "none" }' leg.obj
done >legs
[ "$(tr '\n' ' ' <legs)" = "none leg " ] || fail "it says what is lost, and lost is: $(cat legs)"

# Walls of one cell are lost whatever the sigma: it says what to do, and that helps.
printf 'depth 4\nchip box 0.0625 0.0625 0.0625 0.9375 0.9375 0.9375\n' >shell.chips
expect 0 balloon-sculpt --script shell.chips -o shell.oct
expect 0 balloon-surface shell.oct --triangles 1500 --info
stderr_has "take more triangles, or fill the hollow within its thin walls: balloon-sculpt shell.oct --solid -o FILE.oct$"
expect 0 balloon-surface shell.oct --triangles 6000 --sigma 0.73 --info
stderr_has "the mesh holds [0-9.]+ % of what the sculpture's material does: .* a sigma of 0.73; take a smaller one, or fill"
expect 0 balloon-sculpt shell.oct --solid -o full.oct
expect 0 balloon-surface full.oct --triangles 6000 --sigma 0.73 --info
[ ! -s .stderr ] || fail "what it advised is not enough"

# One Gaussian in one cube is far smaller than that, as in the paper: there is nothing to say.
printf 'depth 0\n' >one.chips
expect 0 balloon-sculpt --script one.chips -o one.oct
expect 0 balloon-surface one.oct --fields-per-cube 1 --sigma 0.4 --triangles 800 --info
[ ! -s .stderr ] || fail "a note on the paper's sphere"
