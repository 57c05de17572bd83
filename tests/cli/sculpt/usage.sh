# Wrong usage ends with 2, help and version with 0; with nothing to do the batch options are named.
expect 0 balloon-sculpt --help
stdout_has '--script=FILE\.chips'
expect 0 balloon-sculpt --version
stdout_has '^balloon-sculpt [0-9]+\.[0-9]+\.[0-9]+$'
refused 1 'no window.*--script.*--render' balloon-sculpt
refused 1 'no window.*--script.*--render' balloon-sculpt new.oct
refused 2 'unrecognized option' balloon-sculpt --no-such
refused 2 'one FILE\.oct is carved at a time' balloon-sculpt a.oct b.oct
refused 2 '--depth 11: must be a whole number from 0 to 10' balloon-sculpt --depth 11 -o a.oct
refused 2 '--depth x: must be a whole number' balloon-sculpt --depth x -o a.oct
refused 2 '--undo-memory 0: must be a whole number from 1 to 65536' balloon-sculpt --undo-memory 0
expect 0 balloon-sculpt --undo-memory 5 -o a.oct
stderr_has '--undo-memory does nothing: only the window undoes'
rm a.oct
refused 2 '--depth 3: a\.oct has its own' balloon-sculpt a.oct --depth 3 --info
refused 2 'give one of them to begin with' balloon-sculpt a.oct --import b.vox --info
refused 2 '--export a\.stl: \.vox, \.ply and \.chips are written' balloon-sculpt --export a.stl
refused 2 'nothing is done with the sculpture: give -o' balloon-sculpt --script a.chips
no_file a.oct
no_file new.oct

# What is written says what it is.
refused 2 '-o x.ply: the name must end in .oct' balloon-sculpt --depth 1 -o x.ply
refused 2 '--render x.jpg: the name must end in .png' balloon-sculpt --depth 1 --render x.jpg
no_file x.ply
no_file x.jpg
echo 'start empty' >s.chips
refused 1 's.chips: not an .oct file: .*--script or --import makes one$' balloon-sculpt s.chips --info
