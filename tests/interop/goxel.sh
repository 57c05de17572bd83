# goxel opens our .vox, cell for cell, and what goxel saves as .vox opens here, as the same sculpture.
needs goxel
needs xvfb-run
needs python3
export HOME="$PWD"
cat >shape.chips <<'END'
depth 4
start empty
fill box 0.125 0.25 0.375 0.625 0.5 0.75
fill sphere 0.7 0.7 0.5 0.2
END
expect 0 balloon-sculpt --script shape.chips -o shape.oct --export shape.vox
for kind in txt vox; do
    expect 0 timeout 60 xvfb-run -a goxel --export "theirs.$kind" shape.vox
    a_file "theirs.$kind"
done

expect 0 balloon-sculpt --import theirs.vox -o back.oct --export back.vox
expect 0 balloon-sculpt back.oct --info
stdout_has '^cells +330$'

# Where a model's corner is at 0 is each program's own choice, and so is the order of its cells.
cat >inside.py <<'END'
import struct

def cells_of(path):
    data = open(path, 'rb').read()
    at = data.index(b'XYZI') + 12
    return [tuple(data[at + 4 + 4 * i:at + 7 + 4 * i]) for i in range(struct.unpack_from('<i', data, at)[0])]

def at_corner(cells):
    low = [min(c[i] for c in cells) for i in range(3)]
    return sorted(tuple(c[i] - low[i] for i in range(3)) for c in cells)

ours = at_corner(cells_of('shape.vox'))
# a line "x y z rrggbb" a cell
opened = at_corner([tuple(map(int, line.split()[:3])) for line in open('theirs.txt') if not line.startswith('#')])
assert ours == opened, (len(ours), len(opened))
assert ours == at_corner(cells_of('back.vox'))
print('OPENED', len(opened), 'cells, and brought them back')
END
expect 0 python3 inside.py
stdout_has '^OPENED 330 cells'
cat .stdout
