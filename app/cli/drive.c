// Steps a timing driver (driver.h), shows how far the driver is, and stops after Ctrl-C or SIGTERM.
#include "app/cli/drive.h"

#include "app/cli/progress.h"

bool dip_drive(DipDriver *driver, const char *things, const char *command, const char *interrupted,
               DipError *err) {
    DipDriverProgress now = dip_driver_progress(driver);
    DipProgress progress = dip_progress_begin(things, now.total);
    DipDriverStep step = DIP_DRIVER_WORKING;
    bool searches = false; // True once the driver looks for disturbed frames, which a second line
                           // of progress shows.
    while (step < DIP_DRIVER_DONE && !dip_interrupted()) {
        step = dip_driver_step(driver, err);
        now = dip_driver_progress(driver);
        if (now.searched > 0 && !searches) {
            searches = true;
            dip_progress_end(&progress, now.drawn);
            progress = dip_progress_begin("rounds searched for disturbed frames to time again",
                                          now.all_rounds);
        }
        progress.total = searches ? now.all_rounds : now.total;
        dip_progress_show(&progress, searches ? now.searched : now.drawn);
    }
    dip_progress_end(&progress, searches ? now.searched : now.drawn);
    // Ctrl-C also ends child processes, so a frame may fail after Ctrl-C. The message then still
    // says only that the command was interrupted.
    return dip_interrupted()
               ? dip_error_set(err, DIP_ERROR_RUNTIME, NULL, 0, command, "%s", interrupted)
               : step == DIP_DRIVER_DONE;
}
