# Wrong usage ends with 2; help and version with 0, on stdout.
refused 2 'give a scene' balloon-sim
refused 2 'unrecognized option' balloon-sim --no-such
refused 2 'one scene or mesh at a time' balloon-sim a.cfg b.cfg
refused 2 "requires an argument" balloon-sim a.cfg --log
expect 0 balloon-sim --help
stdout_has '--contact-sheet=FILE.png'
expect 0 balloon-sim --version
stdout_has '^balloon-sim [0-9]+\.[0-9]+\.[0-9]+$'
expect 0 balloon-sim --help-scene
stdout_has '^ +pressure +on each point, along its normal$'
stdout_has 'default 10, may be scheduled'

refused 2 '--contact-sheet x.jpg: the name must end in .png' balloon-sim m.ply --contact-sheet x.jpg

refused 2 '--effect-cost runs to the end without a window' balloon-sim m.ply --effect-cost cost.tsv --window
