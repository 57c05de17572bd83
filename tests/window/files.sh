# Opening, importing, exporting and saving under names that are typed; what cannot be done is said, and changes nothing.
. "$CASES/hand.sh"

type_name() # NAME: as the answer to what is asked
{
    xdotool type "$1"
    press Return
}

printf 'depth 5\nchip sphere 0.5 0.5 0.5 0.3\n' >hollow.chips
balloon-sculpt -q --script hollow.chips --export hollow.vox
printf 'depth 4\nchip sphere 0.5 0.5 1 0.3\n' >other.chips
balloon-sculpt -q --script other.chips -o other.oct
head -c 60 other.oct >damaged.oct
cat >cube.obj <<'END'
v 0 0 0
v 1 0 0
v 1 1 0
v 0 1 0
v 0 0 1
v 1 0 1
v 1 1 1
v 0 1 1
f 4 3 2 1
f 5 6 7 8
f 1 2 6 5
f 3 4 8 7
f 2 3 7 6
f 5 8 4 1
END

open_sculptor a.oct --depth 5
press 1 g
click 480 360
wait_title 'a.oct *'

# unsaved work is asked for first; and names that lead nowhere leave all as it is
press ctrl+o
picture asked
press Escape
press ctrl+o d
type_name nowhere.oct
picture nowhere
press ctrl+o d
type_name damaged.oct
picture damaged
press ctrl+o d
type_name nowhere.vox
press ctrl+o d
type_name damaged.stl
title_is 'a.oct *' || fail "a name that leads nowhere did something"
click 400 300
until_true "carving does not go on" journal_counts step 2

# saved and opened in one
press ctrl+o s
wait_title a.oct
settle
type_name other.oct
wait_title other.oct
[ ! -e a.oct.journal ] && [ -e other.oct.journal ] || fail "the journal is not the new sculpture's"
printf 'depth 5\nchip sphere 0.515625 0.484375 0.984375 0.08\nchip sphere 0.328125 0.640625 0.984375 0.08\n' >want.chips
balloon-sculpt -q --script want.chips -o want.oct
same_cells a.oct want.oct

# a model is a new sculpture; its hollow is told of
press ctrl+o
type_name hollow.vox
picture hollow
press f
wait_title 'hollow.oct *'
press ctrl+s
wait_title hollow.oct
balloon-sculpt -q --import hollow.vox --solid -o want.oct
same_cells hollow.oct want.oct

# a mesh; the name is taken, so the sculpture gets another; a kill before it is saved loses nothing
touch cube.oct
press ctrl+o
type_name cube.obj
wait_title 'cube-2.oct *'
picture mesh
press 1 g
click 480 360
journal=cube-2.oct.journal
journal_has '^step'
kill -9 "$program"
wait "$program" 2>/dev/null || true
balloon-sculpt -q --recover cube-2.oct -o recovered.oct
sed -n 's/ #.*//; /^chip/p' "$journal" >chips.chips
balloon-sculpt -q --import cube.obj --script chips.chips -o want.oct
same_cells recovered.oct want.oct

# what was mended in a mesh, and that it was open, is told, as --import tells it
notes() { ! command -v import >/dev/null || import -window "$window" -crop 800x40+0+0 +repage "$1.ppm"; } # NAME
told() { ! command -v import >/dev/null || ! cmp -s silent.ppm "$1.ppm" || fail "nothing is said of $1.obj"; } # NAME
cp cube.obj whole.obj
{ cat cube.obj && echo 'f 5 8 4 1'; } >twice.obj
awk '/^f/ { print "f", $2, $3, $4; if (++faces > 1) print "f", $2, $4, $5; next } { print }' cube.obj >holed.obj
balloon-sculpt --import twice.obj --info 2>said >info && grep -q 'twice.obj: 2 repeated triangles dropped' said ||
    fail "a triangle that is there twice is not dropped"
balloon-sculpt --import holed.obj --info 2>said >info && grep -q 'holed.obj: 3 edges are open; its holes' said ||
    fail "a cube without half of a side is not open"
open_sculptor b.oct
for model in whole twice holed; do
    press ctrl+o
    type_name $model.obj
    wait_title "$model.oct *"
    settle
    notes $model
    picture $model
    press ctrl+s
    wait_title $model.oct
done
cp whole.ppm silent.ppm 2>/dev/null || true
told twice
told holed
press ctrl+q
ends 0

# each export is what a script's would be; a file that is there is replaced when one says so twice
open_sculptor a.oct
balloon-sculpt -q a.oct --export want.vox --export want.ply --export want.chips
for form in vox ply chips; do
    press ctrl+e
    press BackSpace BackSpace BackSpace
    type_name $form
    until_true "no a.$form" [ -s a.$form ]
    settle
    cmp -s a.$form want.$form || fail "a.$form is another export"
done
press ctrl+e
press BackSpace BackSpace BackSpace
type_name tiff
picture tiff
[ ! -e a.tiff ] || fail "it writes .tiff"
press Escape
press ctrl+e
picture proposed
type_name typed.vox # in place of the name that is proposed
until_true "no typed.vox" [ -s typed.vox ]
settle
press ctrl+e
press adiaeresis
press eacute
press BackSpace # a letter of two bytes
type_name .vox
until_true "no file with an umlaut in its name" [ -s "$(printf '\303\244').vox" ]
settle
cmp -s typed.vox want.vox || fail "typed.vox is another export"
press ctrl+shift+s
press BackSpace BackSpace BackSpace BackSpace BackSpace
cp other.oct kept.oct
type_name other.oct
picture replace
cmp -s other.oct kept.oct || fail "another file was replaced unasked"
press Return
wait_title other.oct
same_cells other.oct a.oct
press ctrl+q
ends 0
[ ! -s said ] || fail "it said something"
