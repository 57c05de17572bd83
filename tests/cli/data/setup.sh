# data/setup says what it is about to build, and nothing where nothing is left to do. Stand-ins say that all is installed, and count files.
setup=$(dirname "$SWEEP")/setup
mkdir bin folder
: >folder/build.ninja
printf '#!/bin/sh\nprintf installed\n' >bin/dpkg-query
printf '#!/bin/sh\ncase "$*" in *" -n"*) cat files ;; *" build.ninja") ;; *) echo "$*" >built ;; esac\n' >bin/ninja
chmod +x bin/dpkg-query bin/ninja

echo 'ninja: no work to do.' >files
expect 0 env PATH="$PWD/bin:$PATH" "$setup" folder
[ ! -s .stdout ] && [ ! -s .stderr ] || fail "it says something"
no_file built

printf '[1/3] one\n[2/3] two\n[3/3] three\n' >files
expect 0 env PATH="$PWD/bin:$PATH" TARGETS='sim/balloon-sim' "$setup" folder
stderr_has '^building in folder, files to make: 3 '
grep -qx -- '-C folder --quiet sim/balloon-sim' built || fail "built: $(cat built)"
