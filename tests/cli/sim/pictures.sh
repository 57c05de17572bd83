# What a picture can be asked for, what every frame tells of itself, and what is refused.
ply m.ply "$tetra_points" "$tetra_triangles"
short='--set time.end=0.05 --set view.rate=20 --set balloons[0].pressure=0'
for style in latex paper; do
    for order in none sort peel list; do
        expect 0 balloon-sim m.ply $short --set view.size=[64,48] --set view.samples=2 --set view.style=$style \
            --set view.order=$order --frames "$style-$order"
        a_file "$style-$order/frame_0000.png"
    done
done
for stereo in mono parallel crossed over-under red-cyan interlaced left right; do
    expect 0 balloon-sim m.ply $short --set view.size=[64,48] --set view.stereo=$stereo --set view.squeezed=yes \
        --frames "$stereo"
    a_file "$stereo/frame_0001.png"
done
cmp -s left/frame_0001.png right/frame_0001.png && fail "both eyes see the same"
for text in Scene m.ply Keys 'balloons\[0\].pressure=0' Time; do
    grep -aq "$text" mono/frame_0001.png || fail "the frame does not say: $text"
done
for size in '[0,48]' '[64,1000000]'; do
    refused 1 'size.*16 to 16384|size.*16.*16384' balloon-sim m.ply $short --set "view.size=$size" --frames bad
done
refused 1 'camera' balloon-sim m.ply $short --set 'view.camera=[nan,0,1]' --frames bad
refused 1 'view: the camera sees nothing' balloon-sim m.ply $short --set 'view.camera=[0.0,0.0,0.0]' --frames bad
for output in '--frames bad' --check; do
    refused 1 '^balloon-sim: view: a stereo picture 63 wide cannot be halved; that must be even$' balloon-sim m.ply $short --set view.size=[63,48] $output
    refused 1 '^balloon-sim: view: the camera sees nothing' balloon-sim m.ply $short --set 'view.camera=[1e-300,0.0,0.0]' $output
    refused 1 'osmesa' env BALLOON_CONTEXT=none balloon-sim m.ply $short --frames bad $output
done
expect 0 balloon-sim m.ply $short --check --set view.size=[63,48] --set view.stereo=separate
expect 0 balloon-sim m.ply $short --set view.size=[63,48] --set view.stereo=separate --frames separate # which halves nothing
a_file separate/frame_0001-right.png
refused 1 'style.*latex' balloon-sim m.ply $short --set view.style=rubber --frames bad
expect 0 balloon-sim m.ply $short --set view.size=[64,48] --set 'view.camera=[0.0,0.0,0.1]' --frames inside
for side in above:5.0 below:-5.0; do
    expect 0 balloon-sim m.ply $short --set view.size=[64,48] --set "view.camera=[0.0,${side#*:},0.0]" --frames "${side%:*}"
done
cmp -s above/frame_0001.png below/frame_0001.png && fail "it looks the same from above and from below"
no_file bad

# the library that draws is wanted by pictures alone
mkdir broken
: >broken/libOSMesa.so.8
without="env LD_LIBRARY_PATH=$PWD/broken BALLOON_CONTEXT=osmesa"
refused 1 'OSMesa.* is not there \(.*libOSMesa.*\); on Debian: apt install libosmesa6$' $without balloon-sim m.ply $short --frames bad
no_file bad
expect 0 $without balloon-sim m.ply $short --log none.tsv
