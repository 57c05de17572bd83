# .vox files that are damaged or lie, and mesh files, which are not read.
main='MAIN\0\0\0\0'
bad() # bad PATTERN BYTES
{
    printf "$2" >bad.vox
    refused 1 "bad\.vox: $1" balloon-sculpt --import bad.vox -o out.oct
    only_files bad.vox
}
refused 1 'missing\.vox: cannot open' balloon-sculpt --import missing.vox -o out.oct
bad 'the file is empty' ''
bad 'not a \.vox file' 'solid cube\n'
bad 'version 3 of the format' 'VOX \003\0\0\0'
bad 'cut short at byte 8' 'VOX \226\0\0\0MAI'
bad 'chunk MAIN at byte 8: claims 100 bytes where 4 are left' "VOX \\226\\0\\0\\0$main\\144\\0\\0\\0SIZE"
bad 'there is no model' "VOX \\226\\0\\0\\0$main\\0\\0\\0\\0"
bad 'chunk XYZI at byte 20: has no chunk SIZE before it' \
    "VOX \\226\\0\\0\\0$main\\020\\0\\0\\0XYZI\\004\\0\\0\\0\\0\\0\\0\\0\\0\\0\\0\\0"
# 10^9 voxels claimed in a chunk of 8 bytes
bad 'chunk XYZI at byte 44: claims 1000000000 voxels but has room for 1' \
    "VOX \\226\\0\\0\\0$main\\054\\0\\0\\0SIZE\\014\\0\\0\\0\\0\\0\\0\\0\\001\\0\\0\\0\\001\\0\\0\\0\\001\\0\\0\\0XYZI\\010\\0\\0\\0\\0\\0\\0\\0\\0\\312\\232\\073\\0\\0\\0\\001"
refused 2 '--import model\.xyz: \.vox, \.stl, \.ply and \.obj are read' balloon-sculpt --import model.xyz -o out.oct
