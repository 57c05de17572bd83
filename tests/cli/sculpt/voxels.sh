# A MagicaVoxel model comes in upright, and goes out as it came.
# 2 x 1 x 3 cells: one at the origin, one beside it along x, one two above it along z
{
    printf 'VOX \226\0\0\0MAIN\0\0\0\0\064\0\0\0'
    printf 'SIZE\014\0\0\0\0\0\0\0\002\0\0\0\001\0\0\0\003\0\0\0'
    printf 'XYZI\020\0\0\0\0\0\0\0\003\0\0\0\0\0\0\001\001\0\0\002\0\0\002\003'
} >model.vox
expect 0 balloon-sculpt --import model.vox -o model.oct --export again.vox --info
stdout_has '^depth +3 \(8 cells a side\)$'
stdout_has '^bounds x +3 to 4 '
stdout_has '^bounds y +2 to 4 '
stdout_has '^bounds z +3 to 3 '
stdout_has '^material 1 +1 cells'
stdout_has '^material 3 +1 cells'
expect 0 balloon-sculpt --import again.vox -o again.oct
same_file model.oct again.oct
