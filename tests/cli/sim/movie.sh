# A movie by its extension; without ffmpeg one line says which package has it.
ply m.ply "$tetra_points" "$tetra_triangles"
short='--set time.end=0.5 --set view.size=[64,48] --set balloons[0].pressure=0'
if command -v ffmpeg >/dev/null; then
    expect 0 balloon-sim m.ply $short --movie m.mp4
    a_file m.mp4
    expect 0 ffprobe -v error -count_frames -show_entries stream=width,height,nb_read_frames -of csv=p=0 m.mp4
    stdout_has '^64,48,21$'
    refused 1 'm.mp4: ffmpeg takes pictures of 16384 x 16128 at most' balloon-sim m.ply --set view.size=[16384,16384] --movie m.mp4 --check
fi
refused 2 'avi.*mp4' balloon-sim m.ply $short --movie m.avi
no_file m.avi
mkdir empty
refused 1 'ffmpeg' env PATH="$PROGRAMS/sim:$PWD/empty" balloon-sim m.ply $short --movie n.mp4
no_file n.mp4

# A movie that ffmpeg could not make is none, also where whoever began the program does not want to know how children end.
mkdir fake
cat >fake/ffmpeg <<'EOF'
#!/bin/sh
case "$*" in
*-encoders*) echo 'Encoders: libx264 ' ;;
*)
    cat >/dev/null
    exit 1
    ;;
esac
EOF
chmod +x fake/ffmpeg
refused 1 'ffmpeg failed' env --ignore-signal=CHLD PATH="$PWD/fake:$PATH" balloon-sim m.ply $short --movie f.mp4
no_file f.mp4
if command -v gnuplot >/dev/null; then
    expect 0 env --ignore-signal=CHLD balloon-sim m.ply $short --plot p.png
    a_file p.png
fi
