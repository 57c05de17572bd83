# The work of a program that was killed. Each line of a journal ends in the CRC-32 of all text up to there, which
# gzip, too, puts at the end of what it writes.
journal() # FILE LINE...
{
    file=$1
    shift
    : >"$file"
    : >.text
    for line in "$@"; do
        printf '%s' "$line" >>.text
        sum=$(gzip -c .text | tail -c 8 | od -An -tx1 | awk '{ print $4 $3 $2 $1; exit }')
        printf '%s #%s\n' "$line" "$sum" >>"$file"
    done
}
cube='# balloon-sculpt journal 1, cube of depth 4, material 1'
printf 'depth 4\nchip sphere 0.5 0.5 0.5 0.3\n' >wanted.chips
expect 0 balloon-sculpt --script wanted.chips --export wanted.vox

# ... on a sculpture that has never been saved, in place: the journal is then of no use any more.
journal new.oct.journal "$cube" 'chip sphere 0.5 0.5 0.5 0.3' 'step' 'chip box 0 0 0 1 1 1' 'step' 'undo'
expect 0 balloon-sculpt --recover new.oct -o other.oct --export other.vox
stderr_has 'new\.oct: 5 operations recovered$'
same_file other.vox wanted.vox
a_file new.oct.journal
expect 0 balloon-sculpt --recover new.oct -o new.oct
expect 0 balloon-sculpt new.oct --export new.vox
same_file new.vox wanted.vox
no_file new.oct.journal
refused 1 'new\.oct: has no journal, so no work on it was lost' balloon-sculpt --recover new.oct -o again.oct

# A torn last line is left out and told of.
journal torn.oct.journal "$cube" 'chip sphere 0.5 0.5 0.5 0.3'
printf 'chip box 0 0' >>torn.oct.journal
expect 0 balloon-sculpt --recover torn.oct --export torn.vox
stderr_has 'torn\.oct: 1 operations recovered$'
stderr_has 'torn\.oct\.journal: its last 12 bytes are cut off or damaged'
same_file torn.vox wanted.vox

# A journal that belongs to another version is refused; one that is there is told of.
journal new.oct.journal '# balloon-sculpt journal 1, file of hash 0123456789abcdef' 'heat 0.5 0.5 0.5 1'
cp new.oct before.oct
refused 1 'new\.oct\.journal: belongs to another version of new\.oct.*remove the journal' \
    balloon-sculpt --recover new.oct -o new.oct
same_file new.oct before.oct
expect 0 balloon-sculpt new.oct --info
stderr_has 'new\.oct\.journal holds work that was not saved: --recover begins with it'

# What had been saved is no work that is lost, also where a look followed; what came after is. In place of such a sculpture comes another.
expect 0 balloon-sculpt --script wanted.chips -o saved.oct
journal saved.oct.journal "$cube" 'chip sphere 0.5 0.5 0.5 0.3' 'step' '# save'
expect 0 balloon-sculpt saved.oct --info
[ ! -s .stderr ] || fail "what was saved is told to be lost"
journal saved.oct.journal "$cube" 'chip sphere 0.5 0.5 0.5 0.3' 'step' '# save' 'step' 'material 1' 'mirror none'
expect 0 balloon-sculpt saved.oct --info
[ ! -s .stderr ] || fail "what was saved is told to be lost"
journal saved.oct.journal "$cube" 'chip sphere 0.5 0.5 0.5 0.3' 'step' '# save' 'chip box 0 0 0 1 1 0.5' 'step'
expect 0 balloon-sculpt saved.oct --info
stderr_has 'saved\.oct\.journal holds work that was not saved'
journal saved.oct.journal "$cube" 'chip sphere 0.5 0.5 0.5 0.3' 'step' '# save'
echo 'chip box 0 0 0 1 1 0.5' >half.chips
expect 0 balloon-sculpt --script half.chips -o saved.oct
no_file saved.oct.journal
expect 0 balloon-sculpt saved.oct --info
[ ! -s .stderr ] || fail "the journal of what was replaced is told of"

# What is no journal, or one whose beginning is lost.
echo 'chip sphere 0 0 0 1' >foreign.oct.journal
refused 1 'foreign\.oct\.journal: not a journal' balloon-sculpt --recover foreign.oct -o out.oct
: >short.oct.journal
refused 1 'short\.oct\.journal: nothing was written to it yet' balloon-sculpt --recover short.oct -o out.oct
echo "$cube #00000000" >bad.oct.journal
refused 1 'bad\.oct\.journal: line 1: the checksum does not match' balloon-sculpt --recover bad.oct -o out.oct
journal wrong.oct.journal "$cube" 'chip sphere 0 0 0'
refused 1 'wrong\.oct\.journal:2: the line ends early' balloon-sculpt --recover wrong.oct -o out.oct
no_file out.oct
refused 2 '--recover: give the FILE\.oct' balloon-sculpt --recover --info
