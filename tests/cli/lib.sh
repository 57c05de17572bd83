# What a case may say. A check that does not hold ends the case with a line that says why.

# expect EXIT COMMAND...: runs it; stdout and stderr are kept for the checks that follow.
expect()
{
    wanted=$1
    shift
    command_line=$*
    got=0
    "$@" >.stdout 2>.stderr </dev/null || got=$?
    [ "$got" = "$wanted" ] || fail "exit $got, wanted $wanted"
}

fail()
{
    echo "FAILED: $command_line" >&2
    echo "  $1" >&2
    sed 's/^/  stdout: /' .stdout | head -n 20 >&2
    sed 's/^/  stderr: /' .stderr | head -n 20 >&2
    exit 1
}

# An extended regular expression that some line of the output matches.
stdout_has() { grep -Eq -- "$1" .stdout || fail "no line of stdout matches: $1"; }
stderr_has() { grep -Eq -- "$1" .stderr || fail "no line of stderr matches: $1"; }

# One message, on one line: what a refused input gets.
one_message() { [ "$(wc -l <.stderr)" = 1 ] || fail "stderr has $(wc -l <.stderr) lines, wanted one"; }

# refused EXIT PATTERN COMMAND...: the exit code, one message that matches, and nothing on stdout.
refused()
{
    refused_exit=$1
    refused_pattern=$2
    shift 2
    expect "$refused_exit" "$@"
    stderr_has "$refused_pattern"
    [ "$refused_exit" = 2 ] || one_message
    [ ! -s .stdout ] || fail "stdout is not empty"
}

# A case that cannot be had here ends with 77 and a line that says why.
skipped()
{
    echo "$1: nothing was checked"
    exit 77
}
needs() { command -v "$1" >/dev/null || skipped "$1 is not installed"; }

# files_can_be_small BLOCKS PROGRAM: whether the program can begin where no file may be larger; the thread sanitizer writes one of its own.
files_can_be_small() { (ulimit -f "$1" && "$2" --version) >/dev/null 2>&1; }

no_file() { [ ! -e "$1" ] || fail "$1 was left behind"; }
a_file() { [ -s "$1" ] || fail "$1 is missing or empty"; }
same_file() { cmp -s "$1" "$2" || fail "$1 and $2 differ"; }
# The folder holds nothing but these names (and what expect keeps).
only_files()
{
    for found in *; do
        case " $* " in *" $found "*) continue ;; esac
        [ ! -e "$found" ] || fail "$found was left behind"
    done
}

# ply FILE POINTS TRIANGLES: an ASCII .ply of "x y z" lines and "a b c" lines.
ply()
{
    {
        printf 'ply\nformat ascii 1.0\nelement vertex %d\n' "$(printf '%s\n' "$2" | wc -l)"
        printf 'property double x\nproperty double y\nproperty double z\n'
        printf 'element face %d\nproperty list uchar int vertex_indices\nend_header\n' "$(printf '%s\n' "$3" | wc -l)"
        printf '%s\n' "$2"
        printf '%s\n' "$3" | sed 's/^/3 /'
    } >"$1"
}

# A tetrahedron, wound outward: the smallest balloon.
tetra_points='0 0 0
1 0 0
0 1 0
0 0 1'
tetra_triangles='0 2 1
0 1 3
0 3 2
1 2 3'
