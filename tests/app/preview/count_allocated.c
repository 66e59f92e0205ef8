// Tells another program how many bytes a program has allocated. The library is preloaded into the
// program; a thread writes the number as text into the file that COUNT_ALLOCATED_FILE names, five
// times a second. With AddressSanitizer the number is the sum of all blocks' sizes as the program
// asked for them; otherwise it is the C library's sum, which also counts its own padding.
#include <fcntl.h>
#include <malloc.h>
#include <pthread.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>
#include <unistd.h>

enum { PERIOD_NS = 200000000 };

extern size_t __sanitizer_get_current_allocated_bytes(void) __attribute__((weak));

static size_t allocated_bytes(void) {
    if (__sanitizer_get_current_allocated_bytes) {
        return __sanitizer_get_current_allocated_bytes();
    }
    const struct mallinfo2 info = mallinfo2();
    return info.uordblks + info.hblkhd;
}

static void *count(void *argument) {
    const int file = (int)(intptr_t)argument;
    for (;;) {
        char text[32]; // Always of the same length, so that a reader never sees an old tail.
        const int length = snprintf(text, sizeof text, "%20zu\n", allocated_bytes());
        if (pwrite(file, text, (size_t)length, 0) != length) {
            return NULL;
        }
        const struct timespec period = {0, PERIOD_NS};
        nanosleep(&period, NULL);
    }
}

__attribute__((constructor)) static void begin(void) {
    const char *name = getenv("COUNT_ALLOCATED_FILE");
    const int file = name ? open(name, O_WRONLY | O_CREAT | O_CLOEXEC, 0600) : -1;
    pthread_t thread;
    // Programs that this program starts do not count.
    unsetenv("COUNT_ALLOCATED_FILE");
    unsetenv("LD_PRELOAD");
    if (file >= 0 && pthread_create(&thread, NULL, count, (void *)(intptr_t)file) == 0) {
        pthread_detach(thread);
    }
}
