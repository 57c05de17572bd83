# A sculpture of 1024 cells a side is opened, turned, carved and saved; undo that does not fit into its memory is told of.
. "$CASES/hand.sh"

cat >large.chips <<'END'
depth 10
start empty
fill sphere 0.5 0.5 0.5 0.4
chip sphere 0.5 0.5 0.9 0.2
END
balloon-sculpt -q --script large.chips -o a.oct
open_sculptor a.oct --undo-memory 1
picture large
press 1 g
click 480 360
journal_has '^step'
drag 2 300 300 400 330
picture large-turned
press 1 l
picture large-by-side
press l

# many steps, of which the oldest are let go
for x in 400 420 440 520 540 560; do
    click $x 300
    click $x 440
done
picture forgotten
journal_has '^chip sphere 0\.[0-9]+ 0\.[0-9]+ 0\.[0-9]+ 0\.08'
press ctrl+s
wait_title a.oct
sed -n 's/ #.*//; /^chip/p' "$journal" | cat large.chips - >want.chips
[ "$(grep -c '^chip' want.chips)" -ge 10 ] || fail "the clicks are lost"
balloon-sculpt -q --script want.chips -o want.oct
balloon-sculpt -q a.oct --info | grep -v '^preview' >got
balloon-sculpt -q want.oct --info | grep -v '^preview' >want
grep -v '^bytes' got >1
grep -v '^bytes' want >2
cmp -s 1 2 || fail "it is not what the script makes"
press ctrl+q
ends 0
[ ! -s said ] || fail "it said something"
