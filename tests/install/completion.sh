# Bash completes what the programs take: all their options, the files and words that an option wants, a scene's keys.
if ! command -v bash >/dev/null; then
    echo "bash is not installed: completion was not tried"
    exit 77
fi
completion=$SOURCE/data/share/balloon.bash
expect 0 bash -n "$completion"

# The words that bash hands over for a line, which ends in the last of them; one answer a line goes to stdout.
cat >answer <<'END'
. "$1"
shift
COMP_WORDS=("$@")
COMP_CWORD=$(($# - 1))
COMP_WORDBREAKS=$' \t\n"\'><=;|&(:'
_balloon "$1"
[ ${#COMPREPLY[@]} = 0 ] || printf '%s\n' "${COMPREPLY[@]}" | sort
END
offers() # ANSWERS WORD...
{
    wanted_answers=$1
    shift
    expect 0 bash answer "$completion" "$@"
    got_answers=$(tr '\n' ' ' <.stdout | sed 's/ $//')
    [ "$got_answers" = "$wanted_answers" ] || fail "offered: $got_answers; wanted: $wanted_answers"
    [ ! -s .stderr ] || fail "stderr is not empty"
}

# Every option of --help and no other, as the program says it.
for name in balloon-sculpt balloon-surface balloon-sim; do
    expect 0 "$name" --help
    options=$(grep -oE '^ +(-., )?--[a-z-]+' .stdout | sed 's/.*--/--/' | sort | tr '\n' ' ')
    offers "${options% }" "$name" -
done
offers '--mesh-series --mesh-series-constant --mesh-series-format' balloon-sim --mesh-s

# Files of the kinds that are read or written, and folders.
mkdir folder
touch a.oct a.cfg a.ply a.vox a.PNG a.tsv 'b c.ply' a.chips a.mp4 a.txt
offers 'a.oct folder' balloon-sculpt ''
offers 'a.oct folder' balloon-surface --info ''
offers 'a.cfg a.ply b c.ply folder' balloon-sim ''
offers 'b c.ply' balloon-sim -o b
offers 'a.chips folder' balloon-sculpt --script ''
offers 'a.chips' balloon-sculpt --script = a
offers 'a.chips a.ply a.vox' balloon-sculpt --export a
offers 'a.PNG a.tsv' balloon-sim a.cfg --accuracy-cost a
offers 'a.mp4' balloon-sim --movie = a
offers 'folder' balloon-sim --frames ''
offers 'a.PNG a.cfg a.chips a.mp4 a.oct a.ply a.tsv a.txt a.vox' balloon-sim --resume a.
offers '' balloon-sim --threads ''
offers 'a.cfg a.ply' balloon-sim --turntable a

# Words. They are written down here and there: each must be one that the program takes.
offers 'descent random' balloon-surface --seeds ''
offers 'vtp' balloon-sim --mesh-series-format = v
offers '0 1 27 64 8 exact' balloon-surface --fields-per-cube ''
expect 0 balloon-sculpt --depth 2 -o cube.oct
for word in descent random; do
    expect 0 balloon-surface cube.oct --seeds $word -o cube.ply
done
for word in 1 8 27 64 exact; do
    expect 0 balloon-surface cube.oct --fields-per-cube $word -o cube.ply
done
expect 0 balloon-surface cube.oct --fields-per-cube 0 --fields-per-area 100 -o shell.ply
for word in ply vtp; do
    expect 0 balloon-sim cube.ply --set time.end=0 --mesh-series series --mesh-series-format $word
done

# Keys, a level at a time: all that --help-scene has, and the words of each.
expect 0 balloon-sim --help-scene
awk '/^[a-z][^ ]*: / { sub(/:$/, "", $1); block = $1; within = 1 } within && /^  [a-z_]+ / { print block "." $1 "=" }' .stdout |
    sed 's/\[\]/[0]/g' | sort >keys
: >reached
reach() # PREFIX: every key below it
{
    bash answer "$completion" balloon-sim --set "$1" >answers
    for found in $(cat answers); do
        case $found in
        *.) reach "$found" ;;
        *) echo "$found" >>reached ;;
        esac
    done
}
reach ''
sort reached >.stdout
command_line='keys that are offered (the lines) and keys of --help-scene'
cmp -s .stdout keys || fail "they differ: $(diff .stdout keys | head -n 3)"
offers 'time.' balloon-sim --set ti
offers 'balloons[12].rip.at=' balloon-sim --set 'balloons[12].rip.a'
offers 'cvode-adams cvode-bdf' balloon-sim --set time.integrator = cv
offers 'cvode-adams cvode-bdf' balloon-sim --set = time.integrator = cv
offers 'crossed' balloon-sim a.cfg --set view.stereo = cr
offers '' balloon-sim --set time.step = ''

# And as a person does it: at the prompt, with the tabulator key.
ply tetra.ply "$tetra_points" "$tetra_triangles"
printf 'time = { end = 0.0; };\nballoons = ( { mesh = "tetra.ply"; } );\n' >tetra.cfg
printf '. "%s"\nballoon-sim tetra.c\t --set time.integ\txp\t --expl\t\nexit\n' "$completion" >keys-pressed
HOME=$PWD INPUTRC=/dev/null TERM=dumb expect 0 timeout 60 sh -c 'bash --norc --noprofile -i <keys-pressed'
stderr_has 'balloon-sim tetra\.cfg +--set time\.integrator=xpbd +--explain'
stdout_has '^off[[:space:]]+gas'
