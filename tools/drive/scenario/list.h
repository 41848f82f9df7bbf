/* SPDX-License-Identifier: MIT */
/* What a folder of scenarios holds. */
#ifndef FUZZY51_LIST_H
#define FUZZY51_LIST_H

/* Prints a line for each .scn file of FOLDER: its name, its title, its stated outcomes. Returns
 * EXIT_FINE, or EXIT_INPUT after a message. */
int list_scenarios(const char *folder);

#endif
