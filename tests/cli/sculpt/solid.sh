# A hollow model: told of when it comes in, filled on request.
cat >shell.chips <<'END'
depth 3
start empty
material 5
fill box 0.25 0.25 0.25 0.75 0.75 0.75
chip box 0.375 0.375 0.375 0.625 0.625 0.625
END
expect 0 balloon-sculpt --script shell.chips --export shell.vox -o shell.oct
expect 0 balloon-sculpt --import shell.vox -o hollow.oct --info
stdout_has '^cells +56$'
stderr_has 'shell\.vox is hollow: 8 cells within are empty; --solid fills them'
expect 0 balloon-sculpt hollow.oct --export hollow.vox
same_file hollow.vox shell.vox
expect 0 balloon-sculpt --import shell.vox -q --info
[ ! -s .stderr ] || fail "-q did not silence the note"
expect 0 balloon-sculpt --import shell.vox --solid --info
stdout_has '^material 5 +64 cells'
expect 0 balloon-sculpt shell.oct --solid --info
stdout_has '^cells +64$'
refused 2 '--solid: a new cube has no hollows' balloon-sculpt --solid -o a.oct
