/* accuracy.c - see accuracy.h.
 *
 * Rows of all scenes count alike, but those whose plan warned before the frame: what a plan warns of is known then. Exact is what
 * claims to be and had no certain pixel wrong; of the others borders tell, since that is where small masks are wrong: the
 * mean share of borders within a pixel of the true one. */
#include "accuracy.h"

#include <errno.h>
#include <math.h>
#include <string.h>

#include "command.h"
#include "trade_rows.h"

#define FINE 0.985
#define FAIR 0.93

typedef struct sums {
    double border, certain;
    int rows;
} sums;

static int variant_of(const trade_rows *rows, size_t row)
{
    const double scale = trade_number(rows, row, "scale");
    const char *upsample = trade_word(rows, row, "upsample");

    if (scale == 1.0)
        return GN_VARIANT_FULL;
    if (strcmp(upsample, "nearest") == 0)
        return GN_VARIANT_COUNT;
    return (scale == 2.0 ? GN_VARIANT_HALF : GN_VARIANT_QUARTER) + (strcmp(upsample, "depth") == 0);
}

static gn_accuracy class_of(const sums *s, int claims)
{
    const double border = s->border / s->rows;

    if (claims && s->certain == 0.0)
        return GN_ACCURACY_EXACT;
    return border >= FINE ? GN_ACCURACY_FINE : border >= FAIR ? GN_ACCURACY_FAIR : GN_ACCURACY_ROUGH;
}

int accuracy_from_trade(gn_knowledge *knowledge, const char *path)
{
    sums of[GN_METHOD_TOTAL][GN_VARIANT_COUNT];
    FILE *there = fopen(path, "r");
    trade_csv table;
    trade_rows rows;

    if (!there) {
        say("--trade: %s: cannot be read: %s", path, strerror(errno));
        return 0;
    }
    fclose(there);
    if (!trade_open(&table, path))
        return 0;
    if (!trade_rows_make(&rows, &table)) {
        say("--trade: %s: no memory for its rows", path);
        trade_close(&table);
        return 0;
    }
    memset(of, 0, sizeof of);
    for (size_t i = 0; i < rows.count; i++) {
        int one_sided;
        const gn_method method = gn_method_by_name(trade_word(&rows, i, "method"), &one_sided);
        const int variant = variant_of(&rows, i);

        /* a name with a plus has shortcuts of its own */
        if (method == GN_METHOD_TOTAL || variant == GN_VARIANT_COUNT || trade_word(&rows, i, "warning")[0] ||
            isnan(trade_error(&rows, i)) || strchr(trade_word(&rows, i, "config"), '+'))
            continue;
        of[method][variant].border += trade_number(&rows, i, "boundary_f1");
        of[method][variant].certain += trade_number(&rows, i, "wrong_certain");
        of[method][variant].rows++;
    }
    for (int m = 0; m < GN_METHOD_TOTAL; m++)
        for (int v = 0; v < GN_VARIANT_COUNT; v++)
            if (knowledge->ways[m][v].is_known && of[m][v].rows > 0)
                knowledge->ways[m][v].accuracy =
                    class_of(&of[m][v], v == GN_VARIANT_FULL && gn_method_describe((gn_method)m)->exact);
    trade_rows_free(&rows);
    trade_close(&table);
    return 1;
}
