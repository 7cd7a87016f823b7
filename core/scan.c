/* scan.c - see scan.h. Numbers are read here and not by strtod, whose decimal point is the locale's. */
#include "scan.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

static int is_digit(char c)
{
    return c >= '0' && c <= '9';
}

static int lower(char c)
{
    return c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c;
}

static int is_letter(char c)
{
    return (lower(c) >= 'a' && lower(c) <= 'z') || c == '_';
}

void gni_scan_fail(gni_scan *s, const char *at, const char *format, ...)
{
    char text[160];
    va_list args;
    unsigned long line = 1, column = 1;

    if (s->result != GN_OK)
        return;
    va_start(args, format);
    vsnprintf(text, sizeof text, format, args);
    va_end(args);
    for (const char *c = s->text; c < at; c++) {
        column = *c == '\n' ? 1 : column + 1;
        line += *c == '\n';
    }
    s->result = gn_fail(s->context, GN_E_ARG, "%s: line %lu, column %lu: %s", s->what, line, column, text);
    s->token.kind = GNI_TEXT_END;
    s->token.at = s->at = s->end;
    s->token.length = 0;
}

/* White space and comments. */
static void skip(gni_scan *s)
{
    for (;;) {
        const char *start = s->at;

        while (s->at < s->end && (*s->at == ' ' || *s->at == '\t' || *s->at == '\n' || *s->at == '\r'))
            s->at++;
        if (s->at < s->end && (*s->at == '#' || (s->end - s->at > 1 && s->at[0] == '/' && s->at[1] == '/')))
            while (s->at < s->end && *s->at != '\n')
                s->at++;
        if (s->end - s->at > 1 && s->at[0] == '(' && s->at[1] == '*') {
            const char *comment = s->at;

            for (s->at += 2; s->end - s->at > 1 && !(s->at[0] == '*' && s->at[1] == ')');)
                s->at++;
            if (s->end - s->at <= 1) {
                gni_scan_fail(s, comment, "a comment has no end");
                return;
            }
            s->at += 2;
        }
        if (s->at == start)
            return;
    }
}

/* Digits with a point and an exponent; "0..1" is a 0 before two points. */
static void scan_number(gni_scan *s)
{
    const char *c = s->at;
    double value = 0.0;
    int exponent = 0;

    while (c < s->end && is_digit(*c))
        value = 10.0 * value + (*c++ - '0');
    if (c < s->end && *c == '.' && !(s->end - c > 1 && c[1] == '.'))
        for (c++; c < s->end && is_digit(*c); exponent--)
            value = 10.0 * value + (*c++ - '0');
    if (s->end - c > 1 && lower(*c) == 'e' && (is_digit(c[1]) || (s->end - c > 2 && is_digit(c[2])))) {
        const int is_negative = c[1] == '-';
        int power = 0;

        for (c += is_digit(c[1]) ? 1 : 2; c < s->end && is_digit(*c); c++)
            power = power < 1000 ? 10 * power + (*c - '0') : power;
        exponent += is_negative ? -power : power;
    }
    s->token.kind = GNI_NUMBER;
    s->token.number = exponent < 0 ? value / pow(10.0, -exponent) : value * pow(10.0, exponent);
    s->at = c;
}

void gni_scan_next(gni_scan *s)
{
    skip(s);
    if (s->result != GN_OK)
        return;
    s->token.at = s->at;
    s->token.kind = GNI_TEXT_END;
    if (s->at < s->end && is_letter(*s->at)) {
        s->token.kind = GNI_WORD;
        while (s->at < s->end && (is_letter(*s->at) || is_digit(*s->at)))
            s->at++;
    } else if (s->at < s->end && is_digit(*s->at)) {
        scan_number(s);
    } else if (s->at < s->end) {
        const int is_double =
            s->end - s->at > 1 && ((s->at[0] == ':' && s->at[1] == '=') || (s->at[0] == '.' && s->at[1] == '.'));

        s->token.kind = GNI_SIGN;
        s->at += is_double ? 2 : 1;
    }
    s->token.length = (size_t)(s->at - s->token.at);
}

void gni_scan_start(gni_scan *s, gn_context *context, const char *what, const char *text, size_t length)
{
    *s = (gni_scan){what, context, text, text + length, text, {GNI_TEXT_END, text, 0, 0.0}, GN_OK};
    gni_scan_next(s);
}

int gni_scan_is(const gni_scan *s, const char *expected)
{
    if (strlen(expected) != s->token.length)
        return 0;
    for (size_t i = 0; i < s->token.length; i++)
        if (lower(expected[i]) != lower(s->token.at[i]))
            return 0;
    return 1;
}

int gni_scan_take(gni_scan *s, const char *expected)
{
    if (s->result != GN_OK || !gni_scan_is(s, expected))
        return 0;
    gni_scan_next(s);
    return 1;
}

/* One of the expected; 0 having failed. */
static int expect(gni_scan *s, const char *expected)
{
    if (gni_scan_take(s, expected))
        return 1;
    if (s->token.length)
        gni_scan_fail(s, s->token.at, "%s is missing before '%.*s'", expected,
                      (int)(s->token.length < 40 ? s->token.length : 40), s->token.at);
    else
        gni_scan_fail(s, s->token.at, "%s is missing at the end", expected);
    return 0;
}

void gni_scan_expect(gni_scan *s, const char *expected)
{
    char one[24];

    do {
        const size_t length = strcspn(expected, " ");

        memcpy(one, expected, length);
        one[length] = '\0';
        expected += length + (expected[length] == ' ');
    } while (expect(s, one) && *expected);
}

double gni_scan_number(gni_scan *s)
{
    const int is_negative = gni_scan_take(s, "-");
    const int shown = (int)(s->token.length < 40 ? s->token.length : 40);
    double number = 0.0;

    if (!is_negative)
        gni_scan_take(s, "+");
    if (s->token.kind != GNI_NUMBER) {
        gni_scan_fail(s, s->token.at, "a number is missing ('%.*s')", shown, s->token.at);
        return 0.0;
    }
    number = s->token.number;
    if (!isfinite(number))
        gni_scan_fail(s, s->token.at, "the number is too large (%.*s)", shown, s->token.at);
    gni_scan_next(s);
    return is_negative ? -number : number;
}
