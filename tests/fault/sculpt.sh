# A sculpture carved by a script, out of a model, and handed out in each way: over old files.
. "$FAULT/lib.sh"
printf 'depth 4\nchip sphere 0.5 0.5 0.5 0.3\nfill box 0 0 0 0.3 0.3 0.3\nsandpaper 0.5 0.5 0.5 0.4\n' >a.chips
balloon-sculpt -q --script a.chips -o begun.oct --export model.vox --export begun.ply
for file in a.oct a.vox a.ply b.chips; do echo old >$file; done
every_call files balloon-sculpt -q --script a.chips -o a.oct --export a.vox --export a.ply --export b.chips --info
every_call memory balloon-sculpt --script a.chips -o a.oct --export a.vox --export a.ply --export b.chips --info
every_call files balloon-sculpt -q --import model.vox -o a.oct
every_call memory balloon-sculpt --import model.vox --solid -o a.oct
every_call memory balloon-sculpt --import begun.ply --depth 4 --solid -o a.oct
every_call files,lasting balloon-sculpt -q begun.oct --export a.vox --export b.chips -o begun.oct
every_call memory,lasting balloon-sculpt -q begun.oct --export a.vox -o begun.oct
every_call starts balloon-sculpt -q begun.oct -o a.oct --render a.png
every_call files balloon-sculpt -q begun.oct --render a.png
