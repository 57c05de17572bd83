# ParaView opens the mesh series by its .series file: a mesh at each of its times, with the arrays to colour by.
needs pvbatch
pvbatch /dev/stdin <<'END' >/dev/null 2>&1 || skipped "ParaView's module for python is not installed (Debian: python3-paraview)"
import paraview.simple
END
cp "$PROGRAMS/data/sphere.ply" "$PROGRAMS/data/sphere.cfg" "$INTEROP/series.py" .
expect 0 balloon-sim sphere.cfg --set time.end=2 --mesh-series series --mesh-series-format vtp --log log.tsv
cat >inside.py <<'END'
from paraview.simple import OpenDataFile, servermanager
import os, sys
sys.path.insert(0, os.getcwd())
import series

reader = OpenDataFile('series/mesh.vtp.series')
assert set(reader.PointData.keys()) == {'stretch', 'opacity', 'piece'}, reader.PointData.keys()

def frames():
    for time in reader.TimestepValues:
        reader.UpdatePipeline(time)
        yield time, servermanager.Fetch(reader)

series.check(frames())
END
expect 0 timeout 120 pvbatch inside.py
stdout_has '^READ 81 meshes'
cat .stdout
