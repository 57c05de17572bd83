# A checkpoint that is none, damaged or of another scene is refused with what is wrong; one that cannot be written is found out
# before the run, and what was there stays.
ply m.ply "$tetra_points" "$tetra_triangles"
short='--set time.end=0.1'
expect 0 balloon-sim m.ply $short --checkpoint run.ck

refused 1 'no.ck: cannot open: No such file' balloon-sim m.ply $short --resume no.ck
refused 1 'm.ply: not a checkpoint: it does not begin with the signature' balloon-sim m.ply $short --resume m.ply
: >empty.ck
refused 1 'empty.ck: not a checkpoint' balloon-sim m.ply $short --resume empty.ck
head -c 200 run.ck >cut.ck
refused 1 'cut.ck: chunk KEYS at byte [0-9]+: claims [0-9]+ bytes where [0-9]+ are left' balloon-sim m.ply $short --resume cut.ck
{ head -c 100 run.ck; printf 'X'; tail -c +102 run.ck; } >flipped.ck
refused 1 'flipped.ck: chunk KEYS at byte [0-9]+: the checksum does not match; the file is damaged' \
    balloon-sim m.ply $short --resume flipped.ck --log log.tsv -o end.ply
no_file log.tsv
no_file end.ply

refused 1 'run.ck: is of another scene: balloons\[0\].pressure is 12, and was 10' \
    balloon-sim m.ply $short --set 'balloons[0].pressure=12' --resume run.ck
refused 1 'run.ck: is of another scene: time.integrator is verlet, and was symplectic-euler' \
    balloon-sim m.ply $short --set time.integrator=verlet --resume run.ck
sed 's/^0 0 1$/0 0 1.5/' m.ply >other.ply
refused 1 'run.ck: is of another scene: the meshes of other.ply have other points' \
    balloon-sim other.ply $short --resume run.ck
# another place, end and camera are the same scene
mkdir folder
cp m.ply folder/moved.ply
expect 0 balloon-sim folder/moved.ply --set time.end=0.2 --set view.camera=[0,0,5] --resume run.ck

refused 1 '/proc/run.ck: cannot create' balloon-sim m.ply $short --checkpoint /proc/run.ck
refused 1 'no/such/run.ck: cannot create' balloon-sim m.ply $short --checkpoint no/such/run.ck
refused 1 '/dev/full: cannot write: No space left' balloon-sim m.ply $short --checkpoint /dev/full
cp run.ck before.ck
if files_can_be_small 1 balloon-sim; then
    refused 1 'run.ck: cannot write: File too large' \
        sh -c 'ulimit -f 1; exec balloon-sim "$@"' sh m.ply $short --checkpoint run.ck
fi
same_file run.ck before.ck
refused 2 'checkpoint-every: give --checkpoint FILE too' balloon-sim m.ply --checkpoint-every 5
refused 2 'checkpoint-every -1: must be a number' balloon-sim m.ply --checkpoint run.ck --checkpoint-every -1
refused 2 'estimate measures a run from its start' balloon-sim m.ply --estimate --resume run.ck
only_files m.ply other.ply run.ck before.ck empty.ck cut.ck flipped.ck folder
