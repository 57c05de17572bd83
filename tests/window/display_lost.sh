# When the display goes away the program ends at once, and the work is in the journal for the next start.
. "$CASES/lib.sh"
PATH=$SCULPT:$PATH

balloon-sculpt a.oct --depth 5 >log 2>said </dev/null &
program=$!
window=$(timeout 60 xdotool search --sync --onlyvisible --name "balloon-sculpt" | tail -n 1)
[ -n "$window" ] || fail "no window"
at 480 360
sleep 0.3
xdotool click 1
tries=0
until grep -q '^step' a.oct.journal; do
    tries=$((tries + 1))
    [ $tries -lt 100 ] || fail "the click is not in the journal"
    sleep 0.05
done
kill "$SERVER"
tries=0
while kill -0 "$program" 2>/dev/null; do
    tries=$((tries + 1))
    [ $tries -lt 200 ] || { kill -9 "$program"; fail "it goes on without a display"; }
    sleep 0.05
done
ends 1
grep -q '^chip sphere' a.oct.journal || fail "the work is lost"
