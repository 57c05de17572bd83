# When the display goes away the program ends at once, and leaves no half-written log.
. "$CASES/live.sh"

open_live
kill "$SERVER"
tries=0
while kill -0 "$program" 2>/dev/null; do
    tries=$((tries + 1))
    [ $tries -lt 200 ] || { kill -9 "$program"; fail "it goes on without a display"; }
    sleep 0.05
done
ends 1
[ ! -e live.tsv ] || fail "a log was left"
