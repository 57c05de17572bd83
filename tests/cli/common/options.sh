# An option that there is not is refused with exit 2 and one line that names the nearest; the start of a name will do while it is the only one.
for program in balloon-sculpt balloon-surface balloon-sim; do
    refused 2 "^$program: unrecognized option '--qiet'; nearest: --quiet; --help lists" $program --qiet
    one_message
    refused 2 "nearest: --version;" $program --verison
    refused 2 "^$program: unrecognized option '--frobnicate'; --help lists" $program --frobnicate=3
    expect 0 $program --vers
    expect 0 $program --help --qiet
done
refused 2 "'--fraems'; nearest: --frames;" balloon-sim a.cfg --fraems=film
refused 2 "'--pices'; nearest: --pieces;" balloon-sim -qo x.ply a.cfg --set time.step=1 --pices x.tsv
refused 2 "'--trinagles'; nearest: --triangles;" balloon-surface a.oct --trinagles 3000
refused 2 "'--exprot'; nearest: --export;" balloon-sculpt a.oct --exprot a.vox

# An option that was given before with something else is told of, unless it may be repeated.
refused 1 'cannot open' balloon-surface no.oct --triangles 900 -o a.ply --triangles 900
expect 1 balloon-surface no.oct -o a.ply --triangles 900 --output=b.ply --tri 800
stderr_has '^balloon-surface: --output a\.ply does nothing: --output b\.ply comes after it$'
stderr_has '^balloon-surface: --triangles 900 does nothing: --triangles 800 comes after it$'
refused 1 'cannot open' balloon-surface no.oct -o a.ply -o b.ply -q
expect 1 balloon-sculpt --script a.chips --script b.chips --info --info
stderr_has '^balloon-sculpt: --script a\.chips does nothing: --script b\.chips comes after it$'
refused 1 'cannot open' balloon-sculpt no.oct --export a.vox --export b.ply
expect 1 balloon-sim no.cfg --movie a.mp4 --movie b.gif
stderr_has '^balloon-sim: --movie a\.mp4 does nothing: --movie b\.gif comes after it$'
refused 1 'cannot open' balloon-sim no.cfg --set time.step=1 --set time.end=1

# What begins several names is told with all of them.
refused 2 "'--mesh' is ambiguous.*'--mesh-series' '--mesh-series-format' '--mesh-series-constant'" balloon-sim a.cfg --mesh x
refused 2 "'--s' is ambiguous.*'--sigma' '--seeds' '--seed'" balloon-surface a.oct --s 1

# What an option takes is no option, however it looks.
refused 1 '^balloon-sim: --pices: cannot open' balloon-sim --log --qiet -- --pices
refused 1 'a.oct: cannot open' balloon-sculpt a.oct -qo --x.oct
