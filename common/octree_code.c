#include "common/octree_code.h"

#include "common/array.h"
#include "common/octree_blocks.h"

/* Bits that tell `materials` things apart. */
static unsigned bits_for(unsigned materials)
{
    unsigned bits = 0;
    while (1u << bits < materials)
        bits++;
    return bits;
}

struct writer {
    const struct octree *tree;
    struct octree_code *code;
    unsigned char place[OCTREE_MATERIALS]; /* of a material among those in use */
    unsigned leaf_bits;
    unsigned used; /* bits of the last byte */
    bool failed;
};

static void put_bits(struct writer *writer, unsigned value, unsigned bits)
{
    for (unsigned i = 0; i < bits && !writer->failed; i++) {
        struct octree_code *code = writer->code;
        if (writer->used == 8) {
            if (!ARRAY_RESERVE(code, 1)) {
                writer->failed = true;
                return;
            }
            code->items[code->count++] = 0;
            writer->used = 0;
        }
        code->items[code->count - 1] |= (unsigned char)((value >> i & 1) << writer->used++);
    }
}

static void put_node(struct writer *writer, octree_node node, unsigned level)
{
    if (level > 0)
        put_bits(writer, node_is_split(node), 1);
    if (!node_is_split(node)) {
        put_bits(writer, writer->place[node], writer->leaf_bits);
        return;
    }
    for (int i = 0; i < 8; i++)
        put_node(writer, writer->tree->blocks[node_children(node) + i], level - 1);
}

static void find_materials(const struct octree *tree, octree_node node, bool in_use[OCTREE_MATERIALS])
{
    if (!node_is_split(node)) {
        in_use[node] = true;
        return;
    }
    for (int i = 0; i < 8; i++)
        find_materials(tree, tree->blocks[node_children(node) + i], in_use);
}

enum status octree_encode(const struct octree *tree, struct octree_code *code, struct error *err)
{
    struct writer writer = {.tree = tree, .code = code, .used = 8};
    bool in_use[OCTREE_MATERIALS] = {false};
    find_materials(tree, tree->root, in_use);
    if (!ARRAY_RESERVE(code, 1 + OCTREE_MATERIALS))
        return error_no_memory(err, "the octree's bytes");
    unsigned char *count = &code->items[code->count++];
    unsigned materials = 0;
    for (unsigned m = 0; m < OCTREE_MATERIALS; m++) {
        if (!in_use[m])
            continue;
        code->items[code->count++] = (unsigned char)m;
        writer.place[m] = (unsigned char)materials++;
    }
    *count = (unsigned char)(materials - 1);
    writer.leaf_bits = bits_for(materials);
    put_node(&writer, tree->root, tree->depth);
    return writer.failed ? error_no_memory(err, "the octree's bytes") : STATUS_OK;
}

struct reader {
    struct octree *tree;
    const unsigned char *bytes;
    size_t size, at;    /* bytes, and how many of them are begun */
    unsigned used;      /* bits of the byte before `at` */
    unsigned materials; /* in use, with their numbers: */
    const unsigned char *material;
    unsigned leaf_bits;
    bool met[OCTREE_MATERIALS]; /* by place */
    struct error *err;
    enum status status;
};

static void refuse(struct reader *reader, const char *what)
{
    if (!reader->status)
        reader->status = error_set(reader->err, STATUS_INPUT, "%s", what);
}

static unsigned get_bits(struct reader *reader, unsigned bits)
{
    unsigned value = 0;
    for (unsigned i = 0; i < bits; i++) {
        if (reader->used == 8) {
            if (reader->at == reader->size) {
                refuse(reader, "the cells end early");
                return 0;
            }
            reader->at++;
            reader->used = 0;
        }
        value |= (unsigned)(reader->bytes[reader->at - 1] >> reader->used++ & 1) << i;
    }
    return value;
}

static octree_node get_leaf(struct reader *reader)
{
    unsigned place = get_bits(reader, reader->leaf_bits);
    if (place >= reader->materials) {
        refuse(reader, "a leaf has a material that is not among those in use");
        return 0;
    }
    reader->met[place] = true;
    return reader->material[place];
}

/* On failure reader->status is set, and what has been built so far is lost in the blocks: the tree is to be
 * thrown away. */
static octree_node get_node(struct reader *reader, unsigned level)
{
    if (level == 0 || !get_bits(reader, 1))
        return get_leaf(reader);
    octree_node children[8], node = 0;
    for (int i = 0; i < 8 && !reader->status; i++)
        children[i] = get_node(reader, level - 1);
    if (reader->status)
        return 0;
    if (!octree_join(reader->tree, children, &node))
        reader->status = error_no_memory(reader->err, "the octree");
    else if (!node_is_split(node))
        refuse(reader, "a node is split into eight equal leaves");
    return node;
}

static void get_materials(struct reader *reader)
{
    if (reader->size < 1 || reader->size < 2u + reader->bytes[0]) {
        refuse(reader, "the list of materials is cut short");
        return;
    }
    reader->materials = 1u + reader->bytes[0];
    reader->material = reader->bytes + 1;
    reader->at = 1 + reader->materials;
    reader->leaf_bits = bits_for(reader->materials);
    for (unsigned i = 1; i < reader->materials; i++)
        if (reader->material[i] <= reader->material[i - 1])
            refuse(reader, "the list of materials is not in ascending order");
}

enum status octree_decode(const unsigned char *bytes, size_t size, struct octree *tree, struct error *err)
{
    struct reader reader = {.tree = tree, .bytes = bytes, .size = size, .used = 8, .err = err};
    get_materials(&reader);
    if (!reader.status)
        tree->root = get_node(&reader, tree->depth);
    if (reader.status)
        return reader.status;
    if (reader.at != size)
        refuse(&reader, "there are bytes left over after the last cell");
    else if (reader.used < 8 && bytes[size - 1] >> reader.used)
        refuse(&reader, "the bits after the last cell are not zero");
    for (unsigned i = 0; i < reader.materials; i++)
        if (!reader.met[i])
            refuse(&reader, "a material is listed but not in use");
    return reader.status;
}
