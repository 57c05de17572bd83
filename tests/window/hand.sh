# What the cases of the sculptor's window share, beside lib.sh. PICTURES, if set, is a folder for screenshots, to be
# looked at.
. "$CASES/lib.sh"
PATH=$SCULPT:$PATH

open_sculptor() # ARGUMENT...
{
    balloon-sculpt "$@" >log 2>said </dev/null &
    program=$!
    window=$(timeout 60 xdotool search --sync --onlyvisible --name "balloon-sculpt" | tail -n 1)
    [ -n "$window" ] || fail "no window"
    xdotool windowfocus "$window" 2>/dev/null || true
    at 10 10
    settle
}

settle() { sleep 0.3; }

drag() # BUTTON X0 Y0 X1 Y1
{
    pull "$@"
    release "$1"
}

# until_true MESSAGE COMMAND...: for ten seconds
until_true()
{
    why=$1
    shift
    tries=0
    until "$@"; do
        tries=$((tries + 1))
        [ $tries -lt 200 ] || fail "$why"
        sleep 0.05
    done
}

journal=a.oct.journal

# journal_has PATTERN: the operation is in the journal, at the moment it is done
journal_has() { until_true "no line of the journal matches: $1" grep -Eqs -- "$1" "$journal"; }

# journal_counts WORD COUNT: so many of the journal's lines begin with it
journal_counts() { [ "$(grep -c "^$1" "$journal")" = "$2" ]; }

# The title is that of the sculpture, with a star while there is work that is not saved.
title_is() { [ "$(xdotool getwindowname "$window")" = "$1 - balloon-sculpt" ]; }
wait_title() { until_true "the title is $(xdotool getwindowname "$window"), not $1" title_is "$1"; }

picture() { [ -z "${PICTURES:-}" ] || import -window "$window" "$PICTURES/$1.png"; }

# same_cells A.oct B.oct
same_cells()
{
    balloon-sculpt -q "$1" --export 1.vox && balloon-sculpt -q "$2" --export 2.vox && cmp -s 1.vox 2.vox ||
        { [ ! -e "$journal" ] || cat "$journal" >said; fail "$1 and $2 are not the same sculpture"; }
}
