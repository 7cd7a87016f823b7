/* accuracy.h - the class of each way, by what `gnomon measure` found. */
#ifndef ACCURACY_H
#define ACCURACY_H
#include "gn_select.h"

/* Sets the classes of the ways that the table has rows of. 1, or 0 having said what is wrong with the file. */
int accuracy_from_trade(gn_knowledge *knowledge, const char *path);
#endif
