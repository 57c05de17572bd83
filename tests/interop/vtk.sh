# VTK reads the mesh series: stretch, opacity and piece of each point, and as many triangles and pieces as the log has.
python=
for candidate in /usr/bin/python3 python3; do
    [ -n "$python" ] || ! "$candidate" -c 'import vtkmodules.vtkIOXML' 2>/dev/null || python=$candidate
done
[ -n "$python" ] || skipped "VTK's module for python is not installed (Debian: python3-vtk9)"
cp "$PROGRAMS/data/sphere.ply" "$PROGRAMS/data/sphere.cfg" "$INTEROP/series.py" .
expect 0 balloon-sim sphere.cfg --set time.end=2 --mesh-series series --mesh-series-format vtp --log log.tsv
cat >inside.py <<'END'
import json
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader
import series

def frames():
    for frame in json.load(open('series/mesh.vtp.series'))['files']:
        reader = vtkXMLPolyDataReader()
        reader.SetFileName('series/' + frame['name'])
        reader.Update()
        yield frame['time'], reader.GetOutput()

series.check(frames())
END
expect 0 timeout 120 "$python" inside.py
stdout_has '^READ 81 meshes'
cat .stdout
