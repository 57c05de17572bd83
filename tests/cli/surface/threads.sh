# The mesh is the same to the byte for any number of threads, relaxed or not.
printf 'depth 4\nchip sphere 0.3 0.3 0.3 0.35\n' >bitten.chips
expect 0 balloon-sculpt --script bitten.chips -o bitten.oct
for rounds in 0 10; do
    expect 0 balloon-surface bitten.oct --cube-size 0.01 --relax $rounds --threads 1 -o alone.ply
    for threads in 2 5; do
        expect 0 balloon-surface bitten.oct --cube-size 0.01 --relax $rounds --threads $threads -o shared.ply
        same_file alone.ply shared.ply
    done
done
refused 2 'threads' balloon-surface bitten.oct --threads 0 -o none.ply
