# What accuracy costs on this scene: a table on stdout and in a file, references, auto's standing, failures, a plot.
balloon-sculpt -q --depth 1 -o cube.oct
balloon-surface -q cube.oct --cube-size 0.3 -o cube.ply
calm='--set time.end=0.4 --set balloons[0].pressure=4 --set balloons[0].point_mass=1 --set balloons[0].threshold=100'
expect 0 balloon-sim cube.ply $calm --accuracy-cost cost.tsv
[ "$(head -n 1 .stdout | cut -f 1-7)" = "$(printf 'method\tsetting\tsteps\tevaluations\tseconds\terror\torder')" ] ||
    fail "the header is another"
same_file .stdout cost.tsv
grep -v '^#' cost.tsv | awk -F'\t' 'NF != 22 { exit 1 }' || fail "a row has not twenty-two columns"
for method in symplectic-euler explicit-euler verlet rk4 rkn4 rk-adaptive backward-euler implicit-midpoint bdf2 xpbd auto; do
    [ "$(grep -c "^$method	" cost.tsv)" -ge 3 ] || fail "too few rows of $method"
done
awk -F'\t' '$1 == "rk4" && $6 < 1e-4 && $6 > 1e-9 && !($7 > 3.5 && $7 < 4.6 || $7 == "nan") { exit 1 }' cost.tsv ||
    fail "rk4 has another order"
stdout_has '^# all in double precision: '
stdout_has '^# references: .* and .* extrapolated: they agree to [0-9.e-]+, [0-9.e+]+ times better than the best row$'
stdout_has '^# auto at time.tolerance=1e-05 \(.*substep.*\): [0-9.]+ x the time of the fastest'
only_files cube.oct cube.ply cost.tsv

# one picture in each order with each number of samples, for a scene that says nothing of its view
[ "$(grep -c '^picture	view.order=[a-z]* view.samples=[1-4]	' cost.tsv)" = 16 ] || fail "not sixteen rows of pictures"
awk -F'\t' '$2 == "view.order=list view.samples=4" && $6 == 0 && $21 == 0 && $22 == 0 { found = 1 } END { exit !found }' cost.tsv ||
    fail "lists with 4 x 4 samples are not the reference"
mean() { awk -F'\t' -v row="view.order=$1 view.samples=$2" '$2 == row { print $21 }' cost.tsv; }
awk "BEGIN { exit !($(mean none 2) > 2 * $(mean sort 2)) }" || fail "no order is as good as sorting"
stdout_has '^# pictures: 1280 x 480 at 0\.4 s; errors: .*against lists with 4 x 4 samples'
stdout_has '^# pictures: as the scene has it, sort, 1 x 1: [0-9.e-]+ of 255 in the mean, [0-9]+ at worst, [0-9.e+]+ ms; in exact order, list, 1 x 1: '

# a membrane is nothing for a method that moves springs, and no tolerance is kept where it hits the ground
small='--set view.size=[160,120]' # pictures have been priced above
falls='--set gravity.acceleration=[0,-2000,0] --set ground.height=-49'
expect 0 balloon-sim cube.ply $calm $small $falls --set time.end=0.1 --set balloons[0].membrane.thickness=0.5 --accuracy-cost skin.tsv
stdout_has '^# skin is turned back from 0\.1 s on, at the ends of steps: .*time.tolerance does not reach it'
stdout_has '^# failed: xpbd at .*: moves springs only$'
grep -q '^xpbd' skin.tsv && fail "a row of xpbd on a membrane"

# a skin that tears is nothing for methods that go by what hangs together at the start, which a run refuses
tears='--set time.end=0.1 --set balloons[0].membrane.thickness=0.5 --set balloons[0].fracture.mode="tear"'
expect 0 balloon-sim cube.ply $calm $small $tears --accuracy-cost tears.tsv
for method in cvode-adams cvode-bdf; do
    stdout_has "^# failed: $method at .*: cannot follow a skin that tears$"
    grep -q "^$method" tears.tsv && fail "a row of $method on a skin that tears"
done
grep -q '^bdf2' tears.tsv || fail "no row of bdf2, which can follow it"
stdout_has '^# references: rk-adaptive at '

# where all methods are right to the last digit there is no best row to be compared with
expect 0 balloon-sim cube.ply $small --set time.end=0.1 --set balloons[0].pressure=0 --accuracy-cost rest.tsv
stdout_has '^# references: .* and .* extrapolated: they agree to [0-9.e+-]+$'
stdout_has '^# left out: [0-9]+ rows with errors below'

# the setting is what --set takes
setting=$(awk -F'\t' '$1 == "verlet" { print $2; exit }' cost.tsv)
expect 0 balloon-sim cube.ply $calm --set time.integrator=verlet --set "$setting" --log v.tsv

if command -v gnuplot >/dev/null; then
    expect 0 balloon-sim cube.ply $calm $small --accuracy-cost cost.svg
    a_file cost.svg
    grep -q 'auto' cost.svg || fail "auto is not in the plot"
    grep -q 'view.order' cost.svg || fail "pictures are not in the plot"
else
    echo "gnuplot is not installed: no plot was drawn"
fi
# of what makes no step nothing can be told
refused 1 'the first run: time\.end = 0 is over before a step of time\.step = 0\.025$' \
    balloon-sim cube.ply --set time.end=0 --accuracy-cost cost.tsv
refused 1 'time\.end = 0 is over before a step of time\.step = 0\.025$' balloon-sim cube.ply --set time.end=0 --accuracy-cost cost.tsv --check
# what cannot be written is known before the work
refused 1 'no-folder/cost.tsv' balloon-sim cube.ply $calm --accuracy-cost no-folder/cost.tsv
refused 2 'must end in \.tsv, \.png or \.svg' balloon-sim cube.ply --accuracy-cost cost.pdf
refused 1 'gnuplot is needed for plots and is not installed; on Debian: apt install gnuplot-nox$' \
    env PATH="$PROGRAMS/sim" balloon-sim cube.ply $calm --accuracy-cost none.png
no_file none.png
