// DIP_API marks what a shared library exports. Everything else stays private to its library, so a
// caller that reaches past the public headers does not link.
#ifndef DIP_RENDERER_BASE_API_H
#define DIP_RENDERER_BASE_API_H

#if defined(__GNUC__)
#define DIP_API __attribute__((visibility("default")))
#else
#define DIP_API
#endif

#endif
