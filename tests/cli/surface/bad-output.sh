# A full disk, a read-only folder, the sculpture itself: a message, and what was there stays.
expect 0 balloon-sculpt --depth 2 -o cube.oct
cp cube.oct kept.oct
ln -s /dev/full full.ply
refused 1 'cannot write: No space left' balloon-surface cube.oct -o full.ply
refused 1 '/proc/a\.ply: cannot create' balloon-surface cube.oct -o /proc/a.ply
refused 1 'no/such/a\.stl: cannot create' balloon-surface cube.oct -o no/such/a.stl
refused 1 '/proc/a\.png: cannot create' balloon-surface cube.oct --render /proc/a.png
refused 1 'no/such/a\.ply: cannot create' balloon-surface cube.oct --threshold 3 -o no/such/a.ply # before the work
ln -s cube.oct same.ply
refused 1 'same\.ply: is read here' balloon-surface cube.oct -o same.ply
same_file cube.oct kept.oct
refused 2 'a\.png: two outputs' balloon-surface cube.oct --render a.png --accuracy-cost ./a.png
ln -s cube.oct a.tsv
refused 1 'a\.tsv: is read here' balloon-surface cube.oct --accuracy-cost a.png # and a.tsv beside it
same_file cube.oct kept.oct
rm a.tsv
echo old >a.ply
refused 1 'no point reaches' balloon-surface cube.oct --threshold 3 -o a.ply
[ "$(cat a.ply)" = old ] || fail "a.ply was touched"
expect 1 sh -c 'balloon-surface cube.oct --info >/dev/full'
stderr_has 'cannot write the results'
only_files cube.oct kept.oct full.ply same.ply a.ply

# A file that may not grow is like a full disk: no more than 1024 bytes here.
if files_can_be_small 2 balloon-surface; then
    expect 1 sh -c 'ulimit -f 2; balloon-surface -q cube.oct -o a.ply'
    stderr_has 'a\.ply: cannot write: File too large'
    one_message
    [ "$(cat a.ply)" = old ] || fail "a.ply was touched"
    only_files cube.oct kept.oct full.ply same.ply a.ply
fi

# Who reads from a pipe gets the mesh.
mkfifo pipe.ply
cat pipe.ply >read.ply &
expect 0 timeout 20 balloon-surface -q cube.oct -o pipe.ply
wait
expect 0 balloon-surface -q cube.oct -o a.ply
same_file read.ply a.ply
