# Entries, metadata, icon and types of files are what the tools of a desktop take them for.
expect 0 env DESTDIR="$PWD/root" meson install -C "$PROGRAMS" --no-rebuild --quiet
share=root$PREFIX/$DATADIR
missing=
has()
{
    command -v "$1" >/dev/null || { missing="$missing $1"; false; }
}

if has desktop-file-validate; then
    for name in balloon-sculpt balloon-sim; do
        expect 0 desktop-file-validate --no-hints "$share/applications/$name.desktop"
        [ ! -s .stdout ] || fail "there is something to say"
    done
fi
if has appstreamcli; then
    expect 0 appstreamcli validate --no-net --pedantic "$share/metainfo/org.example.balloon.metainfo.xml"
fi
if has rsvg-convert; then
    for size in 16 48 256; do
        expect 0 rsvg-convert -w $size -h $size "$share/icons/hicolor/scalable/apps/balloon.svg" -o icon.png
        a_file icon.png
    done
fi

# Sculptures by their name and by their first bytes; scenes by what is in them, and no other settings.
if has update-mime-database && has gio; then
    expect 0 update-mime-database "$share/mime"
    type_is() # FILE TYPE
    {
        expect 0 env XDG_DATA_HOME="$PWD/$share" gio info -a standard::content-type "$1"
        stdout_has "standard::content-type: $2\$"
    }
    expect 0 balloon-sculpt --depth 1 -o cube.oct
    cp cube.oct cube-without-extension
    type_is cube.oct application/x-balloon-sculpture
    type_is cube-without-extension application/x-balloon-sculpture
    type_is "$SOURCE/data/sculptures/dog.chips" text/x-balloon-chips
    for scene in "$SOURCE"/data/scenes/*.cfg; do
        type_is "$scene" text/x-balloon-scene
    done
    echo 'time = { step = 1; };' >other.cfg
    type_is other.cfg text/plain
fi

# What the simulator's entry runs: the scene that it is opened with, or an example.
if has gio; then
    mkdir programs
    printf '#!/bin/sh\nprintf "%%s\\n" "$@" >"$OPENED.part"\nmv "$OPENED.part" "$OPENED"\n' >programs/balloon-sim
    chmod +x programs/balloon-sim
    opens() # WHAT FILE...
    {
        wanted_argument=$1
        shift
        rm -f opened
        expect 0 env PATH="$PWD/programs:$PATH" OPENED="$PWD/opened" gio launch "$share/applications/balloon-sim.desktop" "$@"
        for _ in $(seq 100); do
            [ ! -e opened ] || break
            sleep 0.05
        done
        [ "$(cat opened)" = "$wanted_argument" ] || fail "the program was given $(cat opened), wanted $wanted_argument"
    }
    opens "$PREFIX/$DATADIR/balloon/scenes/fox.cfg"
    : >'a scene; $HOME.cfg'
    opens "$PWD/a scene; \$HOME.cfg" 'a scene; $HOME.cfg'
fi
if [ -n "$missing" ]; then
    echo "not installed, and so not asked:$missing"
    exit 77
fi
