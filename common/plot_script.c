/* A plot in gnuplot's language. */
#include "common/plot_script.h"

#include <math.h>

enum { PANEL_WIDTH = 620, PANEL_HEIGHT = 470, TITLE_HEIGHT = 40 };

/* Colours that stay apart for colour-blind eyes (Okabe and Ito, "Color universal design", 2008; its black is
 * left to the axes and its yellow, too pale for lines, is left out). */
static const char *const colours[PLOT_BLACK] = {"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                                "#e69f00", "#56b4e9", "#202020"};

/* How many bytes the letter of UTF-8 takes that begins here; 0: none begins. */
static size_t letter_length(const char *text)
{
    const unsigned char first = (unsigned char)*text;
    const size_t length = first < 0x80                    ? 1
                          : first >= 0xC2 && first < 0xE0 ? 2
                          : first >= 0xE0 && first < 0xF0 ? 3
                          : first >= 0xF0 && first < 0xF5 ? 4
                                                          : 0;
    for (size_t i = 1; i < length; i++)
        if (((unsigned char)text[i] & 0xC0) != 0x80)
            return 0;
    return length;
}

/* One letter, of those that a picture can hold: line ends become spaces, and what is no UTF-8, as a file's
 * name may have it, "?". Returns how many bytes it took. */
static size_t put_letter(FILE *script, const char *text)
{
    const size_t length = letter_length(text);
    if (length > 1)
        fwrite(text, 1, length, script);
    else
        fputc(length == 0 ? '?' : *text < ' ' ? ' ' : *text, script);
    return length > 0 ? length : 1;
}

/* A text between quotes, in which gnuplot reads nothing but a doubled quote. */
static void put_text(FILE *script, const char *text)
{
    fputc('\'', script);
    while (text && *text) {
        if (*text == '\'')
            fputc('\'', script);
        text += put_letter(script, text);
    }
    fputc('\'', script);
}

static void put_setting(FILE *script, const char *name, const char *text)
{
    fprintf(script, "set %s ", name);
    put_text(script, text);
    fputs(" noenhanced\n", script);
}

static bool drawable(double value, bool logarithmic)
{
    return isfinite(value) && (value > 0 || !logarithmic);
}

/* A series as a named block of data: x, y and label; a blank line where a point is left out. */
static void put_data(FILE *script, const struct plot_panel *panel, size_t index)
{
    const struct plot_series *s = &panel->series[index];
    fprintf(script, "$series%zu << END_OF_SERIES\n", index);
    for (size_t i = 0; i < s->count; i++) {
        double x = s->style == PLOT_BARS ? (double)i : s->x[i];
        if (!drawable(x, panel->log_x) || !drawable(s->y[i], panel->log_y)) {
            fputc('\n', script);
            continue;
        }
        fprintf(script, "%.12g %.12g \"", x, s->y[i]);
        for (const char *c = s->label ? s->label[i] : ""; *c;)
            c += put_letter(script, *c == '"' || *c == '\\' ? " " : c);
        fputs("\"\n", script);
    }
    fputs("END_OF_SERIES\n", script);
}

static bool has_points(const struct plot_panel *panel)
{
    for (size_t i = 0; i < panel->series_count; i++)
        for (size_t k = 0; k < panel->series[i].count; k++) {
            const struct plot_series *s = &panel->series[i];
            if ((s->style == PLOT_BARS || drawable(s->x[k], panel->log_x)) && drawable(s->y[k], panel->log_y))
                return true;
        }
    return false;
}

static bool has_bars(const struct plot_panel *panel)
{
    return panel->series_count && panel->series[0].style == PLOT_BARS;
}

/* Bars at the same label stand side by side and leave a fifth of the room free. */
static double bar_width(const struct plot_panel *panel)
{
    return 0.8 / (double)panel->series_count;
}

static void find_range(const struct plot_panel *panel, char axis, bool logarithmic, double *low, double *high)
{
    *low = INFINITY;
    *high = -INFINITY;
    for (size_t i = 0; i < panel->series_count; i++)
        for (size_t k = 0; k < panel->series[i].count; k++) {
            const double value = (axis == 'x' ? panel->series[i].x : panel->series[i].y)[k];
            if (drawable(value, logarithmic)) {
                *low = fmin(*low, value);
                *high = fmax(*high, value);
            }
        }
}

/* What is drawn, with room for marks and labels, where gnuplot would end a logarithmic axis at the next
 * powers of ten, and add a whole one for the room: but two powers are on it, so that it can be read. */
static void put_log_range(FILE *script, const struct plot_panel *panel, char axis, double before,
                          double after)
{
    double low, high;
    find_range(panel, axis, true, &low, &high);
    if (!(low <= high))
        return;
    const double length = fmax(log10(high / low), 0.5);
    double from = log10(low) - before * length, to = log10(high) + after * length;
    if (floor(to) - ceil(from) < 1) {
        from = floor(from);
        to = ceil(to);
    }
    fprintf(script, "set %crange [%.6g:%.6g]\n", axis, pow(10, from), pow(10, to));
}

static void put_range(FILE *script, const struct plot_panel *panel)
{
    enum { WHOLE = 9 };                   /* up to here gnuplot would mark halves too */
    static const double round_off = 1e-9; /* of the highest: no lower than 0 */
    double low, high;
    find_range(panel, 'y', false, &low, &high);
    fputs(!panel->from_zero || low < -round_off * fabs(high) ? "set yrange [*:*]\n"
          : high > 0                                         ? "set yrange [0:*]\n"
                                                             : "set yrange [0:1]\n",
          script);
    fputs(panel->whole && high < WHOLE ? "set ytics 1\n" : "set ytics autofreq\n", script);
}

static void put_axes(FILE *script, const struct plot_panel *panel)
{
    put_setting(script, "title", panel->title);
    put_setting(script, "xlabel", panel->x_label);
    put_setting(script, "ylabel", panel->y_label);
    for (int axis = 'x'; axis <= 'y'; axis++) {
        bool logarithmic = axis == 'x' ? panel->log_x && !has_bars(panel) : panel->log_y;
        fprintf(script,
                logarithmic ? "set logscale %c\nset format %c '10^{%%L}'\n"
                            : "unset logscale %c\nset format %c '%%g'\n",
                axis, axis);
    }
    put_range(script, panel);
    bool named = false;
    for (size_t i = 0; i < panel->series_count; i++)
        named = named || panel->series[i].name;
    /* Labels beside points need room, and so does a key among lines, which end where the time does. */
    bool lines = panel->series_count && panel->series[0].style == PLOT_LINE;
    fputs(!lines ? "set autoscale x\nset offsets graph 0.02, graph 0.08, graph 0.05, 0\n"
          : named && !panel->key_outside ? "set autoscale xfix\nset offsets 0, 0, graph 0.3, graph 0.02\n"
                                         : "set autoscale xfix\nset offsets 0, 0, graph 0.05, graph 0.02\n",
          script);
    fputs(!named               ? "set key off\n"
          : panel->key_outside ? "set key on outside right top nobox\n"
                               : "set key on inside right top box lc rgb '#d0d0d0' width 1\n",
          script);
    if (!lines && !has_bars(panel)) {
        if (panel->log_x)
            put_log_range(script, panel, 'x', 0.08, 0.12);
        if (panel->log_y)
            put_log_range(script, panel, 'y', 0.06, named && !panel->key_outside ? 0.4 : 0.08);
        if (panel->log_x && panel->log_y)
            fputs("set offsets 0, 0, 0, 0\n", script);
    }
    if (has_bars(panel))
        fprintf(script, "set style fill solid 0.85 noborder\nset boxwidth %g absolute\n", bar_width(panel));
    fputs(has_bars(panel) ? "set xtics rotate by -35 nomirror noenhanced\n"
                          : "set xtics norotate autofreq nomirror enhanced\n",
          script);
}

static void put_labels(FILE *script, size_t index, const char *which, const char *place, const char *colour)
{
    fprintf(script,
            ", $series%zu using 1:2:3%s with labels %s boxed font ',9' noenhanced tc rgb '%s' notitle", index,
            which, place, colour);
}

static const char *colour_of(const struct plot_series *series, size_t index)
{
    return colours[series->colour ? (size_t)series->colour - 1 : index % PLOT_COLOURS];
}

static void put_series(FILE *script, const struct plot_panel *panel, size_t index)
{
    const struct plot_series *s = &panel->series[index];
    const char *colour = colour_of(s, index);
    const int number = s->mark ? s->mark - 1 : (int)index;
    const int mark = s->mark == PLOT_RING
                         ? 6
                         : 5 + 2 * (number % PLOT_MARKS); /* a ring; filled square, disc, triangle, ... */
    fprintf(script, "$series%zu ", index);
    if (s->style == PLOT_BARS)
        fprintf(script, "using ($0 + %g):2%s with boxes lc rgb '%s' ",
                bar_width(panel) * ((double)index - 0.5 * (double)(panel->series_count - 1)),
                s->label ? ":xtic(3)" : "", colour);
    else if (s->style == PLOT_LINE)
        fprintf(script, "using 1:2 with lines lw 2 lc rgb '%s' ", colour);
    else if (s->style == PLOT_UNDERLAY)
        fputs("using 1:2 with lines lw 14 lc rgb '#e4e0d0' ", script);
    else
        fprintf(script, "using 1:2 with %s lw 2 pt %d ps %g lc rgb '%s' ",
                s->style == PLOT_CURVE ? "linespoints" : "points", mark, s->mark == PLOT_RING ? 1.8 : 0.9,
                colour);
    fputs("title ", script);
    put_text(script, s->name);
    fputs(s->name ? " noenhanced" : "", script);
}

/* After all that is drawn, so that each lies over every line and can be read. */
static void put_series_labels(FILE *script, const struct plot_panel *panel, size_t index)
{
    const struct plot_series *s = &panel->series[index];
    if (!s->label || s->style == PLOT_BARS)
        return;
    put_labels(script, index, s->labels_below ? " every ::::0" : "", "left offset 0.8,0.5",
               colour_of(s, index));
    if (s->labels_below)
        put_labels(script, index, " every ::1", "right offset -0.8,-0.5", colour_of(s, index));
}

static void put_panel(FILE *script, const struct plot_panel *panel)
{
    for (size_t i = 0; i < panel->series_count; i++)
        put_data(script, panel, i);
    put_axes(script, panel);
    if (!has_points(panel)) { /* an empty frame, where gnuplot would give up */
        fputs("set key off\nset xrange [1:10]\nset yrange [1:10]\nplot NaN\nset autoscale\n", script);
        return;
    }
    fputs("plot ", script);
    for (size_t i = 0; i < panel->series_count; i++) {
        fputs(i ? ", " : "", script);
        put_series(script, panel, i);
    }
    for (size_t i = 0; i < panel->series_count; i++)
        put_series_labels(script, panel, i);
    fputc('\n', script);
}

void plot_write_script(const struct plot *plot, bool svg, FILE *script)
{
    size_t rows = (plot->panel_count + plot->columns - 1) / plot->columns;
    const size_t width = plot->width ? plot->width : PANEL_WIDTH,
                 height = plot->height ? plot->height : PANEL_HEIGHT;
    fprintf(script, "set encoding utf8\nset terminal %s size %zu,%zu font 'DejaVu Sans,11' %s\n",
            svg ? "svg" : "pngcairo", plot->columns * width, rows * height + (plot->title ? TITLE_HEIGHT : 0),
            svg ? "background 'white'" : "");
    fputs("set border 3 lc rgb '#404040'\nset tics nomirror out tc rgb '#404040'\n"
          "set grid xtics ytics lc rgb '#e0e0e0' lw 1 lt 1\nset datafile missing 'NaN'\n"
          "set style textbox opaque noborder fillcolor rgb '#50ffffff' margins 0.3,0.1\n"
          "set key top right samplen 2 spacing 1.2 opaque box lc rgb '#d0d0d0' width 1\n",
          script);
    fprintf(script, "set multiplot layout %zu,%zu", rows, plot->columns);
    if (plot->title) {
        fputs(" title ", script);
        put_text(script, plot->title);
        fputs(" noenhanced font ',14'", script);
    }
    fputc('\n', script);
    for (size_t i = 0; i < plot->panel_count; i++)
        put_panel(script, &plot->panels[i]);
    fputs("unset multiplot\n", script);
}
