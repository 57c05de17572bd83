# When the display goes away the program ends at once, and the work is in the journal for the next start.
. "$CASES/hand.sh"

open_sculptor a.oct --depth 5
click 480 360
journal_has '^step'
without_display
grep -q '^chip sphere' a.oct.journal || fail "the work is lost"
