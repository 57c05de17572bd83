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
