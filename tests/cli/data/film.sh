# Frames that are shared out are those of one run, to the byte; a part that is lost is drawn again, and no other.
cp "$PROGRAMS/data/sphere.ply" "$PROGRAMS/data/sphere.cfg" .
film=$(dirname "$SWEEP")/film
BALLOON_SIM=$PROGRAMS/sim/balloon-sim
export BALLOON_SIM
look='--set view.size=[160,60] --set view.rate=10'
expect 0 balloon-sim "$PWD/sphere.cfg" --set time.end=2 $look --frames whole # pictures tell the scene by the name it was given
# 2 s do not divide by 3: the parts meet between two frames
set -- sphere.cfg --out "the film's" --end 2 --parts 3 $look
expect 0 "$film" "$@"
stdout_has '^21 frames: '
for frame in whole/*.png; do same_file "$frame" "the film's/frames/${frame##*/}"; done
[ "$(find "the film's"/part-* -name '*.png' | wc -l)" = 21 ] || fail "parts drew frames of others"

rm -r "the film's/part-2"
touch -d 2000-01-01 "the film's/part-1" "the film's/part-3"
expect 0 "$film" "$@"
[ "$(find "the film's" -maxdepth 1 -name 'part-*' -newermt 2001-01-01 | wc -l)" = 1 ] || fail "other parts were drawn again"
same_file whole/frame_0010.png "the film's/frames/frame_0010.png"

refused 1 'holds another film' "$film" sphere.cfg --out "the film's" --end 2 --parts 4 $look
refused 2 'usage: ' "$film" sphere.cfg --out other
refused 2 'whole number' "$film" sphere.cfg --out other --end 2 --parts 0
expect 1 "$film" sphere.cfg --out bad --end 1 --parts 2 --set 'balloons[0].sprong=1'
stderr_has sprong
