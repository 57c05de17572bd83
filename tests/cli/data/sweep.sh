# A grid of runs: what is killed is run again, and nothing else; names that need quotes; what cannot be swept is refused.
mkdir "it's a folder" bin
cp "$PROGRAMS/data/sphere.ply" "$PROGRAMS/data/sphere.cfg" "it's a folder"
scene="it's a folder/sphere.cfg"

# Stands for the simulator: notes each run, and dies where it is told to; with what called it, too.
cat >bin/balloon-sim <<END
#!/bin/sh
case "\$*" in *--check*) exec "$PROGRAMS/sim/balloon-sim" "\$@" ;; esac
echo "\$*" | grep -o 'spring=.*' >>"$PWD/runs"
case "\$*" in
*spring=20*step=0.05*) [ -e "$PWD/go-on" ] || kill -9 \$\$ ;;
*spring=40*step=0.02*) [ -e "$PWD/go-on" ] || kill -9 \$PPID \$\$ ;;
esac
exec "$PROGRAMS/sim/balloon-sim" "\$@"
END
chmod +x bin/balloon-sim
sweep() { PATH="$PWD/bin:$PATH" BALLOON_SIM="$PWD/bin/balloon-sim" "$SWEEP" "$@"; }

killed_and_resumed() # SCENE --out DIR ...
{
    rm -f runs go-on
    expect 1 sweep "$@"
    stdout_has '^2 of 4 points are there; 1 failed, .* say why; 1 were not run to their end; the same command runs them again'
    [ "$(wc -l <runs)" = 4 ] || fail "not 4 runs: $(cat runs)"
    cut -f 1,2,7 "$3/sweep.tsv" >table
    printf '%s\t%s\t%s\n' 'balloons[0].spring' time.step exit_status 20 0.02 0 20 0.05 137 40 0.02 nan 40 0.05 0 >wanted
    same_file table wanted

    touch go-on
    expect 0 sweep "$@"
    stdout_has '^4 of 4 points are there: '
    sort runs | uniq -c | awk '{ print $1 }' | tr '\n' ' ' >counts
    [ "$(cat counts)" = '1 2 2 1 ' ] || fail "runs of each point: $(cat counts)"
    [ -z "$(ls "$3/work")" ] || fail "work was left behind"
    expect 0 sweep "$@"
    [ "$(wc -l <runs)" = 6 ] || fail "what was there was run again"
}

printf '#!/bin/sh\nexit 1\n' >bin/parallel # not GNU's
chmod +x bin/parallel
killed_and_resumed "$scene" --out "without parallel" --jobs 1 'balloons[0].spring=20:40:2' time.step=0.02:0.05:2 --set time.end=2
rm bin/parallel
set -- "$scene" --out "the sweep's" --jobs 1 'balloons[0].spring=20:40:2' time.step=0.02:0.05:2 --set time.end=2
killed_and_resumed "$@"

# a row says what a run of its own says
expect 0 balloon-sim "$scene" --set 'balloons[0].spring=20' --set time.step=0.05 --set time.end=2 --pieces pieces.tsv --log log.tsv
awk -F '\t' -v burst="$(grep -o 'broke at [^ ]*' .stdout | cut -c 10-)" '
    FILENAME == "log.tsv" && FNR == 2 { whole = $10 }
    FILENAME == "pieces.tsv" && FNR > 1 { left += $4; if (FNR == 2) largest = $4 }
    END { printf "%s\t%.6g\t%.6g\t%d\t0\n", burst, left / whole, largest / whole, FNR - 1 }' log.tsv pieces.tsv >wanted
sed -n 3p "the sweep's/sweep.tsv" | cut -f 3-7 >row
same_file row wanted

if command -v gnuplot >/dev/null; then
    a_file "the sweep's/sweep.png"
    expect 0 sweep "$@" --curve "what's stable=0.6/x"
    head -c 4 "the sweep's/sweep.png" | grep -q PNG || fail "the map is no PNG"
    expect 1 sweep "$@" --curve 'nothing=0.6/'
    stderr_has 'gnuplot failed, no map: '
fi

# The map's axes have the keys' units.
printf '#!/bin/sh\ncp script "%s/script"; : >map.png\n' "$PWD" >bin/gnuplot
chmod +x bin/gnuplot
expect 0 sweep "$@"
rm bin/gnuplot
grep -qxF "set xlabel 'balloons[0].spring, force/length' noenhanced" script && grep -qxF "set ylabel 'time.step, s' noenhanced" script ||
    fail "the axes: $(grep label script)"

# diverged is a result
expect 0 sweep "$scene" --out diverged time.step=0.02:0.3:2 --set 'balloons[0].threshold=1e9'
stdout_has '^2 of 2 points are there, 1 of them diverged: '

refused 1 'holds another sweep' sweep "$scene" --out "the sweep's" time.step=0.02:0.05:2
echo '# changed' >>"$scene"
refused 1 'holds another sweep, or that of a scene that has changed since' sweep "$@"
refused 1 'sprong.*unknown|unknown.*sprong|sprong' sweep "$scene" --out new 'balloons[0].sprong=1:2:2'
no_file new/plan
refused 2 'KEY=FROM:TO:COUNT' sweep "$scene" --out new time.step=1:2
refused 2 'FROM and TO are numbers' sweep "$scene" --out new time.step=a:2:3
refused 2 'above 0' sweep "$scene" --out new time.step=0:2:3:log
refused 2 'the same' sweep "$scene" --out new time.step=2:2:3
refused 2 'usage: ' sweep "$scene" time.step=1:2:3
refused 2 'no such option' sweep "$scene" --fast --out new time.step=1:2:3
refused 1 'there is no such file' sweep none.cfg --out new time.step=1:2:3
