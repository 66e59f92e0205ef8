// Prints the manual page. Only the build runs this program.
#include "app/command_list.h"
#include "app/cli/help.h"
#include "app/cli/log.h"

int main(void) {
    dip_manual_print(&dip_command_list, stdout);
    return dip_output_finish(NULL) ? 0 : 1;
}
