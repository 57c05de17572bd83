# The demo's balloons, torn instead of shattered: springs under the paper's constant pressure come apart, fly, and no number runs away. The
# skin is whole: all triangles are left, in pieces.
for name in sphere triangle dog; do
    cp "$PROGRAMS/data/$name.ply" "$PROGRAMS/data/$name.cfg" .
    expect 0 balloon-sim "$name.cfg" --quiet --set 'balloons[0].fracture.mode=tear' --set 'balloons[0].fracture.strength=1.3' \
        --set time.guard=substep --set time.end=2 --log log.tsv --hash
    stdout_has '([0-9]+) of \1 triangles are left, in ([2-9]|[0-9]{2,}) pieces'
    [ ! -s .stderr ] || fail "$name warns: $(cat .stderr)"
    # what moves is what the pressure worked, less what is held and damped: it started at rest
    awk -F'\t' 'NR == 1 { if ($5 != "kinetic_energy" || $18 != "pressure_work") exit 1; next }
        /nan|inf/ { exit 1 } { kinetic = $5; work = $18 } END { if (!(kinetic < work)) exit 1 }' log.tsv || fail "$name flies with more than it got: $(tail -n 1 log.tsv)"
done
