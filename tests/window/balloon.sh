# What is blown up is the sculpture as it is, also after the balloon was looked at, and as often as one likes.
. "$CASES/hand.sh"
command -v import >/dev/null || exit 77
crop() { import -window "$window" -crop "40x40+$2+$3" +repage "$1.ppm"; } # NAME X Y

open_sculptor a.oct --depth 4
press 1 p p
press k
drag 1 480 700 480 20 # takes away what lies to the right
press ctrl+s
wait_title a.oct
crop silent 8 8
press i
crop blown-up 600 340
picture blown-up
press p p
crop gone 600 340
picture at-rest
cmp -s blown-up.ppm gone.ppm || fail "what was carved away is blown up"
press i p i
crop again 8 8
picture again
cmp -s silent.ppm again.ppm || fail "a balloon that was blown up is not blown up again"
press ctrl+q
ends 0
