// Gives files to a fuzzer's entry point, as libFuzzer does. The arguments are files and folders.
// Fails if the entry point refuses every file: then the corpus has an old format and tests nothing.
#include "tests/fuzz/fuzz.h"

#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

enum { MOST_BYTES = 1 << 24 };

static int accepted; // inputs for which the entry point has not returned -1

static bool replay_file(const char *path) {
    FILE *file = fopen(path, "rb");
    uint8_t *bytes = malloc(MOST_BYTES);
    if (!file || !bytes) {
        fprintf(stderr, "%s: cannot be read\n", path);
        return false;
    }
    const size_t size_bytes = fread(bytes, 1, MOST_BYTES, file);
    fclose(file);
    uint8_t *exact = fuzz_copy(bytes, size_bytes, false);
    free(bytes);
    printf("%s\n", path); // The last line names the input at fault.
    fflush(stdout);
    accepted += LLVMFuzzerTestOneInput(exact, size_bytes) == 0;
    free(exact);
    return true;
}

// Returns the number of files that were replayed, or -1 if one cannot be read.
static int replay_folder(const char *path) {
    DIR *listing = opendir(path);
    int count = 0;
    for (struct dirent *entry = listing ? readdir(listing) : NULL; entry && count >= 0;
         entry = readdir(listing)) {
        char name[4096];
        snprintf(name, sizeof name, "%s/%s", path, entry->d_name);
        if (entry->d_name[0] != '.') {
            count = replay_file(name) ? count + 1 : -1;
        }
    }
    if (listing) {
        closedir(listing);
    }
    return count;
}

int main(int argc, char **argv) {
#ifdef FUZZ_HAS_INITIALIZE
    LLVMFuzzerInitialize(&argc, &argv);
#endif
    int count = 0;
    for (int i = 1; i < argc; i++) {
        struct stat status;
        const bool is_folder = stat(argv[i], &status) == 0 && S_ISDIR(status.st_mode);
        const int more = is_folder ? replay_folder(argv[i]) : replay_file(argv[i]) ? 1 : -1;
        if (more < 0) {
            return 1;
        }
        count += more;
    }
    printf("%d inputs replayed, %d of them accepted\n", count, accepted);
    return accepted > 0 ? 0 : 1;
}
