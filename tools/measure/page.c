/* page.c - see page.h. Pictures are put into the page: SVG as it is, PNG in base 64. */
#include "page.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "command.h"
#include "worst.h"

static const char head[] =
    "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\n"
    "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>gnomon measure</title>\n<style>\n"
    "body{font:15px/1.45 system-ui,sans-serif;margin:0 "
    "auto;max-width:1240px;padding:1rem;color:#1c1c1c;background:#fff}\n"
    "h1{font-size:1.5rem}h2{font-size:1.15rem;margin-top:2rem;border-bottom:1px solid #ccc}\n"
    "dl{display:grid;grid-template-columns:max-content 1fr;gap:.2rem 1rem}dt{color:#666}dd{margin:0}\n"
    ".wide{overflow-x:auto}svg{max-width:100%;height:auto}\n"
    "table{border-collapse:collapse;font-size:.82rem;white-space:nowrap}\n"
    "th{position:sticky;top:0;background:#f0ede6;cursor:pointer;text-align:right;padding:.3rem "
    ".5rem;vertical-align:bottom}\n"
    "th:hover{background:#e2dccd}td{text-align:right;padding:.15rem .5rem;border-bottom:1px solid #eee}\n"
    "td.t,th.t{text-align:left}tr.exact "
    "td{background:#f3f8f1}td.why{white-space:normal;text-align:left;color:#884400}\n"
    "figure{margin:1rem "
    "0}figcaption{font-size:.85rem;color:#444}img{max-width:100%;height:auto;image-rendering:pixelated}\n"
    "@media (max-width:600px){body{padding:.5rem;font-size:14px}}\n"
    "@media "
    "print{body{max-width:none}th{position:static}table{font-size:6pt}figure{break-inside:avoid}.wide{overflow:visible}"
    "}\n"
    "</style></head><body>\n";

/* Sorts by the column of a head that is clicked, numbers by value; a second click the other way. */
static const char script[] =
    "<script>\n"
    "document.querySelectorAll('table.sort th').forEach(function(th,i){th.addEventListener('click',function(){\n"
    "var t=th.closest('table'),b=t.tBodies[0],up=th.dataset.up!=='1';\n"
    "t.querySelectorAll('th').forEach(function(h){delete h.dataset.up});th.dataset.up=up?'1':'0';\n"
    "Array.from(b.rows).sort(function(p,q){var x=p.cells[i].textContent,y=q.cells[i].textContent,\n"
    "u=parseFloat(x),v=parseFloat(y),c=isNaN(u)&&isNaN(v)?x.localeCompare(y):isNaN(u)?1:isNaN(v)?-1:u-v;\n"
    "return up?c:-c}).forEach(function(r){b.appendChild(r)})})});\n"
    "</script>\n";

static const struct {
    const char *column, *title, *format;
    double factor;
} columns[] = {
    {"frame_ms", "ms", "%.2f", 1},
    {"frame_ms_p5", "5 %", "%.2f", 1},
    {"frame_ms_p95", "95 %", "%.2f", 1},
    {"shadow_ms", "shadow ms", "%.2f", 1},
    {"plan_ms", "plan ms", "%.2f", 1},
    {"wrong", "wrong", "%.0f", 1},
    {"wrong_certain", "certain", "%.0f", 1},
    {"interior", "interior", "%.0f", 1},
    {"iou", "IoU", "%.4f", 1},
    {"precision", "precision", "%.4f", 1},
    {"recall", "recall", "%.4f", 1},
    {"boundary_f1", "F 1 px", "%.4f", 1},
    {"boundary_f2", "F 2 px", "%.4f", 1},
    {"distance95", "95 % px", "%.2f", 1},
    {"flicker", "flicker", "%.0f", 1},
    {"psnr", "PSNR", "%.1f", 1},
    {"ssim", "SSIM", "%.4f", 1},
    {"flip", "FLIP", "%.4f", 1},
    {"shadow_fragments", "1000 fragments", "%.0f", 1e-3},
    {"draws", "draws", "%.0f", 1},
    {"traffic_estimate_bytes", "MB (est.)", "%.2f", 1e-6},
    {"energy_estimate_mj", "mJ (est.)", "%.3f", 1},
};
enum { COLUMNS = sizeof columns / sizeof columns[0] };

static void put_escaped(FILE *f, const char *text)
{
    for (; *text; text++)
        switch (*text) {
        case '<':
            fputs("&lt;", f);
            break;
        case '>':
            fputs("&gt;", f);
            break;
        case '&':
            fputs("&amp;", f);
            break;
        case '"':
            fputs("&quot;", f);
            break;
        default:
            fputc(*text, f);
        }
}

/* A file's bytes; NULL where it cannot be read. */
static uint8_t *read_file(const char *path, size_t *size)
{
    FILE *f = fopen(path, "rb");
    uint8_t *bytes = NULL;
    long length;

    if (!f)
        return NULL;
    if (fseek(f, 0, SEEK_END) == 0 && (length = ftell(f)) > 0 && fseek(f, 0, SEEK_SET) == 0) {
        *size = (size_t)length;
        bytes = malloc(*size + 1);
        if (bytes && fread(bytes, 1, *size, f) != *size) {
            free(bytes);
            bytes = NULL;
        }
        if (bytes)
            bytes[*size] = '\0';
    }
    fclose(f);
    return bytes;
}

static void put_base64(FILE *f, const uint8_t *bytes, size_t size)
{
    static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

    for (size_t i = 0; i < size; i += 3) {
        const size_t left = size - i;
        const uint32_t word = (uint32_t)bytes[i] << 16 | (left > 1 ? (uint32_t)bytes[i + 1] << 8 : 0) |
                              (left > 2 ? (uint32_t)bytes[i + 2] : 0);

        fputc(digits[word >> 18], f);
        fputc(digits[word >> 12 & 63], f);
        fputc(left > 1 ? digits[word >> 6 & 63] : '=', f);
        fputc(left > 2 ? digits[word & 63] : '=', f);
    }
}

static void put_svg(FILE *f, const char *directory, const char *name, const char *title)
{
    char path[1024];
    size_t size;
    uint8_t *text;
    const char *start;

    snprintf(path, sizeof path, "%s/%s", directory, name);
    text = read_file(path, &size);
    start = text ? strstr((const char *)text, "<svg") : NULL;
    if (start)
        fprintf(f, "<h2>%s</h2>\n<div class=\"wide\">%s</div>\n", title, start);
    free(text);
}

static void put_facts(FILE *f, const trade_rows *rows)
{
    static const struct {
        const char *column, *title;
    } facts[] = {{"renderer", "renderer"}, {"driver", "through"}, {"depth_bits", "bits of depth"},
                 {"frames", "frames"},     {"path", "camera"},    {"repeat", "times drawn"}};

    fputs("<h1>gnomon measure</h1>\n<dl>\n", f);
    for (size_t i = 0; i < sizeof facts / sizeof facts[0] && rows->count > 0; i++) {
        fprintf(f, "<dt>%s</dt><dd>", facts[i].title);
        put_escaped(f, trade_word(rows, 0, facts[i].column));
        fputs("</dd>\n", f);
    }
    fprintf(f,
            "</dl>\n<p>%lu rows. Times are the wall's clock; what a frame costs in shadows is its time less that of "
            "the same frame "
            "without. Wrong pixels are against ray-traced masks; <em>certain</em>: those of which the truth is sure; "
            "<em>interior</em>: more than two pixels from any border. Traffic and energy are estimates.</p>\n",
            (unsigned long)rows->count);
}

static void put_row(FILE *f, const trade_rows *rows, size_t row)
{
    const int is_exact = trade_number(rows, row, "wrong_certain") == 0.0;

    fprintf(f, "<tr%s><td class=\"t\">", is_exact ? " class=\"exact\"" : "");
    put_escaped(f, trade_word(rows, row, "scene"));
    fputs("</td><td class=\"t\">", f);
    put_escaped(f, trade_word(rows, row, "config"));
    fprintf(f, "</td><td>%sx%s</td><td>%s</td>", trade_word(rows, row, "width"), trade_word(rows, row, "height"),
            trade_word(rows, row, "lights"));
    for (int c = 0; c < COLUMNS; c++) {
        const double value = trade_number(rows, row, columns[c].column) * columns[c].factor;

        fputs("<td>", f);
        if (isinf(value))
            fputs("same", f);
        else if (!isnan(value))
            fprintf(f, columns[c].format, value);
        fputs("</td>", f);
    }
    fputs("<td class=\"why\">", f);
    put_escaped(f, trade_word(rows, row, "impossible"));
    put_escaped(f, trade_word(rows, row, "warning"));
    fputs("</td></tr>\n", f);
}

static void put_table(FILE *f, const trade_rows *rows)
{
    fputs("<h2>All of it</h2>\n<div class=\"wide\"><table class=\"sort\"><thead><tr><th class=\"t\">scene</th>"
          "<th class=\"t\">configuration</th><th>size</th><th>lights</th>",
          f);
    for (int c = 0; c < COLUMNS; c++)
        fprintf(f, "<th>%s</th>", columns[c].title);
    fputs("<th class=\"t\">impossible, or warned of</th></tr></thead><tbody>\n", f);
    for (size_t i = 0; i < rows->count; i++)
        put_row(f, rows, i);
    fputs("</tbody></table></div>\n", f);
}

static void put_worst(FILE *f, const trade_rows *rows, const char *directory)
{
    fputs("<h2>The worst mask of each: as drawn, the truth, and where they differ</h2>\n", f);
    for (size_t i = 0; i < rows->count; i++) {
        char path[1024];
        size_t size;
        uint8_t *bytes;

        worst_path(directory, trade_word(rows, i, "scene"), trade_word(rows, i, "config"), trade_word(rows, i, "width"),
                   trade_word(rows, i, "height"), trade_word(rows, i, "lights"), path, sizeof path);
        if (!(trade_number(rows, i, "worst_wrong") > 0.0) || !(bytes = read_file(path, &size)))
            continue;
        fputs("<figure><img loading=\"lazy\" alt=\"\" src=\"data:image/png;base64,", f);
        put_base64(f, bytes, size);
        fputs("\"><figcaption>", f);
        put_escaped(f, trade_word(rows, i, "scene"));
        fputs(", ", f);
        put_escaped(f, trade_word(rows, i, "config"));
        fprintf(f, ": frame %s, light %s, %s pixels of %sx%s</figcaption></figure>\n",
                trade_word(rows, i, "worst_frame"), trade_word(rows, i, "worst_light"),
                trade_word(rows, i, "worst_wrong"), trade_word(rows, i, "width"), trade_word(rows, i, "height"));
        free(bytes);
    }
}

int page_write(const trade_rows *rows, const char *directory)
{
    char path[1024];
    fresh_file f;

    snprintf(path, sizeof path, "%s/report.html", directory);
    if (!fresh_open(&f, path))
        return 0;
    fputs(head, f.file);
    put_facts(f.file, rows);
    put_svg(f.file, directory, "trade.svg", "Error against time, and against energy");
    put_svg(f.file, directory, "scaling.svg", "Time against lights, faces and pixels");
    put_table(f.file, rows);
    put_worst(f.file, rows, directory);
    fputs(script, f.file);
    fputs("</body></html>\n", f.file);
    return fresh_close(&f, 1);
}
