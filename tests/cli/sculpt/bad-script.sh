# Scripts that cannot be followed: the line, what is wrong, what would be right; no output.
bad() # bad PATTERN TEXT
{
    printf "$2" >s.chips
    refused 1 "s\.chips:$1" balloon-sculpt --script s.chips -o out.oct --export out.ply
    only_files s.chips
}
refused 1 'missing\.chips: cannot open' balloon-sculpt --script missing.chips -o out.oct
bad ' the file is empty' ''
bad '2: "chop" is unknown; a line begins with chip' 'depth 3\nchop sphere\n'
bad '1: "ball" is no shape; there are box' 'chip ball 0 0 0 1\n'
bad '1: the line ends early; it is: chip sphere X Y Z R' 'chip sphere 0.5 0.5'
bad '3: "nan" must be a finite number' '\n\nchip sphere 0.5 nan 0.5 0.1\n'
bad '1: "inf" must be a finite number' 'chip sphere 0.5 0.5 0.5 inf\n'
bad '1: number 1 of the sphere is 1e\+300; must be within' 'chip sphere 1e300 0.5 0.5 1\n'
bad '1: a radius of the sphere is 0; must be at least 1e-09' 'chip sphere 0.5 0.5 0.5 0\n'
bad '1: a radius of the sphere is -1; must be at least 1e-09' 'chip sphere 0.5 0.5 0.5 -1\n'
bad '1: "12" must be a whole number from 0 to 10' 'depth 12\n'
bad '2: start must come before the first operation' 'chip sphere 0.5 0.5 0.5 1\nstart full\n'
head -c 1000 /bin/sh >s.chips
refused 1 's\.chips:1: ' balloon-sculpt --script s.chips -o out.oct
only_files s.chips

# A script that contradicts what it is to carve.
balloon-sculpt --depth 3 -o a.oct
cp a.oct before.oct
printf 'depth 4\n' >s.chips
refused 1 's\.chips:1: depth 4: a\.oct has depth 3' balloon-sculpt a.oct --script s.chips -o a.oct
refused 1 's\.chips:1: depth 4, but --depth is 5' balloon-sculpt --depth 5 --script s.chips -o a.oct
printf '\nstart empty\n' >s.chips
refused 1 's\.chips:2: start: a\.oct is there to be carved' balloon-sculpt a.oct --script s.chips -o a.oct
same_file a.oct before.oct
only_files s.chips a.oct before.oct
