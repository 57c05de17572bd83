# On a screen with a buffer for each eye both are drawn into, the left eye's first; other pictures go into both at once.
. "$CASES/live.sh"
export ASAN_OPTIONS=verify_asan_link_order=0

open_quad() # ARGUMENT...
{
    export LD_PRELOAD="$TWO_BUFFERS"
    open_live "$@"
    unset LD_PRELOAD
}

open_quad --set 'view.stereo=quad'
pause
picture quad
press v
picture mono
press p
quit
[ "$(head -n 3 buffers | tr '\n' ' ')" = 'left right left ' ] || fail "not an eye after the other: $(head -n 3 buffers)"
[ "$(tail -n 1 buffers)" = both ] || fail "one picture is not in both buffers"
rm buffers

# The key comes to it after all others; what is saved has no such buffers.
open_quad
pause
press v v v v v
[ "$(sort -u buffers)" = both ] || fail "two buffers where none were asked for"
press v
[ "$(tail -n 1 buffers)" = right ] || fail "the key does not lead to two buffers"
press p
quit
is_picture ball-2.png 800 600
