# A movie by its extension; without ffmpeg one line says which package has it.
ply m.ply "$tetra_points" "$tetra_triangles"
short='--set time.end=0.5 --set view.size=[64,48] --set balloons[0].pressure=0'
if command -v ffmpeg >/dev/null; then
    expect 0 balloon-sim m.ply $short --movie m.mp4
    a_file m.mp4
    expect 0 ffprobe -v error -count_frames -show_entries stream=width,height,nb_read_frames -of csv=p=0 m.mp4
    stdout_has '^64,48,21$'
fi
refused 2 'avi.*mp4' balloon-sim m.ply $short --movie m.avi
no_file m.avi
mkdir empty
refused 1 'ffmpeg' env PATH="$PROGRAMS/sim:$PWD/empty" balloon-sim m.ply $short --movie n.mp4
no_file n.mp4
