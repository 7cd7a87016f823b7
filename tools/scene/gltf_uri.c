/* gltf_uri.c - bytes from where the document says: files beside it, or base64 inside it.
 *
 * A document may come from anywhere, so a URI may only name a file by a relative path, or carry its data; and a file
 * must be a regular one, since a pipe or a device would keep us waiting. */
#include "gltf.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

int gltf_read_file(gltf *g, const char *where, const char *path, gltf_bytes *out)
{
    char label[GLTF_WHERE + 170] = "";
    struct stat about;
    FILE *file;
    size_t size, got;
    uint8_t *data;

    if (*where) /* without it, it is the document, whose path stands in front of the message already */
        snprintf(label, sizeof label, "%.60s: %.160s: ", where, path);
    if (stat(path, &about) != 0)
        return gltf_fail(g, "%s%s", label, strerror(errno));
    if (!S_ISREG(about.st_mode))
        return gltf_fail(g, "%snot a regular file", label);
    if (about.st_size < 0 || (unsigned long long)about.st_size > GLTF_FILE_MAX)
        return gltf_fail(g, "%s%lld bytes, the limit is %lu", label, (long long)about.st_size,
                         (unsigned long)GLTF_FILE_MAX);
    size = (size_t)about.st_size;
    file = fopen(path, "rb");
    if (!file)
        return gltf_fail(g, "%s%s", label, strerror(errno));
    data = gltf_alloc(g, size + 1, 1);
    if (!data) {
        fclose(file);
        return 0;
    }
    got = fread(data, 1, size, file);
    fclose(file);
    if (got != size) {
        free(data);
        return gltf_fail(g, "%s%lu bytes read of %lu", label, (unsigned long)got, (unsigned long)size);
    }
    data[size] = 0;
    out->data = data;
    out->size = size;
    return 1;
}

static int hex_value(char c)
{
    if (c >= '0' && c <= '9')
        return c - '0';
    if (c >= 'a' && c <= 'f')
        return c - 'a' + 10;
    if (c >= 'A' && c <= 'F')
        return c - 'A' + 10;
    return -1;
}

static int base64_value(char c)
{
    if (c >= 'A' && c <= 'Z')
        return c - 'A';
    if (c >= 'a' && c <= 'z')
        return c - 'a' + 26;
    if (c >= '0' && c <= '9')
        return c - '0' + 52;
    return c == '+' ? 62 : c == '/' ? 63 : -1;
}

static int read_data_uri(gltf *g, const char *where, const char *uri, gltf_bytes *out)
{
    static const char tag[] = ";base64";
    const char *comma = strchr(uri, ',');
    const size_t tag_length = sizeof tag - 1;
    const char *text;
    size_t length, size = 0;
    uint32_t bits = 0;
    int bit_count = 0;
    uint8_t *data;

    if (!comma || (size_t)(comma - uri) < tag_length || strncmp(comma - tag_length, tag, tag_length) != 0)
        return gltf_fail(g, "%s: its data URI is not base64: %.40s", where, uri);
    text = comma + 1;
    length = strlen(text);
    while (length > 0 && text[length - 1] == '=')
        length--;
    if (length % 4 == 1)
        return gltf_fail(g, "%s: base64 of %lu characters is cut short", where, (unsigned long)length);
    data = gltf_alloc(g, length / 4 * 3 + 4, 1);
    if (!data)
        return 0;
    for (size_t i = 0; i < length; i++) {
        const int value = base64_value(text[i]);

        if (value < 0) {
            free(data);
            return gltf_fail(g, "%s: character %lu of its base64 is none", where, (unsigned long)i);
        }
        bits = (bits << 6 | (uint32_t)value) & 0xffffff;
        bit_count += 6;
        if (bit_count >= 8) {
            bit_count -= 8;
            data[size++] = (uint8_t)(bits >> bit_count);
        }
    }
    data[size] = 0;
    out->data = data;
    out->size = size;
    return 1;
}

/* RFC 3986: a scheme is a letter, then letters, digits, '+', '-', '.', up to a colon. */
static int has_scheme(const char *uri)
{
    static const char letters[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ";
    static const char others[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789+-.";

    return strspn(uri, letters) > 0 && uri[strspn(uri, others)] == ':';
}

int gltf_read_uri(gltf *g, const char *where, const char *uri, gltf_bytes *out)
{
    const char *slash = strrchr(g->path, '/');
    const size_t folder = slash ? (size_t)(slash - g->path) + 1 : 0;
    char *path, *end;
    int ok;

    if (strncmp(uri, "data:", 5) == 0)
        return read_data_uri(g, where, uri, out);
    if (has_scheme(uri) || uri[0] == '/' || uri[0] == '\0')
        return gltf_fail(g, "%s: its URI is not a relative path: %.80s", where, uri);
    path = gltf_alloc(g, folder + strlen(uri) + 1, 1);
    if (!path)
        return 0;
    memcpy(path, g->path, folder);
    end = path + folder;
    for (const char *c = uri; *c; c++) {
        const int high = *c == '%' ? hex_value(c[1]) : -1, low = high >= 0 ? hex_value(c[2]) : -1;

        if (*c != '%') {
            *end++ = *c;
        } else if (low < 0 || high + low == 0) { /* %00 would end the path early */
            free(path);
            return gltf_fail(g, "%s: its URI has a wrong %% at character %lu: %.80s", where, (unsigned long)(c - uri),
                             uri);
        } else {
            *end++ = (char)(high * 16 + low);
            c += 2;
        }
    }
    *end = '\0';
    ok = gltf_read_file(g, where, path, out);
    free(path);
    return ok;
}
