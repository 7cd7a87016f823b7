/* keep_open.c - preloaded by tests/valgrind.sh: libraries stay open, so that what a driver keeps has the driver's
 * name, and a leak of gnomon's cannot hide among nameless ones. */
int dlclose(void *library);

int dlclose(void *library)
{
    (void)library;
    return 0;
}
