# What a mesh series must hold for those who read it: see vtk.sh and paraview.sh, which bring its frames.


def check(frames):
    """frames: pairs of a time and a vtkPolyData. Against log.tsv, a row a frame."""
    log = [line.rstrip('\n').split('\t') for line in open('log.tsv')]
    rows = [dict(zip(log[0], map(float, row))) for row in log[1:]]
    count = 0
    for row, (time, mesh) in zip(rows, frames):
        count += 1
        assert abs(time - row['time']) < 1e-9, (time, row['time'])
        data = mesh.GetPointData()
        arrays = {data.GetArrayName(i): data.GetArray(i) for i in range(data.GetNumberOfArrays())}
        assert set(arrays) == {'stretch', 'opacity', 'piece'}, arrays.keys()
        assert mesh.GetNumberOfPolys() == row['triangles_active'], (time, mesh.GetNumberOfPolys())
        values = {name: [array.GetTuple1(i) for i in range(array.GetNumberOfTuples())] for name, array in arrays.items()}
        assert all(len(v) == mesh.GetNumberOfPoints() for v in values.values()), time
        assert min(values['stretch']) > 0 and 0 < min(values['opacity']) <= max(values['opacity']) <= 1, time
        # pieces that touch at a point share it: its number is that of one of them
        assert len(set(values['piece'])) <= row['pieces'], time
    assert count == len(rows) == 81, (count, len(rows))
    print('READ', count, 'meshes;', len(set(values['piece'])), 'pieces of', int(row['pieces']), 'at the end')
