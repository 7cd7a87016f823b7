/* scan.h - words and numbers of a text, one after another, and where in it they stand. */
#ifndef GNI_SCAN_H
#define GNI_SCAN_H
#include "gni.h"

typedef enum gni_token_kind { GNI_TEXT_END, GNI_WORD, GNI_NUMBER, GNI_SIGN } gni_token_kind;

/* A sign is one of a few characters, or ":=" or "..". */
typedef struct gni_token {
    gni_token_kind kind;
    const char *at;
    size_t length;
    double number;
} gni_token;

typedef struct gni_scan {
    const char *what; /* in front of messages */
    gn_context *context;
    const char *text, *end, *at; /* at: behind the token */
    gni_token token;
    gn_result result; /* of the first failure; nothing is read after it */
} gni_scan;

void gni_scan_start(gni_scan *s, gn_context *context, const char *what, const char *text, size_t length);
void gni_scan_next(gni_scan *s);
/* Whether the token is this word, in any case, or this sign; "" is the text's end. */
int gni_scan_is(const gni_scan *s, const char *expected);
int gni_scan_take(gni_scan *s, const char *expected); /* and then goes on */
/* All of these in a row, with spaces between; each of less than 24 characters. */
void gni_scan_expect(gni_scan *s, const char *expected);
double gni_scan_number(gni_scan *s); /* with a sign in front of it */
/* "rules: line 3, column 7: no input has that name (x)": the first stays. */
void gni_scan_fail(gni_scan *s, const char *at, const char *format, ...)
#ifdef __GNUC__
    __attribute__((format(printf, 3, 4)))
#endif
    ;
#endif
