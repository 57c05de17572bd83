# A full disk, a read-only folder, a file where a folder should be: a message, and what was there stays.
ply m.ply "$tetra_points" "$tetra_triangles"
short='--set time.end=0.1 --set view.size=[64,48]'
refused 1 '/dev/full: cannot write: No space left' balloon-sim m.ply $short --log /dev/full
refused 1 '/proc/log.tsv: cannot create' balloon-sim m.ply $short --log /proc/log.tsv
refused 1 'no/such/log.tsv: cannot create' balloon-sim m.ply $short --log no/such/log.tsv
echo here >frames
refused 1 'frames: is a file' balloon-sim m.ply $short --frames frames --log log.tsv
[ "$(cat frames)" = here ] || fail "the file is gone"
no_file log.tsv
refused 1 '/proc/frames: cannot make' balloon-sim m.ply $short --frames /proc/frames
refused 1 '/proc/sheet.png: cannot' balloon-sim m.ply $short --contact-sheet /proc/sheet.png
refused 1 '/dev/full: cannot write' balloon-sim m.ply $short --contact-sheet /dev/full
refused 2 '-o end.xyz: must end in .ply, .stl or .obj' balloon-sim m.ply $short -o end.xyz --log log.tsv
no_file end.xyz
no_file log.tsv
echo old >log.tsv
refused 1 '/proc/end.ply: cannot create' balloon-sim m.ply $short --log log.tsv -o /proc/end.ply # before the run, which would take its place
refused 1 '/proc/plot.png: cannot create' balloon-sim m.ply $short --log log.tsv --plot /proc/plot.png
[ "$(cat log.tsv)" = old ] || fail "the log is another"
mkfifo pipe
cat pipe >table.tsv &
expect 0 timeout -s KILL 20 balloon-sim m.ply $short --pieces pipe # asking beforehand whether it can be written would end what reads
wait $!
[ "$(wc -l <table.tsv)" = 2 ] || fail "the table of the pieces did not come through the pipe"
rm pipe table.tsv
refused 1 '^balloon-sim: end.ply: no skin is left to be written at 0.1 s; give an earlier time.end, or --mesh-series$' \
    balloon-sim -q m.ply $short -o end.ply --set balloons[0].threshold=1.001 --set balloons[0].pressure=1000
only_files m.ply frames log.tsv
expect 1 sh -c 'balloon-sim "$@" >/dev/full' sh m.ply --hash $short
stderr_has 'cannot write the results'

# A name that a script left empty is no name, and that is found out before the run.
for output in --log --checkpoint --pieces --frames --mesh-series; do
    refused 1 '^balloon-sim: "": cannot (create|make the folder): No such file' balloon-sim m.ply --set time.end=1e9 $output ''
done
refused 1 '^balloon-sim: "": cannot open: No such file' balloon-sim ''

# --check says so too, and writes nothing.
refused 1 'frames: is a file; give the name of a folder$' balloon-sim m.ply --check --mesh-series frames
for output in '--frames /proc/f' '--mesh-series /proc/f/' '--movie /proc/f.mp4' '--contact-sheet /proc/f.png' '--log /proc/f' '--plot /proc/f.png' \
    '--point-cache /proc/f.pc2' '--pieces /proc/f' '--checkpoint /proc/f' '-o /proc/f.ply'; do
    refused 1 '^balloon-sim: /proc/f[a-z0-9.]*: cannot create: ' balloon-sim m.ply --check $output
done
mkdir beside.ply # the mesh that the point cache moves
for check in '' --check; do
    refused 1 'beside.ply: is a folder' balloon-sim m.ply $short $check --point-cache beside.pc2
done
rmdir beside.ply
mkdir cost.png # whose table could be written beside it
for check in '' --check; do
    refused 1 '^balloon-sim: cost.png: is a folder; give the name of a file in it$' balloon-sim m.ply $short --accuracy-cost cost.png $check
    refused 1 '^balloon-sim: /proc/f.tsv: cannot create: ' balloon-sim m.ply $short --effect-cost /proc/f.tsv --set drag.wind=[1.0,0.0,0.0] $check
done
rmdir cost.png
refused 1 'm.ply: not a checkpoint' balloon-sim m.ply --check --resume m.ply
expect 0 balloon-sim m.ply --check --frames new --mesh-series new/ --movie new.mp4 --contact-sheet new.png --log new --plot new1.png --point-cache new.pc2 \
    --pieces new.tsv --checkpoint new.ck -o new1.ply
[ ! -s .stderr ] || fail "something is told"
only_files m.ply frames log.tsv

# No output takes the place of what is read, or of another output.
cp m.ply kept.ply
echo 'balloons = ( { mesh = "m.ply"; } );' >m.cfg
cp m.cfg kept.cfg
refused 1 'm\.ply: is read here, and would be replaced' balloon-sim m.ply $short --point-cache m.pc2 # and m.ply beside it
refused 1 './m\.ply: is read here' balloon-sim m.cfg $short -o ./m.ply
refused 1 'm\.cfg: is read here' balloon-sim m.cfg $short --log m.cfg
refused 2 './a\.tsv: two outputs would go there' balloon-sim m.cfg $short --log a.tsv --pieces ./a.tsv
refused 2 'a\.png: two outputs would go there' balloon-sim m.cfg $short --plot a.png --contact-sheet a.png
refused 2 'a\.ply: two outputs would go there' balloon-sim m.cfg $short --point-cache a.pc2 -o a.ply
mv m.cfg m.tsv
refused 1 'm\.tsv: is read here' balloon-sim m.tsv $short --accuracy-cost m.png # and m.tsv beside it

# Nor do those in folders, whose names are not given.
mkdir series
cp m.ply series/mesh_0003.ply # which a shorter series would remove
ln -s series/mesh_0003.ply link.ply
for mesh in series/mesh_0003.ply link.ply; do
    refused 1 "^balloon-sim: $mesh: is read here, and would be replaced or removed by what goes into ./series/; give another folder$" \
        balloon-sim $mesh $short --mesh-series ./series/
done
refused 2 '^balloon-sim: series/mesh_0001.ply: two outputs would go there' balloon-sim m.ply $short --mesh-series series -o series/mesh_0001.ply
refused 2 'series/mesh.ply.series: two outputs would go there' balloon-sim m.ply $short --mesh-series series --log series/mesh.ply.series
refused 2 'series/frame_0000.png: two outputs would go there' balloon-sim m.ply $short --frames series --plot series/frame_0000.png
refused 2 'a-left.png: two outputs would go there' balloon-sim m.ply $short --set view.stereo=separate --contact-sheet a.png --plot a-left.png
[ "$(echo series/*)" = series/mesh_0003.ply ] || fail "there is $(echo series/*)"
expect 0 balloon-sim series/mesh_0003.ply $short --mesh-series series --mesh-series-format vtp -o series/mesh_3.ply
same_file m.ply series/mesh_0003.ply
rm -r series link.ply
same_file m.ply kept.ply
same_file m.tsv kept.cfg
only_files m.ply frames log.tsv kept.ply kept.cfg m.tsv
