# Each tool, as chip and as fill, from the front and on the grid, so that what it must do can be written down beforehand:
# the sculpture that is saved is the one that the script makes.
. "$CASES/hand.sh"

open_sculptor a.oct --depth 5
press 1 g
echo 'depth 5' >want.chips

# did LINE...: these lines are what the hand did since the last call
did()
{
    printf '%s\n' "$@" >>want.chips
    press ctrl+s
    wait_title a.oct
    balloon-sculpt -q --script want.chips -o want.oct
    same_cells a.oct want.oct
}

# cells are 1/32 wide; their middles are odd multiples of 1/64
click 480 360
did 'chip sphere 0.515625 0.484375 0.984375 0.08'
picture sphere

press b
click 400 300
did 'chip box 0.248125 0.560625 0.904375 0.408125 0.720625 1.064375'
press c
click 560 300
did 'chip cylinder 0.671875 0.640625 0.904375 0.671875 0.640625 1.064375 0.08'
press d
drag 1 400 420 560 420
did 'chip capsule 0.328125 0.359375 0.984375 0.671875 0.359375 0.984375 0.08 0.08'
picture stroke

press h
click 600 480
did 'heat 0.765625 0.234375 0.984375 0.08'
picture heat

# rubbed along a drag, at an edge of the cube
press n
drag 1 270 180 270 205
did 'sandpaper 0.046875 0.890625 0.984375 0.08' 'sandpaper 0.046875 0.859375 0.984375 0.08' \
    'sandpaper 0.046875 0.828125 0.984375 0.08'

# material 2, put into the holes and out of the face
press Tab m s
click 480 360
grep -Eq '^fill sphere 0.515625 0.484375' "$journal" || fail "no fill"
sed -n 's/ #.*//; /^fill sphere/p' "$journal" >fill
did 'material 2' "$(cat fill)"
picture fill

# brush size, sunk, and mirrored
press Tab x plus plus bracketright
click 330 300
did 'mirror x' 'chip sphere 0.171875 0.640625 0.984375 0.0968'
press x bracketleft minus minus

# a line to the right through the eye takes what is below; from the side that is the half y < 1/2
press k
drag 1 250 360 710 360
did 'mirror none' 'chip half-space 0.5 0.5 0.5 0 -1 0'
picture cut
press ctrl+z
wait_title 'a.oct *'
did 'undo'
press ctrl+shift+z
wait_title 'a.oct *'
did 'redo'
press ctrl+q
ends 0
[ ! -s said ] || fail "it said something"
