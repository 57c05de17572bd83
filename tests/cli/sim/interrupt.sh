# Ctrl-C, kill and a terminal that is closed end a run between two steps: it keeps log and checkpoint, says how to go on, and ends with 128 + the signal.
ply m.ply "$tetra_points" "$tetra_triangles"
long='--set time.end=1e6 --set balloons[0].pressure=0 --set view.rate=0.001 --threads 1'

# stopped SIGNAL EXIT ARGUMENTS...: runs it, waits for its first checkpoint, sends the signal
stopped()
{
    signal=$1
    wanted_exit=$2
    shift 2
    rm -f run.ck
    command_line="balloon-sim $* (SIG$signal)"
    # a shell makes background jobs deaf to SIGINT: env undoes that
    env --default-signal=INT,HUP balloon-sim "$@" --checkpoint run.ck --checkpoint-every 0 >.stdout 2>.stderr &
    job=$!
    for wait in 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16 17 18 19 20; do
        [ -e run.ck ] && break
        sleep 0.25
    done
    kill -s "$signal" $job
    [ "$signal" != HUP ] || kill -s HUP $job # of a terminal that is closed one hears twice
    got=0
    wait $job || got=$?
    [ "$got" = "$wanted_exit" ] || fail "exit $got, wanted $wanted_exit"
    stderr_has 'interrupted at .* s, after [0-9]+ steps; to go on: the same command with --resume run.ck'
    one_message
}

stopped INT 130 m.ply $long --log log.tsv
a_file run.ck
a_file log.tsv
stopped HUP 129 m.ply $long
a_file run.ck
stopped TERM 143 m.ply $long
time=$(sed -n 's/.*interrupted at \([^ ]*\) s.*/\1/p' .stderr)
end=$(awk "BEGIN { print $time + 1 }")
expect 0 balloon-sim m.ply --set time.end=$end --set 'balloons[0].pressure=0' --resume run.ck --hash
hash=$(tail -n 1 .stdout)
expect 0 balloon-sim m.ply --set time.end=$end --set 'balloons[0].pressure=0' --hash
[ "$(tail -n 1 .stdout)" = "$hash" ] || fail "another hash than without the interruption"
only_files m.ply log.tsv run.ck

# Also while the first method is being chosen, which takes long where the wind is a storm: nothing has begun then, and the run goes on from there.
cp "$PROGRAMS/data/sphere.ply" .
printf 'time = { end = 0.05; };\nballoons = ( { mesh = "sphere.ply"; membrane = { thickness = 0.45; }; gas = { ambient = 6; }; } );\ndrag = { wind = [1e6, 0.0, 0.0]; };\n' >storm.cfg
env --default-signal=INT balloon-sim storm.cfg --checkpoint storm.ck >.stdout 2>.stderr &
job=$!
sleep 2
kill -s INT $job
got=0
wait $job || got=$?
command_line="balloon-sim storm.cfg (SIGINT)"
[ "$got" = 130 ] || fail "exit $got, wanted 130"
stderr_has 'interrupted at 0 s, after 0 steps; to go on: the same command with --resume storm.ck'
a_file storm.ck

# ... and while the last state is drawn from all sides: what was drawn stays.
env --default-signal=INT balloon-sim m.ply --set time.end=0.1 --set view.size=[640,480] --frames round --turntable=100000 >.stdout 2>.stderr &
job=$!
for wait in 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16 17 18 19 20; do
    [ -e round/frame_0002.png ] && break
    sleep 0.25
done
kill -s INT $job
got=0
wait $job || got=$?
command_line="balloon-sim --turntable=100000 (SIGINT)"
[ "$got" = 130 ] || fail "exit $got, wanted 130"
stderr_has '^balloon-sim: interrupted after [0-9]+ of 100000 pictures of the last state$'
a_file round/frame_0002.png

# What nohup starts goes on when the terminal is closed.
rm -f run.ck
env --ignore-signal=HUP balloon-sim m.ply $long --checkpoint run.ck --checkpoint-every 0 >.stdout 2>.stderr &
job=$!
for wait in 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16 17 18 19 20; do
    [ -e run.ck ] && break
    sleep 0.25
done
kill -s HUP $job
sleep 0.1
kill -s TERM $job
got=0
wait $job || got=$?
command_line="balloon-sim (SIGHUP ignored, SIGTERM)"
[ "$got" = 143 ] || fail "exit $got, wanted 143"
