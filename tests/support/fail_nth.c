/* Preloaded into a program: fails the n-th call of one kind, and all that follow it if asked to.
 *
 *   FAIL_CALL   malloc | open | write | rename | fsync | mkdir
 *   FAIL_AT     n, from 1; 0: none fails
 *   FAIL_ON     1: all calls from the n-th on (a disk that stays full)
 *   FAIL_NOT_IN parts of the names of libraries whose own calls are spared, one or two, with a comma between
 *   FAIL_COUNT  a file: their number is written there at the end
 *
 * Calls count from main() on: before, the loader and static constructors have no one to tell. Processes that the
 * program starts are left alone. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static atomic_long calls;
static long fail_at;
static int fails_on;
static char kind[16];
static char count_file[1024];
static atomic_int watching;

/* A call made by a library that takes no failure. */
static int is_spared(const void *caller) {
  static char spared[2][64];
  static int known = 0;
  Dl_info from;
  if (!known) {
    const char *names = getenv("FAIL_NOT_IN");
    if (names) sscanf(names, "%63[^,],%63s", spared[0], spared[1]);
    known = 1;
  }
  if (!spared[0][0] || !dladdr(caller, &from)) return 0;
  return strstr(from.dli_fname, spared[0]) || (spared[1][0] && strstr(from.dli_fname, spared[1]));
}

/* Whether this call of `name` is to fail. */
static int fails(const char *name, const void *caller) {
  if (!atomic_load(&watching) || strcmp(name, kind) != 0 || is_spared(caller)) return 0;
  const long n = atomic_fetch_add(&calls, 1) + 1;
  return fail_at > 0 && (n == fail_at || (fails_on && n > fail_at));
}

#define CALLER __builtin_return_address(0)
#define REAL(type, name, ...)                                       \
  static type (*real)(__VA_ARGS__);                                 \
  if (!real) real = (type(*)(__VA_ARGS__))dlsym(RTLD_NEXT, #name);

/* glibc's own names: dlsym() allocates. */
extern void *__libc_malloc(size_t);
extern void *__libc_calloc(size_t, size_t);
extern void *__libc_realloc(void *, size_t);
extern void *__libc_memalign(size_t, size_t);

static void *none(void) {
  errno = ENOMEM;
  return NULL;
}
void *malloc(size_t size) { return fails("malloc", CALLER) ? none() : __libc_malloc(size); }
void *calloc(size_t n, size_t size) { return fails("malloc", CALLER) ? none() : __libc_calloc(n, size); }
void *realloc(void *old, size_t size) { return fails("malloc", CALLER) ? none() : __libc_realloc(old, size); }
void *aligned_alloc(size_t to, size_t size) { return fails("malloc", CALLER) ? none() : __libc_memalign(to, size); }
/* That of the C library would allocate in its own name. */
char *strdup(const char *text) {
  if (fails("malloc", CALLER)) return none();
  const size_t size = strlen(text) + 1;
  char *copy = __libc_malloc(size);
  return copy ? memcpy(copy, text, size) : NULL;
}
int posix_memalign(void **result, size_t to, size_t size) {
  if (fails("malloc", CALLER)) return ENOMEM;
  *result = __libc_memalign(to, size);
  return *result ? 0 : ENOMEM;
}

static int failed(int code) {
  errno = code;
  return -1;
}
static mode_t mode_of(int flags, va_list rest) { return flags & (O_CREAT | O_TMPFILE) ? va_arg(rest, mode_t) : 0; }

int open(const char *path, int flags, ...) {
  va_list rest;
  va_start(rest, flags);
  const mode_t mode = mode_of(flags, rest);
  va_end(rest);
  if (fails("open", CALLER)) return failed(ENFILE);
  REAL(int, open, const char *, int, ...)
  return real(path, flags, mode);
}
int open64(const char *path, int flags, ...) {
  va_list rest;
  va_start(rest, flags);
  const mode_t mode = mode_of(flags, rest);
  va_end(rest);
  if (fails("open", CALLER)) return failed(ENFILE);
  REAL(int, open64, const char *, int, ...)
  return real(path, flags, mode);
}
FILE *fopen(const char *path, const char *mode) {
  if (fails("open", CALLER)) {
    errno = ENFILE;
    return NULL;
  }
  REAL(FILE *, fopen, const char *, const char *)
  return real(path, mode);
}
FILE *fopen64(const char *path, const char *mode) {
  if (fails("open", CALLER)) {
    errno = ENFILE;
    return NULL;
  }
  REAL(FILE *, fopen64, const char *, const char *)
  return real(path, mode);
}
/* Words to the user are not files. */
ssize_t write(int file, const void *from, size_t size) {
  if (file > 2 && fails("write", CALLER)) return failed(ENOSPC);
  REAL(ssize_t, write, int, const void *, size_t)
  return real(file, from, size);
}
struct iovec;
ssize_t writev(int file, const struct iovec *from, int n) {
  if (file > 2 && fails("write", CALLER)) return failed(ENOSPC);
  REAL(ssize_t, writev, int, const struct iovec *, int)
  return real(file, from, n);
}
ssize_t pwrite(int file, const void *from, size_t size, off_t at) {
  if (fails("write", CALLER)) return failed(ENOSPC);
  REAL(ssize_t, pwrite, int, const void *, size_t, off_t)
  return real(file, from, size, at);
}
ssize_t pwrite64(int file, const void *from, size_t size, off64_t at) {
  if (fails("write", CALLER)) return failed(ENOSPC);
  REAL(ssize_t, pwrite64, int, const void *, size_t, off64_t)
  return real(file, from, size, at);
}
size_t fwrite(const void *from, size_t size, size_t n, FILE *file) {
  if (file != stdout && file != stderr && fails("write", CALLER)) {
    errno = ENOSPC;
    return 0;
  }
  REAL(size_t, fwrite, const void *, size_t, size_t, FILE *)
  return real(from, size, n, file);
}
int rename(const char *from, const char *to) {
  if (fails("rename", CALLER)) return failed(EIO);
  REAL(int, rename, const char *, const char *)
  return real(from, to);
}
int fsync(int file) {
  if (fails("fsync", CALLER)) return failed(EIO);
  REAL(int, fsync, int)
  return real(file);
}
int mkdir(const char *path, mode_t mode) {
  if (fails("mkdir", CALLER)) return failed(EIO);
  REAL(int, mkdir, const char *, mode_t)
  return real(path, mode);
}

static void tell_count(void) {
  atomic_store(&watching, 0);
  FILE *file = count_file[0] ? fopen(count_file, "w") : NULL;
  if (!file) return;
  fprintf(file, "%ld\n", atomic_load(&calls));
  fclose(file);
}

typedef int (*Main)(int, char **, char **);
static Main main_of_program;

static int watched_main(int argc, char **argv, char **environment) {
  atexit(tell_count);
  atomic_store(&watching, kind[0] != 0);
  return main_of_program(argc, argv, environment);
}

typedef int (*Start)(Main, int, char **, Main, void (*)(void), void (*)(void), void *);
int __libc_start_main(Main program, int argc, char **argv, Main init, void (*fini)(void), void (*rtld_fini)(void),
                      void *end) {
  const char *call = getenv("FAIL_CALL");
  const char *at = getenv("FAIL_AT");
  const char *count = getenv("FAIL_COUNT");
  fails_on = getenv("FAIL_ON") != NULL;
  if (call) strncpy(kind, call, sizeof kind - 1);
  if (at) fail_at = atol(at);
  if (count) strncpy(count_file, count, sizeof count_file - 1);
  unsetenv("LD_PRELOAD");
  main_of_program = program;
  return ((Start)dlsym(RTLD_NEXT, "__libc_start_main"))(watched_main, argc, argv, init, fini, rtld_fini, end);
}
