// Lets assimp run under the memory sanitizer, in the wrappers that the linker puts before it.
#include <sanitizer/msan_interface.h>

// What assimp does with its own memory is not checked: its calls of strlen and the like read stacks
// that the sanitizer did not see being written.
#define UNCHECKED(type, name, parameters, arguments)                                               \
    type __real_##name parameters;                                                                 \
    type __wrap_##name parameters;                                                                 \
    type __wrap_##name parameters {                                                                \
        __msan_scoped_disable_interceptor_checks();                                                \
        type result = __real_##name arguments;                                                     \
        __msan_scoped_enable_interceptor_checks();                                                 \
        return result;                                                                             \
    }
UNCHECKED(int, aiIsExtensionSupported, (const char *extension), (extension))
UNCHECKED(const void *, aiImportFile, (const char *file, unsigned flags), (file, flags))
UNCHECKED(const void *, aiImportFileExWithProperties,
          (const char *file, unsigned flags, void *files, const void *properties),
          (file, flags, files, properties))
UNCHECKED(const void *, aiImportFileFromMemory,
          (const char *bytes, unsigned size_bytes, unsigned flags, const char *format),
          (bytes, size_bytes, flags, format))
UNCHECKED(const void *, aiApplyPostProcessing, (const void *scene, unsigned flags), (scene, flags))
UNCHECKED(int, aiExportScene,
          (const void *scene, const char *format, const char *file, unsigned flags),
          (scene, format, file, flags))

enum { STRING_BYTES = 1028 }; // Size of assimp's struct aiString.

// The text that assimp copies may have lain on a stack before.
int __real_aiGetMaterialString(const void *material, const char *key, unsigned type, unsigned index,
                               void *text);
int __wrap_aiGetMaterialString(const void *material, const char *key, unsigned type, unsigned index,
                               void *text);
int __wrap_aiGetMaterialString(const void *material, const char *key, unsigned type, unsigned index,
                               void *text) {
    const int result = __real_aiGetMaterialString(material, key, type, index, text);
    __msan_unpoison(text, STRING_BYTES);
    return result;
}
