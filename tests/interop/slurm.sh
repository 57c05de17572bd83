# A sweep as an array job of Slurm: its daemons on this machine, on loopback, with a key and a folder of their own.
for program in munged slurmctld slurmd sbatch; do
    PATH=$PATH:/usr/sbin command -v $program >/dev/null || skipped "$program is not installed"
done
PATH=$PATH:/usr/sbin
started=
stop() { [ -z "$started" ] || { kill $started 2>/dev/null; wait; } || true; }
trap 'stop; rm -rf "$folder"' EXIT
daemon() # NAME COMMAND...: in the background; what it says goes to NAME.log
{
    name=$1
    shift
    "$@" >"$name.log" 2>&1 </dev/null &
    started="$started $!"
}
wait_for() # SECONDS COMMAND...
{
    tries=$(($1 * 4))
    shift
    until "$@" >/dev/null 2>&1; do
        tries=$((tries - 1))
        [ $tries -gt 0 ] || return 1
        sleep 0.25
    done
}

me=$(id -un)
node=$(hostname -s)
port=$((20000 + $$ % 20000))
mkdir state spool
chmod 755 . # munged's clients come in by this folder
head -c 1024 /dev/urandom >munge.key
chmod 600 munge.key
cat >slurm.conf <<END
ClusterName=sweep
SlurmctldHost=$node(127.0.0.1)
SlurmctldPort=$port
SlurmdPort=$((port + 1))
SlurmUser=$me
SlurmdUser=$me
AuthType=auth/munge
AuthInfo=socket=$PWD/munge.socket
StateSaveLocation=$PWD/state
SlurmdSpoolDir=$PWD/spool
SlurmctldPidFile=$PWD/slurmctld.pid
SlurmdPidFile=$PWD/slurmd.pid
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
MpiDefault=none
ReturnToService=2
SchedulerParameters=batch_sched_delay=0,sched_interval=2
NodeName=$node NodeAddr=127.0.0.1 CPUs=2 State=UNKNOWN
PartitionName=all Nodes=$node Default=YES MaxTime=INFINITE State=UP
END
export SLURM_CONF="$PWD/slurm.conf"
daemon munged munged --foreground --force --key-file="$PWD/munge.key" --socket="$PWD/munge.socket" --pid-file="$PWD/munged.pid" \
    --log-file="$PWD/munged.log" --seed-file="$PWD/munge.seed"
wait_for 10 test -S munge.socket || skipped "munged does not start here: $(tail -n 1 munged.log)"
daemon slurmctld slurmctld -D
wait_for 20 scontrol ping || skipped "slurmctld does not start here: $(tail -n 1 slurmctld.log)"
daemon slurmd slurmd -D
idle() { sinfo --noheader --format %t | grep -q idle; }
wait_for 30 idle || skipped "slurmd does not start here: $(tail -n 1 slurmd.log)"

cp "$PROGRAMS/data/sphere.ply" "$PROGRAMS/data/sphere.cfg" .
export BALLOON_SIM="$PROGRAMS/sim/balloon-sim"
set -- sphere.cfg 'balloons[0].spring=10:40:3' time.step=0.02:0.03:2 --set time.end=1
expect 0 timeout 150 "$SWEEP" "$@" --out "by slurm's" --slurm
stdout_has '^6 of 6 points are there: '
[ "$(ls "by slurm's" | grep -c '^slurm-[1-6].log$')" = 6 ] || fail "not six tasks: $(ls "by slurm's")"
expect 0 "$SWEEP" "$@" --out here
cut -f 1-7 here/sweep.tsv >wanted
cut -f 1-7 "by slurm's/sweep.tsv" >got
same_file wanted got

# What is missing is a job of its own, and nothing else is run.
rm "by slurm's/points/000003.tsv" "by slurm's"/slurm-*.log
expect 0 timeout 150 "$SWEEP" "$@" --out "by slurm's" --slurm
[ "$(ls "by slurm's" | grep -c '^slurm-')" = 1 ] || fail "more than one task: $(ls "by slurm's")"
cut -f 1-7 "by slurm's/sweep.tsv" >got
same_file wanted got

# A film's parts likewise.
expect 0 timeout 150 "$(dirname "$SWEEP")/film" sphere.cfg --out "film's" --end 1 --parts 2 --slurm --set 'view.size=[160,60]' --set view.rate=10
stdout_has '^11 frames: '
