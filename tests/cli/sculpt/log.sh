# A saved sculpture knows how it was made, as long as chips made it.
cat >first.chips <<'END'
depth 4
material 2
start full
chip sphere 0.5 0.5 0.5 0.3
step
chip box 0 0 0 1 1 0.1
step
undo
END
cat >second.chips <<'END'
mirror x
material 9
coefficient 9 0.25
fill sphere 0.3 0.5 0.5 0.1
END
expect 0 balloon-sculpt --script first.chips -o a.oct --info
stdout_has '^chip log +[0-9]+ bytes$'
stdout_has '^preview +[0-9]+ bytes$'
expect 0 balloon-sculpt a.oct --script second.chips -o b.oct --export log.chips
cat >wanted.chips <<'END'
depth 4
material 2
start full
coefficient 9 0.25
chip sphere 0.5 0.5 0.5 0.3
mirror x
material 9
fill sphere 0.3 0.5 0.5 0.1
END
same_file wanted.chips log.chips
expect 0 balloon-sculpt --script log.chips -o c.oct
same_file b.oct c.oct

# What no chip has made has no log, and its script is its leaves.
expect 0 balloon-sculpt --script log.chips --export model.vox
expect 0 balloon-sculpt --import model.vox --script second.chips -o d.oct --info --export leaves.chips
stdout_has '^chip log +none$'
grep -q '^start empty' leaves.chips || fail "leaves.chips is no list of leaves"
expect 0 balloon-sculpt a.oct --solid -o e.oct --info
stdout_has '^chip log +none$'

# A preview cannot be drawn of nothing, and a sculpture is saved without.
echo 'chip box 0 0 0 1 1 1' >all.chips
expect 0 balloon-sculpt --script all.chips -o none.oct --info
[ ! -s .stderr ] || fail "stderr is not empty"
stdout_has '^preview +none$'
