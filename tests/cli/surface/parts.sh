# Each part of a sculpture is found, and --info says how.
cat >parts.chips <<'END'
depth 5
start empty
fill sphere 0.2 0.2 0.2 0.1
fill sphere 0.8 0.2 0.2 0.1
fill sphere 0.5 0.8 0.5 0.15
chip sphere 0.5 0.8 0.5 0.08
END
expect 0 balloon-sculpt --script parts.chips -o parts.oct
expect 0 balloon-surface parts.oct --info
stdout_has '^components +4$'
stdout_has '^euler +8$'
stdout_has '^seeds +4 parts found by descent$'
expect 0 balloon-surface parts.oct --info --seeds random --seed 3
stdout_has '^components +4$'
stdout_has '^seeds +[0-4] of 4 parts found by random points alone$'

# Without --info a line says so, with the largest one's share; not with --quiet, and not of one part.
expect 0 balloon-surface parts.oct -o parts.ply
stderr_has '^balloon-surface: the mesh is no single balloon but 4 parts that do not hang together, the largest with (4[0-9]|5[0-9])(\.[0-9])? % of the area; a larger --sigma or a smaller --threshold joins what is near; 1 is the wall of a hollow within: balloon-sculpt parts\.oct --solid -o FILE\.oct fills it$'
one_message
expect 0 balloon-surface parts.oct -o parts.ply --quiet
[ ! -s .stderr ] || fail "something is told"
expect 0 balloon-surface parts.oct -o parts.ply --sigma 5 --threshold 0.1
[ ! -s .stderr ] || fail "one part is told to be several"
expect 0 balloon-sculpt parts.oct --solid -o solid.oct
expect 0 balloon-surface solid.oct -o parts.ply
stderr_has 'no single balloon but 3 parts .* is near$'
