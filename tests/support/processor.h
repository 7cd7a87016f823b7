/* processor.h - the processor time of this process: what a software driver spends, on all its threads, however busy the
 * machine is with others. */
#ifndef PROCESSOR_H
#define PROCESSOR_H

double processor_ms(void);
#endif
