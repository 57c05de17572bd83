# A film: its frames, the movie and the contact sheet, by threads of their own and by another program.
. "$FAULT/lib.sh"
ply m.ply "$tetra_points" "$tetra_triangles"
echo old >a.png
echo old >a.gif
mkdir frames
run='balloon-sim -q m.ply --set time.end=0.05 --set view.size=[64,48] --set view.rate=40 --threads 1'
every_call files $run --frames frames --contact-sheet a.png
every_call memory $run --frames frames --contact-sheet a.png
every_call starts $run --frames frames --contact-sheet a.png
program ffmpeg || exit 0
every_call files $run --movie a.gif
every_call memory $run --movie a.gif
every_call starts $run --movie a.gif
