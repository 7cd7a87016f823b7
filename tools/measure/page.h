/* page.h - report.html: one page that needs no other file. */
#ifndef PAGE_H
#define PAGE_H
#include "trade_rows.h"

/* The board's facts, the pictures in `directory` (trade.svg, scaling.svg, if they are there), the table, which is sorted by a
 * click on a column's head, and the worst mask of each row. 1, or 0 having said why. */
int page_write(const trade_rows *rows, const char *directory);
#endif
