# Each manual page has what a page must have, tells of the options that the program has and of no others, and of every key
# of a scene; and mandoc has nothing to say against it.
pages="$SOURCE/sculpt/balloon-sculpt.1 $SOURCE/surface/balloon-surface.1 $PROGRAMS/sim/balloon-sim.1"
for page in $pages; do
    name=$(basename "$page" .1)
    expect 0 "$name" --help
    grep -oE '^ +(-., )?--[a-z-]+' .stdout | sed 's/.*--/-/' | sort >options
    grep '^\.It Fl' "$page" | grep -oE 'Fl -[a-z-]+' | sed 's/Fl //' | sort -u >told
    command_line="options of $name --help (<) and its page (>)"
    diff options told >.stdout || fail "they differ"
    command_line="$page"
    for section in NAME SYNOPSIS DESCRIPTION FILES "EXIT STATUS" EXAMPLES "SEE ALSO"; do
        grep -qx "\.Sh $section" "$page" || fail "there is no section $section"
    done
    awk '/^\.Dl [^#]/ { text = substr($0, 5) } /^\.Ed/ { shown = 0 } shown { text = $0 } /^\.Bd -literal/ { shown = 1 }
        length(text) > 78 { print NR ": " text } { text = "" }' "$page" >.stdout
    [ ! -s .stdout ] || fail "these lines are too long to be shown as they are, and copied"
    ! grep -nE '^\.It .* \?' "$page" >.stdout || fail "a ? that sticks to what stands before it, where \\&? would not"
    for option in $(grep -vE '^-(help|usage|version|quiet|output)$' options); do
        sed -n '/^\.Sh SYNOPSIS/,/^\.Sh DESCRIPTION/p' "$page" | grep -q -- "Fl $option\b" || fail "SYNOPSIS lacks -$option"
    done
done

# Blocks and keys in order, as --help-scene and the page have them.
expect 0 balloon-sim --help-scene
awk '/^[a-z][^ ]*: / { sub(/:$/, "", $1); print $1; within = 1 } within && /^  [a-z_]+ / { print "  " $1 }' .stdout >keys
awk '/^\.Ss / { sub(/\\&$/, "", $2); block = $2 }
    /^\.Ss [a-z]/ { print block } /^\.Ss [A-Z]/ { block = "" }
    /^\.It Cm / && block != "" { print "  " $3 }' "$PROGRAMS/sim/balloon-sim.1" >told
command_line='keys of --help-scene (<) and of the page (>)'
diff keys told >.stdout || fail "they differ"
[ "$(wc -l <keys)" -gt 100 ] || fail "only $(wc -l <keys) keys were found"

if ! command -v mandoc >/dev/null; then
    echo "mandoc is not installed: the pages' syntax was not looked at"
    exit 77
fi
for page in $pages; do
    # other pages are looked for where they will have been installed
    mandoc -T lint -W style "$page" 2>/dev/null | grep -v 'referenced manual not found' >.stdout || true
    command_line="mandoc -T lint $page"
    [ ! -s .stdout ] || fail "it has something to say"
done
