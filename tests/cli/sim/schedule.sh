# What the paper's user changes by hand between two steps, a scene changes by its schedule.
ply m.ply "$tetra_points" "$tetra_triangles"
cat >s.cfg <<'END'
time = { step = 0.01; end = 0.1; };
view = { rate = 100; };
balloons = ( { mesh = "m.ply"; pressure = 1; } );
schedule = ( { at = 0.05; pressure = 2; }, { at = 0.08; step = 0.005; } );
END
expect 0 balloon-sim s.cfg --log log.tsv
awk -F'\t' 'NR > 1 { want = $1 > 0.0501 ? 2 : 1; if ($4 != want) exit 1 }' log.tsv || fail "the pressure did not change at .05"
[ "$(tail -n 1 log.tsv | cut -f 13)" = 0.005 ] || fail "the step did not change"
stdout_has '^0.1 s in 12 steps'
