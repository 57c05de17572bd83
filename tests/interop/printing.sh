# What prints in three dimensions: admesh finds nothing to mend in our .stl, and a slicer takes it.
command -v admesh >/dev/null || command -v prusa-slicer >/dev/null || skipped 'neither admesh nor prusa-slicer is installed'
export HOME="$PWD"
for name in dog fox triangle; do
    expect 0 balloon-surface "$PROGRAMS/data/$name.oct" -o "$name.stl" --sigma 1 --triangles 4000
    if command -v admesh >/dev/null; then
        expect 0 admesh "$name.stl"
        stdout_has '^Number of parts +: +1 '
        # "Name : value" pairs, one or two a line; every count of something mended is 0
        tr -s ' ' <.stdout | sed 's/ \([A-Z]\)/\n\1/g' >.pairs
        for count in 'Degenerate facets' 'Edges fixed' 'Facets removed' 'Facets added' 'Facets reversed' 'Backwards edges' 'Normals fixed'; do
            grep -q "^ *$count : 0" .pairs || fail "admesh: $(grep "$count" .pairs || echo "no line on $count")"
        done
    fi
    if command -v prusa-slicer >/dev/null; then
        expect 0 prusa-slicer --info "$name.stl"
        stdout_has '^manifold = yes'
        stdout_has '^number_of_parts = +1$'
        expect 0 timeout 200 prusa-slicer --export-gcode --scale 20 --center 100,100 -o "$name.gcode" "$name.stl"
        grep -q '^G1 X' "$name.gcode" || fail "no move in $name.gcode"
    fi
done
