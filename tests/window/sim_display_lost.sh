# When the display goes away the program ends at once, and leaves no half-written log.
. "$CASES/live.sh"

open_live
# What is written to it then fails, and does not kill: that would be another exit code.
[ $((0x$(awk '/^SigIgn/ { print $2 }' "/proc/$program/status") & 0x1000)) -ne 0 ] || fail "a closed display's signal is not ignored"
without_display
[ ! -e live.tsv ] || fail "a log was left"
