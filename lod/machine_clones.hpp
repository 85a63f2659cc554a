#pragma once

// A function that is compiled for several machines; the program takes the version that suits the one it runs
// on. Thread sanitizers start after that choice is made and cannot bear it: there only one version is made.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__SANITIZE_THREAD__)
#define RELEVO_CLONES(...) gnu::target_clones(__VA_ARGS__)
#else
#define RELEVO_CLONES(...) gnu::hot
#endif
