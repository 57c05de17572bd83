# Mirrors, sandpaper, heat; a script that takes steps back makes the bytes of one that never made them.
cat >hand.chips <<'END'
depth 5
mirror xz
chip sphere 0.1 0.9 0.1 0.2
sandpaper 0.2 0.8 0.2 0.15
step
mirror none
heat 0.5 1 0.5 0.3
step
chip box 0 0 0 1 0.5 1
undo
undo
redo
END
cat >kept.chips <<'END'
depth 5
chip sphere 0.1 0.9 0.1 0.2
chip sphere 0.9 0.9 0.1 0.2
chip sphere 0.1 0.9 0.9 0.2
chip sphere 0.9 0.9 0.9 0.2
mirror xz
sandpaper 0.2 0.8 0.2 0.15
mirror none
heat 0.5 1 0.5 0.3
END
expect 0 balloon-sculpt --script hand.chips --export hand.vox
expect 0 balloon-sculpt --script kept.chips --export kept.vox
same_file hand.vox kept.vox
only_files hand.chips kept.chips hand.vox kept.vox
