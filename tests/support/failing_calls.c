// The calls that the linker's option --wrap redirects: each fails if allocation.c says so, and
// otherwise does what libc does.
#define _GNU_SOURCE
#include "tests/support/allocation_private.h"

#include <errno.h>
#include <pthread.h>
#include <spawn.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>

// --- blocks --------------------------------------------------------------------------------------

void *__real_malloc(size_t size);
void *__real_calloc(size_t count, size_t size);
void *__real_realloc(void *memory, size_t size);
void *__real_aligned_alloc(size_t alignment, size_t size);
int __real_posix_memalign(void **memory, size_t alignment, size_t size);
void __real_free(void *memory);
void *__wrap_malloc(size_t size);
void *__wrap_calloc(size_t count, size_t size);
void *__wrap_realloc(void *memory, size_t size);
void *__wrap_aligned_alloc(size_t alignment, size_t size);
int __wrap_posix_memalign(void **memory, size_t alignment, size_t size);
void __wrap_free(void *memory);
char *__wrap_strdup(const char *text);
char *__wrap_strndup(const char *text, size_t most);

void *__wrap_malloc(size_t size) {
    return dip_allocation_fails(ENOMEM) ? NULL : dip_allocation_hold(__real_malloc(size), size);
}

void *__wrap_calloc(size_t count, size_t size) {
    return dip_allocation_fails(ENOMEM)
               ? NULL
               : dip_allocation_hold(__real_calloc(count, size), count * size);
}

void *__wrap_aligned_alloc(size_t alignment, size_t size) {
    return dip_allocation_fails(ENOMEM)
               ? NULL
               : dip_allocation_hold(__real_aligned_alloc(alignment, size), size);
}

int __wrap_posix_memalign(void **memory, size_t alignment, size_t size) {
    if (dip_allocation_fails(ENOMEM)) {
        return ENOMEM;
    }
    const int failure = __real_posix_memalign(memory, alignment, size);
    if (!failure) {
        dip_allocation_hold(*memory, size);
    }
    return failure;
}

void *__wrap_realloc(void *memory, size_t size) {
    if (dip_allocation_fails(ENOMEM)) {
        return NULL;
    }
    const size_t old_size = dip_allocation_release(memory);
    void *moved = __real_realloc(memory, size);
    dip_allocation_hold(moved ? moved : memory, moved ? size : old_size);
    return moved;
}

void __wrap_free(void *memory) {
    dip_allocation_release(memory);
    __real_free(memory);
}

char *__wrap_strndup(const char *text, size_t most) {
    const size_t length = strnlen(text, most);
    char *copy = __wrap_malloc(length + 1);
    if (copy) {
        memcpy(copy, text, length);
        copy[length] = '\0';
    }
    return copy;
}

char *__wrap_strdup(const char *text) {
    return __wrap_strndup(text, strlen(text));
}

// --- streams -------------------------------------------------------------------------------------

FILE *__real_fopen(const char *file, const char *mode);
FILE *__real_fdopen(int file, const char *mode);
ssize_t __real_getline(char **line, size_t *room, FILE *stream);
FILE *__wrap_fopen(const char *file, const char *mode);
FILE *__wrap_fdopen(int file, const char *mode);
ssize_t __wrap_getline(char **line, size_t *room, FILE *stream);
FILE *__wrap_open_memstream(char **text, size_t *size);
DIR *__wrap_opendir(const char *folder);

FILE *__wrap_fopen(const char *file, const char *mode) {
    return dip_allocation_fails(ENOMEM) ? NULL : __real_fopen(file, mode);
}

FILE *__wrap_fdopen(int file, const char *mode) {
    return dip_allocation_fails(ENOMEM) ? NULL : __real_fdopen(file, mode);
}

DIR *__wrap_opendir(const char *folder) {
    return dip_allocation_fails(ENOMEM) ? NULL : __real_opendir(folder);
}

// Fails where libc allocates the buffer. Where libc lets it grow, this function does not fail.
ssize_t __wrap_getline(char **line, size_t *room, FILE *stream) {
    if (!*line && dip_allocation_fails(ENOMEM)) {
        return -1;
    }
    dip_allocation_release(*line);
    const ssize_t length = __real_getline(line, room, stream);
    dip_allocation_hold(*line, *room);
    return length;
}

// A stream into memory, like that of open_memstream, whose text is allocated here.
typedef struct Memstream {
    char **text;
    size_t *size;
    char *bytes;
    size_t used;
    size_t room;
} Memstream;

static ssize_t write_memstream(void *cookie, const char *bytes, size_t count) {
    Memstream *stream = cookie;
    if (stream->used + count + 1 > stream->room) {
        const size_t room = 2 * (stream->used + count + 1);
        char *grown = __wrap_realloc(stream->bytes, room);
        if (!grown) {
            return 0;
        }
        stream->bytes = grown;
        stream->room = room;
    }
    memcpy(stream->bytes + stream->used, bytes, count);
    stream->used += count;
    stream->bytes[stream->used] = '\0';
    *stream->text = stream->bytes;
    *stream->size = stream->used;
    return (ssize_t)count;
}

// glibc shrinks the text when the stream is closed. If this fails, it frees the text, sets the
// caller's pointer to NULL and reports no error.
static int close_memstream(void *cookie) {
    Memstream *stream = cookie;
    *stream->text = __wrap_realloc(stream->bytes, stream->used + 1);
    if (!*stream->text) {
        __wrap_free(stream->bytes);
    }
    *stream->size = stream->used;
    __wrap_free(stream);
    return 0;
}

FILE *__wrap_open_memstream(char **text, size_t *size) {
    Memstream *stream = __wrap_calloc(1, sizeof *stream);
    char *bytes = stream ? __wrap_calloc(1, 64) : NULL;
    FILE *file = NULL;
    if (bytes) {
        *stream = (Memstream){.text = text, .size = size, .bytes = bytes, .room = 64};
        file = fopencookie(
            stream, "w",
            (cookie_io_functions_t){.write = write_memstream, .close = close_memstream});
    }
    if (!file) {
        __wrap_free(bytes);
        __wrap_free(stream);
        return NULL;
    }
    setvbuf(file, NULL, _IONBF, 0); // Errors show at once, as with libc's own streams.
    return file;
}

// --- mappings, files in memory, threads and processes --------------------------------------------

void *__real_mmap(void *address, size_t size, int protection, int flags, int file, off_t offset);
int __real_munmap(void *address, size_t size);
int __real_memfd_create(const char *name, unsigned flags);
int __real_pipe(int ends[2]);
int __real_pipe2(int ends[2], int flags);
int __real_posix_spawn(pid_t *process, const char *program,
                       const posix_spawn_file_actions_t *actions,
                       const posix_spawnattr_t *attributes, char *const arguments[],
                       char *const environment[]);
int __real_posix_spawn_file_actions_addopen(posix_spawn_file_actions_t *actions, int file,
                                            const char *path, int flags, mode_t mode);
int __real_posix_spawn_file_actions_adddup2(posix_spawn_file_actions_t *actions, int from, int to);
int __real_pthread_create(pthread_t *thread, const pthread_attr_t *attributes,
                          void *(*main_function)(void *), void *argument);
int __real_pthread_join(pthread_t thread, void **result);
void *__wrap_mmap(void *address, size_t size, int protection, int flags, int file, off_t offset);
int __wrap_munmap(void *address, size_t size);
int __wrap_memfd_create(const char *name, unsigned flags);
int __wrap_pipe(int ends[2]);
int __wrap_pipe2(int ends[2], int flags);
int __wrap_posix_spawn(pid_t *process, const char *program,
                       const posix_spawn_file_actions_t *actions,
                       const posix_spawnattr_t *attributes, char *const arguments[],
                       char *const environment[]);
int __wrap_posix_spawn_file_actions_addopen(posix_spawn_file_actions_t *actions, int file,
                                            const char *path, int flags, mode_t mode);
int __wrap_posix_spawn_file_actions_adddup2(posix_spawn_file_actions_t *actions, int from, int to);
int __wrap_pthread_create(pthread_t *thread, const pthread_attr_t *attributes,
                          void *(*main_function)(void *), void *argument);
int __wrap_pthread_join(pthread_t thread, void **result);

void *__wrap_mmap(void *address, size_t size, int protection, int flags, int file, off_t offset) {
    if (dip_allocation_fails(ENOMEM)) {
        return MAP_FAILED;
    }
    void *region = __real_mmap(address, size, protection, flags, file, offset);
    return region == MAP_FAILED ? region : dip_allocation_hold(region, size);
}

int __wrap_munmap(void *address, size_t size) {
    dip_allocation_release(address);
    return __real_munmap(address, size);
}

int __wrap_memfd_create(const char *name, unsigned flags) {
    return dip_allocation_fails(ENOMEM) ? -1 : __real_memfd_create(name, flags);
}

int __wrap_pipe(int ends[2]) {
    return dip_allocation_fails(EMFILE) ? -1 : __real_pipe(ends);
}

int __wrap_pipe2(int ends[2], int flags) {
    return dip_allocation_fails(EMFILE) ? -1 : __real_pipe2(ends, flags);
}

int __wrap_posix_spawn(pid_t *process, const char *program,
                       const posix_spawn_file_actions_t *actions,
                       const posix_spawnattr_t *attributes, char *const arguments[],
                       char *const environment[]) {
    return dip_allocation_fails(EAGAIN)
               ? EAGAIN
               : __real_posix_spawn(process, program, actions, attributes, arguments, environment);
}

int __wrap_posix_spawn_file_actions_addopen(posix_spawn_file_actions_t *actions, int file,
                                            const char *path, int flags, mode_t mode) {
    return dip_allocation_fails(ENOMEM)
               ? ENOMEM
               : __real_posix_spawn_file_actions_addopen(actions, file, path, flags, mode);
}

int __wrap_posix_spawn_file_actions_adddup2(posix_spawn_file_actions_t *actions, int from, int to) {
    return dip_allocation_fails(ENOMEM)
               ? ENOMEM
               : __real_posix_spawn_file_actions_adddup2(actions, from, to);
}

int __wrap_pthread_create(pthread_t *thread, const pthread_attr_t *attributes,
                          void *(*main_function)(void *), void *argument) {
    if (dip_allocation_fails(EAGAIN)) {
        return EAGAIN;
    }
    const int failure = __real_pthread_create(thread, attributes, main_function, argument);
    dip_allocation_thread(failure == 0);
    return failure;
}

int __wrap_pthread_join(pthread_t thread, void **result) {
    dip_allocation_thread(-1);
    return __real_pthread_join(thread, result);
}
