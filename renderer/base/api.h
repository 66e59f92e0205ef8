// DIP_API marks what a shared library exports. Everything else stays private to its library, so a
// caller that reaches past the public headers does not link.
#ifndef DIP_RENDERER_BASE_API_H
#define DIP_RENDERER_BASE_API_H

#if defined(__GNUC__)
#define DIP_API __attribute__((visibility("default")))
#else
#define DIP_API
#endif

// DIP_NORETURN marks a function that does not return.
#if defined(__GNUC__)
#define DIP_NORETURN __attribute__((noreturn))
#else
#define DIP_NORETURN
#endif

// DIP_PRINTF(f, a) lets the compiler check the arguments of a function like printf: parameter f is
// the format, and the arguments begin with parameter a. Under MinGW, formats follow the C standard
// (__USE_MINGW_ANSI_STDIO), not Microsoft's C library.
#if defined(__MINGW32__)
#define DIP_PRINTF(format_index, first) __attribute__((format(gnu_printf, format_index, first)))
#elif defined(__GNUC__)
#define DIP_PRINTF(format_index, first) __attribute__((format(printf, format_index, first)))
#else
#define DIP_PRINTF(format_index, first)
#endif

#endif
