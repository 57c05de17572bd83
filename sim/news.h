/* What effects tell as it happens, for those who read what a program says. */
#ifndef SIM_NEWS_H
#define SIM_NEWS_H

#include "sim/sim.h"

/* Notes on stderr what they have told since it was asked last: that they wake, go to sleep, or can do no
 * more. */
void news_note(struct sim *sim);

#endif
