# Dials that give no surface, with what would be right; no mesh is left behind.
expect 0 balloon-sculpt --depth 2 -o cube.oct
refused 1 'the largest value of the field found is 1, ' balloon-surface cube.oct --threshold 3 -o a.ply
refused 1 'cube size of 5 is too large.* works$' balloon-surface cube.oct --cube-size 5 -o a.ply
refused 1 'cube size of 1e-06 is too small.* works$' balloon-surface cube.oct --cube-size 1e-6 -o a.ply
# Forced, it runs until memory does.
refused 1 'cube size of 4e-05 is too small: about .* triangles in .* GB of memory; .* works' balloon-surface cube.oct --cube-size 4e-5 -o a.ply
# (The address sanitizer needs more room than that for itself.)
if (ulimit -v 330000; balloon-surface --version) >/dev/null 2>&1; then
    for radius in 0.31 0.36; do # what is said to work is not refused as well, only then there is no memory
        echo "start empty fill sphere 0.5 0.5 0.5 $radius" | sed 's/ fill/\nfill/' >ball.chips
        expect 0 balloon-sculpt --depth 3 --script ball.chips -o ball.oct
        expect 1 balloon-surface ball.oct --cube-size 1e-5 -o a.ply
        works=$(sed 's/.*memory; \(.*\) works/\1/' .stderr)
        refused 1 'ball\.oct: not enough memory' sh -c 'ulimit -v 330000; balloon-surface ball.oct --threads 1 -o a.ply --cube-size "$1"' sh "$works"
    done
    rm ball.chips ball.oct
    refused 1 'cube\.oct: not enough memory' sh -c 'ulimit -v 400000; balloon-surface -q cube.oct --cube-size 7e-5 --threads 1 --force -o a.ply'
fi
refused 1 'cube\.oct: 2000000000 triangles are too many: about .* GB of memory; [0-9]+ work$' balloon-surface cube.oct --triangles 2000000000 -o a.ply
refused 1 '1e-05u: too small .*at least 0\.0025u' balloon-surface cube.oct --sigma 1e-5u -o a.ply
# So wide that nothing reaches the threshold, and wider than is allowed.
refused 1 'no point reaches the threshold 0\.5: the largest value .*lower the threshold or sigma' balloon-surface cube.oct --sigma 1000 -o a.ply
# So it is with a sculpture of many cells, at once, with a sigma that does.
printf 'depth 7\nstart empty\nfill sphere 0.5 0.5 0.5 0.4\n' >ball.chips
expect 0 balloon-sculpt --quiet --script ball.chips -o ball.oct
refused 1 'lower the threshold or sigma \(a sigma of 31\.2 cells works\)' balloon-surface ball.oct --sigma 500 -o a.ply
expect 0 balloon-surface --quiet ball.oct --sigma 31.2 --cube-size 0.1 --relax 0 -o b.ply
refused 2 'sigma 1001: must be a number from 0\.01 to 1000' balloon-surface cube.oct --sigma 1001 -o a.ply
# A part of it is a number.
refused 2 'sigma is of 80 characters' balloon-surface cube.oct --sigma "$(printf '1.%078d' 5)" -o a.ply
refused 2 "sigma 11u: must be a number from 1e-05u to 10u" balloon-surface cube.oct --sigma 11u -o a.ply
for sigma in 0 -1 nan inf 1e300 '' u x 0.3x; do
    refused 2 "sigma $sigma?.*: must be a number" balloon-surface cube.oct --sigma "$sigma" -o a.ply
done
for size in 0 -1 nan inf 1e300 x; do
    refused 2 'must be a number' balloon-surface cube.oct --cube-size $size -o a.ply
    refused 2 'must be a number' balloon-surface cube.oct --threshold $size -o a.ply
done
for count in 2 7 9 -1 1.5 5000 exactly; do
    refused 2 'exact, 0, or a regular grid.*1, 8, 27, 64' balloon-surface cube.oct --fields-per-cube $count -o a.ply
done
refused 2 'fields-per-area must be above 0' balloon-surface cube.oct --fields-per-cube 0 -o a.ply
refused 2 'cutoff 9: must be' balloon-surface cube.oct --cutoff 9 -o a.ply
refused 2 'must be descent or random' balloon-surface cube.oct --seeds often -o a.ply
only_files cube.oct ball.chips ball.oct b.ply

# What is said to work does, also where little of the field reaches the threshold, and else it is said that none does.
printf 'depth 3\nstart empty\nfill box 0.25 0.25 0.25 0.375 0.375 0.375\n' >little.chips
expect 0 balloon-sculpt --script little.chips -o little.oct
for top in 3 5; do
    refused 1 'is too large: no corner of a cube falls inside the surface; .* works$' \
        balloon-surface little.oct --sigma 0.5 --threshold 0.318177$top -o a.ply
    works=$(sed 's/.*surface; \(.*\) works/\1/' .stderr)
    expect 0 balloon-surface -q little.oct --sigma 0.5 --threshold 0.318177$top -o a.ply --cube-size "$works"
    rm a.ply
done
refused 1 'is too large: no corner of a cube falls inside the surface, nor of any smaller one that was tried, down to .*; lower the threshold$' \
    balloon-surface little.oct --sigma 0.5 --threshold 0.31817764 -o a.ply
