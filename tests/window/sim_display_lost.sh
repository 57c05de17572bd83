# When the display goes away the program ends at once, and leaves no half-written log.
. "$CASES/live.sh"

open_live
without_display
[ ! -e live.tsv ] || fail "a log was left"
