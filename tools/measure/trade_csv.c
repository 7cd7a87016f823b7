/* trade_csv.c - see trade_csv.h. */
#include "trade_csv.h"

#include <math.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include "command.h"

#define MILLIJOULES_A_BYTE 1e-7 /* 100 mW for a gigabyte a second (Arm; FACTS.md) */

static const char header[] =
    "scene,config,width,height,lights,frames,repeat,path,renderer,driver,method,scale,upsample,near,depth_bits,"
    "casters,faces,impossible,warning,masks,visible,wrong,wrong_certain,interior,boundary,iou,precision,recall,"
    "boundary_f1,boundary_f2,distance95,flicker,psnr,ssim,flip,worst_frame,worst_light,worst_wrong,shadow_fragments,"
    "vertices,indices,draws,bytes_sent,traffic_estimate_bytes,memory_bytes,energy_estimate_mj,frame_ms,frame_ms_p5,"
    "frame_ms_p95,shadow_ms,shadow_ms_p5,shadow_ms_p95,plan_ms,plan_ms_p5,"
    "plan_ms_p95,clock";

const char *trade_header(void)
{
    return header;
}

/* A line that grows. */
typedef struct line {
    char text[4096];
    size_t length;
} line;

static void put(line *l, const char *format, ...)
#ifdef __GNUC__
    __attribute__((format(printf, 2, 3)))
#endif
    ;

static void put(line *l, const char *format, ...)
{
    va_list args;
    int written;

    va_start(args, format);
    written = vsnprintf(l->text + l->length, sizeof l->text - l->length, format, args);
    va_end(args);
    if (written > 0)
        l->length += (size_t)written < sizeof l->text - l->length ? (size_t)written : sizeof l->text - l->length - 1;
}

/* Quoted, its quotes doubled; a comma after it. */
static void put_word(line *l, const char *word)
{
    put(l, "\"");
    for (const char *c = word; *c; c++)
        put(l, *c == '"' ? "\"\"" : "%c", (unsigned char)*c >= ' ' ? *c : '?');
    put(l, "\",");
}

static void put_key(line *l, const row_key *k)
{
    put_word(l, k->scene);
    put_word(l, k->config);
    put(l, "%u,%u,%u,%u,%u,", (unsigned)k->width, (unsigned)k->height, (unsigned)k->lights, (unsigned)k->frames,
        (unsigned)k->repeat);
    put_word(l, k->path);
    put_word(l, k->renderer);
    put_word(l, k->driver);
}

static void put_accuracy(line *l, const trial *t)
{
    put(l, "%u,%llu,%llu,%llu,%llu,%llu,", (unsigned)t->masks, (unsigned long long)t->visible,
        (unsigned long long)t->wrong, (unsigned long long)t->certain_wrong, (unsigned long long)t->interior,
        (unsigned long long)t->boundary);
    put(l, "%.6f,%.6f,%.6f,%.6f,%.6f,%.3f,%llu,", t->iou, t->precision, t->recall, t->boundary_f[0], t->boundary_f[1],
        t->distance95, (unsigned long long)t->flicker);
    if (isinf(t->psnr))
        put(l, "inf,");
    else
        put(l, "%.4f,", t->psnr);
    put(l, "%.6f,%.6f,%u,%u,%llu,", t->ssim, t->flip, (unsigned)t->worst_frame, (unsigned)t->worst_light,
        (unsigned long long)t->worst_wrong);
    put(l, "%.1f,%.1f,%.1f,%.1f,%.1f,%.0f,%.0f,%.6f,", t->fragments, t->vertices, t->indices, t->draws, t->bytes_sent,
        t->traffic, t->memory, t->traffic * MILLIJOULES_A_BYTE);
}

static void put_spread(line *l, const spread *s)
{
    put(l, "%.3f,%.3f,%.3f,", s->median, s->p5, s->p95);
}

static char *copy_of(const char *text, size_t length)
{
    char *copy = malloc(length + 1);

    if (copy) {
        memcpy(copy, text, length);
        copy[length] = '\0';
    }
    return copy;
}

static int keep(trade_csv *t, char *row)
{
    if (t->count == t->capacity && row) {
        const size_t capacity = t->capacity ? 2 * t->capacity : 64;
        char **rows = realloc(t->rows, capacity * sizeof *rows);

        if (rows) {
            t->rows = rows;
            t->capacity = capacity;
        }
    }
    if (!row || t->count == t->capacity) {
        free(row);
        say("%s: no memory for its rows", t->path);
        return 0;
    }
    t->rows[t->count++] = row;
    return 1;
}

static int read_rows(trade_csv *t, FILE *f)
{
    char text[4096];
    int ok = 1, is_first = 1;

    while (ok && fgets(text, sizeof text, f)) {
        const size_t length = strcspn(text, "\n");

        text[length] = '\0';
        if (is_first && strcmp(text, header) != 0) {
            say("%s: is no table of this version: move it away (%.40s)", t->path, text);
            return 0;
        }
        ok = is_first || keep(t, copy_of(text, length));
        is_first = 0;
    }
    return ok;
}

int trade_open(trade_csv *t, const char *path)
{
    FILE *f = fopen(path, "r");
    int ok;

    memset(t, 0, sizeof *t);
    t->path = copy_of(path, strlen(path));
    ok = t->path != NULL;
    if (f) {
        ok = ok && read_rows(t, f);
        fclose(f);
    }
    if (!ok)
        trade_close(t);
    return ok;
}

void trade_close(trade_csv *t)
{
    for (size_t i = 0; i < t->count; i++)
        free(t->rows[i]);
    free(t->rows);
    free(t->path);
    memset(t, 0, sizeof *t);
}

int trade_has(const trade_csv *t, const row_key *key)
{
    line l = {"", 0};

    put_key(&l, key);
    for (size_t i = 0; i < t->count; i++)
        if (strncmp(t->rows[i], l.text, l.length) == 0)
            return 1;
    return 0;
}

static int write_rows(const trade_csv *t)
{
    fresh_file f;

    if (!fresh_open(&f, t->path))
        return 0;
    fprintf(f.file, "%s\n", header);
    for (size_t i = 0; i < t->count; i++)
        fprintf(f.file, "%s\n", t->rows[i]);
    return fresh_close(&f, 1);
}

int trade_add(trade_csv *t, const row_key *key, const config *c, const subject *s, const trial *r)
{
    static const char *const upsamples[] = {"nearest", "bilinear", "depth"};
    line l = {"", 0};

    put_key(&l, key);
    put_word(&l, gn_method_describe(c->method)->name);
    put(&l, "%u,%s,%g,%d,%u,%u,", (unsigned)c->scale, c->scale > 1 ? upsamples[c->upsample] : "",
        s->loaded.camera.znear, s->stage->target.depth_bits, (unsigned)r->casters, (unsigned)r->faces);
    put_word(&l, r->impossible);
    put_word(&l, r->warning);
    if (r->impossible[0]) {
        for (const char *column = strchr(strstr(header, "masks,"), ','); column; column = strchr(column + 1, ','))
            put(&l, ",");
    } else {
        put_accuracy(&l, r);
        put_spread(&l, &r->frame);
        put_spread(&l, &r->shadow);
        put_spread(&l, &r->plan);
        put(&l, "\"%s\"", s->clock.query ? "query" : s->clock.why_not);
    }
    return keep(t, copy_of(l.text, l.length)) && write_rows(t);
}
