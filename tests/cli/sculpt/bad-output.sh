# A full disk, a read-only folder, an impossible name: a message, and what was there stays.
refused 1 '/dev/full: cannot write: No space left' balloon-sculpt -o /dev/full
refused 1 '/proc/a\.oct: cannot create' balloon-sculpt -o /proc/a.oct
refused 1 'no/such/a\.oct: cannot create' balloon-sculpt -o no/such/a.oct
refused 1 '/proc/a\.vox: cannot create' balloon-sculpt --export /proc/a.vox
refused 1 '/proc/a\.ply: cannot create' balloon-sculpt --export /proc/a.ply
refused 1 '/proc/a\.chips: cannot create' balloon-sculpt --export /proc/a.chips
refused 1 '/proc/a\.png: cannot create' balloon-sculpt --render /proc/a.png
mkdir folder.oct
refused 1 'folder\.oct: is a folder' balloon-sculpt -o folder.oct
echo 'start empty' >empty.chips
refused 1 'a\.vox: the sculpture is empty' balloon-sculpt --script empty.chips --export a.vox
refused 1 'a\.ply: the sculpture is empty' balloon-sculpt --script empty.chips --export a.ply
only_files folder.oct empty.chips
expect 1 sh -c 'balloon-sculpt --info >/dev/full'
stderr_has 'cannot write the results'

# No output takes the place of what is read, or of another output.
echo 'start empty # by hand' >hand.chips
cp hand.chips before.chips
expect 0 balloon-sculpt --depth 2 --export model.ply
cp model.ply before.ply
refused 1 'hand\.chips: is read here' balloon-sculpt --script hand.chips --export ./hand.chips
refused 1 'model\.ply: is read here' balloon-sculpt --import model.ply --export model.ply
refused 2 './a\.vox: two outputs' balloon-sculpt --export a.vox --export ./a.vox
same_file hand.chips before.chips
same_file model.ply before.ply
rm hand.chips before.chips model.ply before.ply

# A file that may not grow is like a full disk: no more than 1024 bytes here.
expect 0 balloon-sculpt --depth 3 -o kept.oct
cp kept.oct before.oct
echo 'chip sphere 0.5 0.5 1 0.4' >carve.chips
if files_can_be_small 2 balloon-sculpt; then
    expect 1 sh -c 'ulimit -f 2; balloon-sculpt kept.oct --script carve.chips -o kept.oct'
    stderr_has 'kept\.oct: cannot write: File too large'
    one_message
fi
same_file kept.oct before.oct
only_files folder.oct empty.chips kept.oct before.oct carve.chips
