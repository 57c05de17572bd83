# Missing, empty, truncated and foreign files; a sculpture with nothing in it: one message, no mesh.
refused 1 'none\.oct: cannot open' balloon-surface none.oct -o a.ply
: >nothing.oct
refused 1 'nothing\.oct' balloon-surface nothing.oct -o a.ply
expect 0 balloon-sculpt --depth 3 -o cube.oct
head -c 20 cube.oct >short.oct
refused 1 'short\.oct' balloon-surface short.oct -o a.ply
head -c 4000 /dev/zero >foreign.oct
refused 1 'foreign\.oct' balloon-surface foreign.oct -o a.ply
echo 'start empty' >empty.chips
expect 0 balloon-sculpt --script empty.chips -o empty.oct
refused 1 'empty\.oct: the sculpture is empty' balloon-surface empty.oct -o a.ply
no_file a.ply
