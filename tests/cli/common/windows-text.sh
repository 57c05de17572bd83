# Text from editors of Windows: it begins with a byte order mark, and its lines end with CR LF.
from_windows() { { printf '\357\273\277' && sed 's/$/\r/' "$1"; } >"$2"; }

echo 'depth 2' >a.chips
from_windows a.chips b.chips
expect 0 balloon-sculpt --script a.chips -o a.oct
expect 0 balloon-sculpt --script b.chips -o b.oct --export a.ply
same_file a.oct b.oct

printf 'v %s\n' '0 0 0' '1 0 0' '0 1 0' '0 0 1' >a.obj # no comment before the first point
printf 'f %s\n' '1 3 2' '1 2 4' '1 4 3' '2 3 4' >>a.obj
from_windows a.obj b.obj
ply a.ply "$tetra_points" "$tetra_triangles"
from_windows a.ply b.ply
echo 'pressure = 1;' >inner.cfg
from_windows inner.cfg inner-b.cfg
printf 'time = { end = 0.1; };\nballoons = ( {\n@include "inner.cfg"\nmesh = "a.ply"; } );\n' >a.cfg
sed 's/inner/inner-b/' a.cfg >c.cfg
from_windows c.cfg b.cfg
for file in obj ply cfg; do
    expect 0 balloon-sim -q a.$file --set time.end=0.1 --hash
    mv .stdout of-a
    expect 0 balloon-sim -q b.$file --set time.end=0.1 --hash
    same_file .stdout of-a
done

# Quotes as word processors set them are shown as they are.
printf 'balloons = ( { mesh = \342\200\234a.ply\342\200\235; } );\n' >d.cfg
refused 1 '^balloon-sim: d.cfg:1: syntax error; `.*“` is no value; .* text in quotes$' balloon-sim d.cfg
