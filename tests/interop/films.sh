# ffprobe reads the films: frames, size, seconds.
needs ffmpeg
needs ffprobe
cp "$PROGRAMS/data/sphere.ply" "$PROGRAMS/data/sphere.cfg" .
for kind in mp4 webm gif; do
    expect 0 balloon-sim sphere.cfg --set time.end=1 --set 'view.size=[320,120]' --set view.style=paper --set view.playback=20 --movie "film.$kind"
    expect 0 ffprobe -v error -count_frames -select_streams v:0 -show_entries stream=width,height,nb_read_frames:format=duration -of csv=p=0 "film.$kind"
    stdout_has '^320,120,41$'
    # 41 frames at 20 a second; a .gif counts hundredths, and players end where the last frame begins or ends
    awk 'NR == 2 { exit !($1 >= 1.99 && $1 <= 2.11) }' .stdout || fail "a film of 2.05 s has another length"
done
