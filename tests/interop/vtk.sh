# VTK reads the mesh series: stretch, opacity and piece of each point, and as many triangles and pieces as the log has.
python=
for candidate in /usr/bin/python3 python3; do
    [ -n "$python" ] || ! "$candidate" -c 'import vtkmodules.vtkIOXML' 2>/dev/null || python=$candidate
done
[ -n "$python" ] || skipped "VTK's module for python is not installed (Debian: python3-vtk9)"
cp "$PROGRAMS/data/sphere.ply" "$PROGRAMS/data/sphere.cfg" .
expect 0 balloon-sim sphere.cfg --set time.end=2 --mesh-series series --mesh-series-format vtp --log log.tsv
cat >inside.py <<'END'
import json
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader

log = [line.rstrip('\n').split('\t') for line in open('log.tsv')]
rows = [dict(zip(log[0], map(float, row))) for row in log[1:]]
frames = json.load(open('series/mesh.vtp.series'))['files']
assert len(frames) == len(rows) == 81, (len(frames), len(rows))
for frame, row in zip(frames, rows):
    assert abs(frame['time'] - row['time']) < 1e-9, frame
    reader = vtkXMLPolyDataReader()
    reader.SetFileName('series/' + frame['name'])
    reader.Update()
    mesh = reader.GetOutput()
    data = mesh.GetPointData()
    arrays = {data.GetArrayName(i): data.GetArray(i) for i in range(data.GetNumberOfArrays())}
    assert set(arrays) == {'stretch', 'opacity', 'piece'}, arrays.keys()
    assert mesh.GetNumberOfPolys() == row['triangles_active'], frame
    values = {name: [array.GetTuple1(i) for i in range(array.GetNumberOfTuples())] for name, array in arrays.items()}
    assert all(len(v) == mesh.GetNumberOfPoints() for v in values.values()), frame
    assert min(values['stretch']) > 0 and 0 < min(values['opacity']) <= max(values['opacity']) <= 1, frame
    # pieces that touch at a point share it: its number is that of one of them
    assert len(set(values['piece'])) <= row['pieces'], frame
print('READ', len(frames), 'meshes;', len(set(values['piece'])), 'pieces of', int(row['pieces']), 'at the end')
END
expect 0 timeout 120 "$python" inside.py
stdout_has '^READ 81 meshes'
cat .stdout
