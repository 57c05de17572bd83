# Killed at any moment (kill -9), $KILLS times for each program, spread over its run by a seed: what was there is whole.
# moments LONGEST: seconds, one a line
moments() { awk -v n="$KILLS" -v longest="$1" 'BEGIN { srand(1995); for (i = 0; i < n; i++) printf "%.4f\n", rand() * longest }'; }

# seconds COMMAND...: how long it runs
seconds()
{
    begin=$(date +%s.%N)
    "$@" >/dev/null 2>&1
    awk -v a="$begin" -v b="$(date +%s.%N)" 'BEGIN { print b - a }'
}

# killed MOMENT COMMAND...: runs it and kills it then, or lets it end before
killed()
{
    moment=$1
    shift
    command_line="killed $moment s after it began: $*"
    timeout -s KILL "$moment" "$@" >.stdout 2>.stderr </dev/null || true
}

# either FILE OLD NEW: the file is one of the two, byte by byte
either() { cmp -s "$1" "$2" || cmp -s "$1" "$3" || fail "$1 is neither the old one nor the new one"; }

# A sculpture, and its exports.
printf 'depth 6\nchip sphere 0.5 0.5 0.5 0.3\nsandpaper 0.5 0.5 0.8 0.3\n' >a.chips
echo 'fill box 0.1 0.1 0.1 0.9 0.4 0.9' >more.chips
mkdir old new here
balloon-sculpt -q --script a.chips -o old/a.oct --export old/a.ply
balloon-sculpt -q old/a.oct --script more.chips -o new/a.oct --export new/a.ply
longest=$(seconds balloon-sculpt -q old/a.oct --script more.chips -o here/a.oct --export here/a.ply)
for moment in $(moments "$longest"); do
    cp old/* here
    killed "$moment" balloon-sculpt -q here/a.oct --script more.chips -o here/a.oct --export here/a.ply
    either here/a.oct old/a.oct new/a.oct
    either here/a.ply old/a.ply new/a.ply
done

# A mesh.
balloon-surface -q old/a.oct -o old/a.ply --triangles 500
balloon-surface -q old/a.oct -o new/a.ply --triangles 3000
longest=$(seconds balloon-surface -q old/a.oct -o here/a.ply --triangles 3000)
for moment in $(moments "$longest"); do
    cp old/a.ply here
    killed "$moment" balloon-surface -q old/a.oct -o here/a.ply --triangles 3000
    either here/a.ply old/a.ply new/a.ply
done

# A run: its checkpoint goes on to the hash of one that was never disturbed, its older log and skin stay.
run='balloon-sim -q old/a.ply --threads 1 --set time.end=0.5'
echo old >old/log.tsv
balloon-sim -q old/a.ply --threads 1 --set time.end=0.05 --checkpoint old/run.ck >/dev/null
expect 0 $run --hash -o new/end.ply
hash=$(tail -n 1 .stdout)
longest=$(seconds $run --checkpoint here/run.ck --checkpoint-every 0 --resume old/run.ck --log here/log.tsv)
rm -f here/*
for moment in $(moments "$longest"); do
    cp old/log.tsv old/run.ck here
    killed "$moment" $run --checkpoint here/run.ck --checkpoint-every 0 --resume here/run.ck --log here/log.tsv -o here/end.ply
    [ ! -e here/end.ply ] || same_file here/end.ply new/end.ply
    [ "$(cat here/log.tsv)" = old ] || [ "$(tail -n 1 here/log.tsv | cut -f 1)" = 0.5 ] || fail "half a log"
    expect 0 $run --hash --resume here/run.ck
    [ "$(tail -n 1 .stdout)" = "$hash" ] || fail "another hash after it went on: $(tail -n 1 .stdout), not $hash"
done
ls here | grep -Ev '^(a.oct|a.ply|log.tsv|run.ck|end.ply)(\.[[:alnum:]]{6})?$' && fail "other files were left" || true
