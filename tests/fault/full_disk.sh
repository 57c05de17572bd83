# A disk that fills up in the middle of a film, of a movie and of a checkpoint: a message that names the file, and what was there before is
# there still. Once as a limit of the files' size, which anybody can set; once as a real file system, which takes the right to mount one.
cp "$PROGRAMS/data/sphere.ply" .
run='balloon-sim -q sphere.ply --threads 1 --set view.size=[200,150] --set view.rate=40'
mkdir small
balloon-sim -q sphere.ply --threads 1 --set time.end=0.05 --checkpoint good.ck >/dev/null

# filled COMMAND...: it fails for want of space, says so in one line, and leaves the checkpoint and the picture
picture=film.gif
filled()
{
    cp good.ck small/run.ck
    echo old >small/$picture
    expect 1 "$@"
    stderr_has 'balloon-sim: .*small/.*: .*(No space left on device|File too large)'
    one_message
    same_file small/run.ck good.ck
    [ "$(cat small/$picture)" = old ] || fail "the old $picture is gone"
    for file in small/* small/frames/*; do
        case $file in
        small/run.ck | small/$picture | small/frames | small/frames/frame_00[0-9][0-9].png) ;;
        *\**) ;;
        *) fail "$file was left behind" ;;
        esac
    done
    rm -rf small/frames small/run.ck small/$picture
}

# 64 blocks of 512 bytes, or 1024 as some shells count, are less than a checkpoint
filled sh -c 'ulimit -f 64; exec "$@"' sh $run --set time.end=0.1 --checkpoint small/run.ck

if ! mount -t tmpfs -o size=600k tmpfs small 2>.mount; then
    echo "no right to mount a small file system: the limit of a file's size was tried alone"
    exit 0
fi
trap 'umount small; chmod -R u+w "$folder"; rm -rf "$folder"' EXIT
filled $run --set time.end=1 --frames small/frames --checkpoint small/run.ck

# crowded COMMAND...: the same with so many bytes left
left=65536
crowded()
{
    cp good.ck small/run.ck
    dd if=/dev/zero of=small/pad bs=1024 2>.dd || true
    truncate -s -$left small/pad
    "$@" || got=$?
    rm small/pad
    return "${got:-0}"
}

filled crowded $run --set time.end=0.1 --checkpoint small/run.ck
if command -v ffmpeg >/dev/null; then
    for picture in film.gif film.mp4 film.webm; do
        filled crowded $run --set time.end=1 --set view.size=[800,600] --movie small/$picture
    done
fi
if command -v gnuplot >/dev/null; then
    left=4096
    for picture in plot.png plot.svg; do
        filled crowded $run --set time.end=0.1 --plot small/$picture
    done
fi
