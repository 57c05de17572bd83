/* The table of fields as a person reads it. */
#include "common/scene.h"
#include "common/scene_fields.h"

static const char *type_name(const struct scene_field *field)
{
    switch (field->type) {
    case SCENE_NUMBER:
        return "number";
    case SCENE_WHOLE:
        return "whole number";
    case SCENE_TEXT:
        return "name in quotes";
    case SCENE_CHOICE:
        return "one of";
    case SCENE_VECTOR:
        return "[x, y, z]";
    case SCENE_SIZE:
        return "[width, height]";
    case SCENE_PAIRS:
        return "( (x, y), ... )";
    }
    return "";
}

/* "number from 0 to 10 s, default 2, may be scheduled (paper 3.5)" */
static void write_facts(FILE *stream, const struct scene_field *field)
{
    fputs(type_name(field), stream);
    for (int i = 0; field->choices && field->choices[i]; i++)
        fprintf(stream, "%s \"%s\"", i ? "," : "", field->choices[i]);
    if (field->least < field->most)
        fprintf(stream, " from %g to %.*g", field->least, scene_range_digits(field), field->most);
    if (*field->unit)
        fprintf(stream, ", in %s", field->unit);
    if (*field->standard)
        fprintf(stream, ", default %s", field->standard);
    if (field->flags & SCENE_LIVE)
        fputs(", may be scheduled", stream);
    if (field->flags & SCENE_FREE)
        fputs(", may be another when resumed", stream);
    if (*field->source)
        fprintf(stream, " (%s)", field->source);
}

static void write_block(FILE *stream, const struct scene_block *block)
{
    fprintf(stream, "\n%s%s%s%s: %s\n", block->parent, *block->parent ? "[]." : "", block->name,
            block->list ? "[]" : "", block->meaning);
    for (size_t i = 0; i < block->field_count; i++) {
        const struct scene_field *field = &block->fields[i];
        fprintf(stream, "  %-15s %s\n  %-15s   ", field->key, field->meaning, "");
        write_facts(stream, field);
        fputc('\n', stream);
    }
}

void scene_write_help(FILE *stream)
{
    fputs(
        "A scene is a text file of blocks and keys:\n\n"
        "  time     = { step = 0.025; end = 10.0; };\n"
        "  balloons = ( { mesh = \"sphere.ply\"; pressure = 10.0; rip = { at = 1.0; }; } );\n"
        "  schedule = ( { at = 1.0; pressure = 12.0; } );\n\n"
        "All but the mesh have defaults, the paper's where it gives one. An effect's block (gas, gravity, contact, ...)\n"
        "calls for the effect; without the block there is none. --set takes a key by its path:\n"
        "--set balloons[0].rip.at=1 --set view.stereo=crossed\n",
        stream);
    for (size_t i = 0; i < scene_block_count; i++)
        write_block(stream, &scene_blocks[i]);
}

void scene_write_mdoc(FILE *stream)
{
    for (size_t i = 0; i < scene_block_count; i++) {
        const struct scene_block *block = &scene_blocks[i];
        fprintf(stream, ".Ss %s%s%s%s\n%s.\n.Bl -tag -width spring_factor\n", block->parent,
                *block->parent ? "[]." : "", block->name, block->list ? "[]\\&" : "", block->meaning);
        for (size_t j = 0; j < block->field_count; j++) {
            fprintf(stream, ".It Cm %s\n\\&%s\n.br\n", block->fields[j].key, block->fields[j].meaning);
            write_facts(stream, &block->fields[j]);
            fputc('\n', stream);
        }
        fputs(".El\n", stream);
    }
}
