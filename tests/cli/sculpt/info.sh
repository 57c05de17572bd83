# The figures of sculptures that can be counted by hand.
expect 0 balloon-sculpt --info
stdout_has '^depth +6 \(64 cells a side\)$'
stdout_has '^cells +262144$'
stdout_has '^leaves +1, 1 of them full$'
stdout_has '^exposed faces +24576$'
stdout_has '^bounds x +0 to 63 \(0 to 1\)$'
stdout_has '^material 1 +262144 cells, coefficient 1$'

# An eighth is gone: the faces are as many as before.
cat >corner.chips <<'END'
coefficient 1 0.5
chip box 0.5 0.5 0.5 1 1 1
END
expect 0 balloon-sculpt --depth 2 --script corner.chips --info
stdout_has '^cells +56$'
stdout_has '^volume +0\.875$'
stdout_has '^leaves +8, 7 of them full$'
stdout_has '^exposed faces +96$'
stdout_has '^face area +6$'
stdout_has '^material 1 +56 cells, coefficient 0\.5$'

# Nothing is left.
echo 'chip box 0 0 0 1 1 1' >all.chips
expect 0 balloon-sculpt --script all.chips --info
stdout_has '^cells +0$'
