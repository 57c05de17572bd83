# Files that are no sculpture: the chunk is named, and nothing is written.
balloon-sculpt --depth 3 -o good.oct
size=$(wc -c <good.oct)
refused 1 'missing\.oct: cannot open' balloon-sculpt missing.oct -o out.oct
: >bad.oct
refused 1 'bad\.oct: the file is empty' balloon-sculpt bad.oct -o out.oct
head -c $((size - 1)) good.oct >bad.oct
refused 1 'bad\.oct: .*cut short' balloon-sculpt bad.oct -o out.oct
head -c 30 good.oct >bad.oct
refused 1 'bad\.oct: chunk HEAD at byte 8: claims 16 bytes where 10 are left' balloon-sculpt bad.oct -o out.oct
{
    head -c 20 good.oct
    printf '\004'
    tail -c +22 good.oct
} >bad.oct
refused 1 'bad\.oct: chunk HEAD at byte 8: the checksum does not match' balloon-sculpt bad.oct -o out.oct
# a bit of the tree itself: the chunk TREE follows HEAD, at byte 36
{
    head -c 44 good.oct
    printf '\002'
    tail -c +46 good.oct
} >bad.oct
refused 1 'bad\.oct: chunk TREE at byte 36: the checksum does not match' balloon-sculpt bad.oct -o out.oct

# lies whose checksum is right; gzip has the same sum, before its last four bytes
lie() # PATTERN VERSION DEPTH LEAVES, as bytes
{
    {
        head -c 8 good.oct
        printf "HEAD\\020\\0\\0\\0$2\\0\\0\\0$3\\0\\0\\0$4\\0\\0\\0\\0" >head
        cat head
        gzip -c head | tail -c 8 | head -c 4
        tail -c +37 good.oct
    } >bad.oct
    rm head
    refused 1 "bad\.oct: chunk HEAD: $1" balloon-sculpt bad.oct -o out.oct
}
lie 'version 2 of the format; this program reads version 1' '\002' '\003' '\001\0\0\0'
lie 'depth 11; at most 10 is possible' '\001' '\013' '\001\0\0\0'
lie 'claims 4294967295 leaves, chunk TREE has 1' '\001' '\003' '\377\377\377\377'
cp /bin/sh bad.oct
refused 1 'bad\.oct: not an \.oct file' balloon-sculpt bad.oct -o out.oct
refused 1 '/: ' balloon-sculpt / -o out.oct
only_files good.oct bad.oct
