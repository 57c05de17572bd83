# Wrong usage: exit 2; --help and --version: exit 0.
refused 2 'which sculpture' balloon-surface
refused 2 'nothing to do' balloon-surface a.oct
refused 2 'one sculpture at a time' balloon-surface a.oct b.oct -o c.ply
refused 2 'must end in \.ply, \.stl or \.obj' balloon-surface a.oct -o a.xyz
refused 2 'must end in \.png' balloon-surface a.oct --render a.jpg
refused 2 'give one of them' balloon-surface a.oct --cube-size 0.1 --triangles 3000 -o a.ply
refused 2 'unrecognized option' balloon-surface a.oct --frobnicate
expect 0 balloon-surface --help
stdout_has 'fields-per-cube=N'
expect 0 balloon-surface --version
stdout_has '^balloon-surface [0-9]'
