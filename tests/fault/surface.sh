# A mesh of each kind over an old one, its figures as text and as JSON, and its picture. (One thread where the figures are
# compared: memory depends on who did what.)
. "$FAULT/lib.sh"
printf 'depth 4\nchip sphere 0.5 0.5 0.5 0.3\n' >a.chips
balloon-sculpt -q --script a.chips -o a.oct
for file in a.ply a.stl a.obj a.png; do echo old >$file; done
every_call files balloon-surface -q a.oct -o a.ply --cube-size 0.2 --info --threads 1
every_call memory balloon-surface -q a.oct -o a.ply --cube-size 0.2 --json --threads 1
every_call starts balloon-surface -q a.oct -o a.ply --cube-size 0.2 --threads 3
every_call files balloon-surface -q a.oct -o a.stl --triangles 200 --relax 2
every_call memory,lasting balloon-surface -q a.oct -o a.obj --triangles 200 --seeds random
every_call files balloon-surface -q a.oct --cube-size 0.2 --render a.png
every_call starts balloon-surface -q a.oct --cube-size 0.2 --render a.png
