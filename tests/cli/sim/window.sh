# Without a display the window is refused in one line that names what runs without one; --plot draws a run's log.
ply m.ply "$tetra_points" "$tetra_triangles"
short='--set time.end=0.2'
for display in '' ':98765'; do
    refused 1 '^balloon-sim: no window can be opened on the display ".*--frames.*--movie' env DISPLAY=$display balloon-sim m.ply $short
    refused 1 '^balloon-sim: no window can be opened' env DISPLAY=$display balloon-sim m.ply $short --window --log log.tsv
    no_file log.tsv
done
refused 2 '^balloon-sim: --frames runs to the end without a window' balloon-sim m.ply --window --frames frames
no_file frames

refused 2 'p.txt' balloon-sim m.ply $short --plot p.txt
if command -v gnuplot >/dev/null; then
    expect 0 balloon-sim m.ply $short --plot p.svg
    for word in Pressure Radius Energy Pieces kinetic; do
        grep -q "$word" p.svg || fail "the plot has no $word"
    done
    # with a log of its own, and of a run that was resumed, whose earlier rows it shows too
    expect 0 balloon-sim m.ply $short --plot p.png --log log.tsv --checkpoint c.ck
    a_file p.png
    [ "$(wc -l <log.tsv)" = 10 ] || fail "$(wc -l <log.tsv) rows"
fi
mkdir none
refused 1 'gnuplot' env PATH="${PROGRAMS:?}/sim:$PWD/none" balloon-sim m.ply $short --plot p.png
