/*
 * Meshes in formats of other programs, by assimp (the Open Asset Import Library,
 * https://github.com/assimp/assimp). The library is large, so it is loaded only when such a file is, and need
 * not be there otherwise.
 */
#include "common/array.h"
#include "common/mesh_files.h"

#include <assimp/cimport.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <dlfcn.h>
#include <math.h>
#include <stdlib.h>

/* The calls that are used, as the headers declare them. */
struct assimp {
    void *library;
    __typeof__(&aiImportFile) import_file;
    __typeof__(&aiReleaseImport) release_import;
    __typeof__(&aiGetErrorString) error_string;
};

static bool open_library(struct assimp *assimp)
{
    assimp->library = dlopen(ASSIMP_LIBRARY, RTLD_NOW | RTLD_LOCAL);
    if (!assimp->library)
        return false;
    /* POSIX has dlsym() return functions as void *; C would not cast them */
    *(void **)&assimp->import_file = dlsym(assimp->library, "aiImportFile");
    *(void **)&assimp->release_import = dlsym(assimp->library, "aiReleaseImport");
    *(void **)&assimp->error_string = dlsym(assimp->library, "aiGetErrorString");
    return assimp->import_file && assimp->release_import && assimp->error_string;
}

static enum status add_triangle(const struct aiMesh *part, const struct aiFace *face, const char *path,
                                struct place_list *soup, struct error *err)
{
    if (!ARRAY_RESERVE(soup, 3))
        return error_no_memory(err, path);
    for (unsigned i = 0; i < 3; i++) {
        if (face->mIndices[i] >= part->mNumVertices)
            return error_set(err, STATUS_INPUT, "%s: a corner is point %u of %u", path, face->mIndices[i],
                             part->mNumVertices);
        const struct aiVector3D *place = &part->mVertices[face->mIndices[i]];
        if (!isfinite(place->x) || !isfinite(place->y) || !isfinite(place->z))
            return error_set(err, STATUS_INPUT, "%s: point %u is not finite", path, face->mIndices[i]);
        double *corner = soup->items[soup->count++];
        corner[0] = (double)place->x;
        corner[1] = (double)place->y;
        corner[2] = (double)place->z;
    }
    return STATUS_OK;
}

/* All parts of the model as one mesh. Points and lines, which assimp has as faces too, are no skin. Points
 * that it holds apart for their colours and normals are at the same place to the bit. */
static enum status take_triangles(const struct aiScene *scene, const char *path, struct mesh *mesh,
                                  struct error *err)
{
    struct place_list soup = {0};
    enum status status = STATUS_OK;
    for (unsigned m = 0; m < scene->mNumMeshes; m++) {
        const struct aiMesh *part = scene->mMeshes[m];
        for (unsigned f = 0; f < part->mNumFaces && !status; f++)
            if (part->mFaces[f].mNumIndices == 3)
                status = add_triangle(part, &part->mFaces[f], path, &soup, err);
    }
    if (!status)
        status = mesh_from_soup((const double(*)[3])soup.items, soup.count / 3, mesh, err);
    free(soup.items);
    return status;
}

enum status mesh_read_foreign(const char *path, struct mesh *mesh, struct error *err)
{
    struct assimp assimp = {0};
    enum status status;
    if (!open_library(&assimp)) {
        status = error_set(
            err, STATUS_RESOURCE,
            "%s: files of this kind are read by assimp, and %s is not there; install it (Debian: "
            "libassimp5), or convert the mesh to .ply, .stl or .obj",
            path, ASSIMP_LIBRARY);
    } else {
        const struct aiScene *scene = assimp.import_file(
            path, aiProcess_ValidateDataStructure | aiProcess_Triangulate | aiProcess_PreTransformVertices);
        status = scene ? take_triangles(scene, path, mesh, err)
                       : error_set(err, STATUS_INPUT, "%s: %s", path, assimp.error_string());
        assimp.release_import(scene);
    }
    if (assimp.library)
        dlclose(assimp.library);
    return status;
}
