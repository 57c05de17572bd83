# A run with its log, checkpoint and skin, and one that goes on from a checkpoint: over old files.
. "$FAULT/lib.sh"
ply m.ply "$tetra_points" "$tetra_triangles"
cat >a.cfg <<'END'
time = { step = 0.025; end = 0.1; };
view = { size = [64, 48]; rate = 40; };
balloons = ( { mesh = "m.ply"; gas = { ambient = 1.0; }; } );
gravity = { };
ground = { };
END
run='balloon-sim -q a.cfg --threads 2'
$run --set time.end=0.05 --checkpoint run.ck --log a.tsv >/dev/null
for file in a.ply b.ck; do echo old >$file; done
every_call files $run --log a.tsv --checkpoint b.ck -o a.ply --hash
every_call memory $run --log a.tsv --checkpoint b.ck -o a.ply --hash
every_call files balloon-sim -q m.ply --set time.end=0.025 --checkpoint b.ck --checkpoint-every 0
every_call starts $run --log a.tsv -o a.ply
every_call files,lasting $run --resume run.ck --log a.tsv --checkpoint run.ck -o a.ply --hash
every_call memory,lasting $run --resume run.ck --log a.tsv --checkpoint run.ck --hash
for method in implicit-midpoint rk-adaptive xpbd bdf2 auto; do
    every_call memory balloon-sim -q m.ply --set time.end=0.1 --set time.integrator=$method --hash
done
every_call memory $run --set 'balloons[0].membrane.thickness=0.01' --set 'balloons[0].fracture.seed=2' --hash
