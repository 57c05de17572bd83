# What the README, the tutorial and the page for authors name is there: pictures, files, options.
root=$(dirname "$(dirname "$SWEEP")")
: >.stdout
: >.stderr
for program in balloon-sculpt balloon-surface balloon-sim; do
    "$program" --help
done >options
{ "$SWEEP" --help && "$(dirname "$SWEEP")/film" --help; } >>options

for page in README.md data/tutorial.md data/extending.md; do
    command_line=$page
    grep -o '](\([^)#]*\))' "$root/$page" | sed 's/^](//; s/)$//' >links
    while read -r link; do
        [ -e "$root/$(dirname "$page")/$link" ] || fail "there is no $link"
    done <links
    grep -oE '(data|tests|sim|sculpt|common)/[a-z_]+[a-z0-9_/.-]*[a-z0-9_]' "$root/$page" | sort -u >files
    while read -r file; do
        [ -e "$root/$file" ] || [ -e "$PROGRAMS/$file" ] || grep -q "^+++ b/$file\$\|^\`\`\`$file\$" "$root/$page" || fail "there is no $file"
    done <files
    grep -oE '(^|[ `])--[a-z][a-z-]+' "$root/$page" | tr -d ' `' | sort -u | grep -vxE -- '--(suite|benchmark)' >named
    while read -r option; do
        grep -qE -- "(^|[^a-z-])$option([^a-z-]|\$)" options || fail "no program has $option"
    done <named
    cat links files named >>found
done
[ "$(wc -l <found)" -gt 60 ] || fail "only $(wc -l <found) names were found"

# Where the README sends its reader, the scenes that it names are.
sed -n '/^`data\/scenes` has/,/^\*\*Go to/p' "$root/README.md" | grep -o '`[a-z]*`' | tr -d '`' >scenes
[ "$(wc -l <scenes)" -gt 10 ] || fail "only $(wc -l <scenes) scenes were found"
while read -r scene; do
    [ -e "$PROGRAMS/data/$scene.cfg" ] || fail "there is no $PROGRAMS/data/$scene.cfg"
done <scenes
