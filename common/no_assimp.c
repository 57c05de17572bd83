/* In place of mesh_assimp.c where assimp was not installed when the programs were built. */
#include "common/mesh_files.h"

enum status mesh_read_foreign(const char *path, struct mesh *mesh, struct error *err)
{
    (void)mesh;
    return error_set(
        err, STATUS_RESOURCE,
        "%s: files of this kind are read by assimp, and this program was built without it; build it with "
        "libassimp-dev, or convert the mesh to .ply, .stl or .obj",
        path);
}
