/* The command line: argp's, but that it knows what a misspelt option was meant to be. */
#include "common/command.h"
#include "common/spelling.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static const struct argp_option argp_options[] = {
    {"help", '?', 0, 0, 0, 0}, {"usage", 0, 0, 0, 0, 0}, {"version", 'V', 0, 0, 0, 0}, {0}};

/* The option whose name begins with this, or that has exactly this name; NULL: none. As for argp, the
 * start of a name will do. */
static const struct argp_option *find_name(const struct argp_option *options, const char *name, size_t length)
{
    const struct argp_option *found = NULL;
    for (const struct argp_option *o = options; o->name; o++)
        if (!strncmp(o->name, name, length)) {
            found = o;
            if (!o->name[length])
                break;
        }
    return found;
}

/* Of "-qo FILE": whether the last of the letters takes the next argument. */
static bool letters_take_next(const struct argp_option *options, const char *letters)
{
    for (; *letters; letters++)
        for (const struct argp_option *o = options; o->name; o++)
            if (o->key == *letters && o->arg)
                return !letters[1];
    return false;
}

static _Noreturn void refuse(const struct argp_option *options, const char *name, size_t length)
{
    char wrong[64];
    snprintf(wrong, sizeof wrong, "%.*s", (int)(length < sizeof wrong ? length : sizeof wrong), name);
    struct spelling guess = spelling_of(wrong);
    for (const struct argp_option *o = options; o->name; o++)
        spelling_consider(&guess, o->name);
    for (const struct argp_option *o = argp_options; o->name; o++)
        spelling_consider(&guess, o->name);
    fprintf(stderr, "%s: unrecognized option '--%.*s'%s%s; --help lists all options\n",
            program_invocation_short_name, (int)length, name, guess.nearest ? "; nearest: --" : "",
            guess.nearest ? guess.nearest : "");
    exit(argp_err_exit_status);
}

/* Ends the program at the first option that has no name; what else may be wrong argp says. */
static void refuse_unknown(const struct argp_option *options, int argc, char **argv)
{
    for (int i = 1; i < argc && strcmp(argv[i], "--") != 0; i++) {
        const char *name = argv[i] + 2;
        if (argv[i][0] != '-')
            continue;
        if (argv[i][1] != '-') {
            i += letters_take_next(options, argv[i] + 1);
            continue;
        }
        const size_t length = strcspn(name, "=");
        if (find_name(argp_options, name, length))
            return; /* argp ends the program there */
        const struct argp_option *o = find_name(options, name, length);
        if (!o)
            refuse(options, name, length);
        i += o->arg && !(o->flags & OPTION_ARG_OPTIONAL) && !name[length];
    }
}

/* What is parsed: argp hands its parser nothing of ours. By key: what counts, and what came before. */
static const struct argp *program;
static const char *given[COMMAND_KEYS], *replaced[COMMAND_KEYS];

/* At the end, when it is known whether notes are wanted. */
static void tell_replaced(void)
{
    for (const struct argp_option *o = program->options; o->name; o++)
        if (replaced[o->key] && !(o->flags & OPTION_REPEATS))
            command_note("--%s %s does nothing: --%s %s comes after it", o->name, replaced[o->key], o->name,
                         given[o->key]);
}

static error_t parse(int key, char *argument, struct argp_state *state)
{
    if (key > 0 && key < COMMAND_KEYS && argument) {
        if (given[key] && strcmp(given[key], argument) != 0)
            replaced[key] = given[key];
        given[key] = argument;
    }
    if (key == ARGP_KEY_END)
        tell_replaced();
    return program->parser(key, argument, state);
}

static bool parsed;

/* argp does not ask whether what it printed, as for --help, was written. */
static void end_in_argp(void)
{
    if (!parsed && command_end())
        _exit(1);
}

void command_parse(const struct argp *argp, int argc, char **argv, void *input)
{
    struct argp noting = *argp;
    noting.parser = parse;
    program = argp;
    refuse_unknown(argp->options, argc, argv);
    atexit(end_in_argp);
    argp_parse(&noting, argc, argv, 0, NULL, input);
    parsed = true;
}
