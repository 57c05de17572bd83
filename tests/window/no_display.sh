# Without a display, or with one that is not there, opening fails with one line and never ends the program itself.
. "$CASES/lib.sh"

for display in '' ':98765'; do
    got=0
    DISPLAY=$display "$PROGRAM" >log 2>said || got=$?
    program=$$
    [ "$got" = 3 ] && grep -q '^no window can be opened on the display' said && [ "$(wc -l <said)" = 1 ] || {
        echo "FAILED: exit $got on display \"$display\"" >&2
        cat said >&2
        exit 1
    }
done
