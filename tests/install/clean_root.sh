# The Debian package, built from what is committed, installs in a system that has nothing but the essential packages, and
# there the programs carve, mesh and burst to the same bytes and the same hash as here. Removed, it leaves nothing behind.
#
#     meson test -C build install-clean_root        as root, with debootstrap, on Debian; takes some minutes
#
skip()
{
    echo "$1: the package was not tried in a clean system"
    exit 77
}
[ "$(id -u)" = 0 ] || skip 'not root'
command -v debootstrap >/dev/null || skip 'debootstrap is not installed'
[ -e "$SOURCE/.git" ] || skip 'no git checkout to make a package from'
release=$(. /etc/os-release && echo "$ID $VERSION_CODENAME")
[ "${release% *}" = debian ] || skip "this is ${release% *} and not Debian"

: >.stderr
command_line='debootstrap'
debootstrap --variant=minbase "${release#* }" root >.stdout 2>&1 || {
    ! grep -q 'Failed getting release\|Unable to download' .stdout || skip 'the mirror of Debian cannot be reached'
    fail "it failed"
}
package=${PACKAGE:-}
if [ -z "$package" ]; then
    expect 0 env DEB_BUILD_OPTIONS=nocheck "$SOURCE/data/package"
    package=$(tail -n 1 .stdout)
fi
cp "$package" root/balloon.deb

in_root() { expect 0 chroot root env DEBIAN_FRONTEND=noninteractive LC_ALL=C "$@"; }
in_root apt-get update
find root/usr root/etc root/opt | sort >before
in_root apt-get install -y --no-install-recommends /balloon.deb

for name in balloon-sculpt balloon-surface balloon-sim; do
    in_root $name --version
    stdout_has "^$name $VERSION\$"
done

# the road, there and here
shared=/usr/share/balloon
in_root balloon-sculpt --quiet --script $shared/sculptures/dog.chips -o /dog.oct
in_root balloon-surface --quiet /dog.oct --sigma 1 --triangles 6000 -o /dog.ply
expect 0 balloon-sculpt --quiet --script "$SOURCE/data/sculptures/dog.chips" -o dog.oct
expect 0 balloon-surface --quiet dog.oct --sigma 1 --triangles 6000 -o dog.ply
same_file dog.ply root/dog.ply
for scene in dog helium rubber; do
    expect 0 balloon-sim "$PROGRAMS/data/$scene.cfg" --set time.end=2 --hash
    tail -n 1 .stdout >hash
    in_root balloon-sim $shared/scenes/$scene.cfg --set time.end=2 --hash
    tail -n 1 .stdout >hash-there
    echo "$scene: $(cat hash) here, $(cat hash-there) there"
    cmp -s hash hash-there || fail "hashes differ: $(cat hash) here, $(cat hash-there) there"
done
in_root balloon-sim $shared/scenes/fox.cfg --set time.end=1 --contact-sheet /fox.png
a_file root/fox.png

in_root apt-get purge -y balloon
find root/usr root/etc root/opt | sort >after
left=$(comm -13 before after | grep balloon || true)
[ -z "$left" ] || fail "left behind: $left"
