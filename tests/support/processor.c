/* processor.c - the processor time by POSIX's clock of the process. */
#include "processor.h"

#include <time.h>

double processor_ms(void)
{
    struct timespec t;

    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return 1e3 * (double)t.tv_sec + 1e-6 * (double)t.tv_nsec;
}
