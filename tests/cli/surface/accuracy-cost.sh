# What accuracy costs on this sculpture: a table on stdout and in a file, orders, advice, a plot.
expect 0 balloon-sculpt --depth 1 -o cube.oct
expect 0 balloon-surface cube.oct --cube-size 0.1 --accuracy-cost cost.tsv
[ "$(head -n 1 .stdout)" = "$(printf 'dial\tsetting\tseconds\tevaluations\tbytes\trms_error\tmax_error\tarea_error\tvolume_error')" ] ||
    fail "the header is another"
same_file .stdout cost.tsv
for dial in cube-size fields-per-cube cutoff relax; do
    [ "$(grep -c "^$dial" cost.tsv)" -ge 5 ] || fail "too few rows of $dial"
done
stdout_has '^# order in the cube size: (1\.[89]|2\.[0-3])'
stdout_has '^# for errors of 0\.001: --cube-size [0-9.]+ --fields-per-cube ([0-9]+|exact) --cutoff [0-9.]+$'
only_files cube.oct cost.tsv

if command -v gnuplot >/dev/null; then
    expect 0 balloon-surface cube.oct --cube-size 0.2 --accuracy-cost cost.png
    a_file cost.png
    grep -q '^relax' cost.tsv || fail "no table beside the plot"
else
    echo "gnuplot is not installed: no plot was drawn"
fi

# Without gnuplot the table is printed and written all the same.
rm -f cost.*
expect 1 env PATH="$PROGRAMS/surface" balloon-surface cube.oct --cube-size 0.2 --accuracy-cost cost.png
stderr_has 'gnuplot is needed for plots and is not installed; on Debian: apt install gnuplot-nox$'
one_message
stdout_has '^relax'
only_files cube.oct cost.tsv

# One Gaussian in the basic cube, whose exact field would not reach the threshold: the other dials are priced.
echo 'depth 0' >one.chips
expect 0 balloon-sculpt --script one.chips -o one.oct
expect 0 balloon-surface one.oct --fields-per-cube 1 --sigma 0.4 --cube-size 0.1 --accuracy-cost cost.tsv
stdout_has '^cutoff.4'
if grep -q 'fields-per-cube' .stdout; then fail "fields per cube cannot be priced or advised here"; fi
stdout_has "^# order in the fields' spacing: not walked"
rm one.chips one.oct

# A folder that cannot be written to is told of before the long work: no table is printed.
refused 1 'no/such/cost\.tsv: cannot create' balloon-surface cube.oct --accuracy-cost no/such/cost.tsv
refused 1 '/proc/cost\.tsv: cannot create' balloon-surface cube.oct --accuracy-cost /proc/cost.png
only_files cube.oct cost.tsv

expect 0 balloon-surface cube.oct --cube-size 0.3 --accuracy-cost UPPER.TSV
same_file .stdout UPPER.TSV
refused 2 'must end in \.tsv, \.png or \.svg' balloon-surface cube.oct --accuracy-cost cost.pdf
