# A movie that cannot be, or that ends early.
ply m.ply "$tetra_points" "$tetra_triangles"
set -- m.ply --set 'view.size=[64,48]' --set view.style=paper --set view.playback=10 --set 'balloons[0].pressure=0'

# What this ffmpeg cannot encode is said before anything is computed.
mkdir bin
cat >bin/ffmpeg <<'END'
#!/bin/sh
[ "$2" = -encoders ] || exit 1
printf 'Encoders:\n ------\n V..... gif                  GIF (Graphics Interchange Format)\n'
END
chmod +x bin/ffmpeg
refused 1 'm.webm: .*ffmpeg.* lacks the encoder libvpx-vp9' env PATH="$PWD/bin:$PATH" balloon-sim "$@" --frames f --movie m.webm
no_file m.webm
no_file f

command -v ffmpeg >/dev/null || exit 0

# No room for the movie in mid-film: one message, the frames so far and the old movie stay.
if files_can_be_small 8 balloon-sim; then
    echo old >m.gif
    expect 1 sh -c 'ulimit -f 8; exec "$@"' sh balloon-sim "$@" --set time.end=1e3 --frames f --movie m.gif --turntable
    stderr_has 'm.gif: ffmpeg failed: .*'
    one_message
    a_file f/frame_0000.png
    a_file f/frame_0004.png
    [ "$(cat m.gif)" = old ] || fail "the old movie is gone"
fi

# Killed with its ffmpeg: what there is under the other name can be played.
for kind in mp4 webm; do
    command_line="balloon-sim --movie k.$kind (SIGKILL)"
    balloon-sim "$@" --set time.end=1e6 --turntable --movie k.$kind >.stdout 2>.stderr &
    job=$!
    tries=0
    until [ "$(cat k.*-0.$kind 2>/dev/null | wc -c)" -gt 3000 ]; do
        tries=$((tries + 1))
        [ $tries -lt 2400 ] || { kill -9 $job; fail "no movie grows"; }
        sleep 0.05
    done
    encoder=$(cat /proc/$job/task/*/children) || fail "it has ended"
    # shellcheck disable=SC2086 # one number
    kill -9 $job $encoder
    wait $job || true
    expect 0 ffprobe -v error -count_frames -show_entries stream=width,height,nb_read_frames -of csv=p=0 k.*-0.$kind
    stdout_has '^64,48,[0-9]{2,}$'
    rm k.*-0.$kind
    no_file k.$kind
done
