# meson install puts everything where a system looks for it, and what it installed runs from there.
expect 0 env DESTDIR="$PWD/root" meson install -C "$PROGRAMS" --no-rebuild --quiet
root=root$PREFIX
share=$root/$DATADIR
for name in balloon-sculpt balloon-surface balloon-sim; do
    expect 0 "$root/$BINDIR/$name" --version
    stdout_has "^$name $VERSION\$"
    a_file "$root/$MANDIR/man1/$name.1"
    a_file "$share/bash-completion/completions/$name"
done
for name in applications/balloon-sculpt.desktop applications/balloon-sim.desktop metainfo/org.example.balloon.metainfo.xml \
    icons/hicolor/scalable/apps/balloon.svg mime/packages/balloon.xml; do
    a_file "$share/$name"
done

# The example that a menu opens is there, and so is every mesh that a scene names; nothing else than was meant to be.
scene=$(sed -n 's/^Exec=.*:-\(.*\.cfg\).*/\1/p' "$share/applications/balloon-sim.desktop")
a_file "root$scene"
for scene in "$share"/balloon/scenes/*.cfg; do
    expect 0 "$root/$BINDIR/balloon-sim" "$scene" --check
done
for script in "$share"/balloon/sculptures/*.chips; do
    expect 0 "$root/$BINDIR/balloon-sculpt" --script "$script" -o "$(basename "$script" .chips).oct"
done

# What shares runs out finds the simulator in PATH, and its own helpers beside it.
expect 0 env PATH="$PWD/$root/$BINDIR:$PATH" "$share/balloon/sweep" "$share/balloon/scenes/sphere.cfg" --out swept --set time.end=0.1 \
    'balloons[0].spring=10:40:2'
stdout_has '^2 of 2 points are there: '
grep -qx "$PWD/$root/$BINDIR/balloon-sim" swept/settings || fail "it ran $(head -n 1 swept/settings)"
expect 0 "$share/balloon/film" --help
stdout_has '^film SCENE --out DIR '

others=$(find root -type f -o -type l | grep -vE "/(bin|man1|applications|metainfo|apps|packages|completions|scenes|sculptures)/[^/]+\$|/balloon/(sweep|sweep-map|film|share.sh)\$" || true)
[ -z "$others" ] || fail "installed, and not known here: $others"
