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
cp /bin/sh bad.oct
refused 1 'bad\.oct: not an \.oct file' balloon-sculpt bad.oct -o out.oct
refused 1 '/: ' balloon-sculpt / -o out.oct
only_files good.oct bad.oct
