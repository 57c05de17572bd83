# --check says what a scene holds, --explain which effects are on; neither runs.
cp "$PROGRAMS/data/sphere.ply" "$PROGRAMS/data/sphere.cfg" .
expect 0 balloon-sim sphere.cfg --check --log log.tsv
stdout_has 'sphere.ply: 15[0-9]+ points, 4[0-9]+ edges, 30[0-9]+ triangles, mean radius 45'
stdout_has 'sphere.cfg: good: [0-9]+ bytes, 400 steps of symplectic-euler'
no_file log.tsv
expect 0 balloon-sim sphere.cfg --explain
stdout_has '^off	rip	no balloon has the block$'
expect 0 balloon-sim sphere.cfg --explain --set 'balloons[0].rip.at=1'
stdout_has '^on	rip	1 of 1 balloons have the block \(paper 4.1\)	needs [^;]*; adds to a step: none$'
stdout_has '^off	spring_by_height	'
expect 0 balloon-sim sphere.cfg --explain --set 'balloons[0].pressure=0' --set 'balloons[0].gas.ambient=10' --set 'gravity.air_density=1.2'
stdout_has '^on	gas	1 of 1 balloons have the block .*adds to a step: '
stdout_has '^on	gravity	the scene has the block '
stdout_has '^off	drag	the scene has no such block$'
