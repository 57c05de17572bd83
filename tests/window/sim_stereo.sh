# The key for stereo leads through every layout; in each the pointer pricks what it shows, and sliders are where they are seen, in either
# eye's picture.
. "$CASES/live.sh"

# The ball's picture has a radius of 140 pixels, of 93 in a half's width and of 70 in half the height.
open_live
pause
press v # side by side
picture parallel
click 550 250
press v # crossed
picture crossed
click 250 250
drag 1 601 520 333 520 # the right copy's slider, out of its eye's picture
press v # over-under
picture over-under
click 400 485
click 262 504 # the lower copy's
press v # red-cyan
picture red-cyan
click 340 360
press v # interlaced
picture interlaced
click 460 360
press v # one eye
picture mono
click 400 300
quit
log_has "not every layout was pricked where it was hit" 'at(1, "triangles_active") == 128 && at(-1, "triangles_active") == 122'
log_has "a slider of the lower picture" 'near(at(-1, "gauge_pressure"), 7.5)'

# Where halves are odd, as windows may be, the last column or row is left over.
open_live --set 'view.stereo=over-under'
pause
xdotool windowsize "$window" 801 601
settle
picture odd
click 400 485
press period
quit
log_has "an odd window" 'at(-1, "triangles_active") == 127 && near(at(-1, "time") - at(-2, "time"), 0.025)'

# Without buffers for both eyes they are side by side: one is where a single picture has none.
open_live --set 'view.stereo=quad'
pause
picture no-quad
click 600 300
quit
log_has "no picture for the right eye" 'at(-1, "triangles_active") == 127'
