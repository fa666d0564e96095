// SPDX-License-Identifier: MIT
/* Grows trees at 25 given places, prints the numbers of instances and groups, and writes a file.
 * Usage: save_forest GRAMMAR OUTPUT */
#include <lsys.h>
#include <stdio.h>

static int fail(lsys_messages* messages) {
    fputs(lsys_messages_text(messages), stderr);
    lsys_messages_free(messages);
    return 1;
}

int main(int count, char** arguments) {
    if (count != 3) {
        fputs("usage: save_forest GRAMMAR OUTPUT\n", stderr);
        return 2;
    }
    lsys_tree places[25];
    for (uint32_t i = 0; i < 25; ++i) {
        const lsys_tree place = {
            {4.0F * (float)(i % 5), 0.0F, 4.0F * (float)(i / 5)}, 0.5F * (float)i, 1.0F, i, 0, 0};
        places[i] = place;
    }
    const char* const grammars[] = {arguments[1]};
    const lsys_option heroes = {"heroes", "2"};
    lsys_forest* forest = NULL;
    lsys_messages* messages = NULL;
    if (lsys_forest_of_places(grammars, 1, places, 25, NULL, &heroes, 1, NULL, &forest,
                              &messages) != LSYS_OK) {
        return fail(messages);
    }
    lsys_messages_free(messages);

    lsys_instances* instances = NULL;
    lsys_status status = lsys_make_instances(forest, 0, NULL, &instances, &messages);
    if (status == LSYS_OK) {
        printf("%llu instances in %llu groups\n",
               (unsigned long long)lsys_instances_count(instances),
               (unsigned long long)lsys_instances_group_count(instances));
        lsys_messages_free(messages);
        const lsys_option preset = {"preset", "web"};
        status = lsys_save_forest(forest, arguments[2], &preset, 1, NULL, &messages);
    }
    lsys_instances_free(instances);
    lsys_forest_free(forest);
    if (status != LSYS_OK) {
        return fail(messages);
    }
    lsys_messages_free(messages);
    return 0;
}
