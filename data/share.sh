# shellcheck shell=sh disable=SC2154
# What data/sweep and data/film share: work that is shared out over processes, machines, or Slurm. $self is
# the script that reads this.

fail() # EXIT MESSAGE
{
    echo "$(basename "$self"): $2" >&2
    exit "$1"
}

quoted() # TEXT: as one word of the shell
{
    printf "'%s'" "$(printf '%s' "$1" | sed "s/'/'\\\\''/g")"
}

# Prints the simulator's place: $BALLOON_SIM, else balloon-sim in PATH, else that of ../build.
find_program()
{
    found=${BALLOON_SIM:-$(command -v balloon-sim || echo "$(dirname "$self")/../build/sim/balloon-sim")}
    [ -x "$found" ] || fail 1 "$found: there is no such program; build it, or name it in BALLOON_SIM"
    realpath "$found"
}

# COMMAND... WORD for each word of stdin, JOBS at a time, by GNU parallel, or xargs where that is not
# installed. Whether all went well is for what they leave to tell.
run_each() # JOBS COMMAND...
{
    at_a_time=$1
    shift
    if parallel --version 2>/dev/null | grep -q '^GNU parallel'; then
        bar=
        [ ! -t 2 ] || bar=--bar
        # shellcheck disable=SC2086 # one word or none
        parallel --will-cite --quote $bar --jobs "$at_a_time" "$@" || true
    else
        # xargs would stop at a command that is killed; a shell between them tells it of a failure only
        xargs -n 1 -P "$at_a_time" sh -c '"$@" || exit 1' sh "$@" || true
    fi
}

# An array job with a task for each number up to TASKS, whose script is stdin, in FOLDER; waits for its end.
# Its number is FOLDER/job.
run_by_slurm() # FOLDER TASKS
{
    command -v sbatch >/dev/null || fail 1 "the program sbatch is not installed: on Debian, apt install slurm-client"
    { printf '#!/bin/sh\n' && cat; } >"$1/slurm.sh"
    echo "$(basename "$self"): an array job of $2 tasks; if you stop waiting for it, the same command looks after it" >&2
    sbatch --parsable --wait --job-name="balloon-$(basename "$self")" --array="1-$2" --ntasks=1 --requeue --output=slurm-%a.log \
        --chdir="$1" "$1/slurm.sh" >"$1/job" || true
    [ -s "$1/job" ] || fail 1 "sbatch did not take the job"
}

# Whether that job is still queued or at work.
still_at_work() # FOLDER
{
    [ -s "$1/job" ] && command -v squeue >/dev/null || return 1
    [ -n "$(squeue --noheader --jobs "$(cut -d ';' -f 1 "$1/job")" 2>/dev/null)" ]
}
