# What the cases of windows share. One program runs at a time, its standard output in `log`, what it says in `said`.

# start TITLE COMMAND...: starts it, waits until the log has a line, and moves the pointer over the window whose title
# this extended regular expression matches.
start()
{
    title=$1
    shift
    "$@" >log 2>said </dev/null &
    program=$!
    wait_for '.'
    window=$(xdotool search --sync --onlyvisible --name "$title" | tail -n 1)
    xdotool mousemove --sync --window "$window" 10 10
}

fail()
{
    echo "FAILED: $1" >&2
    sed 's/^/  log: /' log | tail -n 40 >&2
    sed 's/^/  said: /' said | tail -n 20 >&2
    kill "$program" 2>/dev/null || true
    exit 1
}

# wait_for PATTERN: until a line of the log matches; twenty seconds are long enough for any machine.
wait_for()
{
    tries=0
    until grep -Eq -- "$1" log; do
        tries=$((tries + 1))
        [ $tries -lt 400 ] && kill -0 "$program" 2>/dev/null || fail "no line of the log matches: $1"
        sleep 0.05
    done
}

# ends EXIT: the program ends with this exit code.
ends()
{
    got=0
    wait "$program" || got=$?
    [ "$got" = "$1" ] || fail "exit $got, wanted $1"
}

at() { xdotool mousemove --sync --window "$window" "$1" "$2"; }

press() # KEY...
{
    xdotool key "$@"
    settle
}

click() # X Y
{
    at "$1" "$2"
    xdotool click 1
    settle
}

pull() # BUTTON X0 Y0 X1 Y1: takes hold at the first place and is at the second, the button still down
{
    at "$2" "$3"
    xdotool mousedown "$1"
    at $((($2 + $4) / 2)) $((($3 + $5) / 2))
    at "$4" "$5"
}

release() # BUTTON
{
    xdotool mouseup "$1"
    settle
}

# The display goes away, and the program ends at once.
without_display()
{
    kill "$SERVER"
    tries=0
    while kill -0 "$program" 2>/dev/null; do
        tries=$((tries + 1))
        [ $tries -lt 200 ] || { kill -9 "$program"; fail "it goes on without a display"; }
        sleep 0.05
    done
    ends 1
}
