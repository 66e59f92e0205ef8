// Lists names for a message.
#include "assets/model.h"
#include "assets/model_parts.h"

#include <stdio.h>
#include <string.h>

enum { ROOM_FOR_COUNT = 24 }; // Bytes of a list's end: " and 3 more".

void dip_name_list_add(DipNameList *list, const char *name) {
    char quoted[80];
    snprintf(quoted, sizeof quoted, "\"%.70s\"", name);
    dip_make_one_line(quoted);
    const size_t length = strlen(list->text);
    const size_t room = sizeof list->text - ROOM_FOR_COUNT - length;
    if (strstr(list->text, quoted)) {
        return;
    }
    if (strlen(quoted) + sizeof ", " > room) {
        list->left_out++;
    } else {
        snprintf(list->text + length, room, "%s%s", length > 0 ? ", " : "", quoted);
    }
}

const char *dip_name_list_end(DipNameList *list) {
    const size_t length = strlen(list->text);
    if (list->left_out > 0) {
        snprintf(list->text + length, sizeof list->text - length, " and %d more", list->left_out);
    }
    return list->text;
}
