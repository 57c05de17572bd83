# What --info says of a ball with a cavity and a ring beside it: parts, handles, angles; the same as JSON.
cat >parts.chips <<'END'
depth 5
start empty
fill sphere 0.3 0.3 0.3 0.25
chip sphere 0.3 0.3 0.3 0.12
fill box 0.6 0.6 0.6 0.9 0.9 0.75
chip box 0.7 0.7 0.5 0.8 0.8 0.9
END
expect 0 balloon-sculpt --script parts.chips -o parts.oct
expect 0 balloon-surface parts.oct --info
stdout_has '^components +3$'
stdout_has '^part 1 .*euler 2, genus 0, volume 0\.0[0-9]+, '
stdout_has '^part 2 .*euler 2, genus 0, volume -0\.00[0-9]+ \(a cavity\), '
stdout_has '^part 3 .*euler 0, genus 1, volume 0\.0[0-9]+, '
stdout_has '^smallest_angle +(2[5-9]|[3-5][0-9])\.'
stdout_has '^longest_edge +1\.[0-5]'
stdout_has '^worst_residual +[0-9.]+e-1[0-9] '
stdout_has '^angles +50-60 +[0-9]+ .*#####'
stdout_has '^valence +6 '
expect 0 balloon-surface parts.oct --json
cp .stdout info.json
if command -v python3 >/dev/null; then
    expect 0 python3 -m json.tool info.json
    stdout_has '"genus": 1'
else
    echo "python3 is not installed: the JSON was not parsed"
fi

# Plain marching cubes leave slivers; any number of threads makes the same file.
expect 0 balloon-surface parts.oct --relax 0 --info
stdout_has '^smallest_angle +[0-9]\.'
expect 0 balloon-surface parts.oct --threads 1 -o one.ply
expect 0 balloon-surface parts.oct --threads 3 --seeds random -o three.ply
same_file one.ply three.ply

# The demo's sculptures make triangles fit for springs: no angle below 25 degrees, no edge above 1.6 of the mean.
fit_for_springs()
{
    expect 0 balloon-surface "$@" --info
    stdout_has '^smallest_angle +(2[5-9]|[3-5][0-9])\.'
    stdout_has '^longest_edge +1\.([0-5]|6000)'
}
fit_for_springs "$PROGRAMS/data/dog.oct" --sigma 1 --triangles 6000
fit_for_springs "$PROGRAMS/data/triangle.oct" --sigma 1.5 --triangles 3000
fit_for_springs "$PROGRAMS/data/sphere.oct" --fields-per-cube 1 --sigma 0.4 --triangles 3000

# A number of triangles is met.
for count in 500 3000 50000; do
    expect 0 balloon-surface parts.oct --sigma 1 --triangles $count --info
    stdout_has "^triangles +$count$"
done

# What a slicer would say.
if command -v admesh >/dev/null; then
    expect 0 balloon-surface parts.oct -o parts.stl
    expect 0 admesh parts.stl
    stdout_has 'Total disconnected facets +: +0 +0'
    stdout_has 'Number of parts +: +3 '
    stdout_has 'Facets reversed +: +0$'
    stdout_has 'Edges fixed +: +0$'
    stdout_has 'Degenerate facets +: +0$'
else
    echo "admesh is not installed: the .stl was not checked by it"
fi
