/* mask_files.h - masks of a posed scene as files: light0.png, light1.png ... as the command's contract says. */
#ifndef MASK_FILES_H
#define MASK_FILES_H
#include "stage.h"

/* One for each light of the scene, by that way; of `like` method, one_sided, scale, upsample and sharpen are read. 0, or an exit
 * status having said why. */
int write_masks(stage *s, const stage_wish *like, const char *folder);
#endif
