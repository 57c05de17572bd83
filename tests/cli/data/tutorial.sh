# The tutorial's files and commands, as a reader would take them from the page, with fewer triangles and smaller pictures.
source_root=$(dirname "$case_file")/../../..
page=$source_root/data/tutorial.md

# fences LANGUAGE: what stands between ```LANGUAGE and ```.
fences() { awk -v open='```'"$1" '$0 == open { on = 1; next } $0 == "```" { on = 0 } on' "$page"; }

# The files of the page are those of the house.
fences octopus.chips >octopus.chips
fences octopus.cfg >octopus.cfg
same_file octopus.chips "$source_root/data/sculptures/octopus.chips"
same_file octopus.cfg "$source_root/data/scenes/octopus.cfg"

# Its pictures are there.
for picture in $(sed -n 's/^!\[.*\](\(.*\))$/\1/p' "$page"); do
    a_file "$source_root/data/$picture"
done

# What accuracy is priced on here, in place of the octopus: small, and of springs.
sed 's/^depth 7/depth 4/' octopus.chips >small.chips
expect 0 balloon-sculpt -q --script small.chips -o small.oct
expect 0 balloon-sculpt -q --depth 1 -o cube.oct
expect 0 balloon-surface -q cube.oct --cube-size 0.3 -o cube.ply
calm='cube.ply --set time.end=0.1 --set balloons[0].pressure=4 --set balloons[0].point_mass=1 --set balloons[0].threshold=100'

# Its commands, each with what makes it short, and tables where no program draws plots.
shorter='--set view.size=[96,48] --set view.rate=8'
plots=png
command -v gnuplot >/dev/null || plots=tsv
fences sh | sed -E -e 's/--triangles [0-9]+/--triangles 3000/' -e 's/view\.samples=2/view.samples=1/' \
    -e "/-cost /s/\.png/.$plots/" -e "/accuracy-cost/{s/octopus\.oct/small.oct/; s/octopus\.ply/$calm/}" \
    -e '/effect-cost/s/$/ --set time.end=0.05/' \
    -e "/^balloon-sim /s/\$/ $shorter/" >commands
[ "$(wc -l <commands)" -ge 12 ] || fail "the page has $(wc -l <commands) commands"
while read -r line; do
    case $line in *--movie*) command -v ffmpeg >/dev/null || continue ;; esac
    expect 0 sh -c "$line"
    case $line in
    *--info*) [ -s .stdout ] || fail "no figures" ;;
    *whole.png*) stdout_has 'in 1 piece; nothing broke$' ;;
    *pricked.png*) stdout_has 'the first edge broke at [12]\.' ;;
    *wind.png*) stdout_has 'nothing broke$' ;;
    esac
done <commands
for made in sculpture.png skin.png paper.png whole.png whole.tsv pricked.png pricked.tsv wind.png accuracy.$plots mesh.$plots \
    effects.$plots octopus-burst.ply octopus-burst.pc2 burst/mesh.vtp.series; do
    a_file $made
done
! command -v ffmpeg >/dev/null || a_file octopus.mp4
