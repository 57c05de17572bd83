# Films: round the balloons, each eye in files of its own, and never a mixture of two runs.
ply m.ply "$tetra_points" "$tetra_triangles"
short='--set time.end=0.5 --set view.rate=20 --set view.size=[64,48] --set balloons[0].pressure=0'

# Round the last state: every picture is another, and the first is what the scene's own camera sees.
expect 0 balloon-sim m.ply $short --frames still --log still.tsv
expect 0 balloon-sim m.ply $short --frames round --turntable=8 --contact-sheet round.png --log round.tsv
[ "$(ls round | wc -l)" = 8 ] || fail "not 8 pictures"
[ "$(cat round/*.png | wc -c)" -gt 0 ] && [ "$(md5sum round/*.png | cut -c 1-32 | sort -u | wc -l)" = 8 ] || fail "two are alike"
same_file still/frame_0010.png round/frame_0000.png
a_file round.png
[ "$(cut -f 1-12 round.tsv)" = "$(cut -f 1-12 still.tsv)" ] || fail "the turntable changed the run"

# Over the film: after the whole turn the camera is where it was.
expect 0 balloon-sim m.ply $short --frames film --turntable
same_file still/frame_0000.png film/frame_0000.png
cmp -s still/frame_0005.png film/frame_0005.png && fail "the camera stands still"
expect 0 balloon-sim m.ply $short --set time.end=0 --frames begun --turntable # a film of one picture
same_file still/frame_0000.png begun/frame_0000.png
refused 2 'turntable.*--frames' balloon-sim m.ply --turntable --log log.tsv
refused 2 'turntable' balloon-sim m.ply --turntable=0 --frames film

# Each eye: the same pictures as with one of the two alone.
for eye in left right; do
    expect 0 balloon-sim m.ply $short --set view.stereo=$eye --frames $eye
done
expect 0 balloon-sim m.ply $short --set view.stereo=interlaced --contact-sheet rows.png
stderr_has '^balloon-sim: rows.png: rows for either eye run together'
expect 0 balloon-sim m.ply $short --set view.stereo=separate --frames both --contact-sheet both.png
a_file both-left.png
a_file both-right.png
for eye in left right; do
    [ "$(ls both/*-$eye.png | wc -l)" = 11 ] || fail "not 11 pictures of the $eye eye"
    for n in 0000 0010; do
        [ "$(tail -c 200 $eye/frame_$n.png)" = "$(tail -c 200 both/frame_$n-$eye.png)" ] || fail "the $eye eye's frame $n differs"
    done
done

# What a longer run has left goes, and only that; on from a checkpoint the frames before it stay.
others="both/frame_00003.png both/frame_99999999999999999999.png" # which no run writes
touch both/frame_0003.png.bak both/frame_12.png both/notes.txt $others
expect 0 balloon-sim m.ply $short --set time.end=0.2 --frames both --checkpoint run.ck
stderr_has 'both: 22 frames of an earlier run removed'
one_message
rm $others || fail "what is no frame of ours is removed"
[ "$(echo both/*)" = "both/frame_0000.png both/frame_0001.png both/frame_0002.png both/frame_0003.png both/frame_0003.png.bak both/frame_0004.png both/frame_12.png both/notes.txt" ] ||
    fail "the folder holds $(echo both/*)"
expect 0 balloon-sim m.ply $short --frames both --resume run.ck
[ ! -s .stderr ] || fail "something was removed"
same_file still/frame_0010.png both/frame_0010.png
# A run that is over has nothing more to draw, and says so; what a cache of an earlier one holds stays.
echo old >run.pc2
expect 0 balloon-sim m.ply $short --set time.end=0.2 --resume run.ck --movie none.mp4 --contact-sheet none.png --point-cache run.pc2
stderr_has '^balloon-sim: run\.ck is of the end, 0\.2 s: nothing more is drawn, and no film or mesh is written$'
one_message
[ "$(cat run.pc2)" = old ] || fail "a cache without a sample took the place of another"
no_file none.mp4
no_file none.png
expect 0 balloon-sim m.ply $short --set time.end=0.2 --resume run.ck --contact-sheet round.png --turntable=4
[ ! -s .stderr ] || fail "something is told of a film that is there"
# A run that does not begin touches nothing.
refused 1 'mono' balloon-sim m.ply --set view.stereo=none --frames both
refused 1 'osmesa' env BALLOON_CONTEXT=none balloon-sim m.ply $short --frames both
same_file still/frame_0010.png both/frame_0010.png

# The disk is full in mid-film: what is complete stays.
mkdir full
ln -s /dev/full full/frame_0007.png
refused 1 'full/frame_0007.png: .*No space left' balloon-sim m.ply $short --frames full
for n in 0 1 2 3 4 5 6; do
    same_file still/frame_000$n.png full/frame_000$n.png
done

# Frames that are wanted within a step cannot be had, and that is said once; not where each has its step, nor of methods that look into steps.
expect 0 balloon-sim m.ply $short --set time.step=0.025 --set view.rate=100 --mesh-series fast --log fast.tsv
stderr_has '^balloon-sim: at 0.025 s: view.rate is 100 frames a second, and steps are longer: .*; take time.step=0.01 or less$'
[ "$(grep -c view.rate .stderr)" = 1 ] && [ "$(wc -l <fast.tsv)" = 22 ] || fail "$(wc -l <fast.tsv) lines"
expect 0 balloon-sim m.ply $short --set time.step=0.025 --set view.rate=100 --log fast.tsv
stderr_has '^balloon-sim: at 0.025 s: view.rate is 100 rows a second, and steps are longer: .* the log has fewer; take time.step=0.01 or less$'
[ "$(grep -c view.rate .stderr)" = 1 ] && [ "$(wc -l <fast.tsv)" = 22 ] || fail "$(wc -l <fast.tsv) lines"
for dial in --set=time.step=0.01 --set=time.integrator=rk-adaptive; do
    expect 0 balloon-sim m.ply $short --set time.step=0.025 --set view.rate=100 "$dial" --mesh-series fast --log fast.tsv
    ! grep -q view.rate .stderr && [ "$(wc -l <fast.tsv)" = 52 ] || fail "$dial: $(wc -l <fast.tsv) lines, or it is said"
done
