# What the cases of the simulator's window share, beside lib.sh. PICTURES, if set, is a folder for screenshots, to be looked at.
. "$CASES/lib.sh"
PATH=$SIM:$PATH

# An octahedron, each side split into SPLIT, or 4, and blown up to a sphere: 128 triangles.
awk -v n="${SPLIT:-4}" 'function point(x, y, z,  r, key) {
         r = sqrt(x * x + y * y + z * z); key = x " " y " " z
         if (!(key in number)) { number[key] = points++; place = place sprintf("%.9f %.9f %.9f\n", x / r, y / r, z / r) }
         return number[key]
     }
     function corner(i, j,  k) { k = n - i - j; return point(sx * i, sy * j, sz * k) }
     function triangle(a, b, c) { faces++; list = list (sx * sy * sz > 0 ? "3 " a " " b " " c : "3 " a " " c " " b) "\n" }
     BEGIN {
         for (sx = -1; sx <= 1; sx += 2) for (sy = -1; sy <= 1; sy += 2) for (sz = -1; sz <= 1; sz += 2)
             for (i = 0; i < n; i++) for (j = 0; i + j < n; j++) {
                 triangle(corner(i, j), corner(i + 1, j), corner(i, j + 1))
                 if (i + j < n - 1) triangle(corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1))
             }
         printf "ply\nformat ascii 1.0\nelement vertex %d\nproperty double x\nproperty double y\nproperty double z\n", points
         printf "element face %d\nproperty list uchar int vertex_indices\nend_header\n%s%s", faces, place, list
     }' >ball.ply

# A pressure at which it swells and settles; one eye, 800 x 600.
cat >ball.cfg <<'END'
time = { step = 0.025; end = 10.0; integrator = "symplectic-euler"; guard = "off"; };
view = { size = [800, 600]; stereo = "mono"; camera = [0.0, 0.0, 8.0]; };
balloons = ( { mesh = "ball.ply"; radius = 45; point_mass = 1; pressure = 3; } );
END

open_live() # ARGUMENT...
{
    balloon-sim ball.cfg --window --log live.tsv "$@" >log 2>said </dev/null &
    program=$!
    window=$(timeout 60 xdotool search --sync --onlyvisible --name "balloon-sim" | tail -n 1)
    [ -n "$window" ] || fail "no window"
    wait_title '^ball.cfg - balloon-sim'
    xdotool mousemove --window "$window" 10 10 # not in step: it may be there already
    settle
}

settle() { sleep 0.4; }

# wait_title PATTERN: for ten seconds
wait_title()
{
    tries=0
    until xdotool getwindowname "$window" | grep -Eq -- "$1"; do
        tries=$((tries + 1))
        [ $tries -lt 200 ] || fail "the title is $(xdotool getwindowname "$window"), not $1"
        sleep 0.05
    done
}

pause() { press space; wait_title 'paused'; settle; }

# steps COUNT: so many single steps while it is paused, however slow the machine is
steps() { press $(yes period | head -n "$1"); }

drag() # BUTTON X0 Y0 X1 Y1
{
    pull "$@"
    settle
    release "$1"
}

# Ends it; the log is there then.
quit()
{
    press ctrl+q
    ends 0
    grep -Ev "^balloon-sim: (at .* s: balloons|(at .* s: )?time.step .* is split)" said && fail "it said something beside what the run tells"
    cp live.tsv log
}

# log_has MESSAGE CONDITION: of the rows, as awk sees them: c["time"] and so on are the columns' numbers, `last` holds the last row.
log_has()
{
    awk -F'\t' "NR == 1 { for (i = 1; i <= NF; i++) c[\$i] = i; next }
        { row[NR - 1] = \$0; rows = NR - 1 }
        function at(n, name,  f) { split(row[n < 0 ? rows + 1 + n : n], f, \"\\t\"); return f[c[name]] + 0 }
        function near(a, b) { return (a - b) ^ 2 < 1e-12 * (1 + b * b) }
        END { exit !($2) }" live.tsv || fail "$1"
}

# A picture's header holds its sides as the bytes of whole numbers: ISO 15948, 11.2.2.
is_picture() # FILE WIDTH HEIGHT
{
    [ "$(od -An -tx1 -j16 -N8 "$1" | tr -d ' \n')" = "$(printf '%08x%08x' "$2" "$3")" ] || fail "$1: no picture of $2 x $3"
}

picture() { [ -z "${PICTURES:-}" ] || import -window "$window" "$PICTURES/$1.png"; }
