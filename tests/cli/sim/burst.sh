# A sphere bursts: a log row and a picture a frame, a contact sheet, the skin at the end, the same hash every time.
cp "$PROGRAMS/data/sphere.ply" "$PROGRAMS/data/sphere.cfg" .
small='--set view.size=[160,60] --set time.end=2'

expect 0 balloon-sim sphere.cfg $small --frames frames --log log.tsv --contact-sheet sheet.png -o end.ply --hash
stdout_has '^2 s in 80 steps: [0-9]+ of [0-9]+ edges and .* pieces; the first edge broke at 0\.[0-9]+ s$'
hash=$(tail -n 1 .stdout)
printf '%s\n' "$hash" | grep -Eqx '[0-9a-f]{16}' || fail "the last line is no hash"

[ "$(ls frames | wc -l)" = 81 ] || fail "there are $(ls frames | wc -l) frames, wanted 81"
a_file frames/frame_0000.png
a_file frames/frame_0080.png
a_file sheet.png
a_file end.ply
[ "$(wc -l <log.tsv)" = 82 ] || fail "the log has $(wc -l <log.tsv) lines, wanted 82"
[ "$(head -n 1 log.tsv)" = "$(printf 'time\tmean_radius\tvolume\tgauge_pressure\tkinetic_energy\telastic_energy\tmax_stretch\tedges_active\ttriangles_active\tarea\tpieces\tlargest_piece_area\tstep\tseconds\tgas_energy\tdissipated_energy\tfracture_energy\tpressure_work\tuser_work\tbalance_error\tcrack_tips\ttorn_length\thole_area\tcrack_energy')" ] ||
    fail "the log's header is: $(head -n 1 log.tsv)"
awk -F'\t' 'NF != 24 || /nan|inf/ { exit 1 }' log.tsv || fail "a row of the log is not 24 numbers"

# the energy's accounts: all is 0 at first; the burst breaks springs that held some; the error is what is left over
awk -F'\t' 'NR == 2 { for (i = 15; i <= 20; i++) if ($i != 0) exit 1 }
    { left = $5 + $6 + $15 + $16 + $17 - $18 - $19 - $20; if (NR > 1 && left * left > 1e-4 * $20 * $20) exit 1 }
    END { if (!($16 > 0 && $17 > 0 && $18 > 0 && $15 == 0 && $19 == 0)) exit 1 }' log.tsv ||
    fail "the energies do not add up: $(tail -n 1 log.tsv)"

# pictures and logs are only watched: the state is the same without them, and again
expect 0 balloon-sim sphere.cfg $small --hash
[ "$(tail -n 1 .stdout)" = "$hash" ] || fail "another hash: $(tail -n 1 .stdout), not $hash"
expect 0 balloon-sim sphere.cfg $small --hash --set 'balloons[0].pressure=10.001'
[ "$(tail -n 1 .stdout)" != "$hash" ] || fail "the pressure does not matter"
