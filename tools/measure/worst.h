/* worst.h - the worst mask of a configuration as a picture: what was drawn, the truth, and where they differ. */
#ifndef WORST_H
#define WORST_H
#include "trial.h"

/* Where the worst mask of a row is, under its directory. */
void worst_path(const char *directory, const char *scene_file, const char *config_name, const char *width,
                const char *height, const char *lights, char *path, size_t size);

/* Three panels side by side, into path: lit white, shadowed dark, nothing seen blue; wrong pixels red in the third. Draws the
 * mask again. 1, or 0 having said why. */
int worst_write(subject *s, const config *c, const trial *t, const char *path);
#endif
