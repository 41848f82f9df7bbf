/* SPDX-License-Identifier: MIT */
/* Prints what a scenario file may hold: all sections, keys and outcomes, in Markdown. */
#ifndef FUZZY51_KEYS_PAGE_H
#define FUZZY51_KEYS_PAGE_H

/* APP: those of this controller alone; NULL: of all. Returns EXIT_FINE, or EXIT_USAGE after a
 * message when there is no such controller. */
int keys_page_print(const char *app);

#endif
