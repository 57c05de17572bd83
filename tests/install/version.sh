# The version is meson.build's; what tells the project's history begins with it.
history_has() # FILE PATTERN
{
    command_line="the newest version in $1"
    grep -Eq -m 1 -- "$2" "$SOURCE/$1" || fail "it is not $VERSION: nothing matches $2"
}
: >.stdout
: >.stderr
version=$(echo "$VERSION" | sed 's/\./\\./g')
grep -m 1 '^## ' "$SOURCE/data/CHANGELOG.md" >changelog
command_line='the newest version in data/CHANGELOG.md'
grep -Eq "^## $version \([0-9]{4}-[0-9]{2}-[0-9]{2}\)\$" changelog || fail "it is not $VERSION: $(cat changelog)"
date=$(sed -E 's/.*\((.*)\)/\1/' changelog)
history_has data/CITATION.cff "^version: $version\$"
history_has README.md "Balloon $version, "
history_has data/CITATION.cff "^date-released: $date\$"
history_has data/share/balloon.metainfo.xml.in "<release version=\"@VERSION@\" date=\"$date\"/>"
head -n 1 "$SOURCE/data/debian/changelog" >debian
grep -q "^balloon ($version-[0-9]*) " debian || fail "data/debian/changelog begins with $(cat debian)"
