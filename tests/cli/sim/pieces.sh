# A table of the pieces at the end: a line each, and together they are what the log's last row says.
cp "$PROGRAMS/data/sphere.ply" "$PROGRAMS/data/sphere.cfg" .
quick='--set time.end=2 --set view.rate=1'
pieces() { awk -F'\t' 'NR > 1' "$1" | wc -l; }
sums_agree() # the pieces' number, area and triangles: %.9g of up to some hundred areas
{
    tail -n 1 log.tsv | awk -F'\t' -v OFS='\t' '{ print $11, $10, $9, $12 }' >last
    awk -F'\t' 'NR == FNR { split($0, want, "\t"); next }
        FNR > 1 { n++; area += $5; triangles += $3; if ($5 > most) most = $5 }
        END { exit !(n == want[1] && triangles == want[3] && (area / want[2] - 1)^2 < 1e-14 && (most / want[4] - 1)^2 < 1e-14) }' \
        last pieces.tsv || fail "the sums are others than the log's: $(cat last)"
}

expect 0 balloon-sim sphere.cfg $quick --pieces pieces.tsv --log log.tsv
[ "$(head -n 1 pieces.tsv | tr '\t' ' ')" = 'piece balloon triangles rest_area area mass centre_x centre_y centre_z velocity_x velocity_y velocity_z spin_x spin_y spin_z' ] ||
    fail "the header is: $(head -n 1 pieces.tsv)"
awk -F'\t' 'NF != 15 || /nan|inf/ { exit 1 }' pieces.tsv || fail "a row is not 15 numbers"
[ "$(pieces pieces.tsv)" -gt 3 ] || fail "the burst left $(pieces pieces.tsv) pieces"
sums_agree

# torn instead: no mass is lost; a whole balloon is one piece, whose mass is that of its points
tear='--set balloons[0].fracture.mode=tear --set balloons[0].rip.at=0'
expect 0 balloon-sim sphere.cfg --set time.end=0.5 --set view.rate=2 $tear --pieces pieces.tsv --log log.tsv
stdout_has ': [0-9]+ of [0-9]+ edges .* pieces?; [0-9]+ edges are torn in two; the first edge broke at'
sums_agree
cp pieces.tsv torn.tsv
expect 0 balloon-sim sphere.cfg --set time.end=0.1 --set view.rate=10 --pieces pieces.tsv --log log.tsv
[ "$(pieces pieces.tsv)" = 1 ] || fail "a whole balloon is $(pieces pieces.tsv) pieces"
sums_agree
awk -F'\t' 'FNR > 1 { mass[FILENAME] += $6 } END { a = mass["torn.tsv"]; b = mass["pieces.tsv"]; exit !((a / b - 1)^2 < 1e-14) }' \
    torn.tsv pieces.tsv || fail "mass was lost in the tear"

# of two balloons: each piece tells whose it is
cat >two.cfg <<'END'
balloons = ( { mesh = "sphere.ply"; }, { mesh = "sphere.ply"; position = [200.0, 0.0, 0.0]; } );
END
expect 0 balloon-sim two.cfg --set time.end=0.1 --set view.rate=10 --pieces pieces.tsv
[ "$(cut -f 2 pieces.tsv | sort | tr '\n' ' ')" = '0 1 balloon ' ] || fail "the balloons are: $(cut -f 2 pieces.tsv)"

# a failed run leaves the old table, and what cannot be written is found out beforehand
echo old >pieces.tsv
refused 1 'no/such/pieces.tsv: cannot create' balloon-sim sphere.cfg $quick --pieces no/such/pieces.tsv
expect 3 balloon-sim sphere.cfg --set time.step=1 --set time.guard=off --set balloons[0].threshold=1e300 --set time.end=1000 --pieces pieces.tsv
[ "$(cat pieces.tsv)" = old ] || fail "the old table is gone"
