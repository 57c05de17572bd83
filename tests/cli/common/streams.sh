# Where a standard stream is closed no file takes its place and gets what is told.
ply m.ply "$tetra_points" "$tetra_triangles"
short='--set time.end=0.1 --set view.rate=40 --set balloons[0].point_mass=0.001'
expect 0 balloon-sim m.ply $short --log whole.tsv
stderr_has . # there is something to tell
for closed in '2>&-' '<&- 2>&-' '>&-' '<&- >&- 2>&-'; do
    case $closed in *'>&- '* | '>&-') wanted=1 ;; *) wanted=0 ;; esac
    expect $wanted sh -c "balloon-sim \"\$@\" $closed" sh m.ply $short --log log.tsv
    for file in whole log; do
        cut -f 1-13 $file.tsv >$file.cut # all but the seconds that it took
    done
    same_file whole.cut log.cut
    rm log.tsv
done
expect 1 sh -c 'balloon-sculpt "$@" >&-' sh --depth 1 -o a.oct --info
expect 0 balloon-sculpt a.oct --info
expect 1 sh -c 'balloon-surface "$@" >&-' sh a.oct -o a.ply --info
expect 0 balloon-sim a.ply --check
# ... and what argp prints before the work is not lost in silence.
for program in balloon-sculpt balloon-surface balloon-sim; do
    for option in --help --usage --version; do
        expect 1 sh -c "$program $option >&-"
        stderr_has '^balloon-[a-z]+: cannot write the results to stdout: Bad file descriptor$'
        expect 1 sh -c "$program $option >/dev/full"
        stderr_has '^balloon-[a-z]+: cannot write the results to stdout: No space left on device$'
        one_message
        expect 0 $program $option
        expect 2 sh -c "$program --nonsense >&-"
    done
done
