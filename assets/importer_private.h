// What the program and its importer process agree on. Private to importer.c and importer_child.c.
//
// The importer's arguments are import_mark, those of IMPORT_ARGUMENT_LIST, the name of the
// animation or an empty text, those of IMPORT_RULE_ARGUMENT_LIST for each rule, and the model
// files. It inherits two files: the pack file, which it fills and seals, and the writing end of a
// pipe. At its end it writes one byte to the pipe: 0 if the pack is complete and sealed, otherwise
// the errno that says why there is no pack. If the importer ends earlier, the program finds the
// pipe closed.
#ifndef DIP_ASSETS_IMPORTER_PRIVATE_H
#define DIP_ASSETS_IMPORTER_PRIVATE_H

#include "assets/importer.h"

enum { IMPORT_PACK_FILE = 3, IMPORT_PIPE = 4 };

// The arguments before the files, as X(name). All are decimal numbers.
#define IMPORT_ARGUMENT_LIST(X)                                                                    \
    X(version)           /* IMPORT_VERSION */                                                      \
    X(program_id)        /* process id of the program */                                           \
    X(threads)           /* number of threads that decode pictures */                              \
    X(normal_maps)       /* 1: normal maps are loaded, 0: not */                                   \
    X(up)                /* a DipUpAxis */                                                         \
    X(rules)             /* number of rules that mark materials */                                 \
    X(flat)              /* 1: triangles of lit meshes get the normals of their faces, 0: not */   \
    X(has_light_scale)   /* 1: light_scale is given, 0: it is computed */                          \
    X(light_scale)       /* bits of a double */                                                    \
    X(animation)         /* a DipModelAnimation */                                                 \
    X(animation_is_held) /* 1: the animation stands still, 0: it plays */                          \
    X(animation_held_s)  /* bits of a double: where it stands still */                             \
    X(picture_only)      /* 1: the only file is a picture, 0: the files are models */              \
    X(memory_bytes)      /* limit of memory */                                                     \
    X(cpu_s)             /* limit of processor time */

typedef enum ImportArgument {
#define IMPORT_ARGUMENT_ENUM(name) IMPORT_ARGUMENT_##name,
    IMPORT_ARGUMENT_LIST(IMPORT_ARGUMENT_ENUM)
#undef IMPORT_ARGUMENT_ENUM
        IMPORT_ARGUMENT_COUNT
} ImportArgument;

// The arguments of a rule, as X(name). Texts that the rule lacks are empty.
#define IMPORT_RULE_ARGUMENT_LIST(X)                                                               \
    X(mark) /* a DipMaterialMark, decimal */                                                       \
    X(line) /* decimal */                                                                          \
    X(pattern)                                                                                     \
    X(light_map)                                                                                   \
    X(file)                                                                                        \
    X(key)

typedef enum ImportRuleArgument {
#define IMPORT_RULE_ENUM(name) IMPORT_RULE_##name,
    IMPORT_RULE_ARGUMENT_LIST(IMPORT_RULE_ENUM)
#undef IMPORT_RULE_ENUM
        IMPORT_RULE_ARGUMENT_COUNT
} ImportRuleArgument;

_Static_assert((int)IMPORT_RULE_ARGUMENT_COUNT == (int)DIP_IMPORTER_RULE_ARGUMENTS,
               "importer.h counts the arguments of a rule");

// Keeps a program that reads options from taking a file called "-x" for one. Such a program may
// remove this argument.
static const char import_mark[] = "--";

enum { IMPORT_VERSION = 4, IMPORT_NUMBER_BYTES = 24 };

// 1 in builds with a sanitizer. AddressSanitizer does not start in a process whose address space is
// limited, and it reports to the standard error output.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define IMPORT_IS_SANITIZED 1
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer) ||                         \
    __has_feature(memory_sanitizer)
#define IMPORT_IS_SANITIZED 1
#endif
#endif
#ifndef IMPORT_IS_SANITIZED
#define IMPORT_IS_SANITIZED 0
#endif

// Exit codes of the importer.
enum {
    IMPORT_EXIT_DONE = 0, // The pack is complete and sealed.
    IMPORT_EXIT_ARGUMENTS = DIP_IMPORTER_MISUSED,
    IMPORT_EXIT_LIMITS = 3,   // The process could not be limited.
    IMPORT_EXIT_NO_PACK = 4,  // The pack could not be written; the pipe has the reason.
    IMPORT_EXIT_ORPHANED = 5, // The program ended before the importer started.
};

#endif
