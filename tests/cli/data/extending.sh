# The page on effects and integrators: its files and changes on a copy of the sources, built and run as it says.
source_root=$(dirname "$case_file")/../../..
page=$source_root/data/extending.md
command -v patch >/dev/null || { echo "the program patch is not installed" && exit 77; }

# fences LABEL: what stands between ```LABEL and ```.
fences() { awk -v open='```'"$1" '$0 == open { on = 1; next } $0 == "```" { on = 0 } on' "$page"; }

balloon-sculpt -q --depth 1 -o cube.oct
balloon-surface -q cube.oct --cube-size 0.3 -o cube.ply

mkdir copy
for part in meson.build meson_options.txt common render surface sim sculpt data tests; do
    cp -r "$source_root/$part" copy
done
for file in sim/effect_swirl.c sim/rk3.c; do
    fences $file >copy/$file
    a_file copy/$file
done
fences diff >changes
expect 0 patch -d copy -p1 --no-backup-if-mismatch -i "$PWD/changes"
expect 0 meson setup copy/build copy -Dbuildtype=plain -Dwerror=true -Dc_args=-O1
expect 0 ninja -C copy/build sim/balloon-sim
PATH=$PWD/copy/build/sim:$PATH

fences sh >commands
[ "$(wc -l <commands)" = 4 ] || fail "the page has $(wc -l <commands) commands"
while read -r line; do
    expect 0 sh -c "$line"
    case $line in *--explain*) stdout_has '^on	swirl	the scene has the block' ;; esac
done <commands

# The whirl's torque is rate x the moment of inertia, so after a second the spin is 2 at the most; less by as much as that moment
# has grown, since what spins flies outward: a few hundredths.
awk -F'\t' 'NR == 1 { for (i = 1; i <= NF; i++) name[i] = $i }
    NR == 2 { for (i = 1; i <= NF; i++) value[name[i]] = $i; exit !(value["spin_y"] > 1.5 && value["spin_y"] < 2) }' spun.tsv ||
    fail "it does not spin: $(cat spun.tsv)"
awk -F'\t' 'NR == 1 { for (i = 1; i <= NF; i++) name[i] = $i }
    { for (i = 1; i <= NF; i++) value[name[i]] = $i }
    END { share = value["balance_error"] / (1e-9 + value["kinetic_energy"]); exit !(share < 0.1 && share > -0.1) }' log.tsv ||
    fail "the account does not close: $(tail -n 1 log.tsv)"
awk -F'\t' '$1 == "rk3" { rows++; if ($7 > 2.6 && $7 < 3.4) near++ } END { exit !(rows >= 3 && near >= 2) }' cost.tsv ||
    fail "rk3 is not of order 3: $(grep '^rk3' cost.tsv)"
