#include "common/scene_checks.h"
#include "common/scene_fields.h"

#include <math.h>
#include <stdarg.h>
#include <string.h>

/* "FILE:LINE: ...", or without the line where that is 0. */
__attribute__((format(printf, 4, 5))) static enum status refuse(const struct scene *scene, unsigned line,
                                                                struct error *err, const char *format, ...)
{
    char text[ERROR_TEXT_SIZE], place[16] = "";
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    if (line > 0)
        snprintf(place, sizeof place, ":%u", line);
    return error_set(err, STATUS_INPUT, "%s%s: %s", scene->path, place, text);
}

enum status scene_contradiction(const struct scene *scene, size_t number, const char *name, unsigned line,
                                struct error *err, const char *format, ...)
{
    char text[256];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    return refuse(scene, line, err, "balloons[%zu].%s: %s", number, name, text);
}

bool scene_changes(const struct scene_schedule *entry, const char *key, size_t number)
{
    for (size_t i = 0; i < entry->change_count; i++)
        if (!strcmp(entry->change[i].field->key, key))
            return entry->balloon < 0 || (size_t)entry->balloon == number;
    return false;
}

static enum status check_gas(const struct scene *scene, size_t number, struct error *err)
{
    const struct scene_balloon *b = &scene->balloons[number];
    const struct scene_block *block = scene_find_block("", "balloons");
    const bool is_written = scene_line_of(block, b, scene_find_field(block, "pressure"));
    const unsigned line = b->gas.line;
    if (b->gas.ambient == 0)
        return scene_contradiction(scene, number, "gas", line, err,
                                   "give ambient, the pressure of the air outside (about 101325 in Pa)");
    if (is_written && b->pressure != 0)
        return scene_contradiction(scene, number, "gas", line, err,
                                   "the gas makes the pressure, and pressure = %g gives another; leave "
                                   "out one of the two",
                                   b->pressure);
    for (size_t i = 0; i < scene->schedule_count; i++)
        if (scene_changes(&scene->schedule[i], "pressure", number))
            return scene_contradiction(scene, number, "gas", line, err,
                                       "the gas makes the pressure, which schedule[%zu] cannot change; "
                                       "let it change pump",
                                       i);
    return STATUS_OK;
}

bool scene_has_gas(const struct scene *scene)
{
    for (size_t i = 0; i < scene->balloon_count; i++)
        if (scene->balloons[i].gas.on)
            return true;
    return false;
}

/* What turns all pumps passes over balloons that have none, if any has. */
static enum status check_no_gas(const struct scene *scene, size_t number, struct error *err)
{
    for (size_t i = 0; i < scene->schedule_count; i++) {
        const struct scene_schedule *entry = &scene->schedule[i];
        if ((scene_changes(entry, "pump", number) || scene_changes(entry, "pump_until", number)) &&
            (entry->balloon >= 0 || !scene_has_gas(scene)))
            return scene_contradiction(scene, number, "gas", entry->line, err,
                                       "schedule[%zu] turns its pump, but there is no gas; give "
                                       "gas = { ambient = ... }",
                                       i);
    }
    return STATUS_OK;
}

static enum status check_tube(const struct scene *scene, size_t number, struct error *err)
{
    const struct scene_balloon *b = &scene->balloons[number];
    const size_t to = (size_t)b->tube.to;
    const unsigned line = b->tube.line;
    if (to >= scene->balloon_count)
        return scene_contradiction(scene, number, "tube", line, err,
                                   "leads to balloons[%zu], but the balloons are 0 to %zu", to,
                                   scene->balloon_count - 1);
    if (to == number)
        return scene_contradiction(scene, number, "tube", line, err, "leads back to its own balloon");
    if (!b->gas.on || !scene->balloons[to].gas.on)
        return scene_contradiction(scene, number, "tube", line, err,
                                   "balloons[%zu] has no gas that could flow; give gas = { ... }",
                                   b->gas.on ? to : number);
    if (b->tube.area == 0)
        return scene_contradiction(scene, number, "tube", line, err, "give area, the tube's inside");
    if (b->gas.process != scene->balloons[to].gas.process || b->gas.gamma != scene->balloons[to].gas.gamma ||
        b->gas.density != scene->balloons[to].gas.density ||
        b->gas.ambient != scene->balloons[to].gas.ambient)
        return scene_contradiction(scene, number, "tube", line, err,
                                   "joins two kinds of gas; make ambient, process, gamma and density of "
                                   "both balloons the same");
    return STATUS_OK;
}

enum status scene_check_gas(const struct scene *scene, size_t number, struct error *err)
{
    const struct scene_balloon *b = &scene->balloons[number];
    enum status status = b->gas.on ? check_gas(scene, number, err) : check_no_gas(scene, number, err);
    return status || !b->tube.on ? status : check_tube(scene, number, err);
}

static bool is_nowhere(const double direction[3])
{
    return direction[0] == 0 && direction[1] == 0 && direction[2] == 0;
}

enum status scene_check_places(const struct scene *scene, size_t number, struct error *err)
{
    const struct scene_balloon *b = &scene->balloons[number];
    const struct {
        bool on;
        unsigned line;
        const char *name, *key;
        const double *direction;
    } places[] = {
        {b->pins.on, b->pins.line, "pins", "place", b->pins.place},
        {b->string.on, b->string.line, "string", "place", b->string.place},
        {b->gas.on && b->gas.neck > 0, b->gas.line, "gas", "neck_place", b->gas.neck_place},
    };
    for (size_t i = 0; i < sizeof places / sizeof places[0]; i++)
        if (places[i].on && is_nowhere(places[i].direction))
            return scene_contradiction(scene, number, places[i].name, places[i].line, err,
                                       "%s = [0, 0, 0] names no point; give a direction from the balloon's "
                                       "centre, such as [0.0, -1.0, 0.0]",
                                       places[i].key);
    return STATUS_OK;
}

enum status scene_check_surroundings(const struct scene *scene, struct error *err)
{
    if (is_nowhere(scene->view.camera)) {
        const struct scene_block *view = scene_find_block("", "view");
        const int line = scene_line_of(view, &scene->view, scene_find_field(view, "camera"));
        return refuse(scene, line > 0 ? (unsigned)line : 0, err,
                      "view: the camera sees nothing: camera = [0, 0, 0] lies in its target; give where the "
                      "eye is, seen from there, such as [0.0, 1.2, 8.0]");
    }
    if (scene->ground.on && is_nowhere(scene->ground.normal))
        return refuse(scene, scene->ground.line, err,
                      "ground: normal = [0, 0, 0] is no direction; level ground has [0.0, 1.0, 0.0]");
    for (size_t i = 0; i < scene->needles_count; i++)
        if (isnan(scene->needles[i].from[0]))
            return refuse(scene, scene->needles[i].line, err,
                          "needles[%zu] names no point; give from = [x, y, z], where it is at first", i);
    for (size_t i = 0; i < scene->schedule_count; i++)
        if (scene->schedule[i].balloon >= (int)scene->balloon_count)
            return refuse(scene, scene->schedule[i].line, err,
                          "schedule[%zu].balloon is %d, but the balloons are 0 to %zu", i,
                          scene->schedule[i].balloon, scene->balloon_count - 1);
    return STATUS_OK;
}
